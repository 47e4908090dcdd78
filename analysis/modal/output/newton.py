"""Newton steps on F itself: nearer to the wanted poles, and along all F that have them to a small one.

A simple pole with the left and right eigenvectors w, v (w v = 1) moves by dlambda = w B dF C v when F does. Ours; the
derivative is the classical one (Jacobi 1846).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..refusal import PlacementError, Reason
from ..results import OutputFeedback
from ..spectrum import matched

_POLISH = 3  # steps; the second is within rounding where the first was small
_DOWN = 300  # steps along the set
_BACK = 4  # Newton steps from beside the set onto it
_ON = 1e-9  # relative to |Ac|; how far from the poles still counts as on the set
_SHORTEST = 1e-6
_RANK = 1e-12
_GAIN = 1e-6  # relative; a step that brings less is none


def polished(found: OutputFeedback, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback:
    """The nearest to the wanted poles after some Newton steps, each the smallest that would reach them."""
    best = found
    for _ in range(_POLISH):
        slope, lacking = _slope(a, b, c, found.gain, found.wanted)
        found = _with(found, found.gain + _least(slope, lacking, found.gain), a, b, c)
        best = min(best, found, key=lambda one: one.error)
    return best


def descended(found: OutputFeedback, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback:
    """From an F down to one of least Frobenius norm nearby among those with the same poles, of which m p - n are free.

    Each step goes towards the smallest F that has the poles to first order, as far as that brings something once
    Newton steps have led back onto the set. Raises PlacementError for repeated poles, which have no derivative.
    """
    apart = np.abs(found.wanted[:, None] - found.wanted[None, :]) + np.diag(np.full(len(a), np.inf))
    if not np.min(apart) > 0.0:
        raise PlacementError(
            "output feedback", Reason.RANK, "poles are repeated: they have no derivative", 0.0, "take choice least_norm"
        )
    gain, length = found.gain, 1.0
    for _ in range(_DOWN):
        slope, lacking = _slope(a, b, c, gain, found.wanted)
        step = _least(slope, slope @ gain.ravel() + lacking, gain) - gain
        while length > _SHORTEST:
            there = _onto(a, b, c, gain + length * step, found.wanted)
            if there is not None and np.linalg.norm(there) < (1.0 - _GAIN) * np.linalg.norm(gain):
                break
            length *= 0.5
        else:
            break
        gain, length = there, min(1.0, 2.0 * length)
    return polished(replace(_with(found, gain, a, b, c), method="smallest", upper=None, condition_x=None), a, b, c)


def _onto(a: np.ndarray, b: np.ndarray, c: np.ndarray, gain: np.ndarray, wanted: np.ndarray) -> np.ndarray | None:
    """The F with the wanted poles that Newton's method finds, None where it does not."""
    size = np.linalg.norm(a + b @ gain @ c, 2)
    for _ in range(_BACK):
        slope, lacking = _slope(a, b, c, gain, wanted)
        if np.max(np.abs(lacking)) < _ON * size:
            return gain
        gain = gain + _least(slope, lacking, gain)
    return None


def _slope(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, gain: np.ndarray, wanted: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Derivatives of the poles in the elements of F (2 n, m p), and what they lack (2 n,): real, then imaginary."""
    poles, right = np.linalg.eig(a + b @ gain @ c)
    left = np.linalg.solve(right, b.astype(complex))
    by_gain = (left[:, :, None] * (c @ right).T[:, None, :]).reshape(len(poles), -1)
    lacking = matched(wanted, poles) - poles
    return np.vstack([by_gain.real, by_gain.imag]), np.concatenate([lacking.real, lacking.imag])


def _least(slope: np.ndarray, side: np.ndarray, like: np.ndarray) -> np.ndarray:
    """The smallest solution, shaped as F. Half of the rows say the same for conjugate poles."""
    return np.linalg.lstsq(slope, side, rcond=_RANK)[0].reshape(like.shape)


def _with(found: OutputFeedback, gain: np.ndarray, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback:
    return replace(found, gain=gain, closed_loop=a + b @ gain @ c)
