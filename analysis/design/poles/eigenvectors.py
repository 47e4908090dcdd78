"""Which eigenvectors a closed loop may have, and the gain that they make.

The eigenvector x of a pole lies in the null space of P (A - lambda I), P with orthonormal rows and P B = 0, of as many
dimensions as B has rank, and is free in it: Moore, "On the flexibility offered by state feedback in multivariable
systems beyond closed loop eigenvalue assignment", IEEE Transactions on Automatic Control 21 (1976). Kautsky, Nichols
and Van Dooren, "Robust pole assignment in linear state feedback", International Journal of Control 41 (1985).
"""

from __future__ import annotations

import numpy as np

from .multilevel import Level
from .spectrum import Spectrum


class Eigenvectors:
    """Unit eigenvectors of all real poles and pairs as functions of free parameters.

    They are kept as a real matrix Y (n, n): the vectors of the real poles, then sqrt 2 times the real and then the
    imaginary parts of those of the pairs, so that Y has the singular values of the complex matrix. (A + B K) Y = Y M.
    """

    def __init__(self, level: Level, spectrum: Spectrum) -> None:
        """Of the pair on level 0, with as many poles as it has states."""
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
        """Y (n, n) for parameters of any sizes; only directions matter."""
        directions = self._directions(free)[0]
        vectors = (self._spaces @ directions[:, :, None])[:, :, 0]
        pairs = np.sqrt(2.0) * vectors[self.reals :]
        return np.vstack([vectors[: self.reals].real, pairs.real, pairs.imag]).T

    def gain(self, vectors: np.ndarray) -> np.ndarray:
        """K of u = K x that makes Y the eigenvectors: K Y = B^+ (Y M - A Y)."""
        driven = self.inverse @ (vectors @ self.matrix - self.a @ vectors)
        return np.linalg.solve(vectors.T, driven.T).T

    def slope(self, free: np.ndarray, by_vectors: np.ndarray) -> np.ndarray:
        """The gradient in the parameters of a function whose gradient in Y is given."""
        directions, sizes = self._directions(free)
        parts = by_vectors.T
        middle = self.reals + self.pairs
        pairs = np.sqrt(2.0) * (parts[self.reals : middle] + 1j * parts[middle:])
        seen = self._spaces.conj().swapaxes(1, 2) @ np.vstack([parts[: self.reals], pairs])[:, :, None]
        seen = seen[:, :, 0]
        along = np.sum((directions.conj() * seen).real, axis=1, keepdims=True)
        across = (seen - along * directions) / sizes
        real, pair = across[: self.reals], across[self.reals :]
        return np.concatenate([real.real.ravel(), pair.real.ravel(), pair.imag.ravel()])

    def as_complex(self, real: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """All unit eigenvectors (n, n) as columns and their poles (n,), from Y."""
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
