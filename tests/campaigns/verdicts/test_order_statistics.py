"""perilune.analysis.campaigns.verdicts.order_statistics: selection in memory or digit by digit. Truth: numpy's sort."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from perilune.analysis.campaigns.verdicts import order_statistics as module
from perilune.analysis.campaigns.verdicts.order_statistics import order_statistics

SOME = [0.0, -0.0, 1.0, math.inf, -math.inf, math.nan, 5e-324, -5e-324, 1.7976931348623157e308]
ANY = st.floats() | st.sampled_from(SOME)


@given(st.lists(st.lists(ANY, max_size=8), min_size=1, max_size=5), st.sampled_from([0, module.HELD]))
@example([SOME, SOME], 0)
def test_every_rank_is_that_of_the_sorted_values(lists, held):
    """With ``held`` 0 nothing is sorted: every value is found by its digits."""
    parts = [np.array(values, dtype=float) for values in lists]
    known = np.concatenate(parts)
    expected = np.sort(known[~np.isnan(known)])
    before, module.HELD = module.HELD, held
    try:
        assert order_statistics(lambda: iter(parts), range(len(expected))) == expected.tolist()
        with pytest.raises(IndexError):
            order_statistics(lambda: iter(parts), [len(expected)])
    finally:
        module.HELD = before


def test_more_values_than_are_held():
    values = np.random.default_rng(1).standard_normal(3 * module.HELD)
    ranks = [0, 17, len(values) // 2, len(values) - 1]
    assert order_statistics(lambda: np.array_split(values, 7), ranks) == np.sort(values)[ranks].tolist()
