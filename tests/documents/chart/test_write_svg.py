"""Pictures of charts of any axes.

Truth: linear interpolation between the ends of an axis (of logarithms on a logarithmic axis); the number of marks;
equal lengths of equal units.
"""

from __future__ import annotations

import math
import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from lxml import etree

from perilune.analysis.documents.chart.axes import (
    bare_axis,
    fine_axis,
    lane_axis,
    linear_axis,
    logarithmic_axis,
    named_axis,
)
from perilune.analysis.documents.chart.equal import to_scale
from perilune.analysis.documents.chart.layout import NARROWS, lay_out_fluid
from perilune.analysis.documents.chart.panel import chart_panel, wide_figure
from perilune.analysis.documents.chart.quantity import quantity_curve
from perilune.analysis.documents.chart.svg.fluid import POINT
from perilune.analysis.documents.chart.symbols import arrow, marker, marks
from perilune.analysis.documents.chart.write_svg import write_svg
from perilune.analysis.documents.common import panels
from perilune.analysis.documents.common.quantities import MINUS
from perilune.analysis.documents.font.text import text_width
from perilune.analysis.documents.interactive.charts import NO_BOX, Area, Backing, Chart, ChartNote, Dots
from tests.support.figures.fluid import position

WIDTH, HEIGHT = 245.0, 180.0  # pt
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
UNIT = linear_axis((0.0, 1.0), 4)


def draw(chart, **options):
    """Return the laid out chart, and the root of its picture."""
    placed = lay_out_fluid(chart, WIDTH, HEIGHT)
    return placed, etree.fromstring(str(write_svg(placed, "a", "what it shows", WIDTH, HEIGHT, **options)))


def expected(axis, at, begin, length):
    low, high = axis.ends
    if axis.logarithmic:
        low, high, at = math.log(low), math.log(high), math.log(at)
    return begin + (at - low) / (high - low) * length


def area_of(chart):
    """Return width and height (px) of the area of the axes, from whose corner positions count."""
    left, top, right, bottom = chart.fluid.margins
    return POINT * WIDTH - left - right, POINT * HEIGHT - top - bottom


@st.composite
def axes(draw):
    low = draw(st.floats(-5.0, 5.0))
    high = low + draw(st.floats(0.01, 8.0))
    if draw(st.booleans()):
        return logarithmic_axis((10.0**low, 10.0**high), 6)
    ends = (low, high) if draw(st.booleans()) else (high, low)
    axis = linear_axis((low, high), draw(st.integers(2, 9)))
    return Chart(NO_BOX, axis, axis).x if ends[0] < ends[1] else type(axis)(**{**vars(axis), "ends": ends})


def between(axis, fraction):
    low, high = axis.ends
    return low * (high / low) ** fraction if axis.logarithmic else low + fraction * (high - low)


@given(axes(), axes(), st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)), min_size=1, max_size=6))
def test_positions(x, y, fractions):
    points = [(between(x, across), between(y, up)) for across, up in fractions]
    abscissas, ordinates = (np.array(each) for each in zip(*points, strict=True))
    circles = marks(abscissas, ordinates, marker("o", 4.0, "#0072B2", fill="white"))
    note = ChartNote("here", points[0], (False, False), (3.0, -2.0), ("left", "baseline"), "#222222", 9.0)
    placed, root = draw(Chart(NO_BOX, x, y, curves=[circles], notes=[note]))
    width, height = area_of(placed)
    positions = [(expected(x, across, 0.0, width), expected(y, up, height, -height)) for across, up in points]
    circles_in_picture = root.findall(".//{*}circle")
    assert len(circles_in_picture) == len(points)
    for element, at in zip(circles_in_picture, positions, strict=True):
        assert position(element, (width, height)) == pytest.approx(at, abs=0.07)
    text = root.findall(".//{*}text")[-1]
    assert text.text == "here"
    across, up = position(text, (width, height))
    assert (across - 3.0 * POINT, up - 2.0 * POINT) == pytest.approx(positions[0], abs=0.03)


