"""System at an operating point, ready for excitation: its simulation, saved memory, and the size of each state."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from fractions import Fraction

import numpy as np

from ....common.errors import InputError, suggestion
from ....fmus_src.roles import SAMPLE_PERIOD
from ...runtime.flight.base_memory import MemoryCell
from ...runtime.flight.results import COMPLETE, NONFINITE
from ...runtime.process.opening import open_simulation
from ...runtime.ssp.parameter_values import ParameterValue
from ...runtime.system.prepared import PreparedSystem
from ..request.channels import Channel
from ..request.declaration import PointDeclaration
from ..results.requirement import MarginVerdict

LONGEST = 50_000  # communication points of a hyperperiod
LOOKS = 20  # number of communication points before the operating point at which magnitudes are evaluated
LEAST = 1e-6  # fraction of the largest number with the same unit; smaller numbers are rounding, or happen to be near 0
NEVER = 1e-3  # the same fraction for a vector that was always 0
NOTHING = 1e-9  # SI; a smaller number with a unit has not been used yet and determines no scale


class StudyError(RuntimeError):
    """Failure of a simulation that a study needs; the message explains it."""


class OverflowedError(StudyError):
    """Overflow of a simulation; ``signals`` contains the signals up to the overflow."""

    def __init__(self, message: str, signals: dict[str, np.ndarray]) -> None:
        super().__init__(message)
        self.signals = signals


class LoopError(StudyError):
    """Verdict on a loop without margins, with the reason as its message."""

    def __init__(self, message: str, verdict: MarginVerdict) -> None:
        super().__init__(message)
        self.verdict = verdict


class Bench:
    """Simulation of one operating point, with all connectors that are excited or read. Must be closed.

    ``period`` is the hyperperiod in communication points: the least common multiple of the sample periods of the
    channels and the FMUs. The operating point is at a multiple of it, and ``origin`` is the communication point before
    the operating point. ``varied`` names parameters that `set` may change, and ``recorded`` names further variables to
    return with the signals of the channels.
    """

    def __init__(
        self,
        prepared: PreparedSystem,
        point: PointDeclaration,
        channels: Sequence[Channel],
        varied: Sequence[str] = (),
        recorded: Sequence[str] = (),
    ) -> None:
        self.prepared = prepared
        self.point = point
        self.channels = tuple(channels)
        self.connectors = list(dict.fromkeys(name for channel in channels for name in channel.connectors))
        requested = {name for channel in channels for name in channel.recorded}
        if point.signal is not None:
            if point.signal not in prepared.network.nodes:
                known = suggestion(point.signal, prepared.network.nodes)
                raise InputError(prepared.network.file, f"point {point.name}", f"no signal {point.signal}", known)
            requested.add(point.signal)
        self.simulation = open_simulation(
            prepared, varied=varied, requested=requested, additional=recorded, excited=self.connectors, open_end=True
        )
        self.period = self._hyperperiod()
        self.origin = self._origin()

    @property
    def time(self) -> float:
        """Time of the operating point (s)."""
        return self.prepared.start + (self.origin + 1) * self.prepared.step

    @property
    def seconds(self) -> float:
        """Hyperperiod (s)."""
        return self.period * self.prepared.step

    def fly(self, first: int, last: int, excitation: np.ndarray | None = None) -> dict[str, np.ndarray]:
        """Return signals at points ``first`` + 1 to ``last`` (from point 0 if ``first`` is -1). Raises StudyError.

        ``excitation`` [r, connectors] begins at the operating point or, after it, at ``first`` + 1.
        """
        added = np.zeros((0, len(self.connectors))) if excitation is None else excitation
        if first < 0 and added.size:
            added = np.vstack([np.zeros((self.origin + 1, added.shape[1])), added])
        flight = self.simulation.advance(first, last, np.ascontiguousarray(added))
        if flight.status not in COMPLETE or flight.time.size < last - first:
            end = f"{flight.status} at t = {flight.time[-1]:g} s" if flight.time.size else flight.status
            reason = flight.message or "the system ended by itself"
            message = f"the simulation for point {self.point.name} ended early ({end}): {reason}"
            if flight.status == NONFINITE:
                raise OverflowedError(message, {name: values.copy() for name, values in flight.signals.items()})
            raise StudyError(message)
        return {name: values.copy() for name, values in flight.signals.items()}

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """Set varied parameters for later simulations, and find the operating point again."""
        self.simulation.set(values)
        self.origin = self._origin()

    def columns(self, channel: Channel) -> list[int]:
        return [self.connectors.index(name) for name in channel.connectors]

    def _hyperperiod(self) -> int:
        """Return the hyperperiod in communication points."""
        step = self.prepared.step
        period = math.lcm(*(channel.period for channel in self.channels), *self.prepared.periods.values())
        for component, fmu in self.prepared.network.fmus.items():
            variable = fmu.variables.get(SAMPLE_PERIOD)
            if variable is None:
                continue
            value = float(self.prepared.settings.variables.get((component, SAMPLE_PERIOD), variable.start_text))
            if value > 0.0:
                ratio = Fraction(value / step).limit_denominator(1000)
                period = math.lcm(period, max(1, ratio.numerator))
        if period > LONGEST:
            problem = f"the least common multiple of the sample periods, {period * step:g} s, is too long"
            raise InputError(
                self.prepared.network.file, SAMPLE_PERIOD, problem, "give periods with a shorter common multiple"
            )
        return period

    def _origin(self) -> int:
        step, start = self.prepared.step, self.prepared.start
        if self.point.signal is not None:
            flight = self.simulation.advance(-1, self.prepared.steps)
            values = flight.signals[self.point.signal]
            assert self.point.falls_to is not None
            below = np.flatnonzero(values <= self.point.falls_to)
            if not below.size and flight.status not in COMPLETE:
                raise StudyError(
                    f"the simulation to point {self.point.name} ended early: {flight.message or flight.status}"
                )
            if not below.size:
                problem = f"{self.point.signal} never falls to {self.point.falls_to:g}"
                raise InputError(self.prepared.network.file, f"point {self.point.name}", problem, "give another value")
            first = int(below[0])
        else:
            assert self.point.time is not None
            first = math.ceil((self.point.time - start) / step - 1e-6)
        periods = max(1, math.ceil(first / self.period))
        return periods * self.period - 1

    def close(self) -> None:
        self.simulation.close()


class OperatingPoint:
    """Bench simulated to its operating point, with its memory saved there.

    ``scale`` [cells] is the unit in which changes of each cell are measured. For a cell with a unit it is the largest
    absolute value that any cell of the same vector had on the way, at least the fraction LEAST of the largest value
    with this unit, or the fraction NEVER of the latter if the vector was always 0. Vectors without a unit, such as
    covariances, mix quantities: the scale of each of their cells is its present value. It is 1 if no scale can be
    determined. ``sizes`` are the largest absolute values of the signals at the cuts, by loop.
    """

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.memory = bench.simulation.memory()
        self.sizes: dict[str, float] = {}
        largest = np.zeros(len(self.memory.cells))
        last = -1
        for point in np.unique(np.linspace(0, bench.origin, LOOKS).astype(int)):
            signals = bench.fly(last, int(point))
            last = int(point)
            largest = np.maximum(largest, abs(self.memory.read()))
            for channel in bench.channels:
                size = float(np.max(abs(channel.injection_for(signals)), initial=0.0))
                self.sizes[channel.loop] = max(self.sizes.get(channel.loop, 0.0), size)
        self.snapshot = self.memory.save(last)
        self.sizes = {loop: size or 1.0 for loop, size in self.sizes.items()}
        self.scale = _scales(self.memory.cells, largest, self.memory.read())

    def advance_period(self) -> OperatingPoint:
        """Return the operating point one hyperperiod later, with the same scales; this one's snapshot is unchanged."""
        later = copy.copy(self)
        self.memory.restore(self.snapshot)
        last = self.snapshot.point + self.bench.period
        self.bench.fly(self.snapshot.point, last)
        later.snapshot = self.memory.save(last)
        return later

    def release(self) -> None:
        self.memory.release(self.snapshot)


def _scales(cells: list[MemoryCell], largest: np.ndarray, now: np.ndarray) -> np.ndarray:
    vectors: dict[str, float] = {}
    minimum: dict[str, float] = {}
    units: dict[str, float] = {}
    names = [cell.name.partition("[")[0] for cell in cells]
    for cell, name, size, present in zip(cells, names, largest, abs(now), strict=True):
        vectors[name] = max(vectors.get(name, 0.0), float(size))
        if present > 0.0:
            minimum[name] = min(minimum.get(name, np.inf), float(present))
        if cell.unit is not None:
            units[cell.unit] = max(units.get(cell.unit, 0.0), float(size))
    scales = []
    for cell, name, present in zip(cells, names, abs(now), strict=True):
        if cell.unit is None:
            scales.append(float(present) or minimum.get(name, 1.0))
            continue
        like = units[cell.unit]
        scale = max(vectors[name], LEAST * like) if vectors[name] > 0.0 else NEVER * like
        scales.append(scale if scale >= NOTHING else 1.0)
    return np.array(scales)
