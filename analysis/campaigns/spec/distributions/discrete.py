"""Single values: chosen at random, or every combination of a grid in turn."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from ....common.errors import InputError
from ...draws.declared import Columns, Design, Distribution, Draw, Independent
from ..toml.table import Table, integer, numbers
from .intervals import read_ends


@dataclass(frozen=True)
class Discrete(Distribution):
    """A distribution of the single ``values``."""

    values: tuple[float, ...]


@dataclass(frozen=True)
class Choice(Discrete, Independent):
    """One of the values at random, with probabilities in the ratio of ``weights``."""

    weights: tuple[float, ...]
    keyword = "choice"
    keys: ClassVar = ("values", "weights")

    @classmethod
    def read(cls, table: Table) -> Self:
        """From its table of a campaign. Raises InputError."""
        table.only(["distribution", *cls.keys])
        values = table.get("values", numbers)
        weights = table.get("weights", numbers, (1.0,) * len(values))
        if len(weights) != len(values):
            raise table.error("weights", f"{len(weights)} weight(s) for {len(values)} value(s)", "give one per value")
        if min(weights) < 0.0 or not sum(weights) > 0.0:
            raise table.error("weights", "negative, or all zero", "give weights >= 0 with a positive sum")
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
    def read(cls, table: Table) -> Self:
        """From its table of a campaign: its values, or ``count`` of them from low to high. Raises InputError."""
        table.only(["distribution", *cls.keys])
        if "values" in table.content:
            table.only(["distribution", "values"])
            return cls(table.get("values", numbers))
        count = table.get("count", integer)
        if count < 2:
            raise table.error("count", f"{count} point(s)", "give 2 or more, both ends included")
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
