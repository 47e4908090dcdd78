"""What figures of its own a system asks for: plain values, as reading.py finds them in the SSD."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...flight.results import Flight
from ...system.units import Unit
from ..kit.quantities import shown_factor


@dataclass(frozen=True)
class Signal:
    """A Real or Integer scalar, or a vector of them, as a figure takes it.

    ``label`` is its name, ``names`` those of its elements in the record. A recorded value x of element k stands for
    ``factor`` * x + ``offsets[k]`` in ``unit``, None where there is none.
    """

    label: str
    names: tuple[str, ...]
    unit: Unit | None
    factor: float
    offsets: tuple[float, ...]

    def values(self, flight: Flight) -> np.ndarray:
        """Values in ``unit``, elements by rows of time; nan and infinite ones as they are."""
        recorded = np.stack([flight[name] for name in self.names])
        return self.factor * recorded + np.array(self.offsets)[:, None]

    def shown(self, flight: Flight) -> np.ndarray:
        """Values as they are drawn: angles in deg, nan for what is not finite."""
        values = self.values(flight)
        return np.where(np.isfinite(values), values, np.nan) * shown_factor(self.unit_name)

    @property
    def unit_name(self) -> str | None:
        return self.unit.name if self.unit is not None else None


@dataclass(frozen=True)
class Own:
    """What all figures have: ``title``; ``notes``: what they do without, since an FMU that was put in lacks it."""

    title: str
    notes: tuple[str, ...]


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


@dataclass(frozen=True)
class Undrawn(Own):
    """A figure that is asked for and cannot be had, since an FMU that was put in lacks what it is made of."""


Figure = Band | Pulses | Error | Undrawn
