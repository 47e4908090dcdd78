"""Distributions of a campaign file: uniform and discrete distributions, and the reader of [draw.NAME]."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np
import scipy

from ....common.bounds import GRID_POINTS
from ....common.errors import InputError
from ...runtime.loop.elementary import elementary
from ..draws.generators import generator
from ..draws.interfaces import Columns, Continuous, Design, Distribution, Draw, Independent
from .normals import CorrelatedNormal, Normal
from .table import TomlTable, choice_of, integer, names, number, numbers

normal_distribution, normal_quantile = elementary("normal_distribution"), elementary("normal_quantile")


@dataclass(frozen=True)
class _Interval(Continuous):
    """Uniform value between ``low`` and ``high``: low + (high - low) Phi(u) for a standard normal value u."""

    low: float
    high: float
    keys: ClassVar = ("low", "high")

    @classmethod
    def read(cls, table: TomlTable) -> Self:
        """Return the distribution declared in its table of a campaign. Raises InputError."""
        table.only(["distribution", *cls.keys])
        return cls(*read_ends(table))

    @property
    def size(self) -> int:
        return 1

    def from_normals(self, u: np.ndarray) -> list[np.ndarray]:
        width = self.high - self.low
        # computed from the nearer end, so that rounding loses neither tail
        low, high = self.low + width * normal_distribution(u), self.high - width * normal_distribution(-u)
        return [np.where(u < 0.0, low, high)[:, 0]]

    def to_normals(self, columns: Sequence[np.ndarray]) -> np.ndarray:
        values, width = columns[0][:, np.newaxis], self.high - self.low
        low, high = (values - self.low) / width, (self.high - values) / width
        with np.errstate(invalid="ignore"):
            return np.where(low < high, normal_quantile(low), -normal_quantile(high))

    def from_box(self, points: np.ndarray, sigmas: float) -> list[np.ndarray]:
        return [self.low + (self.high - self.low) * points[:, 0]]

    def to_box(self, columns: Sequence[np.ndarray], sigmas: float) -> np.ndarray:
        return ((columns[0] - self.low) / (self.high - self.low))[:, np.newaxis]

    def ranges(self, sigmas: float) -> list[tuple[float, float]]:
        return [(self.low, self.high)]


class Uniform(_Interval, Independent):
    """Independent uniform values in [low, high)."""

    keyword = "uniform"

    def sample(self, trials: int, source: np.random.Generator) -> list[np.ndarray]:
        return [self.low + (self.high - self.low) * source.random(trials)]


class _UniformDesign(_Interval, Design):
    """Uniform values from a design of the complete table, from which blocks of trials are taken."""

    alternative: ClassVar[str] = Uniform.keyword

    @classmethod
    def design(cls, draws: Sequence[Draw], trials: int, seed: int, file: str) -> Callable[[range], Columns]:
        points = cls._points(draws, trials, seed, file)
        whole = {}
        for index, draw in enumerate(draws):
            interval = draw.distribution
            assert isinstance(interval, _Interval)  # true for all draws with this distribution
            whole[draw.name] = interval.low + (interval.high - interval.low) * points[index]
        return lambda part: {name: column[part.start : part.stop] for name, column in whole.items()}

    @classmethod
    def _points(cls, draws: Sequence[Draw], trials: int, seed: int, file: str) -> list[np.ndarray]:
        """Return numbers in [0, 1) for each draw, as an array (trials,)."""
        raise NotImplementedError


class LatinHypercube(_UniformDesign):
    """One value in each of n equal strata for n trials, shuffled independently for each draw."""

    keyword = "latin_hypercube"

    @classmethod
    def _points(cls, draws: Sequence[Draw], trials: int, seed: int, file: str) -> list[np.ndarray]:
        # a Latin hypercube has one such column for each dimension; separate streams keep them independent
        return [
            scipy.stats.qmc.LatinHypercube(1, rng=generator(seed, draw.name)).random(trials)[:, 0] for draw in draws
        ]


class Sobol(_UniformDesign):
    """One scrambled Sobol sequence with a dimension for each draw, in order of their names."""

    keyword = "sobol"

    @classmethod
    def _points(cls, draws: Sequence[Draw], trials: int, seed: int, file: str) -> list[np.ndarray]:
        if trials & (trials - 1):
            higher = 1 << trials.bit_length()
            problem = f"{trials} trials leave a Sobol sequence unbalanced"
            raise InputError(file, "trials", problem, f"use a power of two: {higher // 2} or {higher}")
        points = scipy.stats.qmc.Sobol(len(draws), scramble=True, rng=generator(seed, "design:sobol")).random(trials)
        return [points[:, index] for index in range(len(draws))]


def read_ends(table: TomlTable) -> tuple[float, float]:
    """Return the ends of an interval. Raises InputError."""
    low, high = table.get("low", number), table.get("high", number)
    if not math.isfinite(high - low):
        raise table.error(
            "high", f"{high!r} minus low = {low!r} exceeds the range of doubles", "give a smaller interval"
        )
    if not low < high:
        raise table.error("high", f"{high!r} is not above low = {low!r}", "give low < high, or fix the value in [set]")
    return low, high


@dataclass(frozen=True)
class Discrete(Distribution):
    """Distribution over a finite number of ``values``."""

    values: tuple[float, ...]


@dataclass(frozen=True)
class Choice(Discrete, Independent):
    """One of the values at random, with probabilities proportional to ``weights``."""

    weights: tuple[float, ...]
    keyword = "choice"
    keys: ClassVar = ("values", "weights")

    @classmethod
    def read(cls, table: TomlTable) -> Self:
        table.only(["distribution", *cls.keys])
        values = table.get("values", numbers)
        weights = table.get("weights", numbers, (1.0,) * len(values))
        if len(weights) != len(values):
            raise table.error(
                "weights", f"{len(weights)} weight(s) for {len(values)} value(s)", "give one weight per value"
            )
        if min(weights) < 0.0 or not sum(weights) > 0.0:
            raise table.error(
                "weights", "a weight is negative, or all weights are zero", "give weights >= 0 with a positive sum"
            )
        return cls(values, weights)

    def sample(self, trials: int, source: np.random.Generator) -> list[np.ndarray]:
        weights = np.array(self.weights)
        return [source.choice(np.array(self.values), trials, p=weights / weights.sum())]


@dataclass(frozen=True)
class Grid(Discrete, Design):
    """Every combination of the values of all grids, the last name varying fastest, repeated over the trials."""

    keyword = "grid"
    keys: ClassVar = ("values", "low", "high", "count")
    alternative: ClassVar[str] = Choice.keyword
    is_periodic: ClassVar[bool] = True

    @classmethod
    def read(cls, table: TomlTable) -> Self:
        """Return the grid declared in its table of a campaign: its values, or ``count`` values from low to high.

        Raises InputError.
        """
        table.only(["distribution", *cls.keys])
        if "values" in table.content:
            table.only(["distribution", "values"])
            return cls(table.get("values", numbers))
        count = table.get("count", integer)
        if count < 2:
            raise table.error(
                "count", f"{count} point(s)", "give at least 2 points; low and high are the first and the last"
            )
        GRID_POINTS.check(count, *table.where("count"))
        return cls(tuple(np.linspace(*read_ends(table), count).tolist()))

    @classmethod
    def design(cls, draws: Sequence[Draw], trials: int, seed: int, file: str) -> Callable[[range], Columns]:
        values = {draw.name: np.array(draw.distribution.arguments["values"]) for draw in draws}
        shape = [len(column) for column in values.values()]
        points = int(np.prod(shape, dtype=object))
        if trials % points:
            problem = f"{trials} trials do not fill a grid of {points} points"
            raise InputError(file, "trials", problem, f"use a multiple of {points}")

        def columns(part: range) -> Columns:
            indices = np.unravel_index(np.arange(part.start, part.stop) % points, shape)
            return {name: column[index] for (name, column), index in zip(values.items(), indices, strict=True)}

        return columns


KINDS = (Uniform, Normal, CorrelatedNormal, Choice, Grid, LatinHypercube, Sobol)
DISTRIBUTIONS = {kind.keyword: kind for kind in KINDS}


def read_draw(name: str, table: TomlTable) -> Draw:
    """Return the draw declared in the table [draw.NAME]. Raises InputError."""
    kind = DISTRIBUTIONS[table.get("distribution", choice_of(*DISTRIBUTIONS))]
    distribution = kind.read(table)
    return Draw(name, table.get("names", names) if kind is CorrelatedNormal else (name,), distribution)
