"""perilune.analysis.campaigns.verdicts.order_statistics: bounds by order statistics.

Truth: the beta distribution of order statistics; samples whose quantiles are known; scipy's quantile test, which is
based on the same sign statistic.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import beta, quantile_test

from perilune.analysis.campaigns.verdicts.acceptance import acceptance_number
from perilune.analysis.campaigns.verdicts.order_statistics import tolerance_bound as of_blocks
from perilune.analysis.campaigns.verdicts.stopping import StoppingRule


def tolerance_bound(values, permitted, upper):
    """Return the bound from all of some values, which are in two blocks."""
    return of_blocks(lambda: (values[:7], values[7:]), len(values), permitted, upper)


@given(st.integers(1, 4000), st.floats(0.5, 0.9999), st.floats(0.5, 0.999))
def test_the_order_statistic_has_the_confidence_and_the_next_has_not(flights, share, confidence):
    """The r-th smallest of n is distributed as beta(r, n + 1 - r) on the scale of shares (Wilks)."""
    permitted = acceptance_number(flights, share, confidence)
    if permitted >= 0:
        assert beta.sf(share, flights - permitted, permitted + 1) >= confidence - 1e-9
    if permitted + 1 < flights:
        assert beta.sf(share, flights - permitted - 1, permitted + 2) < confidence + 1e-9


@pytest.mark.parametrize("upper", [True, False])
def test_ten_thousand_campaigns_bound_the_quantile(upper):
    flights, fraction, confidence = 93, 0.95, 0.95
    permitted = acceptance_number(flights, fraction, confidence)
    assert permitted == 1
    values = np.random.default_rng(3).standard_normal((10_000, flights))
    bounds = np.array([tolerance_bound(row, permitted, upper) for row in values])
    quantile = 1.6448536269514722 if upper else -1.6448536269514722
    missed = np.count_nonzero(bounds < quantile if upper else bounds > quantile)
    assert 400 < missed <= 500 + 66  # three deviations


def test_bounds_hold_however_often_they_are_looked_at():
    """The bound of every look of a campaign at once covers the quantile with the confidence."""
    rule = StoppingRule(0.9, 0.9)
    analyses = rule.looks(400)
    values = np.random.default_rng(4).uniform(size=(4000, 400))
    missed = np.zeros(4000, dtype=bool)
    for flights in analyses:
        permitted = rule.acceptance_number(flights)
        if permitted >= 0:
            missed |= np.sort(values[:, :flights], axis=1)[:, -1 - permitted] < 0.9
    assert np.count_nonzero(missed) <= 400 + 57  # three deviations


def test_agrees_with_scipys_quantile_test():
    values = np.random.default_rng(5).exponential(size=200)
    fraction, confidence = 0.95, 0.9
    bound = tolerance_bound(values, acceptance_number(200, fraction, confidence), upper=True)
    interval = quantile_test(values, p=fraction, alternative="less").confidence_interval(confidence)
    assert bound == interval.high


def test_too_few_flights_have_none():
    assert tolerance_bound(np.ones(58), acceptance_number(58, 0.95, 0.95), upper=True) is None
    assert tolerance_bound(np.ones(59), acceptance_number(59, 0.95, 0.95), upper=True) == 1.0


@pytest.mark.parametrize("odd", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_worst(odd):
    values = np.array([*range(92), odd], dtype=float)
    assert tolerance_bound(values, 0, upper=True) == math.inf
    assert tolerance_bound(values, 1, upper=True) == 91.0
    assert tolerance_bound(values, 0, upper=False) == -math.inf
    assert tolerance_bound(values, 1, upper=False) == 0.0


def test_only_the_first_flights_count():
    values = np.arange(100.0)
    assert of_blocks(lambda: (values[:30], values[30:70], values[70:]), 60, 1, True) == 58.0
    assert of_blocks(lambda: (-values[:30], -values[30:70], -values[70:]), 60, 1, False) == -58.0
