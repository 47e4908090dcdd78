"""perilune.analysis.campaigns.summary.success_interval. Truth: the beta distribution, and the counted coverage."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from perilune.analysis.campaigns.summary import success_interval


@given(st.integers(1, 5000), st.floats(0, 1))
def test_ends_are_quantiles_of_beta_distributions(trials, share):
    k = round(share * trials)
    low, high = success_interval(k, trials)
    assert low == pytest.approx(stats.beta.ppf(0.025, k, trials - k + 1) if k else 0.0, rel=1e-6)
    assert high == pytest.approx(stats.beta.ppf(0.975, k + 1, trials - k) if k < trials else 1.0, rel=1e-6)


def test_all_successes():
    # the lower end solves p^n = 0.025
    assert success_interval(2000, 2000) == (pytest.approx(0.025 ** (1 / 2000)), 1.0)


@pytest.mark.parametrize("rate", [0.001, 0.03, 0.5, 0.97, 0.999])
def test_covers_the_true_rate_at_least_as_often_as_it_says(rate):
    trials = 300
    covered = 0.0
    for k in range(trials + 1):
        low, high = success_interval(k, trials)
        if low <= rate <= high:
            covered += stats.binom.pmf(k, trials, rate)
    assert covered >= 0.95


def test_impossible_counts_are_refused():
    for successes, trials in ((3, 2), (-1, 2), (0, 0)):
        with pytest.raises(ValueError, match="successes of"):
            success_interval(successes, trials)
