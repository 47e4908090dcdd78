"""Sampled control loops of the robot in closed form: means of samples, Tustin's lead, double integrator, delayed jets.

Per axis, x being the robot's error from its plan and T the period: the lead's input at tick k is the mean y_k of the
samples at kT - T + T/n, ..., kT; the acceleration that it commands acts from kT + d until the acceleration of the next
tick:

    x(kT + s) = x_k + s v_k + min(s, d) (s - min(s, d)/2) a_(k-1) + max(s - d, 0)^2/2 a_k        0 <= s <= T

which is linear, so y_(k+1) is the mean of this over s = iT/n, i = 1 ... n. L(z) is the lead times the transfer function
from a to y, which is minus the loop transfer function, since a = -C y. Derivation: docs/theory/rendezvous.md.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import control
import numpy as np
from numpy.polynomial import Polynomial

Z = Polynomial([0.0, 1.0])


@dataclass(frozen=True)
class Margins:
    """Gain margin (dB), phase margin (deg), where they are (rad/s), and the least |1 + L|."""

    gain: float
    gain_frequency: float
    phase: float
    phase_frequency: float
    modulus: float


@dataclass(frozen=True)
class SampledLoop:
    """A loop that is opened at the lead's output; calling it gives L(z).

    Times in s, ``gain`` of the lead at rest in 1/s2. ``delay`` is from a tick to the change of acceleration, 0 <=
    delay < period; ``samples`` is how many samples are in a mean, the last one at the tick.
    """

    period: float
    gain: float
    lead_time: float
    lag_time: float
    samples: int
    delay: float

    def reach(self, s: float) -> tuple[float, float]:
        """Return the displacement by the accelerations before and after the change ``s`` after
        the tick, per unit (s2)."""
        before = min(s, self.delay)
        after = s - before
        return before * (s - 0.5 * before), 0.5 * after**2

    @cached_property
    def sampled(self) -> tuple[float, float, float]:
        """Mean over the samples of s and of `reach`."""
        times = [self.period * i / self.samples for i in range(1, self.samples + 1)]
        old, new = np.mean([self.reach(s) for s in times], axis=0)
        return float(np.mean(times)), float(old), float(new)

    @cached_property
    def polynomials(self) -> tuple[Polynomial, Polynomial]:
        """Numerator and denominator of L in rising powers of z."""
        period, delay = self.period, self.delay
        mean_time, mean_old, mean_new = self.sampled
        old, new = self.reach(period)
        speed = delay + (period - delay) * Z  # z (z - 1) V/A
        mean = period * speed + (old + new * Z) * (Z - 1)  # z (z - 1)^2 X/A
        mean = mean + mean_time * speed * (Z - 1) + (mean_old + mean_new * Z) * (Z - 1) ** 2  # z^2 (z - 1)^2 Y/A
        powers = 2
        if mean.coef[0] == 0.0:  # no sample in the midst of a delay: z cancels
            mean, powers = Polynomial(mean.coef[1:]), 1
        lead = self.gain * (2.0 * self.lead_time * (Z - 1) + period * (Z + 1))
        lag = 2.0 * self.lag_time * (Z - 1) + period * (Z + 1)
        return lead * mean, lag * Z**powers * (Z - 1) ** 2

    def __call__(self, z: np.ndarray) -> np.ndarray:
        numerator, denominator = self.polynomials
        return numerator(z) / denominator(z)

    def response(self, frequency: np.ndarray) -> np.ndarray:
        """Return L at angular frequencies (rad/s)."""
        return self(np.exp(1j * self.period * np.asarray(frequency)))

    @cached_property
    def transfer_function(self) -> control.TransferFunction:
        numerator, denominator = self.polynomials
        return control.TransferFunction(numerator.coef[::-1], denominator.coef[::-1], self.period)

    @cached_property
    def lead(self) -> tuple[float, float, float]:
        """decay, share, direct of the lead as g' = decay g + e, m = share g + direct e."""
        divisor = 2.0 * self.lag_time + self.period
        decay = (2.0 * self.lag_time - self.period) / divisor
        direct = self.gain * (2.0 * self.lead_time + self.period) / divisor
        return decay, self.gain * (self.period - 2.0 * self.lead_time) / divisor + decay * direct, direct

    @cached_property
    def plant(self) -> tuple[np.ndarray, np.ndarray]:
        """Matrix and input column of the states x, v, a_(k-1), y at a tick; the input is a_k."""
        mean_time, mean_old, mean_new = self.sampled
        old, new = self.reach(self.period)
        states = np.array(
            [
                [1.0, self.period, old, 0.0],
                [0.0, 1.0, self.delay, 0.0],
                [0.0, 0.0, 0.0, 0.0],
                [1.0, mean_time, mean_old, 0.0],
            ]
        )
        return states, np.array([new, self.period - self.delay, 1.0, mean_new])

    @cached_property
    def state_space(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """A, B, C of L with the states x, v, a_(k-1), y, g at a tick; there is no direct way."""
        states, values = self.plant
        decay, fraction, direct = self.lead
        a = np.zeros((5, 5))
        a[:4, :4] = states
        a[:4, 4] = values * fraction
        a[4, 4] = decay
        return a, np.append(values * direct, 1.0), np.array([0.0, 0.0, 0.0, 1.0, 0.0])

    @cached_property
    def poles(self) -> np.ndarray:
        """Poles of the closed loop, in z."""
        a, b, c = self.state_space
        return np.linalg.eigvals(a - np.outer(b, c))

    def closed(self, position: float, velocity: float, errors: np.ndarray) -> np.ndarray:
        """Simulate the closed loop from tick 0 on: rows of x, v and y as measured, at every tick.

        Starts from rest of the lead and without acceleration; the first mean is that of one sample. ``errors`` are
        those of the means of the samples, tick by tick.
        """
        a, b, c = self.state_space
        state = np.array([position, velocity, 0.0, position, 0.0])
        rows = []
        for error in errors:
            measured = c @ state + error
            rows.append([state[0], state[1], measured])
            state = a @ state - b * measured
        return np.array(rows)

    @cached_property
    def margins(self) -> "Margins":
        """By python-control; no gain margin is downwards, since the lead leads from the lowest frequencies on."""
        gain, phase, modulus, gain_at, phase_at, _ = control.stability_margins(self.transfer_function)
        return Margins(20.0 * math.log10(gain), gain_at, phase, phase_at, modulus)


DESIGNS = {8.0: (1.5625e-4, 160.0, 13.3), 4.0: (6.25e-4, 80.0, 6.67)}


def translation_loop(period: float) -> SampledLoop:
    """Return the loop of translation at a period of 8 or 4 s: samples every second, jets a
    quarter of the period late."""
    return SampledLoop(period, *DESIGNS[period], samples=round(period), delay=0.25 * period)


def attitude_loop() -> SampledLoop:
    """Return the loop of attitude at rest, each axis alike: samples every 0.125 s, gimbal rates held from the tick
    on."""
    return SampledLoop(0.25, 0.16, 5.0, 0.417, samples=2, delay=0.0)
