"""Envelope of a line with many rows: it contains every point and attains the extremes.

Truth: minimum and maximum of each span, by a loop over its rows.
"""

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from perilune.analysis.documents.interactive.envelope import envelope

NUMBERS = st.floats(width=32, allow_infinity=False)


@given(arrays(float, st.integers(0, 80), elements=NUMBERS), st.integers(1, 9))
def test_extremes_of_each_span(y, spans):
    x = np.arange(y.size, dtype=float)
    begins, extremes = envelope(x, y, spans)
    if y.size <= 2 * spans:
        assert np.array_equal(extremes, y, equal_nan=True)
        return
    assert extremes.size == begins.size == 2 * spans
    edges = [int(each) for each in begins[::2]] + [y.size]
    assert edges[0] == 0
    assert max(np.diff(edges)) - min(np.diff(edges)) <= 1
    for index, (begin, end) in enumerate(pairwise(edges)):
        finite = [each for each in y[begin:end] if not np.isnan(each)]
        expected = [min(finite), max(finite)] if finite else [np.nan, np.nan]
        assert np.array_equal(extremes[2 * index : 2 * index + 2], expected, equal_nan=True)
