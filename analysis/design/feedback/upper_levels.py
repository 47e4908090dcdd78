"""Output feedback: the freedom of the upper levels is used to place the poles of the zeroth level.

F C = Phi_0 B^- - B^- A with B^- = B^+ - K_1 P (`poles/zeroth_level.py`) exists if Phi_0 X = Y with X = B^- C^perp and Y
= B^- A C^perp (m, n - p). Phi_0 must also have the remaining m poles. For generic plants with m + p > n this is
possible with any K_1 on the upper level. Here K_1 is any gain that gives the upper level its n - m poles:

    K_1 = K(theta) + N W,    B_1 N = 0,

Here theta are the eigenvectors of the upper level's closed loop (equivalently, the matrices Phi_1, Phi_2 .. with these
spectra, and the factors and one-sided inverses from which they are assembled). N spans the right null space of B_1 = P
A B (its divisors of zero), and W is any matrix: N W affects X and Y but not the upper level. There are (m - 1)(n - m)
free numbers:

    m + p > n:  none is needed; one that makes (Y X^+, Q) observable helps if a diagonal Phi_1 does not;
    m + p = n:  Phi_0 = Y X^-1 has m coefficients to be satisfied;
    m + p < n:  Phi_0 = Y X^+ has, too, and so do the m (n - p - m) equations Y (I - X^+ X) = 0.

m p - n free numbers remain, so the method requires m p >= n. A generic plant with m p >= n has complex solutions
(Brockett and Byrnes 1981), and with m p > n real solutions (Wang, "Pole placement by static output feedback", Journal
of Mathematical Systems, Estimation, and Control 2 (1992)); the equations are solved by least squares from random
starts. Lapin's thesis, section 2.3.1.3, states the aim: controllability by outputs through matrices with desired
spectra, divisors of zero and of unity, and factors on the upper levels. The parametrisation is ours.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import null_space
from scipy.optimize import least_squares

from ....common.errors import InputError
from ..poles.freedom import family_of, on_levels
from ..poles.plant import input_matrix, output_matrix, state_matrix
from ..poles.results import OutputFeedback, PlacementError, Reason, StateFeedback
from ..poles.smallest import polish
from ..poles.spectrum import Spectrum
from ..poles.zeroth_level import ZerothLevel, condition_of, place_zeroth_level

ROUTINE = "upper levels"
_SOLVED = 1e-6  # residual of the equations, in units of the largest pole; Newton's method does the rest
_STEPS = 200
_PLACED = 1e4 * np.finfo(float).eps  # share of kappa |Ac| by which rounding may displace the poles of an F


class UpperLevels:
    """All gains that place the poles of the level above the zeroth, parametrised by ``size`` numbers."""

    def __init__(self, level: ZerothLevel, upper: Spectrum) -> None:
        """Prepare the parametrisation. Raises PlacementError for a pole repeated more often than there are inputs."""
        self.level, self.upper = level, upper
        self.levels, self.family = family_of(*level.above, upper)
        self.divisors = null_space(level.above[1])
        self.unit = float(np.linalg.norm(level.a, 2))
        self.size = self.family.parameters + self.divisors.shape[1] * upper.size

    def added(self, free: np.ndarray) -> np.ndarray:
        """Return N W, the term of K_1 that does not affect the upper level."""
        w = self.unit * free[self.family.parameters :].reshape(self.divisors.shape[1], self.upper.size)
        return self.divisors @ w

    def gain(self, free: np.ndarray) -> np.ndarray:
        """Return K_1 of u = K_1 x."""
        return self.family.gain(self.family.at(free[: self.family.parameters])) + self.added(free)

    def feedback(self, free: np.ndarray) -> StateFeedback:
        """Return the feedback u = -K x of the upper level, computed on its levels: poles are exact up to rounding."""
        a, b = self.level.above
        first = on_levels(self.levels, self.family, free[: self.family.parameters])
        gain = first.gain - self.added(free)
        return replace(first, method=ROUTINE, gain=gain, closed_loop=a - b @ gain)


def output_feedback_upper(
    a: ArrayLike,
    b: ArrayLike,
    c: ArrayLike,
    poles: ArrayLike,
    *,
    upper: ArrayLike | None = None,
    starts: int = 20,
    seed: int = 0,
) -> OutputFeedback:
    """Return the gain F (m, p) of **u = F y** that gives A + B F C the poles, for m p >= n.

    ``a`` is A (n, n), ``b`` B (n, m), ``c`` C (p, n), of full ranks; ``poles`` as in `place`. ``upper`` are the n - m
    poles of the upper levels, by default of the first distribution without divided pairs. The free numbers are searched
    from ``starts`` random starts with ``seed``. The result is the solution with the smallest |F| for m + p > n,
    otherwise the first solution. Raises InputError; PlacementError for m p < n, uncontrollable levels, or if no start
    converges.
    """
    state = state_matrix(a)
    inputs, outputs = input_matrix(b, len(state)), output_matrix(c, len(state))
    spectrum = Spectrum.of(poles, len(state))
    if starts < 1:
        raise InputError("modal", "starts", f"{starts} starts", "give 1 or more")
    n, m, p = len(state), inputs.shape[1], len(outputs)
    if m * p < n:
        problem = f"F has m p = {m} x {p} = {m * p} elements, too few to place n = {n} poles"
        raise PlacementError(ROUTINE, Reason.CLASS, problem, float(m * p), "measure more outputs, or use an observer")
    if m == n or p == n:
        raise InputError(
            "modal",
            "C" if p == n else "B",
            "measures every state" if p == n else "drives every state",
            "use output_feedback",
        )
    high, low = _distribute(spectrum, n - m, upper)
    family = UpperLevels(ZerothLevel(state, inputs, outputs), high)
    random = np.random.default_rng(seed)
    draws = (random.normal(size=family.size) for _ in range(starts))
    if m + p > n:
        return _best(family, low, draws)
    return _solve(family, low, draws, starts)


def _distribute(spectrum: Spectrum, size: int, upper: ArrayLike | None) -> tuple[Spectrum, Spectrum]:
    if upper is not None:
        high = Spectrum.of(upper, size, "upper")
        return high, spectrum.without(high)
    split = next(spectrum.splits(size), None)
    if split is not None:
        return split
    problem = f"the upper levels need {size} poles, which would split one of {len(spectrum.pairs)} conjugate pairs"
    remedy = "solve for (A', C', B') and transpose F, or replace a pair by two real poles"
    raise PlacementError(ROUTINE, Reason.SPREAD, problem, float(len(spectrum.pairs)), remedy)


def _best(family: UpperLevels, lower: Spectrum, draws: Iterator[np.ndarray]) -> OutputFeedback:
    refused: PlacementError | None = None
    feedbacks = []
    for free in draws:
        try:
            feedbacks.append(place_zeroth_level(family.level, family.feedback(free), family.upper, lower))
        except PlacementError as error:
            refused = error
    if not feedbacks:
        assert refused is not None  # there is at least one start
        raise refused
    return replace(min(feedbacks, key=lambda one: one.norm), method=ROUTINE)


def _solve(family: UpperLevels, lower: Spectrum, draws: Iterator[np.ndarray], starts: int) -> OutputFeedback:
    level = family.level
    radius = max(float(np.max(np.abs(lower.poles))), float(np.max(np.abs(family.upper.poles))))
    required = np.poly(lower.poles / radius).real[1:]

    def equations(free: np.ndarray) -> np.ndarray:
        _, x, y = level.lower_matrices(family.gain(free))
        phi = np.linalg.lstsq(x.T, y.T)[0].T
        return np.concatenate([np.poly(phi / radius).real[1:] - required, ((y - phi @ x) / radius).ravel()])

    nearest = np.inf
    for start in draws:
        solution = least_squares(equations, start, max_nfev=_STEPS)
        nearest = min(nearest, size := float(np.max(np.abs(solution.fun))))
        if size > _SOLVED:
            continue
        first = family.feedback(solution.x)
        inverse, x, y = level.lower_matrices(-first.gain)
        phi = np.linalg.lstsq(x.T, y.T)[0].T
        feedback = level.feedback(inverse, phi, family.upper, lower, condition_of(x))
        placed = polish(replace(feedback, method=ROUTINE, levels=first.levels), level.a, level.b, level.c)
        if placed.error <= _PLACED * placed.kappa * float(np.linalg.norm(placed.closed_loop, 2)):
            return placed
    problem = (
        f"the iteration did not converge: after the best of {starts} starts, the residual of the zeroth "
        f"level's equations is {nearest:.2g}"
    )
    remedy = "give more starts, choose other upper poles, or measure more outputs"
    raise PlacementError(ROUTINE, Reason.RESIDUAL, problem, nearest, remedy)
