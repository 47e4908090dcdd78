"""Views of trajectories: scales, times along a path, figure of a notebook.

Truth: a circle and a straight line with known lengths and instants; rectangles of texts.
"""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.documents.font.text import text_width
from perilune.analysis.documents.of.simulation.times_on_path import mark_rows
from perilune.analysis.documents.of.simulation.trajectory import trajectory_plot
from perilune.analysis.documents.of.simulation.trajectory_chart import View, view_chart
from tests.support.documents.subsections import trajectory_panels
from tests.support.pages.samples import run_result

SIZE = (324.0, 230.0)  # pt
TIME = np.linspace(0.0, 100.0, 501)
ANGLE = 2.0 * np.pi * TIME / 110.0


def view(*paths, time=TIME, has_ground=False):
    labels = [f"ship{index}.position" for index in range(len(paths))]
    return View("Side view", "side", [np.stack(path) for path in paths], labels, time, ("x", "z"), has_ground)


def points_of(chart):
    """Return the length of a unit of both axes in the picture."""
    return [
        size * length / (axis.ends[1] - axis.ends[0])
        for size, length, axis in zip(SIZE, chart.box[2:], (chart.x, chart.y), strict=True)
    ]


@pytest.mark.parametrize("radius", [2.0, 3e5])
def test_a_circle_is_one(radius):
    circle = view((radius * np.cos(ANGLE), radius * np.sin(ANGLE)))
    chart, ordinate, scales = view_chart(circle, *SIZE)
    across, up = points_of(chart)
    assert across == pytest.approx(up, rel=1e-3)
    assert scales == "equal scales"
    unit, factor = ("m", 1.0) if radius < 1e4 else ("km", 1e-3)
    assert [chart.x.label, ordinate] == [f"x, {unit}", f"z, {unit}"]
    np.testing.assert_allclose(np.hypot(chart.curves[0].x, chart.curves[0].y), factor * radius)
    for axis in (chart.x, chart.y):
        assert axis.ends[0] < -factor * radius
        assert axis.ends[1] > factor * radius


def test_a_flat_path_is_not_to_scale():
    chart, ordinate, scales = view_chart(view((2e5 * TIME, 50.0 * np.sin(ANGLE))), *SIZE)
    assert scales == "not to scale"
    assert [chart.x.label, ordinate] == ["x, km", "z, m"]


def test_marks_and_ends_of_all_paths():
    """Round times are each 20 s; the ground is a twentieth of the height deep."""
    rising = (TIME, 2.0 * TIME)
    chart, *_ = view_chart(view(rising, (-TIME, TIME), has_ground=True), *SIZE)
    assert [curve.name for curve in chart.curves] == [
        "ship0.position", "ship1.position", *["ship0.position"] * 2, *["ship1.position"] * 2
    ]  # fmt: skip
    first, end = chart.curves[2:4]
    np.testing.assert_allclose(first.x, [0.0, 20.0, 40.0, 60.0, 80.0, 100.0])
    np.testing.assert_allclose(first.y, 2.0 * first.x)
    assert (end.x, end.y) == ([100.0], [200.0])
    assert {(curve.colour, curve.time is None) for curve in chart.curves} == {
        (colour, is_mark) for colour in ("#0072b2", "#d55e00") for is_mark in (False, True)
    }
    (ground,) = chart.areas
    assert (ground.y.min(), ground.y.max()) == pytest.approx((-10.0, 0.0))
    assert [rule.at for rule in chart.rules] == [0.0]


@pytest.mark.parametrize(
    ("time", "expected"),
    [
        (TIME, [0.0, 20.0, 40.0, 60.0, 80.0, 100.0]),
        (np.linspace(3.0, 3.7, 71), [3.0, 3.1, 3.2, 3.3, 3.4, 3.5, 3.6, 3.7]),
        (np.array([5.0]), [5.0]),
        (np.array([5.0, 5.0]), [5.0]),
    ],
)
def test_marked_times(time, expected):
    np.testing.assert_allclose(time[mark_rows(time)], expected)


def extent_of(note, chart):
    """Return left, bottom, right and top (pt) of a text's digits."""
    corner = [
        (at - axis.ends[0]) / (axis.ends[1] - axis.ends[0]) * size * length
        for at, axis, size, length in zip(note.at, (chart.x, chart.y), SIZE, chart.box[2:], strict=True)
    ]
    width = text_width(note.text, note.size, is_bold=note.bold)
    left = corner[0] + note.offset[0] - (width if note.align[0] == "right" else 0.0)
    bottom = corner[1] + note.offset[1]
    return left, bottom, left + width, bottom + 0.7 * note.size


@given(st.lists(st.floats(-3.0, 3.0), min_size=8, max_size=8), st.booleans())
def test_times_cover_neither_each_other_nor_marks(terms, two):
    """On paths of two waves for each coordinate; the end has its time whatever else is there."""
    waves = np.array([np.sin(ANGLE), np.cos(ANGLE), np.sin(2.0 * ANGLE), TIME / 50.0])
    path = np.reshape(terms, (2, 4)) @ waves
    both = [path, path[::-1] + 1.0] if two else [path]
    chart, *_ = view_chart(view(*both), *SIZE)
    end, *others = chart.notes
    assert (end.text, end.bold) == ("100 s", True)
    assert all(not note.bold for note in others)
    instants = {f"{at:g} s": at for at in TIME}
    for note in chart.notes:
        row = int(np.searchsorted(TIME, instants[note.text] - 1e-9))
        assert note.at == pytest.approx((chart.curves[0].x[row], chart.curves[0].y[row]))
    extents = [extent_of(note, chart) for note in others]
    for one, other in combinations([extent_of(end, chart), *extents], 2):
        assert one[0] > other[2] or one[2] < other[0] or one[1] > other[3] or one[3] < other[1]
    across, up = points_of(chart)
    for curve in chart.curves[len(both) :]:
        x, y = (curve.x - chart.x.ends[0]) * across, (curve.y - chart.y.ends[0]) * up
        for left, bottom, right, top in extents:
            assert not np.any((x > left) & (x < right) & (y > bottom) & (y < top))


def test_a_notebook_has_the_same_paths():
    run = run_result()
    figure = trajectory_plot(run)
    panels = trajectory_panels(run)
    assert [axes.get_title(loc="left").partition(":")[0] for axes in figure.axes] == [panel.label for panel in panels]
    for axes, panel in zip(figure.axes, panels, strict=True):
        (chart,) = panel.figure.charts
        lines = [line for line in axes.lines if line.get_transform() is axes.transData]
        assert len(lines) >= len(chart.curves)
        np.testing.assert_allclose(lines[0].get_xdata(), chart.curves[0].x)
        np.testing.assert_allclose(lines[0].get_ydata(), chart.curves[0].y)
