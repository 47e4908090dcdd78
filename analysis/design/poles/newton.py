"""Newton steps on F itself, nearer to the wanted poles.

A simple pole with the left and right eigenvectors w, v (w v = 1) moves by dlambda = w B dF C v when F does.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .results import OutputFeedback
from .spectrum import match

_STEPS = 3  # the second is within rounding where the first was small
_RANK = 1e-12  # relative; half of the equations say the same for conjugate poles


def polish(feedback: OutputFeedback, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback:
    """The nearest to the wanted poles after some Newton steps, each the smallest that would reach them.

    The formulas go through matrices that may be larger than F, and so are the errors that they bring.
    """
    best = feedback
    for _ in range(_STEPS):
        poles, right = np.linalg.eig(feedback.closed_loop)
        left = np.linalg.solve(right, b.astype(complex))
        slope = (left[:, :, None] * (c @ right).T[:, None, :]).reshape(len(poles), -1)
        lacking = match(feedback.wanted, poles) - poles
        rows, sides = np.vstack([slope.real, slope.imag]), np.concatenate([lacking.real, lacking.imag])
        gain = feedback.gain + np.linalg.lstsq(rows, sides, rcond=_RANK)[0].reshape(feedback.gain.shape)
        feedback = replace(feedback, gain=gain, closed_loop=a + b @ gain @ c)
        best = min(best, feedback, key=lambda one: one.error)
    return best