@given(axes(), axes())
def test_texts_of_ticks_lie_in_the_figure_and_do_not_overlap(x, y):
    assume(all(len(axis.ticks) > 1 for axis in (x, y)))
    placed, root = draw(Chart(NO_BOX, x, y))
    (left, _, right, _), (width, height) = placed.fluid.margins, area_of(placed)
    texts = [each for each in root.iter("{*}text") if each.text]
    ticks = [(axis, *tick) for axis in (placed.x, placed.y) for tick in axis.ticks if tick[1]]
    assert sorted(each.text for each in texts) == sorted(text for *_, text in ticks)
    for axis, at, text in ticks:
        half = text_width(text, POINT * axis.size) / 2.0
        is_up = axis is placed.y
        expected_at = expected(axis, at, height if is_up else 0.0, -height if is_up else width)
        texts_at = [position(each, (width, height)) for each in texts if each.text == text]
        assert min(abs(each[is_up] - (0.365 * 11.0 if is_up else 0.0) - expected_at) for each in texts_at) < 0.03
        if is_up:
            assert 2.0 * half <= left
        else:
            assert half - left - 0.1 <= expected_at <= width + right - half + 0.1


def test_marks_beyond_the_axes_are_left_out():
    rows = np.linspace(-1.0, 2.0, 31)
    _, root = draw(Chart(NO_BOX, UNIT, UNIT, curves=[marks(rows, rows, marker("s", 3.0, "#D55E00"))]))
    (path,) = [each for each in root.iter("{*}path") if each.get("fill") == "#d55e00"]
    key = path.getparent().get("id")
    assert path.get("d").count("z") == 1
    copies = [each for each in root.iter("{*}use") if each.get("href") == f"#{key}"]
    assert len(copies) == np.count_nonzero((rows >= -1e-9) & (rows <= 1.0 + 1e-9)) == 11


@pytest.mark.parametrize("trials", [0, 1, 40, 4000])
@pytest.mark.parametrize("cross", [False, True])
def test_dots_of_trials(trials, cross):
    x, y = np.random.default_rng(trials).uniform(-0.2, 1.2, (2, trials))
    dots = Dots(variant="nominal", names=("a", "b"), colour="#9a9a9a", size=3.0, cross=cross)
    placed, root = draw(Chart(NO_BOX, UNIT, UNIT, dots=[dots]), trials=lambda each: (x, y))
    area = area_of(placed)
    positions = np.array(area) * np.stack([x, 1.0 - y], axis=1)
    positions = positions[np.all((positions > -0.05) & (positions < np.array(area) + 0.05), axis=1)]
    paths = [each for each in root.iter("{*}path") if each.get("stroke") == "#9a9a9a"]
    if not positions.size:
        assert not paths
        return
    (path,) = paths
    if cross:
        ends = np.array(NUMBER.findall(path.get("d")), dtype=float).reshape(-1, 2).cumsum(axis=0).reshape(-1, 4, 2)
        assert path.get("d").count("m") == 2 * len(ends)
        centres = ends.mean(axis=1)
        np.testing.assert_allclose(np.abs(ends - centres[:, np.newaxis]), 1.5 * POINT, atol=0.06)
    else:
        assert "stroke-linecap:round" in path.get("style")
        centres = np.array([NUMBER.findall(each)[:2] for each in path.get("d").split("m")[1:]]).astype(float)
        centres = np.cumsum(centres, axis=0)
    apart = np.abs(centres[:, None] - positions[None]).max(axis=2)
    assert apart.min(axis=0).max() < 0.11  # each trial has a mark
    assert apart.min(axis=1).max() < 0.11  # and each mark is of one
    assert len(centres) > 0.9 * len(positions)


def test_dots_without_their_trials():
    dots = Dots(variant="nominal", names=("a", "b"), colour="#9a9a9a", size=3.0)
    with pytest.raises(ValueError, match="nominal"):
        draw(Chart(NO_BOX, UNIT, UNIT, dots=[dots]))


def test_strokes_of_an_area():
    """A square around the centre and a line apart from it."""
    x = np.array([0.2, 0.8, 0.8, 0.8, 0.8, 0.2, 0.2, 0.2, 0.0, 1.0])
    y = np.array([0.2, 0.2, 0.2, 0.8, 0.8, 0.8, 0.8, 0.2, 0.5, 0.5])
    area = Area(x, y, (True, False), "#222222", 0.5, 1.5, (4.0, 2.0))
    placed, root = draw(Chart(NO_BOX, UNIT, UNIT, areas=[area]))
    (path,) = [each for each in root.iter("{*}path") if each.get("stroke-width") == f"{1.5 * POINT:g}"]
    assert path.get("d").count("M") == 2
    assert (path.get("stroke-dasharray"), path.get("opacity"), path.get("fill")) == (
        f"{6 * POINT:g} {3 * POINT:g}", "0.5", None
    )  # fmt: skip
    width, height = area_of(placed)
    square = np.cumsum(np.array(NUMBER.findall(path.get("d").split("M")[1]), dtype=float).reshape(-1, 2), axis=0)
    corners = np.array([(0.2, 0.8), (0.8, 0.8), (0.8, 0.2), (0.2, 0.2), (0.2, 0.8)])
    assert square == pytest.approx(corners * [width, height], abs=0.1)


