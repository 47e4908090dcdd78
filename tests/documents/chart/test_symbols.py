"""Outlines of marks and ticks of logarithmic axes. Truth: matplotlib's outlines and ticks."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.markers import MarkerStyle
from matplotlib.ticker import LogLocator
from matplotlib.transforms import IdentityTransform

from perilune.analysis.documents.chart.symbols import OUTLINES, STROKES
from perilune.analysis.documents.chart.ticks import decade_ticks
from tests.support.figures.read_marks import _polygons


@pytest.mark.parametrize("kind", OUTLINES)
def test_outlines(kind):
    style = MarkerStyle(kind)
    expected = [points.ravel() for points in _polygons(style.get_path(), style.get_transform(), IdentityTransform())]
    assert [len(each) for each in OUTLINES[kind]] == [len(each) for each in expected]
    for outline, points in zip(OUTLINES[kind], expected, strict=True):
        assert outline == pytest.approx(points, abs=5e-5)
    assert (kind in STROKES) == (not style.is_filled())


@given(st.floats(-20.0, 20.0), st.floats(1e-3, 40.0), st.integers(3, 9))
def test_decades(exponent, decades, limit):
    low, high = 10.0**exponent, 10.0 ** (exponent + decades)
    ticks = LogLocator(numticks=limit).tick_values(low, high)
    assert decade_ticks(low, high, limit) == pytest.approx(ticks[(ticks >= low) & (ticks <= high)], rel=1e-12)


@given(st.floats(-3.0, 5.0), st.floats(0.5, 2.2))
def test_multiples_of_decades(exponent, decades):
    low, high = 10.0**exponent, 10.0 ** (exponent + decades)
    ticks = decade_ticks(low, high, 8, (1.0, 2.0, 5.0))
    every = np.array([factor * 10.0**power for power in range(-4, 9) for factor in (1.0, 2.0, 5.0)])
    assert ticks == pytest.approx(every[(every >= low) & (every <= high)])
