"""perilune.analysis.results.selection: quantiles of numbers that are read in parts.

Truth: numpy's quantile of all of them at once, by the same definition.
"""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from perilune.analysis.results import selection

SHARES = (0.0, 0.001, 0.05, 0.25, 0.5, 0.95, 0.99, 0.999, 1.0)


@pytest.fixture(autouse=True, params=[selection.KEPT, 2])
def kept(request, monkeypatch):
    """How many numbers are held: all of these few, or so few that every bit is counted."""
    monkeypatch.setattr(selection, "KEPT", request.param)


def asked(parts, share):
    return selection.quantile(lambda: iter(parts), share)


numbers = st.lists(st.floats(allow_nan=True, allow_infinity=True), max_size=40)


@given(st.lists(numbers, max_size=5), st.floats(0.0, 1.0))
@example([[0.0, -0.0], [5e-324, -5e-324]], 0.5)
@example([[math.inf, -math.inf, math.nan], [1.0]], 0.999)
@example([[1.0] * 30, [np.nextafter(1.0, 2.0)] * 3], 0.95)
def test_quantiles_are_numpys(parts, share):
    arrays = [np.array(part, dtype=float) for part in parts]
    everything = np.concatenate([*arrays, np.zeros(0)])
    known = everything[~np.isnan(everything)]
    found = asked(arrays, share)
    if known.size:
        assert found == np.quantile(known, share, method="inverted_cdf")
    else:
        assert math.isnan(found)


@pytest.mark.parametrize("share", SHARES)
def test_many_numbers_that_are_nearly_the_same(share):
    values = 200.0 + 1e-12 * np.random.default_rng(4).normal(size=20_000)
    assert asked(np.array_split(values, 7), share) == np.quantile(values, share, method="inverted_cdf")


@pytest.mark.parametrize("share", [-0.1, 1.1, math.nan])
def test_what_is_no_share(share):
    with pytest.raises(ValueError, match="is not between 0 and 1"):
        asked([np.ones(3)], share)
