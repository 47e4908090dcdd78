"""Results of one loop beyond its margins: linearised and measured response, modes, state space, limit cycles.

Times are in s, frequencies in rad/s; gains are factors.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..loops.readings import FrequencyResponse


@dataclass(frozen=True)
class Mode:
    """Closed-loop mode over the ``period`` (s) of the linear model.

    ``z`` is the multiplier over one period, and ``s`` is the equivalent log(z)/period (rad/s; not unique above the
    Nyquist frequency of the period). ``kind`` is "loop" for modes that are controllable and observable at the cut, else
    "not controllable", "not observable" or "neither". ``controllability`` and ``observability`` are the norms of the
    mode's input and output vectors, relative to the largest norm of any mode.
    """

    z: complex
    s: complex
    damping: float
    frequency: float
    kind: str
    controllability: float
    observability: float


@dataclass(frozen=True)
class Structure:
    """Ranks of the controllability and observability matrices, and their smallest retained singular values."""

    states: int  # number of states of the complete memory
    order: int  # number of states that affect the cut and are affected by it
    controllable: int
    observable: int
    least_controllable: float
    least_observable: float


@dataclass(frozen=True)
class Linearised:
    """Properties of the Jacobian that show whether it can be trusted."""

    states: int
    period: float  # s, over which the Jacobian was taken
    plateau: float  # largest relative change of a column between neighbouring steps of the difference
    doubtful: tuple[str, ...]  # memory whose columns have no plateau: kinks, switches
    periodicity: float  # largest share of the response at other frequencies; 0: time-invariant


@dataclass(frozen=True)
class Measured:
    """Properties of the injection that show whether it can be trusted."""

    amplitude: float  # amplitude of one line, in the cut's unit
    lines: int
    periods: int
    period: float  # s, of the multisine
    half_amplitude_change: float  # largest relative change of L between full and half amplitude
    unexcited: float  # largest response on unexcited lines over the response on excited ones: nonlinearity, noise
    curve: FrequencyResponse


@dataclass(frozen=True)
class Agreement:
    """Largest difference between the two methods below half the Nyquist frequency."""

    gain: float  # factor, at least 1
    phase: float  # rad
    frequency: float  # rad/s, highest that was compared
    agrees: bool


@dataclass(frozen=True)
class StateSpace:
    """Open loop x[k+1] = A x[k] + B u[k], y[k] = C x[k] + D u[k], with L from ``u`` to ``y``.

    ``u`` is the signal into the loop after the break point, ``y`` is minus the return signal, so the loop is closed by
    u = d - y, and L is positive for negative feedback. All are deviations from the simulation at the operating point,
    in the units of ``signal_units`` and ``state_units`` (None: dimensionless).

    ``period`` (s) is the time from k to k + 1. If ``samples`` is 1, the period is the loop's sample period. For a loop
    that changes from sample to sample within the hyperperiod, the period is the hyperperiod, and u and y stack its
    ``samples``, oldest first, channel by channel within each. ``error`` is the largest relative difference between L of
    the model and L of the study where |L| is between 1/33 and 33.
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    period: float
    samples: int
    states: tuple[str, ...]
    state_units: tuple[str | None, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    signal_units: tuple[str | None, ...]  # units of inputs and outputs
    error: float

    def response(self, frequency: np.ndarray) -> np.ndarray:
        """Return L(w) at angular frequencies (rad/s, shape (n,)), of shape (n, outputs, inputs)."""
        z = np.exp(1j * self.period * np.asarray(frequency, dtype=float))
        shifted = z[:, None, None] * np.eye(len(self.a)) - self.a
        return self.c @ np.linalg.solve(shifted, self.b.astype(complex)[None]) + self.d


@dataclass(frozen=True)
class AmplitudePoint:
    """L at one frequency, measured with one amplitude of the injected signal (in its unit)."""

    amplitude: float
    value: complex
    change: float  # relative to the smallest amplitude


@dataclass(frozen=True)
class LimitCycle:
    """Limit cycle predicted by harmonic balance, with amplitude and period of the simulated limit cycle.

    Amplitudes are at the element's input.
    """

    amplitude: float
    period: float  # s
    stable: bool
    simulated_amplitude: float | None  # None: the simulation has no sustained oscillation
    simulated_period: float | None


@dataclass(frozen=True)
class Nonlinearity:
    """Element of the loop with its describing function N(a), and the limit cycles that L and N predict."""

    name: str
    kind: str
    parameters: dict[str, float]
    unit: str | None  # unit of the amplitude
    amplitude: np.ndarray
    gain: np.ndarray  # complex N over amplitude
    cycles: tuple[LimitCycle, ...]
    note: str