def test_opacity_backing_and_bare_axes():
    faint = quantity_curve(np.arange(3.0), np.arange(3.0), "altitude", "m")
    curves = [type(faint)(**{**vars(faint), "opacity": 0.4})]
    note = ChartNote("limit", (0.5, 0.5), (True, True), (0.0, 0.0), ("center", "center"), "#222222", 8.0, True,
                Backing("#ffffff", 0.8, 2.0))  # fmt: skip
    placed, root = draw(Chart(NO_BOX, bare_axis(UNIT), lane_axis(["one", "two"]), curves=curves, notes=[note]))
    assert [each.text for each in root.iter("{*}text")] == ["one", "two", "limit"]
    (line,) = [each for each in root.iter("{*}path") if each.get("stroke-linejoin")]
    assert line.get("opacity") == "0.4"
    (backing,) = [each for each in root.iter("{*}rect") if each.get("fill-opacity")]
    area = area_of(placed)
    assert float(backing.get("width")) == pytest.approx(
        POINT * (text_width("limit", 8.0, is_bold=True) + 4.0), abs=0.02
    )
    middle = position(backing, area)[0] + float(backing.get("width")) / 2.0
    assert middle == pytest.approx(area[0] / 2.0, abs=0.02)
    grid = [each for each in root.iter("{*}path") if each.get("stroke-width") == "0.6"]
    assert "h" not in grid[0].get("d")  # lanes have no lines


@pytest.mark.parametrize(
    ("at", "align", "side"), [((1.02, 0.5), ("left", "center"), 2), ((0.5, 1.0), ("center", "bottom"), 1)]
)
def test_room_for_notes_at_the_edge(at, align, side):
    note = ChartNote("98.5 % (97.9 to 99.0 %)", at, (True, True), (0.0, 2.0), align, "#222222", 9.0)
    without, _ = draw(Chart(NO_BOX, UNIT, UNIT))
    placed, root = draw(Chart(NO_BOX, UNIT, UNIT, notes=[note]))
    text = root.findall(".//{*}text")[-1]
    length, (left, top, *_) = POINT * text_width(note.text, 9.0), placed.fluid.margins
    across, up = position(text, area_of(placed))
    begin = left + across - (length / 2.0 if align[0] == "center" else 0.0)
    assert begin >= 0.0
    assert begin + length <= POINT * WIDTH
    assert top + up - POINT * 0.9 * 9.0 >= 0.0
    assert placed.box != without.box


@given(st.floats(0.1, 1e4), st.floats(0.1, 1e4))
def test_equal_units(across, up):
    def chart_of(x, y):
        return Chart(NO_BOX, linear_axis(x, 5, label="range, m"), linear_axis(y, 6))

    x, y = (-across, across), (up, 2.0 * up)
    chart = to_scale(chart_of, x, y, WIDTH, HEIGHT)
    width, height = area_of(chart)
    lengths = [axis.ends[1] - axis.ends[0] for axis in (chart.x, chart.y)]
    assert lengths[0] / width == pytest.approx(lengths[1] / height, rel=1e-4)
    for axis, (low, high) in ((chart.x, x), (chart.y, y)):
        slack = 1e-9 * (high - low)
        assert axis.ends[0] <= low + slack
        assert axis.ends[1] >= high - slack
        assert len(axis.ticks) >= 2
    figure = chart_panel("", "a", "a", chart, HEIGHT / 72.0, WIDTH / 72.0).figure
    assert figure.charts[0].box == chart.box
    assert f"aspect-ratio:{round(width, 2):g}/{round(height, 2):g}" in figure.svg


