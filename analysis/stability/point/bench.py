"""A system at an operating point, ready to be excited: where it starts, its rates, its flights."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction

import numpy as np

from ...common.errors import InputError, suggestion
from ...runtime.flight.results import COMPLETE
from ...runtime.flight.simulation import Simulation
from ...runtime.ssp.parameter_sets import ParameterValue
from ...runtime.system.prepared import PreparedSystem
from ..request.channels import Channel
from ..request.declaration import Point

LONGEST = 50_000  # communication points of a hyperperiod


class StudyError(RuntimeError):
    """A flight that a study needs broke off; the message says how."""


class Bench:
    """One operating point's simulation with everything that can be excited or is read.

    ``period`` is the hyperperiod in communication points: the least common multiple of the channels' and of the
    FMUs' sample periods. ``origin`` is the communication point just before the operating point, which is a
    multiple of it. ``varied`` names parameters that `set` may change. Use as a context manager.
    """

    def __init__(
        self, prepared: PreparedSystem, point: Point, channels: Sequence[Channel], varied: Sequence[str] = ()
    ) -> None:
        self.prepared = prepared
        self.point = point
        self.channels = tuple(channels)
        self.connectors = list(dict.fromkeys(name for channel in channels for name in channel.connectors))
        wanted = {name for channel in channels for name in channel.recorded}
        if point.signal is not None:
            if point.signal not in prepared.network.nodes:
                known = suggestion(point.signal, prepared.network.nodes)
                raise InputError(prepared.network.file, f"point {point.name}", f"no signal {point.signal}", known)
            wanted.add(point.signal)
        self.simulation = Simulation(prepared, varied=varied, wanted=wanted, excited=self.connectors)
        self.period = self._hyperperiod()
        self.origin = self._origin()

    @property
    def time(self) -> float:
        """Time of the operating point (s)."""
        return self.prepared.start + (self.origin + 1) * self.prepared.step

    @property
    def seconds(self) -> float:
        """The hyperperiod (s)."""
        return self.period * self.prepared.step

    def fly(self, first: int, last: int, excitation: np.ndarray | None = None) -> dict[str, np.ndarray]:
        """Signals at points first + 1 to last (from 0 on with ``first`` -1). Raises StudyError.

        ``excitation`` [r, connectors] begins at the operating point or, behind it, at ``first`` + 1.
        """
        added = np.zeros((0, len(self.connectors))) if excitation is None else excitation
        if first < 0 and added.size:
            added = np.vstack([np.zeros((self.origin + 1, added.shape[1])), added])
        flight = self.simulation.advance(first, last, np.ascontiguousarray(added))
        if flight.status not in COMPLETE or flight.time.size < last - first:
            end = f"{flight.status} at t = {flight.time[-1]:g} s" if flight.time.size else flight.status
            reason = flight.message or "the system ended by itself"
            raise StudyError(f"the flight for point {self.point.name} ended early ({end}): {reason}")
        return {name: values.copy() for name, values in flight.signals.items()}

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """Give varied parameters other values for the flights that follow, and find the operating point again."""
        self.simulation.set(values)
        self.origin = self._origin()

    def columns(self, channel: Channel) -> list[int]:
        """Columns of the excitation that belong to a channel."""
        return [self.connectors.index(name) for name in channel.connectors]

    def _hyperperiod(self) -> int:
        """In communication points."""
        step = self.prepared.step
        period = math.lcm(*(channel.period for channel in self.channels), *self.prepared.periods.values())
        for component, fmu in self.prepared.network.fmus.items():
            variable = fmu.variables.get("sample_period")
            if variable is None:
                continue
            value = float(self.prepared.settings.variables.get((component, "sample_period"), variable.start))
            if value > 0.0:
                ratio = Fraction(value / step).limit_denominator(1000)
                period = math.lcm(period, max(1, ratio.numerator))
        if period > LONGEST:
            problem = f"the sample periods fit together only every {period * step:g} s"
            raise InputError(
                self.prepared.network.file, "sample_period", problem, "give periods with a common multiple"
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
                    f"the flight to point {self.point.name} ended early: {flight.message or flight.status}"
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

    def __enter__(self) -> Bench:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
