"""Route B: a loop's frequency response measured by a multisine added at the cut while the loop is closed.

It needs no memory, only inputs and outputs, so it serves anyone's FMUs. Every flight starts at the beginning; the
same flight without the multisine is subtracted, so that the motion along the trajectory and the sensors' noise, which
is the same in both, leave nothing but the answer to the multisine. L = -V/U on whole periods after the transient.
Source: Pintelon and Schoukens 2012, System Identification, chapters 2 and 5 (multisines, and unexcited lines that
show what is not linear).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .bench import Bench, StudyError
from .channels import Channel
from .multisine import Multisine, line_spectrum, multisine, unexcited_share
from .results import Curve, RouteB

SEED = 1  # of the multisine's phases
PERIODS = 2  # measured, after those that the transient takes
PATIENCE = 8  # periods of transient at most
SETTLED = 1e-5  # relative difference of the last two periods
PER_DECADE = 20
FEWEST, MOST = 128, 65536  # samples in a period
DEFAULT_SHARE = 0.01  # amplitude where none is declared, of the signal's own size
FLIGHT_POINTS = 2_000_000  # communication points of one flight at most


class NotMeasurableError(RuntimeError):
    """A loop cannot be measured here; the message says why."""


@dataclass
class Injector:
    """Measures one channel of a bench. ``lowest`` is the least frequency wanted (rad/s)."""

    bench: Bench
    channel: Channel
    lowest: float

    def __post_init__(self) -> None:
        self.seconds = self.channel.period * self.bench.prepared.step
        samples = 2 * round(np.pi / (self.lowest * self.seconds))
        if samples > MOST:
            raise NotMeasurableError(f"{self.lowest:g} rad/s needs {samples} samples a period, more than {MOST}")
        self.samples = max(FEWEST, samples)
        self.signal: Multisine = multisine(self.samples, 1.0, self.samples // 2 - 1, SEED, per_decade=PER_DECADE)
        self.frequency = 2.0 * np.pi * self.signal.lines / (self.samples * self.seconds)
        self._transient = 1
        self._base: dict[str, np.ndarray] = {}

    def measure(self) -> RouteB:
        """L with the declared amplitude and with half of it. Raises NotMeasurableError, StudyError."""
        peak = self.peak()
        value, unexcited = self.spectrum(peak)
        half, _ = self.spectrum(0.5 * peak)
        low = self.frequency <= 0.5 * np.pi / self.seconds
        return RouteB(
            amplitude=peak / float(np.max(abs(self.signal.signal))),
            lines=len(self.signal.lines),
            periods=PERIODS,
            period=self.samples * self.seconds,
            half_amplitude_change=float(np.max(abs(half[low] / value[low] - 1.0))),
            unexcited=unexcited,
            curve=Curve(self.frequency, value),
        )

    def peak(self) -> float:
        """The largest value of the multisine: the declared amplitude or a share of the signal's own size."""
        if self.channel.amplitude is not None:
            return self.channel.amplitude
        size = float(np.max(abs(self.channel.injected(self._undisturbed()))))
        return DEFAULT_SHARE * (size or 1.0)

    def spectrum(self, peak: float) -> tuple[np.ndarray, float]:
        """L on the lines with a multisine of this largest value, and the largest answer on unexcited lines."""
        wave = self.signal.signal * (peak / float(np.max(abs(self.signal.signal))))
        while True:
            u, v = self._answer(np.tile(wave, self._transient + PERIODS))
            ends = [
                line_spectrum(u[start : start + self.samples], self.samples, self.signal.lines)
                for start in (-2 * self.samples + len(u), -self.samples + len(u))
            ]
            change = float(np.max(abs(ends[1] - ends[0])) / np.max(abs(ends[1])))
            if change < SETTLED or self._transient >= PATIENCE:
                break
            self._transient *= 2
        kept = slice(-PERIODS * self.samples, None)
        inside = line_spectrum(u[kept], self.samples, self.signal.lines)
        back = line_spectrum(v[kept], self.samples, self.signal.lines)
        if not np.all(abs(inside) > 0.0):
            raise NotMeasurableError("nothing of what is added arrives behind the cut")
        return -back / inside, unexcited_share(u[kept], self.signal)

    def _points(self) -> int:
        """Communication points behind the operating point that a measurement takes."""
        points = (self._transient + PERIODS) * self.samples * self.channel.period
        until = self.bench.point.until
        end = self.bench.time + points * self.bench.prepared.step
        if until is not None and end > until:
            raise NotMeasurableError(
                f"{self.lowest:.3g} rad/s and its transient take until {end:g} s, but the point lasts until {until:g} s"
            )
        if points + self.bench.origin > FLIGHT_POINTS:
            raise NotMeasurableError(f"a measurement takes {points} communication points, more than {FLIGHT_POINTS}")
        return points

    def _undisturbed(self) -> dict[str, np.ndarray]:
        """Signals from the operating point on without anything added."""
        points = self._points()
        if not self._base or len(next(iter(self._base.values()))) < points:
            self._base = self._behind(self.bench.fly(-1, self.bench.origin + points))
        return {name: values[:points] for name, values in self._base.items()}

    def _behind(self, signals: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: values[self.bench.origin + 1 :] for name, values in signals.items()}

    def _answer(self, samples: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What goes in and comes back at the channel's samples, the undisturbed flight subtracted."""
        channel, base = self.channel, self._undisturbed()
        added = np.repeat(samples, channel.period)
        mine = channel.excitation(base, added)
        excitation = np.zeros((added.size, len(self.bench.connectors)))
        excitation[:, self.bench.columns(channel)] = mine
        signals = self._behind(self.bench.fly(-1, self.bench.origin + added.size, excitation))
        nothing = np.zeros_like(mine)
        rows = slice(0, None, channel.period)
        u = channel.injected(signals) - channel.injected(base)
        v = channel.back(signals, mine) - channel.back(base, nothing)
        return u[rows], v[rows]


def measured(injector: Injector, peak: float) -> np.ndarray | None:
    """L on the lines with this amplitude, None where the flight does not survive it."""
    try:
        return injector.spectrum(peak)[0]
    except StudyError:
        return None
