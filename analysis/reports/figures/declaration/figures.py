"""The figures that a system can declare."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ....runtime.flight.results import Flight
from ...common.quantities import shown_factor
from .values import Arc, Own, Rows, Signal, Undrawn


@dataclass(frozen=True)
class Band(Own):
    """A signal that is to come into a band and stay: from ``low`` to ``high`` in its unit, None for no limit.

    ``name`` says in a word what it is when it has: "settled". ``about`` is what was subtracted, in the signal's unit;
    empty: nothing; ``less`` is a signal that is subtracted. ``labels`` name the elements of a vector. Where ``shade``
    is below ``shade_below`` the time is shaded; the signal is drawn against each of ``against``, too.
    """

    signal: Signal
    low: float | None
    high: float | None
    name: str
    about: tuple[float, ...]
    labels: tuple[str, ...]
    less: Signal | None = None
    shade: Signal | None = None
    shade_below: float = 0.0
    against: tuple[Signal, ...] = ()

    def values(self, flight: Flight) -> np.ndarray:
        """What is to come into the band, in the signal's unit, elements by rows of time."""
        values = self.signal.values(flight)
        return values if self.less is None else values - self.less.values(flight)

    def shown(self, flight: Flight) -> np.ndarray:
        """Likewise as it is drawn: angles in deg, nan for what is not finite."""
        values = self.values(flight)
        return np.where(np.isfinite(values), values, np.nan) * shown_factor(self.signal.unit_name)


@dataclass(frozen=True)
class Pulses(Own):
    """Pulses of jets: ``lengths`` with their sign (s), one for each axis, which start in the row and act after it.

    ``count`` tells new ones by its changes; None: every row has new ones. ``remainder`` (s, as many) is what was
    demanded and not fired, ``total`` what was spent so far.
    """

    lengths: Signal
    count: Signal | None
    remainder: Signal | None
    total: Signal | None
    labels: tuple[str, ...]


@dataclass(frozen=True)
class Error(Own):
    """An estimate less the truth, with the standard deviation that the estimator states, all in one unit.

    Where ``sigma`` is 0 none is stated. Shares of time within it are counted from ``after`` (s) on; None: the start.
    """

    estimate: Signal
    truth: Signal
    sigma: Signal | None
    after: float | None
    labels: tuple[str, ...]
    rows: Rows | None = None


@dataclass(frozen=True)
class Curve(Own):
    """Scalars of one unit over time, each in a panel of its own or all ``together``, by their ``labels``.

    ``low`` and ``high`` in their unit are drawn as lines, None for none.
    """

    signals: tuple[Signal, ...]
    labels: tuple[str, ...]
    low: float | None
    high: float | None
    together: bool
    rows: Rows | None


@dataclass(frozen=True)
class Point:
    """A position that two scalars name, in the units of the path."""

    x: Signal
    y: Signal
    name: str


@dataclass(frozen=True)
class Path(Own):
    """A scalar over another one or an arc; ``equal`` draws both to one scale. ``points`` are positions beside it."""

    x: Signal | Arc
    y: Signal
    equal: bool
    points: tuple[Point, ...]
    rows: Rows | None


LANDING = "landing"
# What a vector is measured by, as a number: its length, or the largest size of its elements.
MEASURES: Mapping[str, Callable[[np.ndarray], float]] = {
    "length": lambda vector: float(np.linalg.norm(vector)),
    "largest": lambda vector: float(np.max(np.abs(vector))),
}


@dataclass(frozen=True)
class Phase:
    """What the sequencer's ``value`` is called.

    Where several have one value they follow each other, and each but the last ends at the first row in which its
    ``until`` is not 0.
    """

    value: int
    name: str
    until: Signal | None


@dataclass(frozen=True)
class Phases(Own):
    """The phases that an Integer ``signal`` tells.

    What a phase uses up is by how much ``spent`` falls over it. ``status`` is an Integer whose first rises are marked;
    or the elements of ``status_times`` (s) are the times at which statuses 1, 2 ... were there first, below 0 for
    never. ``meanings`` say a status in words.
    """

    signal: Signal
    phases: tuple[Phase, ...]
    spent: Signal | None
    status: Signal | None
    status_times: Signal | None
    meanings: Mapping[int, str]


@dataclass(frozen=True)
class Limit:
    """What a number may be at the end of the run: from ``least`` to ``most`` in its unit, None for no limit.

    The number is the ``signal``, or the ``measure`` of it where it is a vector. ``less`` is a signal that is subtracted
    first, element by element; constants that are subtracted are in the signal's offsets.
    """

    signal: Signal
    name: str
    least: float | None
    most: float | None
    less: Signal | None = None
    measure: str | None = None

    def value(self, flight: Flight) -> float:
        """The number at the last row of a flight that has one."""
        last = self.signal.values(flight)[:, -1]
        if self.less is not None:
            last = last - self.less.values(flight)[:, -1]
        return MEASURES[self.measure](last) if self.measure is not None else float(last[0])


@dataclass(frozen=True)
class Limits(Own):
    """Limits that hold at the end of the run; with ``when`` only of a run at whose end this scalar is not 0."""

    limits: tuple[Limit, ...]
    when: Signal | None = None

    def obstacle(self, flight: Flight) -> str:
        """Why a flight cannot be held against them; empty where it can."""
        if not flight.complete:
            return f"the flight did not reach its end: {flight.status}"
        if self.when is not None and not self.when.values(flight)[0, -1]:
            value = "false" if flight.types[self.when.names[0]] == "Boolean" else "0"
            return f"{self.when.label} is {value} at the end"
        return ""


@dataclass(frozen=True)
class BoundValues:
    """What no flight can beat: propellant (kg) of braking and landing in one, `LANDING`, and of pieces of it, by
    ``names``; where the ``values`` are not there ``missing`` says why, and what to do.
    """

    names: tuple[str, ...]
    values: Mapping[str, float]
    missing: str = ""


@dataclass(frozen=True)
class Item:
    """A row of a budget: what ``phases`` used up, and numbers of the bound that are added and taken off."""

    name: str
    phases: tuple[str, ...]
    plus: tuple[str, ...]
    minus: tuple[str, ...]


@dataclass(frozen=True)
class Budget(Own):
    """What was used up, item by item, in ``unit``; ``of`` are the phases that the items name."""

    of: Phases
    items: tuple[Item, ...]
    bound: BoundValues | None


Figure = Band | Pulses | Error | Curve | Path | Phases | Limits | Budget | Undrawn
