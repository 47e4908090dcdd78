"""Use of the freedom of a placement with several inputs: well-conditioned eigenvectors, or a small gain.

The eigenvector x of a pole is any vector in the null space of P (A - lambda I), with orthonormal rows of P and P B = 0,
whose dimension is the rank of B: Moore, "On the flexibility offered by state feedback in multivariable systems beyond
closed loop eigenvalue assignment", IEEE Transactions on Automatic Control 21 (1976).

A level's Phi_i = S_i D_i S_i^-1 has the poles D_i for any S_i, and the poles can be distributed over the levels. Every
attainable closed loop has eigenvectors of Moore's form, so the search runs over these, where every point is a closed
loop and nothing is singular: quasi-Newton steps (BFGS) from several starts, the best result of which is used. The
result is placed exactly on the levels (`on_levels`). The search is ours; the criteria are those of Kautsky, Nichols and
Van Dooren, "Robust pole assignment in linear state feedback", International Journal of Control 41 (1985) and of
Kochetkov and Utkin, "Minimizing the feedback matrix norm in modal control problems", Automation and Remote Control 75
(2014).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from scipy.linalg import qr
from scipy.optimize import minimize

from .controllability import TOLERANCE
from .multilevel import PoleLevel, decompose, place_on_levels
from .results import PlacementError, Reason, StateFeedback
from .spectrum import Spectrum

_ORDERS = (2.0, 16.0, 128.0)  # orders of norms that tend to the largest singular value; the first is smooth everywhere
_COARSE, _FINE = (1e-3, 400), (1e-6, 600)  # slope and steps at which a descent ends
_KEPT = 2  # starts that are continued
Objective = Callable[[np.ndarray], tuple[float, np.ndarray]]


class Eigenvectors:
    """Unit eigenvectors of all real poles and pairs as functions of free parameters.

    They are represented by a real matrix Y (n, n). Its columns are the vectors of the real poles, then sqrt 2 times the
    real parts and then sqrt 2 times the imaginary parts of the vectors of the pairs, so that Y has the singular values
    of the complex matrix. (A + B K) Y = Y M.
    """

    def __init__(self, level: PoleLevel, spectrum: Spectrum) -> None:
        """Prepare the pair on level 0 with one pole for each state."""
        self.spectrum = spectrum
        self.a, self.inverse = level.a, np.linalg.pinv(level.b)
        self.reals, self.pairs, self._rank = len(spectrum.real), len(spectrum.pairs), level.rank
        poles = np.array([*spectrum.real, *spectrum.pairs], dtype=complex)
        rows = level.down @ (level.a - poles[:, None, None] * np.eye(len(level.a)))
        # the last columns of the complete Q are orthogonal to the rows
        self._spaces = np.linalg.qr(rows.conj().swapaxes(1, 2), mode="complete")[0][:, :, len(level.down) :]
        self.parameters = (self.reals + 2 * self.pairs) * self._rank
        self.matrix = np.diag([*spectrum.real, *np.real(spectrum.pairs), *np.real(spectrum.pairs)])
        first, second = slice(self.reals, self.reals + self.pairs), slice(self.reals + self.pairs, None)
        self.matrix[second, first] = -np.diag(np.imag(spectrum.pairs))
        self.matrix[first, second] = np.diag(np.imag(spectrum.pairs))

    def at(self, free: np.ndarray) -> np.ndarray:
        """Return Y (n, n) for the parameters; only the direction of each vector matters."""
        directions = self._directions(free)[0]
        vectors = (self._spaces @ directions[:, :, None])[:, :, 0]
        pairs = np.sqrt(2.0) * vectors[self.reals :]
        return np.vstack([vectors[: self.reals].real, pairs.real, pairs.imag]).T

    def gain(self, vectors: np.ndarray) -> np.ndarray:
        """Return K of u = K x with the eigenvectors Y: K Y = B^+ (Y M - A Y)."""
        driven = self.inverse @ (vectors @ self.matrix - self.a @ vectors)
        return np.linalg.solve(vectors.T, driven.T).T

    def slope(self, free: np.ndarray, by_vectors: np.ndarray) -> np.ndarray:
        """Return the gradient with respect to the parameters from the gradient ``by_vectors`` with respect to Y."""
        directions, sizes = self._directions(free)
        parts = by_vectors.T
        middle = self.reals + self.pairs
        pairs = np.sqrt(2.0) * (parts[self.reals : middle] + 1j * parts[middle:])
        projected = self._spaces.conj().swapaxes(1, 2) @ np.vstack([parts[: self.reals], pairs])[:, :, None]
        projected = projected[:, :, 0]
        along = np.sum((directions.conj() * projected).real, axis=1, keepdims=True)
        across = (projected - along * directions) / sizes
        real, pair = across[: self.reals], across[self.reals :]
        return np.concatenate([real.real.ravel(), pair.real.ravel(), pair.imag.ravel()])

    def as_complex(self, real: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return all unit eigenvectors (n, n) as columns and their poles (n,), from Y."""
        middle = self.reals + self.pairs
        pairs = np.sqrt(0.5) * (real[:, self.reals : middle] + 1j * real[:, middle:])
        poles = np.array([*self.spectrum.real, *self.spectrum.pairs, *np.conj(self.spectrum.pairs)])
        return np.hstack([real[:, : self.reals], pairs, pairs.conj()]), poles

    def _directions(self, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        rank, middle = self._rank, (self.reals + self.pairs) * self._rank
        directions = free[:middle].astype(complex)
        directions[self.reals * rank :] += 1j * free[middle:]
        directions = directions.reshape(-1, rank)
        sizes = np.linalg.norm(directions, axis=1, keepdims=True)
        return directions / sizes, sizes


def least_condition(
    a: np.ndarray, b: np.ndarray, spectrum: Spectrum, starts: int, seed: int, tolerance: float = TOLERANCE
) -> StateFeedback:
    """Return the placement with the smallest kappa found in ``starts`` searches. Raises PlacementError.

    The searches minimise |Y|_q |Y^-1|_q of the eigenvectors Y in Schatten norms of increasing order q.
    """
    levels, family = family_of(a, b, spectrum, tolerance)
    parameters = _search(family, [partial(condition, order=order) for order in _ORDERS], starts, seed)
    return on_levels(levels, family, parameters)


def least_norm(
    a: np.ndarray, b: np.ndarray, spectrum: Spectrum, starts: int, seed: int, tolerance: float = TOLERANCE
) -> StateFeedback:
    """Return the placement with the smallest |K| found in ``starts`` searches. Raises PlacementError.

    The searches minimise Schatten norms of K of increasing order q.
    """
    levels, family = family_of(a, b, spectrum, tolerance)
    parameters = _search(family, [partial(gain_norm, family, order=order) for order in _ORDERS], starts, seed)
    return on_levels(levels, family, parameters)


def condition(vectors: np.ndarray, order: float) -> tuple[float, np.ndarray]:
    """Return log |Y|_q |Y^-1|_q in Schatten norms of order q, and its gradient in Y."""
    left, sizes, right = np.linalg.svd(vectors)
    size, fraction = _norm(sizes, order)
    inverse_size, inverse_share = _norm(1.0 / sizes, order)
    return size + inverse_size, (left * (fraction - inverse_share / sizes**2)) @ right


def gain_norm(family: Eigenvectors, vectors: np.ndarray, order: float) -> tuple[float, np.ndarray]:
    """Return log |K|_q in the Schatten norm of order q, and its gradient in Y."""
    gain = family.gain(vectors)
    left, sizes, right = np.linalg.svd(gain, full_matrices=False)
    size, fraction = _norm(sizes, order)
    sensitivity = np.linalg.solve(vectors, ((left * fraction) @ right).T).T
    outer = family.inverse.T @ sensitivity
    return size, outer @ family.matrix.T - family.a.T @ outer - gain.T @ sensitivity


def on_levels(levels: Sequence[PoleLevel], family: Eigenvectors, free: np.ndarray) -> StateFeedback:
    """Return the placement with these eigenvectors, from its Phi_i.

    Phi of a level has the left eigenvectors w Bt, where w are rows of the inverse eigenvector matrix, chosen by
    pivoting to be well conditioned. These rows are B^- up to a factor, and (Bt^+ - B^-) P' is the gain of the level
    above, which has more inputs than its rank there and is not determined by its Phi alone. The remainder is passed to
    higher levels through P. If the rows separate a conjugate pair, Phi_i is complex; the gain is not.
    """
    vectors, poles = family.as_complex(family.at(free))
    desired, above, remaining = [], [], poles
    for level in levels:
        inverse = np.linalg.inv(vectors)
        rows = inverse @ level.left
        chosen = qr(rows.conj().T, mode="r", pivoting=True)[1][: level.rank]
        desired.append(np.linalg.solve(rows[chosen], remaining[chosen, None] * rows[chosen]))
        back = np.linalg.solve(rows[chosen], inverse[chosen])
        above.append((np.linalg.pinv(level.left) - back) @ level.down.T)
        vectors, remaining = level.down @ np.delete(vectors, chosen, axis=1), np.delete(remaining, chosen)
    return place_on_levels(levels, desired, family.spectrum.poles, above=above)


def family_of(
    a: np.ndarray, b: np.ndarray, spectrum: Spectrum, tolerance: float = TOLERANCE
) -> tuple[list[PoleLevel], Eigenvectors]:
    """Return the levels of a pair and its attainable eigenvectors. Raises PlacementError."""
    levels = decompose(a, b, tolerance)
    rank = levels[0].rank
    maximum = max(np.unique(spectrum.poles, return_counts=True)[1])
    if maximum > rank:
        problem = f"a pole occurs {maximum} times, but B has rank {rank}: a full set of eigenvectors does not exist"
        raise PlacementError("free eigenvectors", Reason.RANK, problem, float(maximum), "use choice diagonal")
    return levels, Eigenvectors(levels[0], spectrum)


def _search(family: Eigenvectors, objectives: Sequence[Objective], starts: int, seed: int) -> np.ndarray:
    """Return the parameters with the least value of the last objective.

    The first objective is minimised from all starts for some steps, all objectives only from the best of these.
    """
    random = np.random.default_rng(seed)
    first = [_descend(family, objectives[0], random.normal(size=family.parameters), *_COARSE) for _ in range(starts)]
    minima = []
    for value, free in sorted(first, key=lambda end: end[0])[:_KEPT]:
        for objective in objectives:
            value, free = _descend(family, objective, free, *_FINE)
        minima.append((value, free))
    return min(minima, key=lambda end: end[0])[1]


def _descend(
    family: Eigenvectors, objective: Objective, free: np.ndarray, slope: float, steps: int
) -> tuple[float, np.ndarray]:
    """Descend until the gradient is below ``slope``, or for ``steps`` steps; return value and parameters."""

    def value(at: np.ndarray) -> tuple[float, np.ndarray]:
        size, by_vectors = objective(family.at(at))
        return size, family.slope(at, by_vectors)

    result = minimize(value, free, jac=True, method="BFGS", options={"gtol": slope, "maxiter": steps})
    return float(result.fun), result.x


def _norm(sizes: np.ndarray, order: float) -> tuple[float, np.ndarray]:
    """Return the logarithm of a Schatten norm, and its gradient in the singular values."""
    largest = np.max(sizes)
    powers = (sizes / largest) ** (order - 1.0)
    total = np.sum(powers * sizes / largest)
    return float(np.log(largest) + np.log(total) / order), powers / (total * largest)
