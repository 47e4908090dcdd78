"""Frequency-response test: a multisine is added at the cut of the closed loop, and the response is measured.

The test uses inputs and outputs only, not memory, and so works with any FMUs. Every simulation begins at the start; the
same simulation without the multisine is subtracted, which cancels the motion along the trajectory and the sensors'
noise. L = -V/U on whole periods after the transient.

Source: Pintelon and Schoukens 2012, System Identification, chapters 2 and 5 (multisines, and unexcited lines that show
nonlinearity).
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass

import numpy as np

from ..loops.curves import quotient
from ..loops.growth import WINDOWS, growth_to_overflow, steady_growth
from ..loops.multisine import Multisine, fraction_unexcited, line_spectrum, multisine, single_line
from ..loops.readings import FrequencyResponse
from ..request.channels import Channel
from ..results.requirement import MarginVerdict
from ..results.responses import Measured
from .bench import Bench, LoopError, OverflowedError

SEED = 1  # seed of the multisine's phases
PERIODS = 1  # least number of measured periods, after the transient
MOST_ROUNDS = 12  # samples of a loop in a hyperperiod up to which the window is a whole number of hyperperiods
FIRST = 2  # periods in which a transient may look like growth
PATIENCE = 8  # periods of transient at most
SETTLED = 1e-5  # relative difference of two windows one period apart, below which the response is settled
STILL_MOVING = 1e-2  # difference above which a loop counts as unstable, or as not periodic
PER_DECADE = 20
FEWEST, MOST = 128, 65536  # samples in a period
DEFAULT_SHARE = 0.01  # amplitude as a fraction of the signal's magnitude, if none is declared
FLIGHT_POINTS = 2_000_000  # largest number of communication points of one simulation


class NotMeasurableError(RuntimeError):
    """Loop that cannot be measured; the message explains why."""


class UnstableError(LoopError):
    """Unbounded growth of the effect of a disturbance, by the factor ``growth`` per sample."""

    def __init__(self, growth: float) -> None:
        super().__init__(f"unstable: the response grows {growth:.5g}-fold per sample", MarginVerdict.FAIL)
        self.growth = growth


@dataclass
class Injector:
    """Measurement of one channel of a bench. ``lowest`` is the lowest required frequency (rad/s)."""

    bench: Bench
    channel: Channel
    lowest: float

    def __post_init__(self) -> None:
        self.seconds = self.channel.period * self.bench.prepared.step
        samples = max(FEWEST, round(2.0 * np.pi / (self.lowest * self.seconds)))
        if samples > MOST:
            raise NotMeasurableError(f"{self.lowest:g} rad/s needs {samples} samples per period, more than {MOST}")
        # A periodic loop also responds at frequencies shifted by multiples of the hyperperiod's frequency. These are
        # between the lines, because the window is a whole number of hyperperiods but the period of the signal is not.
        # No line is at such a multiple itself, where constant terms respond in the linearisation.
        rounds = self.bench.period // self.channel.period
        while math.gcd(samples, rounds) > 1:
            samples += 1
        self.samples = samples
        self.periods = rounds * math.ceil(PERIODS / rounds) if rounds <= MOST_ROUNDS else PERIODS
        self.signal: Multisine = multisine(samples, 1.0, (samples - 1) // 2, SEED, per_decade=PER_DECADE)
        self.frequency = 2.0 * np.pi * self.signal.lines / (self.samples * self.seconds)
        self._transient, self.patience = 1, PATIENCE
        self._base: dict[str, np.ndarray] = {}

    def measure(self) -> Measured:
        """Measure L with the declared amplitude and with half of it.

        Raises NotMeasurableError, StudyError, UnstableError.
        """
        peak = self.peak()
        value, unexcited = self.spectrum(peak)
        half, _ = self.spectrum(0.5 * peak)
        low = self.frequency <= 0.5 * np.pi / self.seconds
        return Measured(
            amplitude=peak / float(np.max(abs(self.signal.signal))),
            lines=len(self.signal.lines),
            periods=self.periods,
            period=self.samples * self.seconds,
            half_amplitude_change=float(np.max(abs(quotient(half[low], value[low]) - 1.0))),
            unexcited=unexcited,
            curve=FrequencyResponse(self.frequency, value),
        )

    def peak(self) -> float:
        """Return the peak of the multisine: the declared amplitude, or a fraction of the signal's magnitude."""
        if self.channel.amplitude is not None:
            return self.channel.amplitude
        size = float(np.max(abs(self.channel.injection_for(self._simulate_undisturbed()))))
        return DEFAULT_SHARE * (size or 1.0)

    def make_signal(self, peak: float | None = None) -> tuple[np.ndarray, float]:
        """Return one period of the signal [samples] and its peak, by default `peak`. Raises as `measure`."""
        size = self.peak() if peak is None else peak
        return self.signal.signal * (size / float(np.max(abs(self.signal.signal)))), size

    def spectrum(self, peak: float) -> tuple[np.ndarray, float]:
        """Measure L on the lines with a multisine of this peak, and the largest response on unexcited lines."""
        wave, _ = self.make_signal(peak)
        window = self.periods * self.samples
        while True:
            u, v = self._answer(np.tile(wave, self._transient + self.periods + 1))
            inside, before = (
                line_spectrum(u[start : start + window], self.samples, self.signal.lines)
                for start in (len(u) - window, len(u) - window - self.samples)
            )
            change = float(np.max(abs(inside - before)) / np.max(abs(inside)))
            if change > STILL_MOVING and len(u) >= (WINDOWS + FIRST) * self.samples:
                rate = steady_growth(u[-WINDOWS * self.samples :])
                if rate is not None:
                    raise UnstableError(rate)
            if change < SETTLED or self._transient >= self.patience:
                break
            self._transient *= 2
        if change > STILL_MOVING:
            periods = self._transient
            raise NotMeasurableError(
                f"the response still changes by {change:.2g} of its magnitude after {periods} periods"
            )
        back = line_spectrum(v[-window:], self.samples, self.signal.lines)
        if not np.all(abs(inside) > 0.0):
            raise NotMeasurableError("the injected signal does not arrive downstream of the cut")
        return -back / inside, fraction_unexcited(u[-window:], self.signal)

    def measure_line(self, frequency: float) -> tuple[float, complex]:
        """Return the frequency (rad/s) of a line near the requested one, and L there, measured with a sine.

        Raises as `measure`.
        """
        cycles = frequency * self.seconds / (2.0 * np.pi)  # periods per sample
        rounds = self.bench.period // self.channel.period
        lengths = np.arange(
            max(FEWEST, math.ceil(1.0 / cycles)), max(FEWEST, self.samples, math.ceil(2.0 / cycles)) + 1
        )
        lengths = lengths[np.gcd(lengths, rounds) == 1]
        lines = np.maximum(1, np.round(cycles * lengths).astype(int))
        best = int(np.argmin(abs(lines / lengths / cycles - 1.0)))
        probe = copy.copy(self)
        probe.samples = int(lengths[best])
        probe.signal = single_line(probe.samples, int(lines[best]))
        probe.patience = math.ceil(PATIENCE * self.samples / probe.samples)
        probe._transient = math.ceil(self._transient * self.samples / probe.samples)
        response, _ = probe.spectrum(self.peak())
        return float(2.0 * np.pi * lines[best] / (probe.samples * self.seconds)), complex(response[0])

    def _points(self) -> int:
        """Return the number of communication points after the operating point that a measurement takes."""
        points = (self._transient + self.periods + 1) * self.samples * self.channel.period
        until = self.bench.point.until
        end = self.bench.time + points * self.bench.prepared.step
        if until is not None and end > until:
            raise NotMeasurableError(
                f"measuring at {self.lowest:.3g} rad/s, transient included, would last until {end:g} s, but the "
                f"operating point ends at {until:g} s"
            )
        if points + self.bench.origin > FLIGHT_POINTS:
            raise NotMeasurableError(f"a measurement takes {points} communication points, more than {FLIGHT_POINTS}")
        return points

    def _simulate_undisturbed(self) -> dict[str, np.ndarray]:
        """Return signals from the operating point on, simulated without excitation."""
        points = self._points()
        if not self._base or len(next(iter(self._base.values()))) < points:
            try:
                self._base = self._behind(self.bench.fly(-1, self.bench.origin + points))
            except OverflowedError as error:
                raise self._overflow(error, {}) from error
        return {name: values[:points] for name, values in self._base.items()}

    def _behind(self, signals: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: values[self.bench.origin + 1 :] for name, values in signals.items()}

    def _answer(self, samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the input and the return signal at the channel's samples, minus the undisturbed simulation."""
        channel, base = self.channel, self._simulate_undisturbed()
        added = np.repeat(samples, channel.period)
        mine = channel.excitation(base, added)
        excitation = np.zeros((added.size, len(self.bench.connectors)))
        excitation[:, self.bench.columns(channel)] = mine
        try:
            signals = self._behind(self.bench.fly(-1, self.bench.origin + added.size, excitation))
        except OverflowedError as error:
            raise self._overflow(error, base) from error
        nothing = np.zeros_like(mine)
        rows = slice(0, None, channel.period)
        u = channel.injection_for(signals) - channel.injection_for(base)
        v = channel.return_signal(signals, mine) - channel.return_signal(base, nothing)
        return u[rows], v[rows]

    def _overflow(self, error: OverflowedError, base: dict[str, np.ndarray]) -> Exception:
        """Return the verdict on an overflow: growth of the disturbance, or of the simulation if ``base`` is None.

        Returns the error itself if nothing grew.
        """
        signals = self._behind(error.signals)
        reached = len(next(iter(signals.values())))
        with np.errstate(all="ignore"):
            deviation = self.channel.injection_for(signals)
            if base:
                deviation = deviation - self.channel.injection_for({name: base[name][:reached] for name in signals})
        rate = growth_to_overflow(deviation[:: self.channel.period])
        return error if rate is None else UnstableError(rate)
