"""Placement by controllability indices: any controllable pair, any spectrum.

With Q = [b_1 .. A^(k_1 - 1) b_1, b_2 ..], t_i the row of Q^-1 at the end of block i, Gamma = [t_i A^(k_i - 1) B] and
phi_i the wanted polynomial of degree k_i, u = -K x with K = Gamma^-1 [t_i phi_i(A)]. Inputs with k_i = 0 get no gain.
Canonical form: Luenberger (1967); the gain was derived here: t_i (A - B K)^j = t_i A^j for j < k_i, and then
t_i phi_i(A - B K) = 0.
"""

from __future__ import annotations

import numpy as np

from .controllability import TOLERANCE, controllability_indices
from .polynomial import make_polynomial
from .results import StateFeedback
from .spectrum import Spectrum


def indices(a: np.ndarray, b: np.ndarray, spectrum: Spectrum, tolerance: float = TOLERANCE) -> StateFeedback:
    """Place the spectrum. Raises PlacementError for a pair that is not controllable."""
    lengths = controllability_indices(a, b, tolerance)
    used = [i for i, length in enumerate(lengths) if length]
    degrees = [lengths[i] for i in used]
    columns = [b[:, i] for i in used]
    chains = []
    for column, degree in zip(columns, degrees, strict=True):
        chain = [column]
        for _ in range(degree - 1):
            chain.append(a @ chain[-1])
        chains.append(np.column_stack(chain))
    q = np.hstack(chains)
    ends = np.cumsum(degrees) - 1
    powers = [np.linalg.solve(q.T, np.eye(len(a))[:, ends]).T]  # t_i A^l for l = 0, 1, ..
    for _ in range(max(degrees)):
        powers.append(powers[-1] @ a)
    gamma = np.array([powers[degree - 1][i] @ b[:, used] for i, degree in enumerate(degrees)])
    rows = np.array([powers[degree][i] for i, degree in enumerate(degrees)])
    for level, block in enumerate(make_polynomial(spectrum, degrees)):
        rows += block @ powers[level]
    gain = np.zeros(b.T.shape)
    gain[used] = np.linalg.solve(gamma, rows)
    return StateFeedback("indices", gain, spectrum.poles, a - b @ gain, float(np.linalg.cond(q)))
