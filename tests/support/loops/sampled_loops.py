"""Sampled state-space loops with margins known from other sources, and their frequency responses."""

from __future__ import annotations

from dataclasses import dataclass

import control
import numpy as np
from hypothesis import strategies

from perilune.analysis.stability.loops.curves import Response


def response_of(system: control.StateSpace) -> Response:
    """Return L over angular frequency: (n,) for one channel, else (n, m, m)."""

    def response(frequency: np.ndarray) -> np.ndarray:
        z = np.exp(1j * np.asarray(frequency) * system.dt)
        value = np.linalg.solve(z[:, None, None] * np.eye(system.nstates) - system.A, system.B.astype(complex))
        value = system.C @ value + system.D
        return value[:, 0, 0] if system.ninputs == 1 else value

    return response


def outside(system: control.StateSpace, factor: complex = 1.0) -> int:
    """Count poles outside of the unit circle of the loop closed with ``factor`` (factor 0: of the open loop)."""
    feedback = np.linalg.solve(np.eye(system.ninputs) + factor * system.D, factor * system.C)
    return int(np.sum(np.abs(np.linalg.eigvals(system.A - system.B @ feedback)) > 1.0 + 1e-9))


def nearest_to_circle(system: control.StateSpace, factor: complex = 1.0) -> float:
    """Return distance of the closed loop's poles from the unit circle."""
    feedback = np.linalg.solve(np.eye(system.ninputs) + factor * system.D, factor * system.C)
    return float(np.min(np.abs(np.abs(np.linalg.eigvals(system.A - system.B @ feedback)) - 1.0)))


def held(transfer: control.TransferFunction, period: float) -> control.StateSpace:
    """Return a continuous plant after a zero-order hold."""
    return control.c2d(control.ss(transfer), period, "zoh")


def delay(samples: int, period: float) -> control.StateSpace:
    """Return the state space of z**-samples."""
    shift = np.eye(samples, k=-1)
    return control.ss(shift, np.eye(samples, 1), np.eye(1, samples, samples - 1), 0.0, period)


@dataclass(frozen=True)
class HeldDoubleIntegrator:
    """kp + kd (1 - 1/z)/T and a delay of n samples on a held 1/s^2, designed backwards from its crossings.

    With z = exp(j a), a = w T, the plant is T^2/2 (z + 1)/(z - 1)^2 = -T^2/4 cos(a/2)/sin(a/2)^2 exp(-j a/2). So -L
    has the phase atan2(c sin a, 1 + c (1 - cos a)) - (n + 1/2) a, c = kd/(kp T). c follows from the angle at which
    that is 0 (less than pi/(2 n + 2)), kp from the angle at which |L| is 1.
    """

    period: float
    samples: int
    phase_crossover: float  # a, rad
    gain_crossover: float

    @property
    def ratio(self) -> float:
        tangent = np.tan((self.samples + 0.5) * self.phase_crossover)
        return tangent / (np.sin(self.phase_crossover) - tangent * (1.0 - np.cos(self.phase_crossover)))

    def size(self, angle: float) -> float:
        """Return |L|/kp."""
        lead = np.hypot(1.0 + self.ratio * (1.0 - np.cos(angle)), self.ratio * np.sin(angle))
        return 0.25 * self.period**2 * np.cos(0.5 * angle) / np.sin(0.5 * angle) ** 2 * lead

    @property
    def gain_margin(self) -> float:
        return self.size(self.gain_crossover) / self.size(self.phase_crossover)

    @property
    def phase_margin(self) -> float:
        angle = self.gain_crossover
        lead = np.arctan2(self.ratio * np.sin(angle), 1.0 + self.ratio * (1.0 - np.cos(angle)))
        return lead - (self.samples + 0.5) * angle

    @property
    def system(self) -> control.StateSpace:
        kp = 1.0 / self.size(self.gain_crossover)
        difference = control.ss(0.0, 1.0, -1.0, 1.0, self.period)  # 1 - 1/z
        lead = kp * (1.0 + self.ratio * difference)
        h = self.period
        plant = control.ss([[1.0, h], [0.0, 1.0]], [[0.5 * h * h], [h]], [[1.0, 0.0]], 0.0, h)
        return plant * lead * delay(self.samples, h)


@strategies.composite
def random_loops(draw: strategies.DrawFn, channels: int = 1, integrators: bool = True) -> control.StateSpace:
    """Draw a loop of stable and unstable poles, integrators, a direct term or none; everything
    well away from being marginal."""
    seed = draw(strategies.integers(0, 2**32 - 1))
    random = np.random.default_rng(seed)
    order = draw(strategies.integers(1, 5))
    period = draw(strategies.sampled_from([0.1, 1.0, 8.0]))
    blocks = []
    while sum(len(block) for block in blocks) < order:
        kind = draw(strategies.sampled_from(["real", "pair", *(["one"] if integrators else [])]))
        radius = draw(strategies.sampled_from([0.3, 0.8, 0.95, 1.1, 1.5]))
        angle = random.uniform(0.05, 3.0)
        if kind == "one":
            blocks.append(np.array([[1.0]]))
            integrators = False  # one per channel: two alike would be missed
        elif kind == "real":
            blocks.append(np.array([[radius * random.uniform(0.8, 1.0) * random.choice([-1.0, 1.0])]]))
        else:
            turn = [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]
            blocks.append(radius * random.uniform(0.95, 1.0) * np.array(turn))
    states = sum(len(block) for block in blocks)
    matrix, place = np.zeros((states, states)), 0
    for block in blocks:
        matrix[place : place + len(block), place : place + len(block)] = block
        place += len(block)
    gain = draw(strategies.sampled_from([0.1, 0.5, 1.0]))
    inputs, outputs = random.normal(size=(states, channels)), gain * random.normal(size=(channels, states))
    direct = draw(strategies.sampled_from([0.0, 0.3])) * random.normal(size=(channels, channels))
    return control.ss(matrix, inputs, outputs, direct, period)
