"""Figures of signals over time, or one over another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....runtime.flight.results import Flight
from ...common.quantities import shown_factor
from .values import Arc, Own, Rows, Signal


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
