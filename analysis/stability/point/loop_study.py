"""Everything about one channel at one operating point, linearisation and frequency-response test put together."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..loops.curves import Response, interpolate, quotient
from ..loops.readings import decibels
from ..request.channels import Channel
from ..request.declaration import Limits
from ..results.report import LoopReport
from ..results.responses import AmplitudePoint, Measured
from .assessment import Assessment, assess, requirements
from .bench import Bench, StudyError
from .injection import Injector, NotMeasurableError
from .modes import structure
from .open_loop import open_loop
from .responses import NOT_LINEAR, LoopModel, agreement, disagreement

SILENT = "nothing of what is added comes back: L is 0"
FACTORS = (0.25, 4.0, 16.0)  # of the declared amplitude, beside itself
FIRST_LOOK = 1e-3  # of the Nyquist frequency: where a measurement without a linearisation begins
LOOP_GAIN = 5.0  # a measurement begins low enough when the gain of its lowest line is at least this
LINES_FROM = 10.0  # of the lowest frequency that is looked at: a fifth of the lowest gain crossover
STEP_LENGTH = 12.0  # over the lowest crossover: length of a step response


@dataclass
class LoopStudy:
    """One channel with what is known of it: its linear model (None: not to be had), its measurement."""

    bench: Bench
    channel: Channel
    model: LoopModel | None
    limits: Limits
    notes: dict[str, str] = field(default_factory=dict)
    injector: Injector | None = None
    measured: Measured | None = None

    def __post_init__(self) -> None:
        self.seconds = self.channel.period * self.bench.prepared.step
        self.nyquist = np.pi / self.seconds

    def measure(self) -> None:
        """Frequency-response test, from well below the crossover on."""
        try:
            if self.model is not None:
                self._measure_from(LINES_FROM * self.model.lowest)
                return
            lowest = FIRST_LOOK * self.nyquist
            while True:
                measured = self._measure_from(lowest)
                if abs(measured.curve.value[0]) > LOOP_GAIN:
                    return
                lowest *= 0.25
        except (NotMeasurableError, StudyError) as error:
            if self.measured is None:
                self.notes["frequency-response test"] = str(error)

    def _measure_from(self, lowest: float) -> Measured:
        injector = Injector(self.bench, self.channel, lowest)
        self.measured = injector.measure()
        self.injector = injector
        return self.measured

    @property
    def _doubtful(self) -> bool:
        return self.model is not None and not self.model.has_plateau

    @property
    def _bent(self) -> bool:
        return self.measured is not None and self.measured.half_amplitude_change > NOT_LINEAR

    def refuse_what_is_no_loop(self) -> None:
        """Raises StudyError where nothing comes back and no pole is known, or where neither method finds it linear.

        Of what is not linear the error has L over the amplitude.
        """
        if self.model is None and self.measured is not None and not np.any(self.measured.curve.value):
            raise StudyError(
                f"{SILENT}, and no poles are known without a linearisation ({self.notes['linearisation']})"
            )
        if self._doubtful and self.measured is None:
            assert self.model is not None
            names = ", ".join(self.model.facts.doubtful)
            reason = self.notes.get("frequency-response test", "it is not measured")
            raise StudyError(f"its derivatives have no plateau ({names}), and there is no measurement: {reason}")
        if (self._doubtful or self.model is None) and self._bent:
            assert self.injector is not None
            amplitudes = self.amplitudes(float(np.sqrt(self.injector.frequency[0] * self.injector.frequency[-1])))
            assert amplitudes is not None
            points, frequency = amplitudes
            sizes = "; ".join(
                f"{decibels(item.value):.2f} dB, {np.degrees(np.angle(item.value)):.1f} deg with {item.amplitude:g}"
                for item in points
            )
            raise StudyError(f"not applicable, since it is not linear: at {frequency:.3g} rad/s L is {sizes}")

    @cached_property
    def assessed(self) -> tuple[Assessment, Response]:
        """Margins, by linearisation where it can be trusted, else by the frequency-response test, after `measure`.

        Raises StudyError where there is neither, or where the response is no loop's that margins could be read from.
        """
        try:
            return self._assess()
        except ValueError as error:
            raise StudyError(f"{self.channel.name}: {error}") from error

    def _assess(self) -> tuple[Assessment, Response]:
        if self.model is not None and not (self._doubtful and self.measured is not None and not self._bent):
            undamped, include = self.model.lightly_damped()
            assessment = assess(
                self.model.response,
                self.model.lowest,
                self.nyquist,
                self.seconds,
                self.model.unstable_open,
                undamped,
                include,
                self.model.slower,
            )
            return assessment, self.model.response
        if self.measured is None:
            raise StudyError(f"{self.channel.name}: " + "; ".join(f"{name}: {why}" for name, why in self.notes.items()))
        if self.model is not None:
            names = ", ".join(self.model.facts.doubtful)
            self.notes["linearisation"] = (
                f"its derivatives have no plateau ({names}), so margins are those of the frequency-response test"
            )
        curve = self.measured.curve
        response = interpolate(curve.frequency, curve.value, self.seconds)
        return assess(response, curve.frequency[0], curve.frequency[-1], self.seconds, None), response

    def report(self, closed: Sequence[str]) -> LoopReport:
        """The report without what needs other flights than the two methods'."""
        assessment, _ = self.assessed
        if not np.any(assessment.curve.value):
            self.notes["loop"] = SILENT
        # what grows outside does so whether or not the loop's own derivatives can be trusted
        trusted = self.model is not None and ("linearisation" not in self.notes or self.model.outside)
        model = self.model if trusted else None
        poles = np.array([mode.z for mode in model.modes]) if model else np.zeros(0, dtype=complex)
        stable = model.stable if model else None
        report = LoopReport(
            name=self.channel.name,
            loop=self.channel.loop,
            point=self.bench.point.name,
            cut=" ".join(self.channel.connectors),
            returned=self.channel.returned or "same connector, upstream of the injection point",
            unit=self.channel.unit,
            sample_period=self.seconds,
            closed=tuple(closed),
            sign="L = -(return signal)/(signal into the loop): positive for negative feedback, critical point -1",
            curve=assessment.curve,
            classical=assessment.classical,
            robust=assessment.robust,
            stable=stable,
            largest=model.largest if model else None,
            unstable_open=model.unstable_open if model else None,
            outside=tuple(name for block in model.outside for name in block.names) if model else (),
            modes=model.modes if model else (),
            poles_z=poles,
            structure=structure(model.model, model.port, model.facts.states) if model else None,
            open_loop=open_loop(model.model, (model.port,)) if model and "linearisation" not in self.notes else None,
            linearised=self.model.facts if self.model else None,
            measured_response=self.measured,
            not_applicable={**self.notes, **assessment.notes},
            step=self._step(assessment) if model and stable else None,
        )
        report.requirements = requirements(report.margins, self.limits, report.outside)
        if self.model is not None and self.measured is not None:
            compared = agreement(self.model.response, self.measured, self.seconds)
            report.agreement = compared
            if not compared.agrees:
                report.not_applicable["agreement"] = disagreement(compared, self.model.facts, self.measured)
        return report

    def _step(self, assessment: Assessment) -> tuple[np.ndarray, np.ndarray]:
        """Response of T, what comes back over what is added, to a step at the cut."""
        assert self.model is not None
        crossings = [crossing.frequency for crossing in assessment.classical.phase]
        length = STEP_LENGTH / min(crossings, default=self.nyquist) * 2.0 * np.pi / 4.0
        model, port = self.model.model, self.model.port
        periods = max(2, int(np.ceil(length / model.period)))
        state = np.zeros(len(model.a))
        ones = np.ones(port.count)
        values = []
        for _ in range(periods):
            values.append(-(model.cv[port.rows] @ state + model.dv[port.rows, port.rows] @ ones))
            state = model.a @ state + model.b[:, port.rows] @ ones
        return np.arange(periods * port.count) * self.seconds, np.concatenate(values)

    def amplitudes(self, frequency: float) -> tuple[tuple[AmplitudePoint, ...], float] | None:
        """L on the measured line nearest to a frequency (rad/s), over the amplitude of what is added."""
        if self.injector is None or self.measured is None:
            return None
        peak = self.injector.peak()
        line = int(np.argmin(abs(np.log(self.injector.frequency / frequency))))
        by_amplitude = {1.0: self.measured.curve.value}
        for factor in FACTORS:
            with suppress(NotMeasurableError, StudyError):
                by_amplitude[factor], _ = self.injector.spectrum(factor * peak)
        reference = by_amplitude[min(by_amplitude)][line]
        points = tuple(
            AmplitudePoint(factor * peak, complex(value[line]), float(abs(quotient(value[line], reference) - 1.0)))
            for factor, value in sorted(by_amplitude.items())
        )
        return points, float(self.injector.frequency[line])
