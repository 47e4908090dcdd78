"""Search for the smallest F with the required poles, from several such F, with Newton steps on F itself.

The set of these F has m p - n dimensions. It is described by the coefficients of the characteristic polynomial det(s I
- M), with derivatives from d det = -tr(adj(s I - M) dM), where adj(s I - M) is computed by the method of Faddeev and
Leverrier. On this set |F| is minimised by sequential quadratic programming (scipy's SLSQP, Kraft 1988), and Newton's
method improves the poles up to rounding: a simple pole with the left and right eigenvectors w, v (w v = 1) moves by
dlambda = w B dF C v with F. The method is ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.linalg import qr
from scipy.optimize import minimize

from .results import OutputFeedback, PlacementError, Reason
from .spectrum import match

_NEWTON_STEPS = 3  # steps; the second is within rounding if the first was small
_RANK = 1e-12  # relative; half of the equations are redundant for conjugate poles
_STARTS = 5  # number of smallest results of distributions to start from
_ACCURACY = 1e-10  # tolerance of |F|^2, relative to the start's
_STEPS = 100  # iterations of one search
_ROUNDS, _WORTH = 10, 0.01  # number of successive searches, and the least improvement of the last
_ALLOWED = 1000.0 * np.finfo(float).eps  # share of kappa |Ac| by which rounding may displace the poles of an F


def polish(feedback: OutputFeedback, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback:
    """Improve the poles by a few Newton steps of least norm; return the best result.

    The placement formulas use matrices that may be larger than F, with correspondingly larger rounding errors.
    """
    best = feedback
    for _ in range(_NEWTON_STEPS):
        poles, right = np.linalg.eig(feedback.closed_loop)
        left = np.linalg.solve(right, b.astype(complex))
        slope = (left[:, :, None] * (c @ right).T[:, None, :]).reshape(len(poles), -1)
        lacking = match(feedback.wanted, poles) - poles
        rows, sides = np.vstack([slope.real, slope.imag]), np.concatenate([lacking.real, lacking.imag])
        gain = feedback.gain + np.linalg.lstsq(rows, sides, rcond=_RANK)[0].reshape(feedback.gain.shape)
        feedback = replace(feedback, gain=gain, closed_loop=a + b @ gain @ c)
        best = min(best, feedback, key=lambda one: one.error)
    return best


def minimise_gain(feedbacks: Sequence[OutputFeedback], a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback:
    """Return the feedback of least |F| among ``feedbacks`` and the results of searches from them.

    Raises PlacementError for repeated poles, at which Newton's method has no derivative.
    """
    desired = feedbacks[0].wanted
    apart = np.abs(desired[:, None] - desired[None, :]) + np.diag(np.full(len(desired), np.inf))
    if not np.min(apart) > 0.0:
        raise PlacementError(
            "output feedback",
            Reason.RANK,
            "the search for the smallest gain needs distinct poles",
            0.0,
            "use choice least_norm",
        )
    starts = sorted(feedbacks, key=lambda one: one.norm)[:_STARTS]
    return min((_search_from(start, a, b, c) for start in starts), key=lambda one: one.norm)


def polynomial_and_slope(matrix: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the coefficients of det(s I - M), without the leading 1 (n,), and of adj(s I - M) (n, n, n).

    Both are in descending order.
    """
    adjugate, coefficients = [np.eye(len(matrix))], []
    for k in range(1, len(matrix) + 1):
        product = matrix @ adjugate[-1]
        coefficients.append(-np.trace(product) / k)
        adjugate.append(product + coefficients[-1] * np.eye(len(matrix)))
    return np.array(coefficients), np.array(adjugate[:-1])


def _search_from(start: OutputFeedback, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback:
    """Return the result of successive searches, each from the last result, until F hardly becomes smaller."""
    for _ in range(_ROUNDS):
        end = _search(start, a, b, c)
        if end is None or end.norm >= (1.0 - _WORTH) * start.norm:
            break
        start = end
    return start


def _search(start: OutputFeedback, a: np.ndarray, b: np.ndarray, c: np.ndarray) -> OutputFeedback | None:
    """Return the result of one search, None if it misses the required poles."""
    radius, scale = float(np.max(np.abs(start.wanted))), float(np.linalg.norm(start.gain))
    desired = np.poly(start.wanted / radius).real[1:]
    driven = b * (scale / radius)

    def loop(free: np.ndarray) -> np.ndarray:
        return a / radius + driven @ free.reshape(start.gain.shape) @ c

    def slope(free: np.ndarray) -> np.ndarray:
        return -(c @ polynomial_and_slope(loop(free))[1] @ driven).swapaxes(1, 2).reshape(len(a), -1)

    first = start.gain.ravel() / scale
    # combinations of the equations with orthonormal derivatives at the start
    mixed = np.linalg.pinv(qr(slope(first).T, mode="economic")[1].T)
    ended = minimize(
        lambda free: (free @ free, 2.0 * free),
        first,
        jac=True,
        method="SLSQP",
        constraints={
            "type": "eq",
            "fun": lambda free: mixed @ (polynomial_and_slope(loop(free))[0] - desired),
            "jac": lambda free: mixed @ slope(free),
        },
        options={"ftol": _ACCURACY, "maxiter": _STEPS},
    )
    if not np.all(np.isfinite(ended.x)):
        return None
    gain = scale * ended.x.reshape(start.gain.shape)
    there = replace(
        start,
        method="smallest",
        gain=gain,
        closed_loop=a + b @ gain @ c,
        condition_u=None,
        levels=(),
        upper=None,
        condition_x=None,
    )
    there = polish(there, a, b, c)
    allowed = _ALLOWED * there.kappa * np.linalg.norm(there.closed_loop, 2)
    return there if there.error <= allowed else None
