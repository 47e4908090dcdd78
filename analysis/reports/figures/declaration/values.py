"""What all figures that a system asks for are made of: signals, some of their rows, a title."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....runtime.flight.results import Flight
from ....runtime.ssp.units import Unit
from ...common.quantities import shown_factor
from ...common.round_body import ground_range


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
class Arc:
    """How far along the ground a ``position`` is from the origin of its frame, see kit/round_body.py.

    The origin is on a sphere of ``radius`` (m) around (0, 0, -radius); the position has three elements in m.
    """

    position: Signal
    radius: float

    @property
    def label(self) -> str:
        return f"range of {self.position.label}"

    @property
    def unit_name(self) -> str:
        return "m"

    def shown(self, flight: Flight) -> np.ndarray:
        """In m, one row as of a scalar; nan for what is not finite."""
        return ground_range(self.position.shown(flight), self.radius)[None]


@dataclass(frozen=True)
class Own:
    """What all figures have: ``title``; ``notes``: what they do without, since an FMU that was put in lacks it."""

    title: str
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Rows:
    """The rows in which a scalar is from ``low`` to ``high``, in its own unit; None for no limit."""

    signal: Signal
    low: float | None
    high: float | None

    def chosen(self, flight: Flight) -> np.ndarray:
        """True for each of these rows."""
        values = self.signal.values(flight)[0]
        low, high = (-np.inf if self.low is None else self.low), (np.inf if self.high is None else self.high)
        return (values >= low) & (values <= high)


@dataclass(frozen=True)
class Undrawn(Own):
    """A figure that is asked for and cannot be had, since an FMU that was put in lacks what it is made of.

    ``has_limits`` says that it is one of `Limits`, which then nobody evaluates.
    """

    has_limits: bool = False
