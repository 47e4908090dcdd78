"""A loop's linear model as others read it: A, B, C, D of L with names, units and the period of the samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class StateSpace:
    """The open loop x[k+1] = A x[k] + B u[k], y[k] = C x[k] + D u[k], with L from ``u`` to ``y``.

    ``u`` is what goes into the loop behind the break point, ``y`` minus what returns to it, so that the loop is
    closed by u = d - y and L is positive for negative feedback. All are deviations from the flight at the operating
    point, in the units given (None: without one).

    ``period`` (s) is that between two k. Where ``samples`` is 1 it is the loop's own sample period; a loop that changes
    from sample to sample within the hyperperiod has its ``samples`` of u and y stacked, oldest first, channel by
    channel within each, and the hyperperiod for its period. ``error`` is the largest relative difference of the
    model's L from the study's where |L| is between 1/33 and 33.
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
    signal_units: tuple[str | None, ...]  # of inputs and outputs alike
    error: float

    def response(self, frequency: np.ndarray) -> np.ndarray:
        """y over u at angular frequencies (rad/s, shape (n,)): shape (n, outputs, inputs)."""
        z = np.exp(1j * self.period * np.asarray(frequency, dtype=float))
        shifted = z[:, None, None] * np.eye(len(self.a)) - self.a
        return self.c @ np.linalg.solve(shifted, self.b.astype(complex)[None]) + self.d
