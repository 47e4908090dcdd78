"""Output feedback with m + p = n: Phi_0 = Y X^-1 is fixed by K_1, and K_1 is what is chosen.

The eigenvectors of the upper level's poles are free (Phi_1 = S D S^-1); the m equations "characteristic polynomial of
Phi_0 as wanted" are solved for them by least squares from random starts. Ours; for m p > n solutions are generic over
complex numbers (Brockett and Byrnes 1981), real ones not.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

from .freedom import family_of, on_levels
from .newton import polish
from .refusal import PlacementError, Reason
from .results import OutputFeedback
from .spectrum import Spectrum
from .zeroth_level import ZerothLevel, condition_of

_SOLVED = 1e-5  # of the polynomial's coefficients, poles measured by the largest wanted one; Newton does the rest
_STEPS = 60  # of a search: those that arrive took fewer


def square(level: ZerothLevel, upper: Spectrum, lower: Spectrum, starts: int, seed: int) -> OutputFeedback:
    """``upper`` (n - m poles) on the upper level, ``lower`` (m) on the zeroth. Raises PlacementError."""
    levels, family = family_of(*level.above, upper)
    radius = float(np.max(np.abs(lower.poles)))
    wanted = np.poly(lower.poles / radius).real[1:]

    def residual(free: np.ndarray) -> np.ndarray:
        _, x, y = level.lower_matrices(family.gain(family.at(free)))
        return np.poly(np.linalg.solve(x.T, y.T) / radius).real[1:] - wanted

    random = np.random.default_rng(seed)
    minimum = np.inf
    for _ in range(starts):
        solution = least_squares(residual, random.normal(size=family.parameters), max_nfev=_STEPS)
        minimum = min(minimum, size := float(np.max(np.abs(solution.fun))))
        if size < _SOLVED:
            first = on_levels(levels, family, solution.x)
            inverse, x, y = level.lower_matrices(-first.gain)
            phi = np.linalg.solve(x.T, y.T).T
            placed = replace(level.feedback(inverse, phi, upper, lower, condition_of(x)), levels=first.levels)
            return polish(placed, level.a, level.b, level.c)
    raise PlacementError(
        "output feedback",
        Reason.RESIDUAL,
        f"m + p = n, and of {starts} starts the nearest leaves {minimum:.2g} of the polynomial",
        minimum,
        "give more starts, spread the poles in another way, or measure more",
    )
