"""Structured singular value of complex matrices with one complex uncertainty per channel: upper bound by scaling.

The bound is the minimum of the largest singular value of D M D^-1 over positive diagonal D; up to three channels it is
the structured singular value itself (Packard and Doyle, "The complex structured singular value", Automatica 29 (1993),
sections 5 and 9). The logarithm of any Schatten norm of D M D^-1 is convex in log D (three lines theorem), smooth for
finite order of the norm, and for m channels exceeds the logarithm of the largest singular value by at most
log(m)/order. So Newton's method minimises norms of growing order, each from the previous minimum, for all matrices at
once.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse.csgraph import connected_components

_ACCURACY = 1e-10  # relative, of the last norm; tests verify that the bound is within a few times this
_GROWTH = 10.0  # factor on the order from one norm to the next
_MOST = 300  # Newton steps; the largest number needed by 300 real matrices of six channels with kinks was 91
_SHORTEST = 1e-12  # fraction of a Newton step
_FARTHEST = 3.0  # longest step of log D
_FLAT = 1e-10  # added curvature; without it the scale of a channel that affects no other would grow without limit
_ROUNDING = 1e-15
_SWEEPS = 4


def upper_bound(matrix: np.ndarray) -> np.ndarray:
    """Return the bound for each M of ``matrix`` (n, m, m), within about 1e-9.

    It is the minimum of the largest singular value of D M D^-1. Raises ValueError if it is not found.
    """
    bounds = np.zeros(len(matrix))
    for pattern in np.unique(matrix != 0.0, axis=0):
        alike = np.flatnonzero(np.all((matrix != 0.0) == pattern, axis=(1, 2)))
        # scaling removes one-way coupling and leaves groups of channels that affect each other
        groups, group = connected_components(pattern, directed=True, connection="strong")
        for number in range(groups):
            chosen = np.flatnonzero(group == number)
            bounds[alike] = np.maximum(bounds[alike], _of_group(matrix[np.ix_(alike, chosen, chosen)]))
    return bounds


def _of_group(matrix: np.ndarray) -> np.ndarray:
    channels = matrix.shape[-1]
    if channels == 1:
        return np.abs(matrix[:, 0, 0])
    largest = np.max(np.abs(matrix), axis=(1, 2))
    unit = matrix / largest[:, None, None]
    return largest * (_two(unit) if channels == 2 else _several(unit))


def _two(matrix: np.ndarray) -> np.ndarray:
    """Return both singular values at the optimal (balanced) scaling, from the determinant and the sum of squares."""
    across, back = np.abs(matrix[:, 0, 1]), np.abs(matrix[:, 1, 0])
    balanced = matrix.copy()
    balanced[:, 0, 1] = np.sqrt(across * back) * np.exp(1j * np.angle(matrix[:, 0, 1]))
    balanced[:, 1, 0] = np.sqrt(across * back) * np.exp(1j * np.angle(matrix[:, 1, 0]))
    return np.linalg.svd(balanced, compute_uv=False)[:, 0]


def _several(matrix: np.ndarray) -> np.ndarray:
    bounds = np.full(len(matrix), np.nan)
    logarithm = _balance(np.abs(matrix) ** 2)
    half = np.full(len(matrix), 2.0)  # half the norm's order; balancing has minimised the norm of order 2
    active = np.arange(len(matrix))
    for _ in range(_MOST):
        now, x, q = matrix[active], logarithm[active], half[active]
        value, gradient, curvature, sizes = _expansion(now, x, q)
        # the first channel keeps its scale, as only ratios matter
        gradient, curvature = gradient[:, 1:], curvature[:, 1:, 1:]
        extra = _FLAT + _ROUNDING * np.trace(curvature, axis1=1, axis2=2)
        curvature = curvature + extra[:, None, None] * np.eye(gradient.shape[1])
        step = -np.linalg.solve(curvature, gradient[:, :, None])[:, :, 0]
        step *= np.minimum(1.0, _FARTHEST / np.maximum(np.max(np.abs(step), axis=1), _FARTHEST))[:, None]
        slope = np.sum(step * gradient, axis=1)
        last = value - np.log(sizes[:, 0]) < _ACCURACY
        settled = -slope <= 0.1 * np.where(last, _ACCURACY, np.log(matrix.shape[-1]) / (2.0 * q))
        bounds[active[settled & last]] = sizes[settled & last, 0]
        half[active[settled & ~last]] *= _GROWTH
        moving = ~settled
        if moving.any():
            trial = _descend(now[moving], x[moving], q[moving], step[moving], value[moving], slope[moving])
            logarithm[active[moving]] = trial
        active = active[~(settled & last)]
        if not active.size:
            return bounds
    raise ValueError(f"the structured singular value of {active.size} matrices was not found in {_MOST} steps")


def _balance(squares: np.ndarray) -> np.ndarray:
    """Return log D (n, m) that makes rows and columns of D M D^-1 nearly equal in norm (Osborne 1960)."""
    channels = squares.shape[-1]
    minimum = 1e-20 * np.sum(squares, axis=(1, 2), keepdims=True)  # else a row of zeros has no balance
    squares = (squares + minimum) * (1.0 - np.eye(channels))
    logarithm = np.zeros(squares.shape[:2])
    for _ in range(_SWEEPS):
        for k in range(channels):
            gains = np.exp(2.0 * logarithm)
            row = gains[:, k] * np.sum(squares[:, k, :] / gains, axis=1)
            column = np.sum(squares[:, :, k] * gains, axis=1) / gains[:, k]
            logarithm[:, k] += 0.25 * np.log(column / row)
    return logarithm - logarithm[:, :1]


def _scale(matrix: np.ndarray, logarithm: np.ndarray) -> np.ndarray:
    gains = np.exp(logarithm)
    return matrix * gains[:, :, None] / gains[:, None, :]


def _norm(sizes: np.ndarray, half: np.ndarray) -> np.ndarray:
    """Return the log of the Schatten norm of order 2 ``half`` from singular values, the largest first."""
    fractions = (sizes / sizes[:, :1]) ** (2.0 * half[:, None])
    return np.log(sizes[:, 0]) + np.log(np.sum(fractions, axis=1)) / (2.0 * half)


def _descend(
    matrix: np.ndarray, start: np.ndarray, half: np.ndarray, step: np.ndarray, value: np.ndarray, slope: np.ndarray
) -> np.ndarray:
    """Return log D after the steps, each shortened until a tenth of the decrease predicted by its slope is reached."""
    length = np.ones(len(matrix))
    while True:
        trial = start.copy()
        trial[:, 1:] += step * length[:, None]
        norms = _norm(np.linalg.svd(_scale(matrix, trial), compute_uv=False), half)
        uphill = norms > value + 0.1 * length * slope + 1e-15
        if not uphill.any():
            return trial
        length[uphill] *= 0.4
        if np.min(length) < _SHORTEST:
            raise ValueError("the structured singular value was not found: its upper bound does not decrease")


def _expansion(
    matrix: np.ndarray, logarithm: np.ndarray, half: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return the log norm of order 2 ``half``, its gradient and Hessian in log D, and the singular values.

    With B = D M D^-1 = U S V* and A = B* B the norm's log is log(tr A^q)/(2 q). For the channel whose E is 1 on the
    diagonal, and 0 elsewhere, dB = E B - B E and dA = 2 B* E B - E A - A E. Second derivatives of traces follow from
    divided differences of q r^(q-1) (Lewis and Sendov, "Twice differentiable spectral functions", SIAM J. Matrix Anal.
    Appl. 23 (2001)).
    """
    left, sizes, right = np.linalg.svd(_scale(matrix, logarithm))
    value = _norm(sizes, half)
    s = sizes / sizes[:, :1]
    squares = s * s
    # U* E U and V* E V for every channel: (n, channel, m, m)
    left_products = left.conj()[:, :, :, None] * left[:, :, None, :]
    back = right.swapaxes(1, 2)
    moved = back[:, :, :, None] * back.conj()[:, :, None, :]
    left_products = (s[:, :, None] * s[:, None, :])[:, None] * left_products
    first = 2.0 * left_products - (squares[:, :, None] + squares[:, None, :])[:, None] * moved  # dA, in the basis V

    order = half[:, None, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        weight = np.exp((half[:, None] - 1.0) * np.log(squares))
        higher = np.maximum(squares[:, :, None], squares[:, None, :])
        lower = np.minimum(squares[:, :, None], squares[:, None, :])
        apart = -np.expm1((order - 1.0) * np.log(lower / higher)) / (higher - lower)
        alike = higher - lower <= 1e-15 * higher
        divided = np.maximum(weight[:, :, None], weight[:, None, :]) * np.where(alike, (order - 1.0) / higher, apart)
    divided = np.where(higher > 0.0, divided, 0.0)

    n, channels = s.shape
    total = np.sum(squares * weight, axis=1)[:, None]
    diagonal = np.arange(channels)
    gradient = np.sum(weight[:, None] * first[:, :, diagonal, diagonal].real, axis=2) / total

    def traces(one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Return Re tr(one_k other_l) for all pairs of channels."""
        flat = other.swapaxes(2, 3).reshape(n, channels, -1).swapaxes(1, 2)
        return (one.reshape(n, channels, -1) @ flat).real

    weighted = weight[:, None, :, None]
    hessian = traces(divided[:, None] * first, first)
    hessian -= 4.0 * traces(weighted * left_products, moved) + 2.0 * traces(weighted * moved, first)
    hessian[:, diagonal, diagonal] += 4.0 * np.sum(
        weight[:, None] * left_products[:, :, diagonal, diagonal].real, axis=2
    )
    hessian = 0.5 * hessian / total[:, :, None] - 0.5 * order * gradient[:, :, None] * gradient[:, None, :]
    return value, 0.5 * gradient, hessian, sizes
