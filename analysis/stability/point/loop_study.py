"""Study of one channel at one operating point, by linearisation and frequency-response test."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ..loops.curves import Response, interpolate, quotient
from ..loops.readings import Classical, FrequencyResponse, Robust, decibels
from ..loops.refinement import refine
from ..request.channels import Channel
from ..request.declaration import MarginLimits
from ..results.report import LoopReport
from ..results.requirement import MarginVerdict
from ..results.responses import AmplitudePoint, Measured
from .assessment import Assessment, assess, requirements
from .bench import Bench, LoopError, StudyError
from .injection import Injector, NotMeasurableError, UnstableError
from .modes import structure
from .open_loop import open_loop
from .responses import NOT_LINEAR, LoopModel, agreement, disagreement
from .silence import find_silent_end

SILENT = "none of the injected signal returns: L is 0"
RETURN_LIMIT = 1e-9  # gain below which there is no return signal
FACTORS = (0.25, 4.0, 16.0)  # factors on the declared amplitude, in addition to 1
FIRST_LOOK = 1e-3  # fraction of the Nyquist frequency at which a measurement without a linearisation begins
TEST_POINTS = 40  # number of frequencies at which a model is evaluated
LOOP_GAIN = 5.0  # a measurement begins low enough if the gain of its lowest line is at least this
LINES_FROM = 10.0  # factor on the lowest frequency: a fifth of the lowest gain crossover
STEP_LENGTH = 12.0  # over the lowest crossover: length of a step response


@dataclass
class LoopStudy:
    """Study of one channel: its linear model (None if unavailable), and its measurement."""

    bench: Bench
    channel: Channel
    model: LoopModel | None
    limits: MarginLimits
    notes: dict[str, str] = field(default_factory=dict)
    injector: Injector | None = None
    measured: Measured | None = None
    refined: FrequencyResponse | None = None  # the measured response with lines at its crossings
    unstable: UnstableError | None = None  # growth in the simulation of a measurement

    def __post_init__(self) -> None:
        self.seconds = self.channel.period * self.bench.prepared.step
        self.nyquist = np.pi / self.seconds

    def measure(self) -> None:
        """Run the frequency-response test; its lowest line is well below the crossover."""
        try:
            if self.model is not None:
                self._measure_from(LINES_FROM * self.model.lowest)
                return
            lowest = FIRST_LOOK * self.nyquist
            while True:
                measured = self._measure_from(lowest)
                if abs(measured.curve.value[0]) > LOOP_GAIN or self._measurement_silent:
                    return
                lowest *= 0.25
        except (NotMeasurableError, StudyError) as error:
            if isinstance(error, UnstableError):
                self.unstable = error
            if self.measured is None:
                self.notes["frequency-response test"] = str(error)

    def refine(self) -> None:
        """Measure at the crossings as well, if the margins are from the frequency-response test."""
        if self.measured is None or self.injector is None or not self._by_measurement or self._silent:
            return

        def margins_of(curve: FrequencyResponse) -> tuple[Classical, Robust]:
            assessment = self._assess_measured(curve)[0]
            return assessment.classical, assessment.robust

        try:
            refined = refine(self.measured.curve, margins_of, self.injector.measure_line)
        except ValueError:  # a curve without margins, which `assessed` reports
            return
        except (NotMeasurableError, StudyError) as error:
            self.notes["margins"] = f"they lie between test frequencies: {error}"
            return
        self.refined = refined.curve
        if refined.remainder:
            self.notes["margins"] = refined.remainder

    def _measure_from(self, lowest: float) -> Measured:
        injector = Injector(self.bench, self.channel, lowest)
        self.measured = injector.measure()
        self.injector = injector
        return self.measured

    @property
    def _doubtful(self) -> bool:
        return self.model is not None and not self.model.has_plateau

    @property
    def _model_silent(self) -> bool:
        return self.model is not None and bool(np.max(abs(self.model.response(self._test_frequencies))) < RETURN_LIMIT)

    @property
    def _measurement_silent(self) -> bool:
        return self.measured is not None and bool(np.max(abs(self.measured.curve.value)) < RETURN_LIMIT)

    @property
    def _test_frequencies(self) -> np.ndarray:
        """Frequencies (rad/s) at which a linear model is evaluated, over the range of a measurement."""
        return np.geomspace(FIRST_LOOK, 1.0, TEST_POINTS) * self.nyquist

    @property
    def _silent(self) -> bool:
        """True if there is no return signal by any method that ran."""
        if self.model is None and self.measured is None:
            return False
        return (self.model is None or self._model_silent) and (self.measured is None or self._measurement_silent)

    @property
    def _by_measurement(self) -> bool:
        """True if the margins are from the test: the loop is linear, and the linearisation cannot be trusted."""
        if self.measured is None:
            return False
        overlooked = self._model_silent and not self._measurement_silent
        return self.model is None or ((self._doubtful or overlooked) and not self._bent)

    @property
    def _bent(self) -> bool:
        return self.measured is not None and self.measured.half_amplitude_change > NOT_LINEAR

    def check_loop(self) -> None:
        """Raise StudyError without a return signal, for unbounded growth, and if no method finds a linear loop.

        For a nonlinear loop the message contains L over the amplitude.
        """
        if self.unstable is not None and (self.model is None or self._doubtful):
            raise self.unstable
        if self._silent:
            self._refuse_silence()
        if self._doubtful and self.measured is None:
            assert self.model is not None
            names = ", ".join(self.model.facts.doubtful)
            reason = self.notes.get("frequency-response test", "it is not measured")
            raise StudyError(
                f"its finite-difference derivatives depend on the difference step ({names}), and "
                f"there is no measurement: {reason}"
            )
        overlooked = self._model_silent and self.measured is not None and not self._measurement_silent
        if (self._doubtful or self.model is None or overlooked) and self._bent:
            assert self.injector is not None
            amplitudes = self.amplitudes(float(np.sqrt(self.injector.frequency[0] * self.injector.frequency[-1])))
            assert amplitudes is not None
            points, frequency = amplitudes
            sizes = "; ".join(
                f"{decibels(item.value):.2f} dB, {np.degrees(np.angle(item.value)):.1f} deg at amplitude "
                f"{item.amplitude:g}"
                for item in points
            )
            raise StudyError(f"not applicable, since the loop is not linear: at {frequency:.3g} rad/s L is {sizes}")

    def _refuse_silence(self) -> None:
        """Raise LoopError, unless the model is unstable and a simulation confirms the growth."""
        injector = self.injector or Injector(self.bench, self.channel, LINES_FROM * FIRST_LOOK * self.nyquist)
        try:
            wave, peak = injector.make_signal()
        except (NotMeasurableError, StudyError) as error:
            raise LoopError(f"{SILENT} ({error})", MarginVerdict.NOT_APPLICABLE) from error
        measured = self.measured is not None
        silence = find_silent_end(self.bench.prepared, self.bench, self.channel, peak, wave, measured)
        if silence.growth is not None and self.model is None:
            raise UnstableError(silence.growth)
        if silence.growth is not None and self.model is not None and not self.model.stable:
            return
        untried = self.notes.get("frequency-response test")
        why = f", by linearisation alone: {untried}" if untried else ""
        raise LoopError(silence.reason + why, MarginVerdict.NOT_APPLICABLE)

    @cached_property
    def assessed(self) -> tuple[Assessment, Response]:
        """Margins and response: of the linearisation if it can be trusted, else of the frequency-response test.

        To be used after `measure`. Raises StudyError if there is neither, or if margins cannot be read from the
        response.
        """
        try:
            return self._assess()
        except ValueError as error:
            raise StudyError(f"{self.channel.name}: {error}") from error

    def _assess(self) -> tuple[Assessment, Response]:
        if self.model is not None and not self._by_measurement:
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
            why = (
                f"its finite-difference derivatives depend on the difference step ({names})"
                if self._doubtful
                else "it finds no returning signal"
            )
            self.notes["linearisation"] = f"{why}, so margins are those of the frequency-response test"
        return self._assess_measured(self.refined or self.measured.curve)

    def _assess_measured(self, curve: FrequencyResponse) -> tuple[Assessment, Response]:
        response = interpolate(curve.frequency, curve.value, self.seconds)
        return assess(response, curve.frequency[0], curve.frequency[-1], self.seconds, None), response

    def report(self, closed: Sequence[str]) -> LoopReport:
        """Return the report, without results that need simulations beyond the two methods."""
        assessment, _ = self.assessed
        if not np.any(assessment.curve.value):
            self.notes["loop"] = SILENT
        # growth outside the loop does not depend on whether the loop's derivatives can be trusted
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
            measured_response=self._refine_measurement(),
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

    def _refine_measurement(self) -> Measured | None:
        """Return the measurement with further lines at its crossings."""
        if self.measured is None or self.refined is None:
            return self.measured
        return replace(self.measured, curve=self.refined, lines=len(self.refined.frequency))

    def _step(self, assessment: Assessment) -> tuple[np.ndarray, np.ndarray]:
        """Return the step response of T, from the excitation at the cut to the return signal."""
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
        """Measure L over the amplitude of the excitation, on the measured line nearest to a frequency (rad/s)."""
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
