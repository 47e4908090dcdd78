"""Quantiles are order statistics everywhere in the product.

Truth: the order statistic k = ceil(p n) in integers, numpy's "inverted_cdf", and the sources.
"""

import ast
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from perilune.analysis.campaigns.verdicts.order_statistics import column_quantiles, quantile_rank, quantiles
from perilune.common.paths import ROOT

VALUES = st.floats(allow_nan=True, allow_infinity=True)
OTHERS = {"percentile", "quantile", "nanpercentile", "nanquantile", "median", "nanmedian", "mquantiles"}


@given(st.integers(0, 10_000), st.integers(1, 10**6))
def test_ranks_counted_in_whole_numbers(parts, count):
    """A fraction in ten thousandths: the least k with k / n >= p, from 0."""
    assert quantile_rank(parts / 10_000, count) == max(0, -(-parts * count // 10_000) - 1)


@given(st.integers(1, 1000), st.integers(1, 1000))
def test_a_fraction_that_counts_values_is_that_value(part, more):
    """k of n as a double may be a little above k / n, which is not one value more."""
    assert quantile_rank(part / (part + more), part + more) == part - 1


@given(
    arrays(float, st.tuples(st.integers(0, 12), st.integers(1, 4)), elements=VALUES),
    st.lists(st.integers(0, 100), min_size=1, max_size=4),
)
def test_quantiles_of_an_array_are_numpys(values, percents):
    result = quantiles(values, [percent / 100 for percent in percents])
    assert result.shape == (len(percents), values.shape[1])
    for column, row in zip(values.T, result.T, strict=True):
        known = column[~np.isnan(column)]
        for percent, value in zip(percents, row, strict=True):
            if known.size:
                rank = max(1, -(-percent * known.size // 100))
                assert value == np.sort(known)[rank - 1]
                if math.isclose(percent / 100 * known.size, percent * known.size / 100, rel_tol=0.0):
                    assert value == np.quantile(known, percent / 100, method="inverted_cdf")
            else:
                assert math.isnan(value)


@given(st.lists(VALUES, max_size=40), st.integers(0, 100))
def test_columns_and_arrays_agree(values, percent):
    column = np.array(values, dtype=float)
    known = int(np.count_nonzero(~np.isnan(column)))
    (first,) = column_quantiles(lambda: iter(np.array_split(column, 3)), known, [percent / 100])
    np.testing.assert_array_equal(first, quantiles(column, [percent / 100])[0])


@pytest.mark.parametrize("fraction", [-0.01, 1.01, math.nan, math.inf])
def test_what_is_no_fraction_is_refused(fraction):
    with pytest.raises(ValueError, match="is not between 0 and 1"):
        quantiles(np.ones(3), [fraction])


def test_the_product_has_no_other_quantile():
    """Calls of numpy's quantiles, which interpolate, are absent."""
    calls = []
    for file in sorted((ROOT / "analysis").rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in OTHERS:
                owner = ast.unparse(node.func.value)
                if owner in ("np", "numpy", "scipy.stats", "stats", "statistics"):
                    calls.append(f"{file.relative_to(ROOT)}:{node.lineno}")
    assert calls == []
