"""Charts drawn by matplotlib. Truth: the same charts, read back from the figure."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.documents.chart.axes import bare_axis, lane_axis, linear_axis, logarithmic_axis, named_axis
from perilune.analysis.documents.chart.layout import lay_out
from perilune.analysis.documents.chart.marks import (
    band_areas,
    horizontal_band,
    horizontal_line,
    vertical_band,
    vertical_line,
)
from perilune.analysis.documents.chart.plot import plot_charts
from perilune.analysis.documents.chart.quantity import quantity_curve
from perilune.analysis.documents.chart.symbols import OUTLINES, arrow, marker, marks
from perilune.analysis.documents.interactive.charts import NO_BOX, Area, Backing, Chart, ChartNote, Dots
from tests.documents.chart.test_history_charts import plain
from tests.support.figures.read_figure import read_charts
from tests.support.lengths import either

ROWS = np.linspace(0.0, 4.0, 9)
UNIT = linear_axis((0.0, 4.0), 4, label="time, s")
POSITIONS = np.random.default_rng(5).uniform(0.0, 4.0, (2, 30))
AXES = {
    "linear": UNIT,
    "logarithmic": logarithmic_axis((0.02, 5e5), 6, label="frequency, rad/s"),
    "named": named_axis((-0.15, 1.15), [(0.0, "false"), (1.0, "true")]),
    "bare": bare_axis(UNIT),
    "lanes": lane_axis(["nominal", "dispersed"]),
    "inverted": replace(linear_axis((0.0, 4.0), 5), ends=(4.0, 0.0)),
}


def read_back(chart):
    figure = plot_charts([chart], 2.5, 3.4, trials=lambda dots: tuple(POSITIONS))
    figure.canvas.draw()
    (read,) = read_charts(figure)
    return read


@pytest.mark.parametrize("y", [each for each in AXES if each != "logarithmic"])
@pytest.mark.parametrize("x", [each for each in AXES if each not in ("lanes", "inverted")])
def test_axes(x, y):
    anything = marks(np.array([1.0]), np.array([0.5]), marker("o", 4.0, "#0072b2"))
    chart = Chart(NO_BOX, AXES[x], AXES[y], curves=[anything])
    read = read_back(chart)
    assert read.box == pytest.approx(lay_out(chart, 3.4 * 72.0, 2.5 * 72.0).box, abs=2e-5)
    # An ordinate's label is the picture's, and so is the abscissa's where axes share it.
    assert plain(read) == plain(replace(chart, y=replace(chart.y, label="")))


def test_everything_else():
    vector = quantity_curve(ROWS, np.sin(ROWS), "plant.angle", "rad", 1)
    curves = [
        vector,
        quantity_curve(ROWS, np.where(ROWS == 1.0, np.nan, ROWS), "plant.mode", None, 2, steps=True),
        replace(quantity_curve(ROWS, ROWS, "plant.range", "m"), opacity=0.4, time=ROWS * 2.0, metric="metric.miss"),
        *(
            marks(ROWS, ROWS / 2.0, marker(kind, 7.0, "#D55E00", fill="#ffffff"))
            for kind in OUTLINES
            if kind not in "+x|_"
        ),
        *(marks(ROWS, ROWS / 2.0, marker(kind, 7.0, "#D55E00", width=1.5)) for kind in "+x|_"),
        marks(ROWS[:1], ROWS[:1], marker("o", 5.0, "#009e73", fill=""), beyond=True),
    ]
    stroked = np.array([0.0, 1.0, 1.0, 2.0, 2.0, 0.5])
    chart = Chart(
        NO_BOX, UNIT, replace(UNIT, label=""), curves=curves,
        dots=[Dots(variant="nominal", names=("metric.a", "draw.b"), success=True, colour="#9a9a9a", size=2.5),
              Dots(variant="nominal", names=("metric.a", "draw.b"), colour="#d55e00", size=3.5, cross=True)],
        areas=[*band_areas(ROWS, ROWS - 1.0, ROWS + 1.0, "#E69F00", 0.4), horizontal_band(1.0, 2.0, "#009E73", 0.16),
               vertical_band(0.5, 1.0, "#6b6b6b", 0.35),
               Area(stroked, stroked**2, (False, False), "#222222", 0.5, 1.2, (4.0, 2.0))],
        rules=[horizontal_line(1.0, "#222222", 0.9, (5.0, 3.0)), vertical_line(2.0, "#222222", 0.8)],
        notes=[ChartNote("12 dB", (1.0, 2.0), (False, False), (4.0, -3.0), ("left", "center"), "#222222", 8.0, True,
                    Backing("#ffffff", 0.8, 2.0)),
               ChartNote("nominal", (1.02, 1.5), (True, False), (0.0, 0.0), ("left", "center"), "#6b6b6b", 9.0)],
    )  # fmt: skip
    assert plain(read_back(chart)) == plain(chart)


@given(st.floats(-math.pi, math.pi), st.floats(8.0, 40.0))
@settings(max_examples=either(10, 5))
def test_arrows(angle, length):
    """matplotlib has paths of marks in another unit: their points, in pt, are the same."""
    chart = Chart(NO_BOX, UNIT, UNIT, curves=[arrow((1.0, 2.0), angle, length, "#6b6b6b")])
    (read,) = read_back(chart).curves
    expected = chart.curves[0].marker
    points = [each.size * np.array(each.outline[0]) for each in (read.marker, expected)]
    assert points[0] == pytest.approx(points[1], abs=length * 2e-4)
    assert (read.marker.fill, read.marker.edge, read.joined) == (expected.fill, "", False)


def test_separate_strokes_are_separate_areas():
    x, y = np.array([0.0, 1.0, 2.0, 3.0]), np.array([0.0, 1.0, 0.0, 1.0])
    areas = [Area(x, y, (False, False), "#222222", 1.0, 1.0)]
    read = read_back(Chart(NO_BOX, UNIT, UNIT, curves=[quantity_curve(ROWS, ROWS, "a", None)], areas=areas)).areas
    assert [(each.x.tolist(), each.y.tolist()) for each in read] == [([0, 1], [0, 1]), ([2, 3], [0, 1])]


def test_charts_in_one_column_have_their_axes_above_each_other():
    wide = replace(UNIT, ticks=[(0.0, "a long name of a lane")], named=True)
    figure = plot_charts([Chart(NO_BOX, UNIT, UNIT), Chart(NO_BOX, UNIT, wide)], 2.0, 6.8, titles=["m", "deg"])
    first, second = (axes.get_position() for axes in figure.axes)
    assert first.x0 == pytest.approx(second.x0)
    assert first.y0 > 0.5 > second.y1
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["m", "deg"]
    grid = plot_charts([Chart(NO_BOX, UNIT, UNIT)] * 3, 2.0, 3.4, columns=2)
    assert tuple(grid.get_size_inches()) == (6.8, 4.0)
