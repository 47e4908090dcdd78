"""Areas between steps, and dashed circles.

Truth: matplotlib's areas between steps; the equation of a circle.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.figure import Figure

from perilune.analysis.documents.chart.marks import CIRCLE_DASHES, DASH, band_areas, dashed_circle


def test_areas_of_steps_are_those_of_matplotlib():
    x = np.array([0.0, 1.0, 2.5, 4.0])
    low, high = np.array([0.0, 1.0, np.nan, 0.5]), np.array([2.0, 3.0, 1.0, 4.0])
    low[2] = -1.0
    (area,) = band_areas(x, low, high, "#000000", 0.3, steps=True)
    polygon = Figure().subplots().fill_between(x, low, high, step="post").get_paths()[0]
    corners = {tuple(each) for each in np.asarray(polygon.vertices)}
    assert {*zip(area.x.tolist(), area.y.tolist(), strict=True)} == corners


def test_a_dashed_circle():
    circle = dashed_circle(7.0, "#222222", 1.0)
    np.testing.assert_allclose(np.hypot(circle.x, circle.y), 7.0, rtol=1e-12)
    chords = np.hypot(np.diff(circle.x)[::2], np.diff(circle.y)[::2])
    assert chords.sum() == pytest.approx(DASH * 2.0 * math.pi * 7.0, rel=1e-3)
    assert chords.size == CIRCLE_DASHES
