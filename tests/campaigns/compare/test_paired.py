"""perilune.analysis.campaigns.compare.paired: two variants on the same trials.

Truth: counting by hand; the binomial distribution summed with `math.comb`; the published example of McNemar's
exact test (Bentur et al. 2009 in Fagerland, Lydersen and Laake 2014: 1, 1, 7 and 12 children, p = 0.0703); the
coverage of both intervals, exactly enumerated or from order statistics.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.compare.paired import compare_rates, compare_values, holm_adjusted


def outcomes(both, only_a, only_b, neither):
    """Return outcomes of A and B with these numbers of trials of each kind."""
    kinds = [(True, True)] * both + [(True, False)] * only_a + [(False, True)] * only_b + [(False, False)] * neither
    a, b = zip(*kinds, strict=True)
    return np.array(a), np.array(b)


def coin(k, n):
    """Return the probability of at least so uneven a split of n tosses of a fair coin, either way."""
    minimum = min(k, n - k)
    tail = sum(math.comb(n, i) for i in range(minimum + 1)) / 2**n
    return min(1.0, 2.0 * tail)


def test_the_published_example():
    actual = compare_rates(*outcomes(1, 1, 7, 12))
    assert (actual.both, actual.only_a, actual.only_b, actual.neither) == (1, 1, 7, 12)
    assert actual.difference == pytest.approx(-6 / 21)
    assert actual.p_value == pytest.approx(0.0703125, rel=1e-12)
    assert actual.interval[0] < actual.difference < actual.interval[1] < 0.0


@given(st.lists(st.tuples(st.booleans(), st.booleans()), min_size=1, max_size=60))
def test_counts_and_test_against_counting(rows):
    a, b = (np.array(column) for column in zip(*rows, strict=True))
    actual = compare_rates(a, b)
    assert actual.both == sum(x and y for x, y in rows)
    assert actual.neither == sum(not x and not y for x, y in rows)
    assert actual.difference == pytest.approx(a.mean() - b.mean(), abs=1e-12)
    discordant = actual.only_a + actual.only_b
    assert actual.both + actual.neither + discordant == len(rows)
    assert actual.p_value == pytest.approx(coin(actual.only_a, discordant) if discordant else 1.0, rel=1e-9)
    assert -1.0 <= actual.interval[0] <= actual.difference <= actual.interval[1] <= 1.0
    swapped = compare_rates(b, a)
    assert swapped.interval == pytest.approx((-actual.interval[1], -actual.interval[0]), abs=1e-12)


@pytest.mark.parametrize("rates", [(0.1, 0.1), (0.02, 0.08), (0.3, 0.05), (0.0, 0.05), (0.2, 0.4)])
@pytest.mark.parametrize("trials", [20, 60])
def test_the_interval_of_rates_covers_nearly_as_often_as_it_says(rates, trials):
    """Summed over every possible number of disagreements of either kind."""
    p, q = rates
    covered = 0.0
    for k, m in itertools.product(range(trials + 1), repeat=2):
        if k + m > trials:
            continue
        ways = math.comb(trials, k) * math.comb(trials - k, m)
        probability = ways * p**k * q**m * (1.0 - p - q) ** (trials - k - m)
        if probability > 1e-9:
            low, high = compare_rates(*outcomes(trials - k - m, k, m, 0)).interval
            covered += probability * (low <= p - q <= high)
    assert covered >= 0.935


NUMBERS = st.floats(-100.0, 100.0)


@given(st.lists(st.tuples(NUMBERS, NUMBERS), min_size=1, max_size=40))
def test_values_against_counting(rows):
    a, b = (np.array(column) for column in zip(*rows, strict=True))
    actual = compare_values(a, b)
    difference = sorted(x - y for x, y in rows)
    assert actual.count == len(rows)
    assert actual.smaller == sum(value < 0.0 for value in difference)
    assert actual.equal == sum(value == 0.0 for value in difference)
    assert actual.larger == sum(value > 0.0 for value in difference)
    assert actual.median == difference[(len(rows) - 1) // 2]  # of an even number the lower one in the middle
    n = actual.smaller + actual.larger
    assert actual.p_value == pytest.approx(coin(actual.smaller, n) if n else 1.0, rel=1e-9)


@pytest.mark.parametrize("trials", [1, 5, 6, 7, 20, 101, 400])
def test_the_interval_of_the_median_is_the_shortest_of_order_statistics_that_covers(trials):
    """Ends k-th from either end cover the median with 1 - 2 P(fewer than k of n tosses are heads)."""
    difference = np.random.default_rng(trials).normal(size=trials)
    ordered = np.sort(difference)
    actual = compare_values(difference, np.zeros(trials))
    miss, k = 0.0, 0
    while 2.0 * (miss + math.comb(trials, k) / 2**trials) <= 0.05:
        miss += math.comb(trials, k) / 2**trials
        k += 1
    if k == 0:
        assert actual.interval is None
    else:
        assert actual.interval == (ordered[k - 1], ordered[trials - k])


def test_only_trials_where_both_are_finite_count():
    a = np.array([1.0, np.nan, np.inf, 4.0, 2.0])
    b = np.array([2.0, 1.0, 1.0, 1.0, -np.inf])
    actual = compare_values(a, b)
    assert (actual.count, actual.smaller, actual.larger, actual.median) == (2, 1, 1, -1.0)
    nothing = compare_values(a[1:3], b[1:3])
    assert (nothing.count, nothing.median, nothing.interval, nothing.p_value) == (0, None, None, None)


@given(st.lists(st.floats(0.0, 1.0), max_size=6))
def test_adjusted_values_are_those_of_the_closed_test(p_values):
    """Marcus, Peritz and Gabriel (1976): the largest Bonferroni value of all families with a test in them."""
    indices = range(len(p_values))
    families = [set(each) for size in indices for each in itertools.combinations(indices, size + 1)]
    expected = [
        min(1.0, max(len(family) * min(p_values[index] for index in family) for family in families if test in family))
        for test in indices
    ]
    np.testing.assert_allclose(holm_adjusted(p_values), expected, rtol=1e-12)
