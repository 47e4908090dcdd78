"""Interfaces for sampling a campaign: draws with their distributions, and derived values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import ClassVar, Protocol, TypeAlias

import numpy as np

Columns = dict[str, np.ndarray]
Argument: TypeAlias = "float | tuple[Argument, ...]"


class Distribution(ABC):
    """Distribution with its arguments, which are the fields of a frozen dataclass under the keys of the file.

    ``keyword`` is the name of the distribution in a campaign's file; ``size`` is the number of its independent
    coordinates, 0 if it is discrete.
    """

    keyword: ClassVar[str]

    @property
    def size(self) -> int:
        return 0

    @property
    def arguments(self) -> dict[str, Argument]:
        """Arguments, floats or tuples of floats, under the keys of the campaign file."""
        return {each.name: getattr(self, each.name) for each in fields(self)}  # type: ignore[arg-type]

    def describe(self) -> str:
        """Return the arguments as text, with long lists shortened."""
        return ", ".join(f"{key} {_number_text(value)}" for key, value in self.arguments.items())


class Independent(Distribution):
    """Distribution with trials that are independent of each other."""

    @abstractmethod
    def sample(self, trials: int, source: np.random.Generator) -> list[np.ndarray]:
        """Draw the next ``trials`` values from a random stream; return an array (trials,) for each name of the draw.

        The values do not depend on how trials are divided into blocks.
        """


class Design(Distribution):
    """Distribution that is sampled by a single design of all trials, for all draws with this distribution together.

    ``alternative`` is the distribution with independent trials. If ``is_periodic``, any block of trials can be drawn
    without the other blocks.
    """

    alternative: ClassVar[str]
    is_periodic: ClassVar[bool] = False

    @classmethod
    @abstractmethod
    def design(cls, draws: Sequence[Draw], trials: int, seed: int, file: str) -> Callable[[range], Columns]:
        """Return a function that maps a range of trials to columns; ``draws`` are in order of name.

        Raises InputError.
        """


class Continuous(Distribution):
    """Distribution with coordinates: independent standard normal variables (points, size), or a unit cube.

    The cube spans intervals, and normal distributions within ``sigmas`` standard deviations along their axes. Columns
    are arrays (points,), one for each name of the draw.
    """

    @abstractmethod
    def from_normals(self, u: np.ndarray) -> list[np.ndarray]:
        """Return columns for standard normal values ``u`` (points, size), by the isoprobabilistic transformation."""

    @abstractmethod
    def to_normals(self, columns: Sequence[np.ndarray]) -> np.ndarray:
        """Return the inverse of `from_normals`, which is infinite at the ends of an interval."""

    @abstractmethod
    def from_box(self, points: np.ndarray, sigmas: float) -> list[np.ndarray]:
        """Return columns for ``points`` (points, size) in the unit cube."""

    @abstractmethod
    def to_box(self, columns: Sequence[np.ndarray], sigmas: float) -> np.ndarray:
        """Return the inverse of `from_box`, which is below 0 or above 1 outside the box."""

    @abstractmethod
    def ranges(self, sigmas: float) -> list[tuple[float, float]]:
        """Return minimum and maximum of each column in the box; correlated columns do not reach them jointly."""


@dataclass(frozen=True)
class Draw:
    """Dispersed input: the names of the values that it draws, and their distribution.

    ``names`` contains only the draw's name, except for correlated_normal, which draws several values. A value with a
    dot in its name is a component's parameter; other values are only for [derive] and the metrics.
    """

    name: str
    names: tuple[str, ...]
    distribution: Distribution


class Formula(Protocol):
    """Expression over draws; ``where`` (file, element) is named in errors."""

    @property
    def text(self) -> str: ...
    @property
    def where(self) -> tuple[str, str]: ...
    @property
    def names(self) -> frozenset[str]: ...
    def evaluate(self, values: Mapping[str, np.ndarray | float]) -> float | np.ndarray: ...


class Numbers(Protocol):
    """Named numbers for each trial that are not drawn."""

    @property
    def name(self) -> str: ...
    def numbers_of(self, trials: range) -> np.ndarray: ...


class CampaignDraws(Protocol):
    """Properties of a campaign that determine its samples.

    ``derived`` are formulas over draws and earlier derived values.
    """

    @property
    def file(self) -> str: ...
    @property
    def trials(self) -> int: ...
    @property
    def seed(self) -> int: ...
    @property
    def draws(self) -> Sequence[Draw]: ...
    @property
    def derived(self) -> Mapping[str, Formula]: ...
    @property
    def lookups(self) -> Sequence[Numbers]: ...


def input_names(campaign: CampaignDraws) -> list[str]:
    """Return the names of the drawn values, in order."""
    return [name for draw in campaign.draws for name in draw.names]


def designs_of(draws: Sequence[Draw]) -> dict[type[Design], list[Draw]]:
    """Return the draws of each kind of design, in order."""
    groups: dict[type[Design], list[Draw]] = {}
    for draw in draws:
        if isinstance(draw.distribution, Design):
            groups.setdefault(type(draw.distribution), []).append(draw)
    return groups


def _number_text(value: Argument) -> str:
    """Format a number, or a list of numbers in brackets, shortened if it is long."""
    if not isinstance(value, tuple):
        return f"{value:.10g}"
    inner = [_number_text(entry) for entry in value]
    return f"[{', '.join(inner if len(inner) <= 12 else [*inner[:5], '…', *inner[-2:]])}]"
