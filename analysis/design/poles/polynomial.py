"""Monic matrix polynomials with a required determinant.

Phi(s) = I s^p + N_(p-1) s^(p-1) + .. + N_0 is represented by its coefficients N (p, m, m), N_0 first.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from .plant import real_matrix
from .spectrum import Spectrum


def make_polynomial(spectrum: Spectrum, degrees: Sequence[int]) -> np.ndarray:
    """Return the coefficients (largest degree, r, r) of a matrix polynomial with this spectrum.

    Column j has degree ``degrees[j]``; its leading coefficient 1 is not stored. Each diagonal element has separate
    poles. A conjugate pair a ± i b for which the diagonal elements have no room left uses two elements of odd degree,
    in the block

        [ (s - a) f     -b g    ]
        [    b f     (s - a) g  ]

    whose determinant is f g ((s - a)^2 + b^2).
    """
    odd = [j for j, degree in enumerate(degrees) if degree % 2]
    across = max(0, len(spectrum.pairs) - sum(degree // 2 for degree in degrees))
    lying = list(zip(odd[0 : 2 * across : 2], odd[1 : 2 * across : 2], spectrum.pairs[:across], strict=True))
    rooms = [degree - any(j in (first, second) for first, second, _ in lying) for j, degree in enumerate(degrees)]
    parts = Spectrum(spectrum.real, spectrum.pairs[across:]).distribute(rooms)
    assert parts is not None  # pairs that do not fit use two elements
    coefficients = np.zeros((max(degrees) + 1, len(degrees), len(degrees)))
    for j, part in enumerate(parts):
        coefficients[: part.size + 1, j, j] = part.polynomial
    for first, second, pair in lying:
        for j, other, sign in ((first, second, 1.0), (second, first, -1.0)):
            factor = coefficients[:, j, j].copy()
            coefficients[:, other, j] = sign * pair.imag * factor
            coefficients[:, j, j] = np.roll(factor, 1) - pair.real * factor
    for j, degree in enumerate(degrees):
        coefficients[degree, j, j] -= 1.0  # the leading coefficient, which is not stored
    return coefficients[:-1]


def polynomial_of_solvents(solvents: Sequence[ArrayLike]) -> np.ndarray:
    """Return N (p, m, m) of Phi(s) = (s I - S_p) .. (s I - S_1) for ``solvents`` S_1 .. S_p, real (m, m) each.

    Its spectrum is the union of the spectra of the solvents. Raises InputError.
    """
    size = len(np.atleast_2d(solvents[0]))
    coefficients = np.eye(size)[None]
    for index, solvent in enumerate(solvents):
        factor = real_matrix(f"solvents[{index}]", solvent, (size, size))
        zero = np.zeros((1, size, size))
        coefficients = np.concatenate([zero, coefficients]) - np.concatenate([factor @ coefficients, zero])
    return coefficients[:-1]


def block_companion(coefficients: np.ndarray) -> np.ndarray:
    """Return the real matrix (p m, p m) with the spectrum of the polynomial N (p, m, m)."""
    blocks, size, _ = coefficients.shape
    below = np.hstack(list(-coefficients))
    return np.vstack([np.eye((blocks - 1) * size, blocks * size, size), below])