@pytest.mark.parametrize("degrees", [0.0, 90.0, 200.0])
def test_arrows_point(degrees):
    curve = arrow((0.5, 0.5), math.radians(degrees), 20.0, "#6b6b6b")
    _, root = draw(Chart(NO_BOX, UNIT, linear_axis((0.0, 100.0), 4), curves=[curve]))
    assert not [each for each in root.iter("{*}path") if each.get("stroke-linejoin")]
    (outline,) = np.array(curve.marker.outline).reshape(1, -1, 2) * 20.0
    tip = outline[np.argmax(np.hypot(*outline.T))]
    assert tip == pytest.approx(
        [20.0 * math.cos(math.radians(degrees)), 20.0 * math.sin(math.radians(degrees))], abs=0.01
    )


WIDTHS = (296.0, 366.0, 500.0, 700.0, 1000.0)  # px, of a page's column


@given(axes(), axes(), st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)), min_size=1, max_size=4))
def test_a_fluid_chart_at_any_width(x, y, fractions):
    assume(all(len(axis.ticks) > 1 for axis in (x, y)))
    points = [(between(x, across), between(y, up)) for across, up in fractions]
    abscissas, ordinates = (np.array(each) for each in zip(*points, strict=True))
    circles = marks(abscissas, ordinates, marker("o", 4.0, "#0072B2", fill="#ffffff"))
    figure = wide_figure("a", "a", Chart(NO_BOX, x, y, curves=[circles]), 2.5)
    (chart,) = figure.charts
    root = etree.fromstring(str(figure.svg))
    left, top, right, bottom = chart.fluid.margins
    height = 2.5 * 72.0 * POINT - top - bottom
    size = f"height:{height:g}px;padding:{top:g}px {right:g}px {bottom:g}px {left:g}px"
    assert root.get("style") == f"width:calc(100% - {left + right:g}px);{size}"
    elements = root.findall(".//{*}circle")
    assert len(elements) == len(points)
    texts = [each for group in root.iter("{*}g") for each in group.findall("{*}text") if "%" in each.get("x")]
    fine = {each for group in root.iter("{*}g") if "fine-" in group.get("class", "") for each in group.iter("{*}text")}
    for width in WIDTHS:
        length = width - left - right
        for element, (across, up) in zip(elements, points, strict=True):
            at = expected(x, across, 0.0, length), expected(y, up, height, -height)
            assert position(element, (length, height)) == pytest.approx(at, abs=0.2)
        is_narrow = bool(chart.x.narrow) and width <= chart.x.narrow
        spans = sorted(
            (left + position(each, (length, height))[0], text_width(each.text, x.size * POINT) / 2.0)
            for each in texts
            if not is_narrow or each not in fine
        )
        assert len(spans) == len(chart.x.few if is_narrow else chart.x.ticks)
        for at, half in spans:
            assert at - half >= -0.1
            assert at + half <= width + 0.1
        for (before, one), (after, other) in pairwise(spans):
            assert after - before >= one + other + 2.0


NAMES = ["one of the candidates", "another one of these", "a third one", "the last one"]


@pytest.mark.parametrize(
    ("axis", "few"),
    [
        (linear_axis((3450.0, 4020.0), 12), ["3500", "3600", "3700", "3800", "3900", "4000"]),
        (linear_axis((0.0, 100000.0), 10), ["0", "50000", "100000"]),  # not each third of them
        (linear_axis((-0.3, 0.3), 12), [f"{MINUS}0.3", f"{MINUS}0.2", f"{MINUS}0.1", "0", "0.1", "0.2", "0.3"]),
        (fine_axis((0.02, 3e9), 12), ["1", "100", "10⁴", "10⁶", "10⁸"]),
        (named_axis((0.0, 3.0), list(enumerate(NAMES))), NAMES[::2]),
        (linear_axis((0.0, 4.0), 5), []),
    ],
)  # fmt: skip
def test_a_narrow_screen_has_ticks_at_round_numbers(axis, few):
    """As many as have room, at multiples of 1, 2, 2.5 or 5 times a power of ten."""
    (chart,) = wide_figure("a", "a", Chart(NO_BOX, axis, UNIT), 2.5).charts
    assert [chart.x.ticks[index][1] for index in chart.x.few] == few


def test_the_sheet_hides_fine_ticks_up_to_each_width():
    sheet = (Path(panels.__file__).parent / "page.css").read_text(encoding="utf-8")
    rules = re.findall(r"@container \(max-width: (\d+)px\) \{ \.fine-(\d+) \{ display: none; \} \}", sheet)
    assert rules == [(str(width), str(width)) for width in NARROWS]
