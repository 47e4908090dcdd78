"""Subset simulation of failures of known probability.

Truth: closed forms of normal and chi-squared variables; repetitions with other random numbers, for the coverage of
intervals and the scatter of estimates.
"""

import numpy as np
import pytest
from scipy import stats

from perilune.analysis.studies.rare.subset_simulation import StalledLevelError, subset_simulation
from perilune.analysis.studies.rare.uncertainty import chain_correlation, family_interval
from tests.support.lengths import either

REPEATS = either(400, 40)
COVERED = either(0.9, 0.85)  # of 0.95: 40 repeats have a deviation of 0.034
MEAN_FLIGHTS = {1e-4: 2e4, 1e-7: 3.3e4}


def plane(u):
    """Return the distance along the diagonal of ten draws."""
    return u.sum(axis=1) / np.sqrt(u.shape[1])


def two_ways(u):
    """Return the larger of two draws of different signs: two regions of failure."""
    return np.maximum(u[:, 0], -u[:, 1])


def shell(u):
    """Return the squared distance: failure in every direction."""
    return np.sum(u**2, axis=1)


CASES = {
    "plane": (plane, 10, stats.norm.isf),
    "two ways": (two_ways, 2, lambda p: stats.norm.isf(1.0 - np.sqrt(1.0 - p))),
    "shell": (shell, 4, lambda p: stats.chi2.isf(p, 4)),
}


@pytest.mark.parametrize("probability", [1e-4, 1e-7])
@pytest.mark.parametrize("case", CASES)
def test_intervals_cover_what_is_true(case, probability):
    function, dimensions, limit_of = CASES[case]
    limit = limit_of(probability)
    actual = [
        subset_simulation(lambda at: function(at.draws) - limit, dimensions, seed=seed)
        for seed in range(REPEATS if probability == 1e-4 or case == "plane" else either(400, 4))
    ]
    flights = np.mean([result.evaluations for result in actual])
    assert flights < MEAN_FLIGHTS[probability]
    if len(actual) < 40:
        assert all(
            result.interval.low < 3 * probability and result.interval.high > probability / 3 for result in actual
        )
        return
    covered = np.mean([result.interval.low <= probability <= result.interval.high for result in actual])
    estimates = np.array([result.probability for result in actual])
    assert covered >= COVERED
    assert abs(estimates.mean() / probability - 1.0) < 4.0 * estimates.std() / probability / np.sqrt(len(actual))
    reported = np.mean([result.interval.variation for result in actual])
    assert reported == pytest.approx(estimates.std() / probability, rel=either(0.15, 0.4))


def test_a_probability_that_is_not_small_is_counted():
    actual = subset_simulation(lambda at: at.draws[:, 0] - 1.0, 1, seed=1, samples=2000)
    assert actual.evaluations == 2000
    failures = round(actual.probability * 2000)
    exact = stats.binomtest(failures, 2000).proportion_ci(0.95, method="exact")
    assert actual.interval[:2] == (exact.low, exact.high)
    assert exact.low < stats.norm.sf(1.0) < exact.high
    assert len(actual.failures) == failures
    assert (actual.failures.draws[:, 0] >= 1.0).all()


def test_the_same_seed_gives_the_same_bits():
    first, repeated, other = (subset_simulation(lambda at: plane(at.draws) - 3.0, 3, seed=seed) for seed in (5, 5, 6))
    assert first.failures.draws.tobytes() == repeated.failures.draws.tobytes()
    assert (first.probability, first.interval) == (repeated.probability, repeated.interval)
    assert first.probability != other.probability


def test_failures_are_distributed_as_failures():
    """On condition of failure the distance along the plane is a truncated normal, and what is across it is as ever."""
    points = np.concatenate(
        [
            subset_simulation(lambda at: at.draws[:, 0] - 3.0, 2, seed=seed).failures.draws
            for seed in range(either(40, 10))
        ]
    )
    truth = stats.truncnorm(3.0, np.inf)
    assert points[:, 0].mean() == pytest.approx(truth.mean(), abs=0.02)
    assert points[:, 0].std() == pytest.approx(truth.std(), rel=0.08)
    assert points[:, 1].mean() == pytest.approx(0.0, abs=0.1)
    assert points[:, 1].std() == pytest.approx(1.0, rel=0.08)


def test_what_is_not_reached_has_a_bound():
    actual = subset_simulation(lambda at: at.draws[:, 0] - 8.0, 1, seed=2, samples=1000, least=1e-6)
    assert actual.probability is None
    assert actual.interval.low == 0.0
    assert stats.norm.sf(8.0) < actual.interval.high < 1e-5
    assert not len(actual.failures)


def test_infinite_margins_are_failures():
    """A region of the space known only to be a failure."""
    actual = subset_simulation(lambda at: np.where(at.draws[:, 0] > 3.0, np.inf, at.draws[:, 0] - 3.5), 2, seed=3)
    assert actual.interval.low < stats.norm.sf(3.0) < actual.interval.high


def test_steps_of_the_margin():
    """Margins with few values: levels are where they are, not at a tenth."""
    actual = subset_simulation(lambda at: np.floor(4.0 * at.draws[:, 0]) / 4.0 - 3.5, 1, seed=4)
    assert actual.interval.low < stats.norm.sf(3.5) < actual.interval.high
    with pytest.raises(StalledLevelError) as caught:
        subset_simulation(lambda at: np.where(at.draws[:, 0] > 9.0, 1.0, -1.0), 1, seed=4)
    assert caught.value.args == (-1.0, 1.0)


@pytest.mark.parametrize("options", [{"samples": 99}, {"least": 0.0}, {"least": 1.0}])
def test_wrong_numbers(options):
    with pytest.raises(ValueError, match="samples"):
        subset_simulation(lambda at: at.draws[:, 0], 1, **options)


def test_correlation_of_chains():
    """Two-state Markov chains: their correlation at lag k is rho^k."""
    random, rho, fraction, length = np.random.default_rng(1), 0.6, 0.3, 12
    state = random.random(100_000) < fraction
    states = [state]
    for _ in range(length - 1):
        stays = random.random(state.size) < rho
        state = np.where(stays, state, random.random(state.size) < fraction)
        states.append(state)
    expected = 2.0 * sum((1.0 - lag / length) * rho**lag for lag in range(1, length))
    assert chain_correlation(np.array(states).T) == pytest.approx(expected, rel=0.02)
    assert chain_correlation(np.ones((5, 1), dtype=bool)) == 0.0


def test_families_without_relatives_are_independent_draws():
    """Every failure in a separate family: the variance of a share of independent draws."""
    actual = family_interval(0.1, np.arange(100), 1000, 0.95)
    assert actual.variation == pytest.approx(np.sqrt(0.9 / (0.1 * 1000)), rel=1e-12)
    one = family_interval(0.1, np.zeros(100), 1000, 0.95)  # all of one family: nothing is known
    assert one.low < 1e-4
    assert one.high == 1.0
