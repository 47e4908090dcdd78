"""Limits and ticks of axes.

Truth: matplotlib's MaxNLocator and its automatic limits of axes.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from perilune.analysis.documents.chart.axes import fine_axis
from perilune.analysis.documents.chart.ticks import axis_ends, axis_ticks

NUMBERS = st.floats(-1e9, 1e9) | st.floats(-10.0, 10.0)
WIDTHS = st.floats(1e-6, 1e9) | st.floats(1e-3, 10.0)


@given(low=NUMBERS, width=WIDTHS, intervals=st.integers(2, 8), integer=st.booleans())
@example(low=0.1, width=0.2, intervals=4, integer=False)
@example(low=-0.05, width=1.1, intervals=4, integer=True)
@example(low=9.99999e8, width=3.0, intervals=5, integer=False)
def test_ticks_are_those_of_matplotlib(low, width, intervals, integer):
    high = low + width
    if not high - low > 1e-12 * abs(low):
        return
    locator = MaxNLocator(intervals, steps=[1, 2, 2.5, 5, 10], integer=integer, min_n_ticks=2)
    expected = [each for each in locator.tick_values(low, high) if low <= each <= high]
    edge = 1e-8 * width
    inner = [each for each in axis_ticks(low, high, intervals, integer=integer) if low <= each <= high]
    assert len(inner) == pytest.approx(len(expected), abs=0)
    assert np.allclose(inner, expected, rtol=1e-12, atol=edge)


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True, width=32), max_size=6))
@example([])
@example([math.nan])
@example([0.0, 0.0])
@example([5.0, 5.0])
@example([1e-320, 2e-320])
def test_ends_are_those_of_matplotlib(numbers):
    axes = Figure().subplots()
    values = np.array(numbers, dtype=float)
    axes.plot(values, np.where(np.isfinite(values), values, np.nan))
    expected = axes.get_ylim()
    assert axis_ends(values) == pytest.approx(expected, rel=1e-12)


@given(low=st.floats(-9.0, 6.0), decades=st.floats(0.02, 15.0))
@example(low=-2.0, decades=3.5)
@example(low=0.5, decades=0.1)
def test_ticks_of_logarithmic_axes_are_multiples_of_powers_of_ten(low, decades):
    """All k 10^n of the axis in order, or beyond six decades all powers alone; between two and nine have texts."""
    ends = 10.0**low, 10.0 ** (low + decades)
    axis = fine_axis(ends)
    inside = [k * 10.0**n for n in range(-10, 23) for k in range(1, 10) if ends[0] <= k * 10.0**n <= ends[1]]
    powers = [each for each in inside if math.isclose(math.log10(each), round(math.log10(each)), abs_tol=1e-9)]
    actual = [at for at, _ in axis.ticks]
    assert actual == sorted(actual)
    texts = [text for _, text in axis.ticks if text]
    assert 1 <= len(texts) <= 9
    expected = powers if len(powers) > 6 else inside
    missing = [each for each in expected if not any(math.isclose(each, at, rel_tol=1e-9) for at in actual)]
    assert not missing
    if len(inside) >= 2 and decades > 0.5:
        assert len(actual) == pytest.approx(len(expected), abs=2)  # at an end, by rounding


@given(low=NUMBERS, width=WIDTHS, intervals=st.integers(2, 8))
def test_ticks_at_other_multiples_are_those_of_matplotlib(low, width, intervals):
    """Degrees are counted in 15, 30, 45 and 90."""
    multiples = [1.0, 1.5, 3.0, 4.5, 9.0, 10.0]
    high = low + width
    if not high - low > 1e-12 * abs(low):
        return
    expected = [each for each in MaxNLocator(intervals, steps=multiples).tick_values(low, high) if low <= each <= high]
    actual = [each for each in axis_ticks(low, high, intervals, multiples=multiples) if low <= each <= high]
    assert np.allclose(actual, expected, rtol=1e-12, atol=1e-8 * width)
