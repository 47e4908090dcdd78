"""Plants driven by pulses of variable length, exact over a tick for any number of switch-offs.

Input i has the value U_i from the start of a tick T for tau_i and then 0, so that

    x+ = expm(A T) x + sum_i expm(A (T - tau_i)) Psi(tau_i) b_i U_i,    Psi(tau) = integral_0^tau expm(A s) ds,
    dx+/dx = expm(A T),    dx+/dtau_i = expm(A (T - tau_i)) b_i U_i.

Psi b is a column of expm([A b; 0 0] tau): Van Loan, "Computing integrals involving the matrix exponential", IEEE
Transactions on Automatic Control 23 (1978). The division of the tick at the switch-offs is from Lapin's thesis (2.2.1);
the formulas are ours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from ....common.errors import InputError
from .plant import input_matrix, real_matrix, state_matrix


@dataclass(frozen=True)
class PulsedPlant:
    """Plant x' = A x + B u over ticks of ``period`` (s), with pulses at their starts; ``a`` (n, n), ``b`` (n, m)."""

    a: np.ndarray
    b: np.ndarray
    period: float

    @classmethod
    def of(cls, a: ArrayLike, b: ArrayLike, period: float) -> PulsedPlant:
        """Return a plant from arrays or lists. Raises InputError."""
        state = state_matrix(a)
        if not 0.0 < period < np.inf:
            raise InputError("modal", "period", f"is {period:g} s", "give a time above 0")
        return cls(state, input_matrix(b, len(state)), float(period))

    @cached_property
    def transition(self) -> np.ndarray:
        """Matrix dx+/dx = expm(A T) (n, n), independent of the pulses."""
        return expm(self.a * self.period)

    def after(self, state: ArrayLike, lengths: ArrayLike, values: ArrayLike) -> np.ndarray:
        """Return x (n,) after a tick, for pulses of ``lengths`` tau (m,) in s and ``values`` U (m,).

        Raises InputError.
        """
        lengths, values = self._pulses(lengths, values)
        propagated = self.transition @ real_matrix("state", state, (len(self.a),))
        for column, length, value in zip(self.b.T, lengths, values, strict=True):
            propagated += value * (expm(self.a * (self.period - length)) @ self._integral(column, length))
        return propagated

    def by_lengths(self, lengths: ArrayLike, values: ArrayLike) -> np.ndarray:
        """Return the derivative of x after a tick with respect to the pulse lengths, (n, m). Raises InputError."""
        lengths, values = self._pulses(lengths, values)
        columns = [
            expm(self.a * (self.period - length)) @ column for column, length in zip(self.b.T, lengths, strict=True)
        ]
        return np.column_stack(columns) * values

    def _integral(self, column: np.ndarray, length: float) -> np.ndarray:
        """Return Psi(tau) b."""
        size = len(column)
        joint = np.zeros((size + 1, size + 1))
        joint[:size, :size], joint[:size, size] = self.a, column
        return expm(joint * length)[:size, size]

    def _pulses(self, lengths: ArrayLike, values: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        shape = (self.b.shape[1],)
        return pulse_lengths(lengths, shape, self.period), real_matrix("values", values, shape)


def pulsed_step(
    rate: Callable[[np.ndarray, np.ndarray], np.ndarray],
    state: ArrayLike,
    lengths: ArrayLike,
    values: ArrayLike,
    period: float,
    *,
    longest: float = np.inf,
) -> np.ndarray:
    """Return x (n,) of x' = ``rate`` (x, u) after a tick of ``period`` (s), for pulses as in `PulsedPlant`.

    Uses the fourth-order Runge-Kutta method over the intervals between switch-offs, in equal steps of at most
    ``longest`` (s). Raises InputError.
    """
    propagated = np.array(state, dtype=float)
    pulses = real_matrix("values", values, np.shape(lengths))
    ends = pulse_lengths(lengths, pulses.shape, period)
    if not longest > 0.0:
        raise InputError("modal", "longest", f"is {longest:g} s", "give a time above 0")
    instants = np.unique([0.0, *ends, period])
    for begin, end in pairwise(instants):
        steps = max(1, int(np.ceil((end - begin) / longest)))
        on, h = np.where(ends >= end, pulses, 0.0), (end - begin) / steps
        for _ in range(steps):
            one = rate(propagated, on)
            two = rate(propagated + 0.5 * h * one, on)
            three = rate(propagated + 0.5 * h * two, on)
            propagated = propagated + h / 6.0 * (one + 2.0 * two + 2.0 * three + rate(propagated + h * three, on))
    return propagated


def pulse_lengths(lengths: ArrayLike, shape: tuple[int, ...], period: float) -> np.ndarray:
    pulses = real_matrix("lengths", lengths, shape)
    outside = pulses[(pulses < 0.0) | (pulses > period)]
    if outside.size:
        raise InputError(
            "modal", "lengths", f"a pulse lasts {outside[0]:g} s", f"give 0 to {period:g} s, the tick period"
        )
    return pulses
