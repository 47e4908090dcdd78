"""What a study finds of a loop that is not linear: L over the amplitude, elements, limit cycles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class AmplitudePoint:
    """Gain and phase of L at one frequency, measured with one amplitude of the injected signal (in its unit)."""

    amplitude: float
    value: complex
    change: float  # relative to the smallest amplitude's


@dataclass(frozen=True)
class LimitCycle:
    """A limit cycle predicted by harmonic balance, and what a simulation shows. Amplitudes at the element's input."""

    amplitude: float
    period: float  # s
    stable: bool
    simulated_amplitude: float | None  # None: the flight has no oscillation that lasts
    simulated_period: float | None


@dataclass(frozen=True)
class Nonlinearity:
    """An element of the loop with its describing function N(a), and the limit cycles that L and N predict."""

    name: str
    kind: str
    parameters: dict[str, float]
    unit: str | None  # of the amplitude
    amplitude: np.ndarray
    gain: np.ndarray  # complex N over amplitude
    cycles: tuple[LimitCycle, ...]
    note: str
