"""One operating point: its bench, linear model and loops, and the validity of the frozen-time linearisation."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from ....common.errors import InputError
from ..loops.disk import joint_disk_margin
from ..loops.margin_values import UNSTABLE, LoopMargins, MarginQuantity
from ..loops.readings import decibel_size, degree_size
from ..request.channels import Channel, channels_of
from ..request.declaration import LoopDeclaration, MarginLimits, PointDeclaration
from ..request.request import Subject
from ..results.report import JointReport, PointReport
from ..results.requirement import MarginRequirement, Scope
from .assessment import lowest_frequency
from .bench import Bench, OperatingPoint, StudyError
from .jacobian import STEPS
from .linearise import Linearisation, linearise
from .loop_study import LoopStudy
from .open_loop import open_loop
from .responses import ONE_STEP, LoopModel, loop_model

MOST_TRIM = 8  # number of cells that change most
TENTH = 0.1  # relative change of L at which the frozen-time linearisation is no longer valid


class PointStudy:
    """Loops of one operating point. A context manager."""

    def __init__(
        self, subject: Subject, point: PointDeclaration, loops: Sequence[LoopDeclaration], varied: Sequence[str] = ()
    ) -> None:
        self.point, self.loops = point, tuple(loops)
        self.prepared = subject.at(point)
        channels = [
            channel for loop in loops for channel in channels_of(loop, self.prepared.network, self.prepared.step)
        ]
        self.bench = Bench(self.prepared, point, channels, varied)
        self.linear: Linearisation | None = None
        self.why_not = ""
        self._start: OperatingPoint | None = None
        self._models: dict[str, LoopModel] = {}

    @property
    def channels(self) -> tuple[Channel, ...]:
        return self.bench.channels

    def linearise(self, cells: Sequence[int] | None = None, steps: Sequence[float] = STEPS) -> None:
        """Linearise, or note why this is impossible; ``cells`` and ``steps`` are as in `linearise`."""
        try:
            self._start = OperatingPoint(self.bench)
            self.linear = linearise(self._start, cells, steps)
        except (InputError, StudyError) as error:
            self.why_not = str(error)

    def model(self, channel: Channel) -> LoopModel | None:
        """Return the linearisation of one channel, or None."""
        if self.linear is None:
            return None
        if channel.name not in self._models:
            port = next(port for port in self.linear.model.ports if port.channel is channel)
            self._models[channel.name] = loop_model(self.linear, port)
        return self._models[channel.name]

    def margins(self, states: Sequence[int], names: Sequence[str]) -> list[LoopMargins]:
        """Return margins of channels by name, for known relevant memory cells. Raises StudyError."""
        self.linearise(states, ONE_STEP)
        if self.linear is None:
            raise StudyError(self.why_not)
        ports = {port.channel.name: port for port in self.linear.model.ports}
        return [loop_model(self.linear, ports[name]).margins() for name in names]

    def loop_study(self, channel: Channel, limits: MarginLimits) -> LoopStudy:
        notes = {} if self.linear is not None else {"linearisation": self.why_not}
        return LoopStudy(self.bench, channel, self.model(channel), limits, notes)

    def report(self) -> PointReport:
        """Return the report on the point, with the change of the memory over a further hyperperiod."""
        drift = holds = None
        trim: tuple[tuple[str, float, float, str | None], ...] = ()
        if self.linear is not None:
            trim = tuple(self.linear.drift[:MOST_TRIM])
            with suppress(StudyError):
                drift = self._drift()
                holds = TENTH / drift * self.bench.seconds if drift > 0.0 else float("inf")
        options = self.prepared.options
        return PointReport(
            name=self.point.name,
            phase=self.point.phase,
            time=self.bench.time,
            settings={
                **{slot: options.use[slot] for slot in self.point.layer.use},
                **dict.fromkeys(self.point.layer.parameters, "parameter set"),
                **{name: options.set[name] for name in self.point.layer.set},
            },
            trim=trim,
            drift=drift,
            holds=holds,
        )

    def _drift(self) -> float:
        """Return the largest relative change of a loop's L near its crossovers over one hyperperiod."""
        assert self.linear is not None
        assert self._start is not None
        start = self._start.advance_period()
        try:
            later = linearise(start, self.linear.cells)
        finally:
            start.release()
        worst = 0.0
        for before, after in zip(self.linear.model.ports, later.model.ports, strict=True):
            frequency = np.geomspace(1e-3, 1.0, 60) * np.pi / before.seconds
            first = self.linear.model.reduce((before,)).response((before,), frequency)[:, 0, 0]
            second = later.model.reduce((after,)).response((after,), frequency)[:, 0, 0]
            near = (abs(first) > 0.1) & (abs(first) < 10.0)
            worst = max(worst, float(np.max(abs(second[near] / first[near] - 1.0), initial=0.0)))
        return worst

    def joint(self, loop: LoopDeclaration, limits: MarginLimits) -> JointReport | None:
        """Return the report on all channels of a loop at once, None for a single channel or without a linear model.

        Raises StudyError if the margin is not resolved over frequency.
        """
        if self.linear is None:
            return None
        ports = tuple(port for port in self.linear.model.ports if port.channel.loop == loop.name)
        if len(ports) < 2:
            return None
        model = self.linear.model.reduce(ports)
        seconds = ports[0].seconds
        low = lowest_frequency(lambda frequency: model.response(ports, frequency)[:, 0, 0], seconds)
        try:
            margin = joint_disk_margin(lambda frequency: model.response(ports, frequency), low, np.pi / seconds)
        except ValueError as error:
            raise StudyError(str(error)) from error
        models = [item for port in ports if (item := self.model(port.channel)) is not None]
        stable = all(item.stable for item in models)
        required = {
            MarginQuantity.DISK_GAIN: (decibel_size(margin.gain), limits.dispersed_gain_margin_db),
            MarginQuantity.DISK_PHASE: (degree_size(margin.phase), limits.dispersed_phase_margin_deg),
        }
        return JointReport(
            name=loop.name,
            point=self.point.name,
            channels=tuple(port.channel.name for port in ports),
            stable=stable,
            disk_margin=margin.alpha,
            disk_gain=margin.gain,
            disk_phase=margin.phase,
            disk_frequency=margin.frequency,
            frequency=margin.frequencies,
            disk_margins=margin.alphas,
            open_loop=open_loop(model, ports) if all(item.has_plateau for item in models) else None,
            requirements=tuple(
                MarginRequirement.at_least(Scope.JOINT, quantity, size if stable else UNSTABLE, limit)
                for quantity, (size, limit) in required.items()
            ),
        )

    def close(self) -> None:
        if self._start is not None:
            self._start.release()
        self.bench.close()

    def __enter__(self) -> PointStudy:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
