"""Random plants, spectra with sufficient distances, and conditions on a placement."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.optimize import linear_sum_assignment

EPS = float(np.finfo(float).eps)


def random_spectrum(random: np.random.Generator, size: int, pairs: int) -> np.ndarray:
    """Draw reals from -4 to -0.5, pairs (-3 .. -0.5) +- i (0.3 .. 2), until any two are at least 0.2 apart."""
    while True:
        upper = random.uniform(-3.0, -0.5, pairs) + 1j * random.uniform(0.3, 2.0, pairs)
        poles = np.concatenate([random.uniform(-4.0, -0.5, size - 2 * pairs), upper, upper.conj()])
        apart = np.abs(poles[:, None] - poles[None, :]) + np.diag(np.full(size, np.inf))
        if np.min(apart) >= 0.2:
            return poles


def random_systems(
    count: int, states: int, inputs: int, outputs: int = 1, most_pairs: int | None = None, seed: int = 0
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]]:
    """Yield A, B, C with normal elements, and poles with any number of pairs up to ``most_pairs``."""
    random = np.random.default_rng([states, inputs, outputs, seed])
    maximum = states // 2 if most_pairs is None else min(most_pairs, states // 2)
    for _ in range(count):
        yield (
            random.normal(size=(states, states)),
            random.normal(size=(states, inputs)),
            random.normal(size=(outputs, states)),
            random_spectrum(random, states, int(random.integers(maximum + 1))),
        )


def pole_error(closed_loop: np.ndarray, desired: np.ndarray) -> float:
    """Return the largest distance between poles after optimal one-to-one matching."""
    apart = np.abs(np.linalg.eigvals(closed_loop)[:, None] - np.asarray(desired)[None, :])
    return float(np.max(apart[linear_sum_assignment(apart)]))


def kappa_of(closed_loop: np.ndarray) -> float:
    """Return condition number of the eigenvectors of unit length."""
    return float(np.linalg.cond(np.linalg.eig(closed_loop)[1]))


def assert_placed(closed_loop: np.ndarray, desired: np.ndarray, conditions: float = 1.0) -> bool:
    """Assert the general bounds, and 1e-10 where ``conditions`` and kappa are at most 1000; return if they are."""
    error, kappa = pole_error(closed_loop, desired), kappa_of(closed_loop)
    assert error <= 1000.0 * EPS * kappa * np.linalg.norm(closed_loop, 2)
    well = kappa <= 1e3 and conditions <= 1e3
    assert error <= 1e-10 or not well
    return well
