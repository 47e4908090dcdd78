"""What all declared figures consist of: signals, selections of samples, a title."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...runtime.flight.results import Flight
from ...runtime.ssp.conversions import Unit
from ..common.quantities import display_factor
from ..common.round_body import ground_range


@dataclass(frozen=True)
class Signal:
    """A Real or Integer scalar, or a vector of them, in the unit of a figure.

    ``label`` is its name, ``names`` those of its elements in the record. A recorded value x of element k stands for
    ``factor`` * x + ``offsets[k]`` in ``unit``, None where there is none.
    """

    label: str
    names: tuple[str, ...]
    unit: Unit | None
    factor: float
    offsets: tuple[float, ...]

    def values(self, flight: Flight) -> np.ndarray:
        """Values in ``unit``, [elements, samples]; nan and infinite values unchanged."""
        recorded = np.stack([flight[name] for name in self.names])
        return self.factor * recorded + np.array(self.offsets)[:, None]

    def plot_values(self, flight: Flight) -> np.ndarray:
        """Values to be plotted: angles in deg, nan where not finite."""
        values = self.values(flight)
        return np.where(np.isfinite(values), values, np.nan) * display_factor(self.unit_name)

    @property
    def unit_name(self) -> str | None:
        return self.unit.name if self.unit is not None else None


@dataclass(frozen=True)
class Arc:
    """Ground range of a ``position`` from the origin of its frame, see common/round_body.py.

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

    def plot_values(self, flight: Flight) -> np.ndarray:
        """Values to be plotted, in m, as of a scalar; nan where not finite."""
        return ground_range(self.position.plot_values(flight), self.radius)[None]


@dataclass(frozen=True)
class BaseFigure:
    """The ``title`` of a figure, and ``notes`` on signals that are left out since a substituted FMU lacks them."""

    title: str
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Rows:
    """The samples in which a scalar is from ``low`` to ``high``, in its own unit; None for no limit."""

    signal: Signal
    low: float | None
    high: float | None

    def select(self, flight: Flight) -> np.ndarray:
        """Whether each sample is selected."""
        values = self.signal.values(flight)[0]
        low, high = (-np.inf if self.low is None else self.low), (np.inf if self.high is None else self.high)
        return (values >= low) & (values <= high)


@dataclass(frozen=True)
class Unavailable(BaseFigure):
    """A declared figure that cannot be plotted, since a substituted FMU lacks a signal of it.

    ``has_limits`` is true of `Limits`, which are then not evaluated.
    """

    has_limits: bool = False
