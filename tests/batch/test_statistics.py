"""perilune.analysis.batch.statistics.

Truth: Python's statistics module and scipy's distribution function over the same finite columns; a quantile's
definition counted trial by trial, in integers.
"""

import math
import statistics as exact

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import ecdf

from perilune.analysis.batch.statistics import QUANTILES, STATISTICS
from perilune.analysis.batch.statistics import statistics as of_blocks

NUMBERS = st.floats(-1e6, 1e6)
ANY = NUMBERS | st.sampled_from([math.inf, -math.inf, math.nan])


def statistics(values, unit):
    """Statistics of a column in one block."""
    return of_blocks(lambda: [values], unit)


def counted(values, percent):
    """The least value that at least so many percent of the values do not exceed."""
    known = [value for value in values if not math.isnan(value)]
    fits = [x for x in known if 100 * sum(value <= x for value in known) >= percent * len(known)]
    return min(fits) if fits else None


@given(st.lists(NUMBERS, min_size=2, max_size=300))
def test_finite_columns_against_other_libraries(values):
    found = statistics(np.array(values), "m")
    assert (found["count"], found["unit"]) == (len(values), "m")
    assert (found["min"], found["max"]) == (min(values), max(values))
    assert found["mean"] == pytest.approx(exact.fmean(values), rel=1e-9, abs=1e-9)
    assert found["std"] == pytest.approx(exact.stdev(values), rel=1e-9, abs=1e-9)
    assert found["rms"] == pytest.approx(math.sqrt(exact.fmean(value * value for value in values)), rel=1e-9)
    share = ecdf(values).cdf
    for key, percent in QUANTILES.items():
        assert share.evaluate(found[key]) >= percent / 100 > share.evaluate(np.nextafter(found[key], -math.inf))


@given(st.lists(ANY, max_size=120))
def test_quantiles_by_counting(values):
    found = statistics(np.array(values, dtype=float), "1")
    for key, percent in QUANTILES.items():
        expected = counted(values, percent)
        assert (None if found[key] is None else float(found[key])) == expected
        assert found[key] is None or isinstance(found[key], str) == math.isinf(expected)


@given(st.lists(ANY, max_size=60))
def test_other_statistics_are_those_of_the_finite_values(values):
    column = np.array(values, dtype=float)
    found = statistics(column, "1")
    assert found["count"] == sum(map(math.isfinite, values))
    alone = statistics(column[np.isfinite(column)], "1")
    for key in set(STATISTICS) - set(QUANTILES):
        assert found[key] == alone[key]
        assert (found[key] is None) == (found["count"] < (2 if key == "std" else 1))


@pytest.mark.parametrize("trials", [20, 100, 1000, 2000])
def test_quantiles_of_whole_numbers(trials):
    found = statistics(np.random.default_rng(trials).permutation(trials) + 1.0, "1")
    assert [found[key] for key in QUANTILES] == [math.ceil(percent * trials / 100) for percent in (5, 50, 95, 99)]


def test_one_trial_in_twenty_that_never_settles():
    settled = np.array([math.inf, math.nan, *range(1, 20)])
    found = statistics(settled, "s")
    assert (found["count"], found["max"], found["p95"], found["p99"]) == (19, 19.0, 19.0, "inf")
    assert statistics(settled[:-1], "s")["p95"] == "inf"


@given(st.lists(st.lists(ANY, max_size=20), min_size=1, max_size=6), st.randoms(use_true_random=False))
def test_blocks_change_no_bit_and_neither_does_their_order(lists, chance):
    parts = [np.array(values, dtype=float) for values in lists]
    whole = statistics(np.concatenate(parts), "1")
    chance.shuffle(parts)
    assert of_blocks(lambda: parts, "1") == whole
