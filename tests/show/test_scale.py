"""Bins of a scale: each number is in the bin between whose edges it lies.

Truth: comparison of the number with the edges; the minimum and the maximum.
"""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.show.scale import ABOVE, BARS, BELOW, BINS, NAN, make_scale

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
            assert number < scale.edges[code + 1] or number == scale.edges[-1] == np.finfo(float).max


@given(st.integers(-1000, 1000), st.integers(1, 5000))
def test_whole_numbers_are_spread_evenly(first, count):
    column = np.arange(first, first + count + 1, dtype=float)
    scale = make_scale(column)
    if scale.knee:
        return
    bars = np.bincount(scale.bin(column) // (BINS // BARS), minlength=BARS)
    used = bars[bars > 0]
    assert np.all(used[:-1] == used[0])
    assert used[-1] <= used[0]


def test_a_scale_over_decades_is_bent():
    column = 10.0 ** np.linspace(-6, 6, 1000)
    scale = make_scale(column)
    bins = scale.bin(column)
    assert np.unique(bins).size > 900  # linear, all but the last decade would be in one bin
    assert not make_scale(np.linspace(5, 6, 1000)).knee
