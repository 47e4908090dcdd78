"""Subset simulation over draws and noise, for failures of known probability.

Truth: the limit state is a sum of independent normal numbers, one for each noise source and for the draws; repetitions
with other random numbers, for the coverage of intervals and the scatter of estimates.
"""

import numpy as np
import pytest
from scipy import stats

from perilune.analysis.studies.rare.subset_simulation import subset_simulation
from tests.support.hashed_noise import hashed_normals
from tests.support.lengths import LONG, either

DIMENSIONS = 5
REPEATS = either(400, 12)
SAMPLES = either(4500, 1500)
COVERED = either(0.92, 0.75)  # of 0.95: 12 repeats have a deviation of 0.06
CASES = {
    "noise alone": 0.0,
    "both alike": 1.0,
    "draws three times the noise": 3.0,
}  # the draws' deviation by the noise's


def limit_state(weights, draws, probability, seed):
    """Return a weighted sum of the noise of each source and of all draws together, 0 at the
    quantile of the probability."""
    weights = np.asarray(weights, dtype=float)
    limit = stats.norm.isf(probability) * np.hypot(np.linalg.norm(weights), draws)

    def margin(points):
        noise = hashed_normals(points.streams, seed) @ weights if weights.size else 0.0
        return points.draws.sum(axis=1) * draws / np.sqrt(DIMENSIONS) + noise - limit

    return margin


def simulate(weights, draws, probability, repeats=REPEATS):
    return [
        subset_simulation(
            limit_state(weights, draws, probability, seed), DIMENSIONS if draws else 0, len(weights), seed=seed,
            samples=SAMPLES,
        )
        for seed in range(repeats)
    ]  # fmt: skip


@pytest.mark.parametrize("probability", [1e-3, 1e-4] if LONG else [1e-3])
@pytest.mark.parametrize("case", CASES)
def test_intervals_cover_what_is_true(case, probability):
    weights = np.ones(5)
    actual = simulate(weights, CASES[case] * np.linalg.norm(weights), probability)
    lows, highs = np.array([estimate.interval[:2] for estimate in actual]).T
    mean = np.mean([estimate.probability for estimate in actual]) / probability
    widths = highs / lows
    covered = np.mean((lows <= probability) & (probability <= highs))
    print(f"{case} {probability:g}: {covered:.3f} cover, mean {mean:.3f}, median width {np.median(widths):.2f}")
    assert covered >= COVERED
    assert mean == pytest.approx(1.0, abs=either(0.1, 0.3))
    assert np.median(widths) < 5.0
    assert not any(estimate.noise_ends for estimate in actual)


@pytest.mark.parametrize("probability", [1e-3, 1e-4])
def test_one_source_alone_is_bounded(probability):
    """A fresh stream of the only source is as rare as the level: nothing is gained on plain Monte Carlo."""
    actual = simulate([1.0], 0.0, probability, either(400, 20))
    bounds = np.array([estimate.interval.high for estimate in actual])
    print(
        f"one source {probability:g}: bound holds in {np.mean(bounds >= probability):.3f}, median {np.median(bounds)}"
    )
    assert np.mean(bounds >= probability) >= either(0.92, 0.85)
    for estimate in actual:
        assert estimate.noise_ends
        last = estimate.levels[-1]
        assert not last.trusted
        assert last.probability is None
        assert last.noise_acceptance < 0.05
        assert estimate.equivalent_trials == pytest.approx(SAMPLES, rel=0.3)
        if estimate.probability is None:
            nothing = stats.binomtest(0, SAMPLES).proportion_ci(0.95, method="exact").high
            assert estimate.interval.high == pytest.approx(nothing, rel=0.35)


@pytest.mark.parametrize("weights", [[1.0, 0.1, 0.1, 0.1, 0.1, 0.1], [1.0, 0.3, 0.3, 0.3]])
def test_a_source_that_is_not_renewed_ends_levels_whatever_the_others_do(weights):
    """The mean acceptance rate stays above 5 % for the weak sources' sake, and the chains have one noise."""
    actual = simulate(weights, 0.0, 1e-3, either(400, 12))
    lows, highs = np.array([study.interval[:2] for study in actual]).T
    covered = np.mean((lows <= 1e-3) & (highs >= 1e-3))
    print(f"{weights}: {covered:.3f} cover, bounds in {np.mean([study.noise_ends for study in actual]):.3f}")
    assert covered >= COVERED
    assert np.mean([study.noise_ends for study in actual]) > 0.8
    for last in (study.levels[-1] for study in actual if study.noise_ends):
        assert last.noise_acceptance > 0.05 > last.least_acceptance
        assert last.source == 0


def test_noise_of_failures_is_distributed_as_noise_of_failures():
    """On condition of failure the sum is a truncated normal, and what is across it is as ever."""
    noise = np.concatenate(
        [
            hashed_normals(
                subset_simulation(
                    limit_state(np.ones(4), 0.0, 1e-2, seed), 0, 4, seed=seed, samples=2000
                ).failures.streams,
                seed,
            )
            for seed in range(either(40, 8))
        ]
    )
    along, across = noise.sum(axis=1) / 2.0, (noise[:, 0] - noise[:, 1]) / np.sqrt(2.0)
    truth = stats.truncnorm(stats.norm.isf(1e-2), np.inf)
    assert along.mean() == pytest.approx(truth.mean(), abs=0.03)
    assert across.mean() == pytest.approx(0.0, abs=0.15)
    assert across.std() == pytest.approx(1.0, rel=0.1)


def test_streams_are_never_given_twice():
    """Every flight whose noise is to be fresh has a stream that no flight before had."""
    recorded = []

    def margin(points):
        recorded.append(points.streams.copy())
        return limit_state(np.ones(3), 1.0, 1e-3, 1)(points)

    actual = subset_simulation(margin, DIMENSIONS, 3, seed=1, samples=500)
    first = recorded[0]
    assert np.array_equal(first, np.repeat(np.arange(500)[:, np.newaxis], 3, axis=1))
    later = np.concatenate(recorded[1:])
    known, fresh = set(range(500)), []
    for row in later:
        fresh += [number for number in row.tolist() if number not in known]
        known.update(row.tolist())
    assert len(fresh) == len(set(fresh))
    assert max(known) < 500 + 3 * actual.evaluations


def test_sources_without_effect_cost_no_move():
    """Noise that changes nothing: flights are as many, and the interval is no wider than without it."""
    without = [subset_simulation(limit_state([], 1.0, 1e-3, s), DIMENSIONS, 0, seed=s, samples=1000) for s in range(10)]
    inert = simulate(np.zeros(4), 1.0, 1e-3, 10)
    variation = np.mean([estimate.interval.variation for estimate in without]) * np.sqrt(1000 / SAMPLES)
    assert np.mean([estimate.interval.variation for estimate in inert]) < 1.25 * variation
    for estimate in inert:
        assert all(level.noise_acceptance == 1.0 for level in estimate.levels[1:])


def test_nothing_random_is_refused():
    with pytest.raises(ValueError, match="dimensions = 0 or sources = 0 is out of range"):
        subset_simulation(lambda at: at.draws[:, 0], 0, 0)
