"""Normal distributions, independent or correlated.

The isoprobabilistic transformation (Hohenbichler and Rackwitz 1981) is in closed form: mean + sigma u, or for jointly
normal values mean + V sqrt(D) u, with the eigenvalues D and eigenvectors V of their covariance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import ClassVar, Self

import numpy as np

from ..draws.generators import standard_normals
from ..draws.interfaces import Continuous, Independent
from .table import TomlTable, names, number, numbers, sequence

FLAT = 1e-12  # fraction of a covariance's largest eigenvalue; axes with smaller eigenvalues do not vary


class _Jointly(Continuous, Independent):
    """Jointly normal values: ``means`` (names,) and ``factor`` (names, size) with covariance factor factor^T."""

    @property
    def means(self) -> Sequence[float]:
        raise NotImplementedError

    @property
    def factor(self) -> np.ndarray:
        raise NotImplementedError

    @property
    def size(self) -> int:
        return self.factor.shape[1]

    def from_normals(self, u: np.ndarray) -> list[np.ndarray]:
        return _combine(self.means, self.factor, u)

    def to_normals(self, columns: Sequence[np.ndarray]) -> np.ndarray:
        offset = np.column_stack(columns) - np.array(self.means)
        inverse = self.factor / np.sum(self.factor**2, axis=0)  # valid because its columns are orthogonal
        return np.column_stack(_combine([0.0] * self.size, inverse.T, offset))

    def from_box(self, points: np.ndarray, sigmas: float) -> list[np.ndarray]:
        return self.from_normals(sigmas * (2.0 * points - 1.0))

    def to_box(self, columns: Sequence[np.ndarray], sigmas: float) -> np.ndarray:
        return 0.5 + 0.5 * self.to_normals(columns) / sigmas

    def ranges(self, sigmas: float) -> list[tuple[float, float]]:
        half = sigmas * np.sum(np.abs(self.factor), axis=1)
        return [(float(mean - width), float(mean + width)) for mean, width in zip(self.means, half, strict=True)]


@dataclass(frozen=True)
class Normal(_Jointly):
    """Independent normal values with ``mean`` and standard deviation ``sigma``."""

    mean: float
    sigma: float
    keyword = "normal"
    keys: ClassVar = ("mean", "sigma")

    @classmethod
    def read(cls, table: TomlTable) -> Self:
        table.only(["distribution", *cls.keys])
        mean, sigma = table.get("mean", number), table.get("sigma", number)
        if not sigma > 0.0:
            raise table.error("sigma", f"{sigma!r} is not positive", "give sigma > 0, or fix the value in [set]")
        return cls(mean, sigma)

    @property
    def means(self) -> Sequence[float]:
        return (self.mean,)

    @property
    def factor(self) -> np.ndarray:
        return np.array([[self.sigma]])

    def sample(self, trials: int, source: np.random.Generator) -> list[np.ndarray]:
        return [self.mean + self.sigma * standard_normals(source, trials)]


@dataclass(frozen=True)
class CorrelatedNormal(_Jointly):
    """Several jointly normal values with ``mean`` (names,) and ``covariance`` (names, names)."""

    mean: tuple[float, ...]
    covariance: tuple[tuple[float, ...], ...]
    keyword = "correlated_normal"
    keys: ClassVar = ("names", "mean", "covariance")

    @classmethod
    def read(cls, table: TomlTable) -> Self:
        table.only(["distribution", *cls.keys])
        size = len(table.get("names", names))
        mean, covariance = table.get("mean", numbers), table.get("covariance", sequence(numbers))
        if len(mean) != size:
            raise table.error("mean", f"{len(mean)} value(s) for {size} name(s)", "give one mean per name")
        if len(covariance) != size or any(len(row) != size for row in covariance):
            raise table.error("covariance", f"not a {size} by {size} matrix", "give one row and one column per name")
        matrix = np.array(covariance)
        if not np.allclose(matrix, matrix.T, rtol=1e-12, atol=0.0):
            raise table.error("covariance", "not symmetric", "give the same value at [i][j] and [j][i]")
        values, _ = principal_axes(covariance)
        if values[0] < -1e-12 * abs(values[-1]) or not values[-1] > 0.0:
            problem = f"not a covariance: its eigenvalues range from {values[0]:.3g} to {values[-1]:.3g}"
            raise table.error("covariance", problem, "give a nonzero matrix without negative eigenvalues")
        return cls(mean, covariance)

    @property
    def means(self) -> Sequence[float]:
        return self.mean

    @cached_property
    def factor(self) -> np.ndarray:
        values, vectors = principal_axes(self.covariance)
        varies = values > FLAT * values[-1]
        return vectors[:, varies] * np.sqrt(values[varies])

    def sample(self, trials: int, source: np.random.Generator) -> list[np.ndarray]:
        values, vectors = principal_axes(self.covariance)
        factor = vectors * np.sqrt(np.maximum(values, 0.0))
        return _combine(self.mean, factor, standard_normals(source, (trials, len(self.mean))))


@cache
def principal_axes(covariance: tuple[tuple[float, ...], ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return the eigenvalues of a symmetric matrix, in ascending order, and its eigenvectors as columns.

    They are computed with 30 digits: the last bits of LAPACK's results, and therefore the draws, would depend on the
    processor.
    """
    from mpmath import mp

    with mp.workdps(30):
        values, vectors = mp.eigsy(mp.matrix(covariance))
        return np.array(values.tolist(), dtype=float)[:, 0], np.array(vectors.tolist(), dtype=float)


def _combine(means: Sequence[float], factor: np.ndarray, u: np.ndarray) -> list[np.ndarray]:
    """Return the values mean + factor u, as an array (points,) for each mean."""
    # summed column by column: a matrix product may round a row differently in a longer table
    return [mean + sum(factor[i, j] * u[:, j] for j in range(factor.shape[1])) for i, mean in enumerate(means)]
