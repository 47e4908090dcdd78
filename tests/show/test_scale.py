"""Bins of a scale: each number is in the one bin whose edges it lies between.

Truth: the comparison of the number with the edges, and the least and the greatest number.
"""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.show.scale import ABOVE, BELOW, BINS, NAN, make_scale

NUMBERS = st.lists(st.floats(), min_size=1, max_size=60)


@given(NUMBERS)
def test_bins_are_between_their_edges(numbers):
    column = np.array(numbers)
    scale = make_scale(column)
    finite = column[np.isfinite(column)]
    assert (scale is None) == (finite.size == 0)
    if scale is None:
        return
    assert scale.edges.shape == (BINS + 1,)
    assert np.all(np.isfinite(scale.edges))
    assert np.all(np.diff(scale.edges) >= 0)
    assert scale.edges[0] <= finite.min() <= finite.max() <= scale.edges[-1]
    for number, code in zip(column, scale.bin(column).tolist(), strict=True):
        if np.isnan(number):
            assert code == NAN
        elif np.isinf(number):
            assert code == (ABOVE if number > 0 else BELOW)
        else:
            assert scale.edges[code] <= number
            assert number < scale.edges[code + 1] or (code == BINS - 1 and number == scale.edges[-1])


def test_a_scale_over_decades_is_bent():
    column = 10.0 ** np.linspace(-6, 6, 1000)
    scale = make_scale(column)
    bins = scale.bin(column)
    assert np.unique(bins).size > 900  # linear, all but the last decade would be in one bin
    assert not make_scale(np.linspace(5, 6, 1000)).knee
