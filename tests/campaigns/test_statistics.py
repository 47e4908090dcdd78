"""perilune.analysis.campaigns.statistics: statistics and quantiles of finite columns.

Truth: Python's statistics module, scipy's distribution function and numpy's quantile over the same finite columns; a
quantile's definition, counted trial by trial in integers.
"""

import math
import statistics as exact

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.stats import ecdf

from perilune.analysis.campaigns.statistics import QUANTILES, STATISTICS, quantile
from perilune.analysis.campaigns.statistics import statistics as of_blocks
from perilune.analysis.campaigns.verdicts import order_statistics

NUMBERS = st.floats(-1e6, 1e6)
ANY = NUMBERS | st.sampled_from([math.inf, -math.inf, math.nan])


def statistics(values, unit):
    """Return statistics of a column in one block."""
    return of_blocks(lambda: [values], unit)


def counted(values, percent):
    """Return the least value that at least ``percent`` percent of the values do not exceed."""
    known = [value for value in values if not math.isnan(value)]
    fits = [x for x in known if 100 * sum(value <= x for value in known) >= percent * len(known)]
    return min(fits) if fits else None


@given(st.lists(NUMBERS, min_size=2, max_size=300))
def test_finite_columns_against_other_libraries(values):
    actual = statistics(np.array(values), "m")
    assert (actual.count, actual.unit) == (len(values), "m")
    assert (actual.min, actual.max) == (min(values), max(values))
    assert actual.mean == pytest.approx(exact.fmean(values), rel=1e-9, abs=1e-9)
    assert actual.std == pytest.approx(exact.stdev(values), rel=1e-9, abs=1e-9)
    assert actual.rms == pytest.approx(math.sqrt(exact.fmean(value * value for value in values)), rel=1e-9)
    fraction = ecdf(values).cdf
    for key, percent in QUANTILES.items():
        assert (
            fraction.evaluate(actual.value(key))
            >= percent / 100
            > fraction.evaluate(np.nextafter(actual.value(key), -math.inf))
        )


@given(st.lists(ANY, max_size=120))
def test_quantiles_by_counting(values):
    actual = statistics(np.array(values, dtype=float), "1")
    for key, percent in QUANTILES.items():
        expected = counted(values, percent)
        assert (None if actual.value(key) is None else float(actual.value(key))) == expected
        assert actual.value(key) is None or math.isinf(actual.value(key)) == math.isinf(expected)


@given(st.lists(ANY, max_size=60))
def test_other_statistics_are_those_of_the_finite_values(values):
    column = np.array(values, dtype=float)
    actual = statistics(column, "1")
    assert actual.count == sum(map(math.isfinite, values))
    alone = statistics(column[np.isfinite(column)], "1")
    for key in set(STATISTICS) - set(QUANTILES):
        assert actual.value(key) == alone.value(key)
        assert (actual.value(key) is None) == (actual.count < (2 if key == "std" else 1))


@pytest.mark.parametrize("trials", [20, 100, 1000, 2000])
def test_quantiles_of_whole_numbers(trials):
    actual = statistics(np.random.default_rng(trials).permutation(trials) + 1.0, "1")
    assert [actual.value(key) for key in QUANTILES] == [
        math.ceil(percent * trials / 100) for percent in (5, 50, 95, 99)
    ]


def test_one_trial_in_twenty_that_never_settles():
    settled = np.array([math.inf, math.nan, *range(1, 20)])
    actual = statistics(settled, "s")
    assert (actual.count, actual.max, actual.p95, actual.p99) == (19, 19.0, 19.0, math.inf)
    assert statistics(settled[:-1], "s").p95 == math.inf


@given(st.lists(st.lists(ANY, max_size=20), min_size=1, max_size=6), st.randoms(use_true_random=False))
def test_blocks_change_no_bit_and_neither_does_their_order(lists, chance):
    parts = [np.array(values, dtype=float) for values in lists]
    whole = statistics(np.concatenate(parts), "1")
    chance.shuffle(parts)
    assert of_blocks(lambda: parts, "1") == whole


@pytest.fixture(params=[order_statistics.HELD, 2])
def held(request, monkeypatch):
    """Set the number of values held in memory: all of these few, or so few that every bit is counted."""
    monkeypatch.setattr(order_statistics, "HELD", request.param)


def asked(parts, share):
    return quantile(lambda: iter(parts), share)


parts_of_numbers = st.lists(st.floats(allow_nan=True, allow_infinity=True), max_size=40)


@given(st.lists(parts_of_numbers, max_size=5), st.floats(0.0, 1.0))
@example([[0.0, -0.0], [5e-324, -5e-324]], 0.5)
@example([[math.inf, -math.inf, math.nan], [1.0]], 0.999)
@example([[1.0] * 30, [np.nextafter(1.0, 2.0)] * 3], 0.95)
@pytest.mark.usefixtures("held")
def test_quantiles_are_numpys(parts, share):
    arrays = [np.array(part, dtype=float) for part in parts]
    everything = np.concatenate([*arrays, np.zeros(0)])
    known = everything[~np.isnan(everything)]
    actual = asked(arrays, share)
    if known.size:
        assert actual == np.quantile(known, share, method="inverted_cdf")
    else:
        assert math.isnan(actual)


@pytest.mark.parametrize("share", [0.0, 0.001, 0.05, 0.25, 0.5, 0.95, 0.99, 0.999, 1.0])
@pytest.mark.usefixtures("held")
def test_many_numbers_that_are_nearly_the_same(share):
    values = 200.0 + 1e-12 * np.random.default_rng(4).normal(size=20_000)
    assert asked(np.array_split(values, 7), share) == np.quantile(values, share, method="inverted_cdf")


@pytest.mark.parametrize("share", [-0.1, 1.1, math.nan])
def test_what_is_no_share(share):
    with pytest.raises(ValueError, match="is not between 0 and 1"):
        asked([np.ones(3)], share)
