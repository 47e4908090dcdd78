"""Figures that a system can declare, and their elements: signals, selections of samples, titles."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from ...runtime.flight.results import Flight
from ...runtime.ssp.conversions import Unit
from ..common.quantities import display_factor
from ..common.round_body import downrange


@dataclass(frozen=True)
class Signal:
    """A Real or Integer scalar, or a vector of Reals or Integers, in the unit of a figure.

    ``label`` is its name on pages, ``names`` are the recorded names of its elements. A recorded value x of element k is
    ``factor`` * x + ``offsets[k]`` in ``unit`` (None: without unit).
    """

    label: str
    names: tuple[str, ...]
    unit: Unit | None
    factor: float
    offsets: tuple[float, ...]

    def values(self, flight: Flight) -> np.ndarray:
        """Return values in ``unit``, [elements, samples], including non-finite ones."""
        recorded = np.stack([flight[name] for name in self.names])
        return self.factor * recorded + np.array(self.offsets)[:, None]

    def plot_values(self, flight: Flight) -> np.ndarray:
        """Return values to plot: angles in deg, NaN where not finite."""
        values = self.values(flight)
        return np.where(np.isfinite(values), values, np.nan) * display_factor(self.unit_name)

    @property
    def unit_name(self) -> str | None:
        return self.unit.name if self.unit is not None else None


@dataclass(frozen=True)
class Arc:
    """Downrange distance of a ``position`` from the origin of its frame; see common/round_body.py.

    The origin is on a sphere of ``radius`` (m) around (0, 0, -radius); the position has three elements in m.
    """

    position: Signal
    radius: float

    @property
    def label(self) -> str:
        return f"downrange of {self.position.label}"

    @property
    def unit_name(self) -> str:
        return "m"

    def plot_values(self, flight: Flight) -> np.ndarray:
        """Return values to plot, in m, [1, samples]; NaN where not finite."""
        return downrange(self.position.plot_values(flight), self.radius)[None]


@dataclass(frozen=True)
class GroupDeclaration:
    """Figures under a common heading ``title``, which a page shows immediately or folded."""

    title: str
    is_folded: bool


@dataclass(frozen=True)
class FigureDeclaration:
    """The ``title`` of a figure, and ``notes`` on signals omitted because a substituted FMU lacks them.

    ``group`` is None for figures under the system's name.
    """

    title: str
    notes: tuple[str, ...]
    group: GroupDeclaration | None = field(default=None, kw_only=True)


@dataclass(frozen=True)
class SampleRange:
    """The samples in which a scalar is between ``low`` and ``high`` (None: no limit) in its unit."""

    signal: Signal
    low: float | None
    high: float | None

    def select(self, flight: Flight) -> np.ndarray:
        """Return True for each selected sample, [samples]."""
        values = self.signal.values(flight)[0]
        low, high = (-np.inf if self.low is None else self.low), (np.inf if self.high is None else self.high)
        return (values >= low) & (values <= high)


@dataclass(frozen=True)
class UnavailableFigure(FigureDeclaration):
    """A declared figure that cannot be plotted because a substituted FMU lacks one of its signals.

    ``has_limits`` is True for a `LimitsFigure`, whose limits are then not evaluated.
    """

    has_limits: bool = False


@dataclass(frozen=True)
class BandFigure(FigureDeclaration):
    """A signal with a tolerance band from ``low`` to ``high`` (None: no limit) in its unit.

    ``name`` describes a signal within the band: "settled". ``about`` are constants already subtracted, in the signal's
    unit, if any; ``less`` is a signal to subtract. ``labels`` name the elements of a vector. Times at which ``shade``
    is below ``shade_below`` are shaded; the signal is also plotted against each signal in ``against``.
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
        """Return the values to compare with the band, in the signal's unit, [elements, samples]."""
        values = self.signal.values(flight)
        return values if self.less is None else values - self.less.values(flight)

    @property
    def line_names(self) -> tuple[str, ...]:
        """The names of the plotted elements; a scalar has the signal's name unless something is subtracted."""
        if len(self.labels) > 1:
            return self.labels
        is_signal = self.less is None and not any(self.signal.offsets)
        return (self.signal.label if is_signal else f"{self.title} {self.labels[0]}".rstrip(),)

    def plot_values(self, flight: Flight) -> np.ndarray:
        """Return the values to plot: angles in deg, NaN where not finite."""
        values = self.values(flight)
        return np.where(np.isfinite(values), values, np.nan) * display_factor(self.signal.unit_name)


@dataclass(frozen=True)
class PulsesFigure(FigureDeclaration):
    """Pulses of jets: signed ``lengths`` (s), one per axis; a pulse starts at its sample.

    A change of ``count`` signals new pulses; if it is None, every sample has new ones. ``remainder`` (s, one per axis)
    is the pulse length demanded but not fired, and ``total`` is the thruster on-time so far.
    """

    lengths: Signal
    count: Signal | None
    remainder: Signal | None
    total: Signal | None
    labels: tuple[str, ...]


