"""Sobol' indices and rank correlations of functions that have closed forms.

Truth: the indices of Ishigami and Homma's function (1990) and of a sum; scipy's own `sobol_indices` of a function; the
correlation of normal variables (Kruskal 1958: rho_s = 6 / pi asin(r / 2)).
"""

import numpy as np
import pytest
from scipy import stats

from perilune.analysis.studies.sobol import indices, rank_correlations, saltelli_points
from tests.support.lengths import either

A, B = 7.0, 0.1
V1, V2 = 0.5 * (1 + B * np.pi**4 / 5) ** 2, A**2 / 8
V13 = B**2 * np.pi**8 * (1 / 18 - 1 / 50)
FIRST = np.array([V1, V2, 0.0]) / (V1 + V2 + V13)
TOTAL = np.array([V1 + V13, V2, V13]) / (V1 + V2 + V13)


def ishigami(places):
    x = np.pi * (2.0 * places - 1.0)
    return np.sin(x[:, 0]) + A * np.sin(x[:, 1]) ** 2 + B * x[:, 2] ** 4 * np.sin(x[:, 0])


def weighted(places):
    return places @ np.array([3.0, 2.0, 1.0])


def actual(base, seed):
    random = np.random.default_rng(seed)
    points = saltelli_points(base, 3, random)
    assert points.shape == (5 * base, 3)
    return indices(np.array([ishigami(points), weighted(points)]), base, random)


def test_the_indices_of_ishigami_and_of_a_sum():
    result = actual(4096, 1)
    np.testing.assert_allclose(result.first, [FIRST, [9 / 14, 4 / 14, 1 / 14]], atol=0.02)
    np.testing.assert_allclose(result.total, [TOTAL, [9 / 14, 4 / 14, 1 / 14]], atol=0.02)
    assert (result.total_interval[0] <= result.total).all()
    assert (result.total <= result.total_interval[1]).all()


@pytest.mark.slow
def test_intervals_cover():
    """Quasi-random points, whose errors are smaller than the bootstrap's, which takes them for random ones."""
    repeats = either(200, 12)
    inside = np.zeros((2, 2, 3))
    for seed in range(repeats):
        result = actual(128, seed)
        for order, (ends, truth) in enumerate(((result.first_interval, FIRST), (result.total_interval, TOTAL))):
            for number, true in enumerate((truth, np.array([9, 4, 1]) / 14)):
                inside[order, number] += (ends[0, number] <= true + 1e-12) & (true <= ends[1, number] + 1e-12)
    assert (inside / repeats).min() >= either(0.85, 0.7)
    assert (inside / repeats).mean() >= 0.93


def test_as_scipy_does_of_a_function():
    dists = [stats.uniform(), stats.uniform(), stats.uniform()]
    theirs = stats.sobol_indices(func=lambda x: ishigami(x.T), n=256, dists=dists, rng=np.random.default_rng(5))
    random = np.random.default_rng(5)
    ours = indices(ishigami(saltelli_points(256, 3, random))[np.newaxis], 256, random)
    np.testing.assert_allclose(ours.first[0], theirs.first_order, rtol=1e-12)
    np.testing.assert_allclose(ours.total[0], theirs.total_order, rtol=1e-12)


def test_one_number_of_one_input_is_all_its_variance():
    points = saltelli_points(256, 1, np.random.default_rng(1))
    result = indices(3.0 * points.T - 1.0, 256, np.random.default_rng(2))
    assert (result.first.shape, result.first_interval.shape) == ((1, 1), (2, 1, 1))
    assert result.first[0, 0] == pytest.approx(1.0, abs=0.02)
    assert result.total[0, 0] == pytest.approx(1.0, abs=0.02)


def test_the_same_random_numbers_give_the_same_intervals():
    first, repeated = actual(64, 3), actual(64, 3)
    assert first.total_interval.tobytes() == repeated.total_interval.tobytes()


@pytest.mark.parametrize("r", [-0.9, 0.0, 0.5])
def test_rank_correlations_of_normals(r):
    u, v = np.random.default_rng(2).standard_normal((2, 40000))
    rho = rank_correlations({"u": u}, {"y": r * u + np.sqrt(1 - r**2) * v})["y"]["u"]
    assert rho == pytest.approx(6.0 / np.pi * np.arcsin(r / 2.0), abs=0.02)


def test_rank_correlations_of_what_is_not_finite():
    u = np.arange(6.0)
    metrics = {
        "monotone": np.exp(u),
        "settles_never": np.array([1, 2, 3, 4, np.inf, np.inf]),
        "some": np.array([np.nan, 5, 4, 3, np.nan, 1]),
        "same": np.ones(6),
        "few": np.array([1.0, 2.0, np.nan, np.nan, np.nan, np.nan]),
    }
    actual = rank_correlations({"u": u, "held": np.full(6, 2.0)}, metrics)
    assert actual["monotone"] == {"u": pytest.approx(1.0), "held": None}
    assert actual["settles_never"]["u"] > 0.9
    assert actual["some"]["u"] == pytest.approx(-1.0)
    assert actual["same"]["u"] is None
    assert actual["few"]["u"] is None