@dataclass(frozen=True)
class ErrorFigure(FigureDeclaration):
    """An estimate minus the truth, with the standard deviation that the estimator reports, all in one unit.

    The error is not evaluated where ``sigma`` is 0. Fractions of time within sigma count from ``after`` (s; None: the
    start).
    """

    estimate: Signal
    truth: Signal
    sigma: Signal | None
    after: float | None
    labels: tuple[str, ...]
    rows: SampleRange | None = None


@dataclass(frozen=True)
class CurveFigure(FigureDeclaration):
    """Scalars of one unit over time with their ``labels``, each in a separate panel or all ``together``.

    ``low`` and ``high`` are drawn as lines (None: no line).
    """

    signals: tuple[Signal, ...]
    labels: tuple[str, ...]
    low: float | None
    high: float | None
    together: bool
    rows: SampleRange | None


@dataclass(frozen=True)
class PathPoint:
    """A position of two scalars, in the units of the path."""

    x: Signal
    y: Signal
    name: str


@dataclass(frozen=True)
class PathFigure(FigureDeclaration):
    """A scalar over another scalar or an arc, on ``equal`` scales if requested; ``points`` are further positions."""

    x: Signal | Arc
    y: Signal
    equal: bool
    points: tuple[PathPoint, ...]
    rows: SampleRange | None


LANDING = "landing"
# Norms of a vector: its length, or the largest magnitude of its elements.
MEASURES: Mapping[str, Callable[[np.ndarray], float]] = {
    "length": lambda vector: float(np.linalg.norm(vector)),
    "largest": lambda vector: float(np.max(np.abs(vector))),
}


@dataclass(frozen=True)
class SequencerPhase:
    """The name of a sequencer's phase with this ``value``.

    If consecutive phases have the same value, each of them but the last ends at the first sample at which its ``until``
    is not 0.
    """

    value: int
    name: str
    until: Signal | None


@dataclass(frozen=True)
class PhasesFigure(FigureDeclaration):
    """The phases identified by an Integer ``signal``.

    The consumption of a phase is the decrease of ``spent`` during it. ``status`` is an Integer whose first occurrences
    of higher values are marked; alternatively the elements of ``status_times`` (s) are the times at which statuses 1,
    2, ... first occurred, negative for never. ``meanings`` are the texts of statuses.
    """

    signal: Signal
    phases: tuple[SequencerPhase, ...]
    spent: Signal | None
    status: Signal | None
    status_times: Signal | None
    meanings: Mapping[int, str]


@dataclass(frozen=True)
class Limit:
    """The permitted range of a final value: ``least`` to ``most`` (None: no limit) in its unit.

    The value is the ``signal``, or the ``measure`` of a vector. ``less`` is a signal that is first subtracted element
    by element; constants to subtract are in the signal's offsets.
    """

    signal: Signal
    name: str
    least: float | None
    most: float | None
    less: Signal | None = None
    measure: str | None = None

    def value(self, flight: Flight) -> float:
        """Return the value at the last sample of a run with samples."""
        last = self.signal.values(flight)[:, -1]
        if self.less is not None:
            last = last - self.less.values(flight)[:, -1]
        return MEASURES[self.measure](last) if self.measure is not None else float(last[0])


@dataclass(frozen=True)
class LimitsFigure(FigureDeclaration):
    """Limits on final values; with ``when`` only for a run at whose end this scalar is not 0."""

    limits: tuple[Limit, ...]
    when: Signal | None = None

    def obstacle(self, flight: Flight) -> str:
        """Return the reason why the limits of a run cannot be evaluated; empty if they can."""
        if not flight.complete:
            return f"the flight did not reach its end: {flight.status}"
        if self.when is not None and not self.when.values(flight)[0, -1]:
            value = "false" if flight.types[self.when.names[0]] == "Boolean" else "0"
            return f"{self.when.label} is {value} at the end"
        return ""


@dataclass(frozen=True)
class BoundValues:
    """Lower bounds on propellant (kg) by ``names``: of single-burn braking and landing, `LANDING`, and of phases.

    Without ``values``, ``missing`` states the reason and a remedy.
    """

    names: tuple[str, ...]
    values: Mapping[str, float]
    missing: str = ""


@dataclass(frozen=True)
class BudgetItem:
    """A row of a budget: consumption of ``phases``, plus the bound's values ``plus``, minus its values ``minus``."""

    name: str
    phases: tuple[str, ...]
    plus: tuple[str, ...]
    minus: tuple[str, ...]


@dataclass(frozen=True)
class BudgetFigure(FigureDeclaration):
    """Consumption by item; ``of`` are the phases that the items refer to."""

    of: PhasesFigure
    items: tuple[BudgetItem, ...]
    bound: BoundValues | None
