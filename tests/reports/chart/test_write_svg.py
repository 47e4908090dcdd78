"""Pictures of charts of any axes.

Truth: the formula of a straight line between the ends of an axis, of logarithms where it is logarithmic; the number
of marks; the lengths of what has equal units.
"""

from __future__ import annotations

import math
import re
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from lxml import etree

from perilune.analysis.reports.chart.axes import bare_axis, lane_axis, linear_axis, logarithmic_axis
from perilune.analysis.reports.chart.equal import to_scale
from perilune.analysis.reports.chart.layout import lay_out
from perilune.analysis.reports.chart.panel import chart_panel, fluid_figure
from perilune.analysis.reports.chart.quantity import quantity_curve
from perilune.analysis.reports.chart.symbols import arrow, marker, marks
from perilune.analysis.reports.chart.write_svg import write_svg
from perilune.analysis.reports.font.text import text_width
from perilune.analysis.reports.interactive.charts import NO_BOX, Area, Backing, Chart, Dots, Note

WIDTH, HEIGHT = 245.0, 180.0  # pt
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
UNIT = linear_axis((0.0, 1.0), 4)


def draw(chart, **options):
    """The laid out chart, and the root of its picture."""
    placed = lay_out(chart, WIDTH, HEIGHT)
    return placed, etree.fromstring(str(write_svg(placed, "a", "what it shows", WIDTH, HEIGHT, **options)))


def expected(axis, at, begin, length):
    low, high = axis.ends
    if axis.logarithmic:
        low, high, at = math.log(low), math.log(high), math.log(at)
    return begin + (at - low) / (high - low) * length


def inside(chart):
    left, top, width, height = chart.box
    return left * WIDTH, top * HEIGHT, width * WIDTH, height * HEIGHT


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
    note = Note("here", points[0], (False, False), (3.0, -2.0), ("left", "baseline"), "#222222", 9.0)
    placed, root = draw(Chart(NO_BOX, x, y, curves=[circles], notes=[note]))
    left, top, width, height = inside(placed)
    positions = [(expected(x, across, left, width), expected(y, up, top + height, -height)) for across, up in points]
    circles_in_picture = root.findall(".//{*}circle")
    assert len(circles_in_picture) == len(points)
    for element, position in zip(circles_in_picture, positions, strict=True):
        assert (float(element.get("cx")), float(element.get("cy"))) == pytest.approx(position, abs=0.06)
    text = root.findall(".//{*}text")[-1]
    assert text.text == "here"
    assert (float(text.get("x")) - 3.0, float(text.get("y")) - 2.0) == pytest.approx(positions[0], abs=0.02)


@given(axes(), axes())
def test_texts_of_ticks_lie_in_the_figure_and_do_not_overlap(x, y):
    assume(all(len(axis.ticks) > 1 for axis in (x, y)))
    placed, root = draw(Chart(NO_BOX, x, y))
    left, top, width, height = inside(placed)
    for group, axis in zip(root.findall("./{*}g"), (x, y), strict=False):
        for element, (at, text) in zip(group.findall("{*}text"), axis.ticks, strict=False):
            assert element.text == text
            half = text_width(text, axis.size) / 2.0
            if axis is x:
                assert float(element.get("x")) == pytest.approx(expected(x, at, left, width), abs=0.02)
                assert half - 0.1 <= float(element.get("x")) <= WIDTH - half + 0.1
            else:
                assert float(element.get("y")) - 0.365 * 8.0 == pytest.approx(
                    expected(y, at, top + height, -height), abs=0.02
                )
                assert float(element.get("x")) - 2.0 * half >= 0.0


def test_marks_beyond_the_axes_are_left_out():
    rows = np.linspace(-1.0, 2.0, 31)
    _, root = draw(Chart(NO_BOX, UNIT, UNIT, curves=[marks(rows, rows, marker("s", 3.0, "#D55E00"))]))
    (path,) = [each for each in root.iter("{*}path") if each.get("fill") == "#d55e00"]
    assert path.get("d").count("M") == np.count_nonzero((rows >= -1e-9) & (rows <= 1.0 + 1e-9)) == 11
    assert path.get("d").count("z") == 11


@pytest.mark.parametrize("trials", [0, 1, 40, 4000])
@pytest.mark.parametrize("cross", [False, True])
def test_dots_of_trials(trials, cross):
    x, y = np.random.default_rng(trials).uniform(-0.2, 1.2, (2, trials))
    dots = Dots(variant="nominal", names=("a", "b"), colour="#9a9a9a", size=3.0, cross=cross)
    placed, root = draw(Chart(NO_BOX, UNIT, UNIT, dots=[dots]), trials=lambda each: (x, y))
    left, top, width, height = inside(placed)
    positions = np.stack([left + width * x, top + height * (1.0 - y)], axis=1)
    positions = positions[
        np.all((positions > [left - 0.05, top - 0.05]) & (positions < [left + width + 0.05, top + height + 0.05]), 1)
    ]
    paths = [each for each in root.iter("{*}path") if each.get("stroke") == "#9a9a9a"]
    if not positions.size:
        assert not paths
        return
    (path,) = paths
    begins = path.get("d").split("M")[1::2] if cross else path.get("d").split("m")[1:]
    centres = np.array([NUMBER.findall(each)[:2] for each in begins]).astype(float)
    if cross:
        centres += [1.5, -1.5]  # from the end of its first stroke to its middle
    else:
        assert "stroke-linecap:round" in path.get("style")
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
    (path,) = [each for each in root.iter("{*}path") if each.get("stroke-width") == "1.5"]
    assert path.get("d").count("M") == 2
    assert (path.get("stroke-dasharray"), path.get("opacity"), path.get("fill")) == ("6 3", "0.5", None)
    left, top, width, height = inside(placed)
    square = np.cumsum(np.array(NUMBER.findall(path.get("d").split("M")[1]), dtype=float).reshape(-1, 2), axis=0)
    corners = [(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8), (0.2, 0.2)]
    assert square == pytest.approx(np.array([(left + a * width, top + (1 - b) * height) for a, b in corners]), abs=0.1)


def test_opacity_backing_and_bare_axes():
    faint = quantity_curve(np.arange(3.0), np.arange(3.0), "altitude", "m")
    curves = [type(faint)(**{**vars(faint), "opacity": 0.4})]
    note = Note("limit", (0.5, 0.5), (True, True), (0.0, 0.0), ("center", "center"), "#222222", 8.0, True,
                Backing("#ffffff", 0.8, 2.0))  # fmt: skip
    placed, root = draw(Chart(NO_BOX, bare_axis(UNIT), lane_axis(["one", "two"]), curves=curves, notes=[note]))
    assert [each.text for each in root.iter("{*}text")] == ["one", "two", "limit"]
    (line,) = [each for each in root.iter("{*}path") if each.get("stroke-linejoin")]
    assert line.get("opacity") == "0.4"
    (backing,) = [each for each in root.iter("{*}rect") if each.get("fill-opacity")]
    left, _, width, _ = inside(placed)
    assert float(backing.get("width")) == pytest.approx(text_width("limit", 8.0, is_bold=True) + 4.0, abs=0.01)
    assert float(backing.get("x")) + float(backing.get("width")) / 2.0 == pytest.approx(left + width / 2.0, abs=0.02)
    grid = [each for each in root.iter("{*}path") if each.get("stroke-width") == "0.6"]
    assert "H" not in grid[0].get("d")  # lanes have no lines


@pytest.mark.parametrize(
    ("at", "align", "side"), [((1.02, 0.5), ("left", "center"), 2), ((0.5, 1.0), ("center", "bottom"), 1)]
)
def test_room_for_notes_at_the_edge(at, align, side):
    note = Note("98.5 % (97.9 to 99.0 %)", at, (True, True), (0.0, 2.0), align, "#222222", 9.0)
    without, _ = draw(Chart(NO_BOX, UNIT, UNIT))
    placed, root = draw(Chart(NO_BOX, UNIT, UNIT, notes=[note]))
    text = root.findall(".//{*}text")[-1]
    length = text_width(note.text, 9.0)
    begin = float(text.get("x")) - (length / 2.0 if align[0] == "center" else 0.0)
    assert begin >= 0.0
    assert begin + length <= WIDTH
    assert float(text.get("y")) - 0.9 * 9.0 >= 0.0
    assert placed.box != without.box


@given(st.floats(0.1, 1e4), st.floats(0.1, 1e4))
def test_equal_units(across, up):
    def chart_of(x, y):
        return Chart(NO_BOX, linear_axis(x, 5, label="range, m"), linear_axis(y, 6))

    x, y = (-across, across), (up, 2.0 * up)
    chart = to_scale(chart_of, x, y, WIDTH, HEIGHT)
    _, _, width, height = inside(chart)
    lengths = [axis.ends[1] - axis.ends[0] for axis in (chart.x, chart.y)]
    assert lengths[0] / width == pytest.approx(lengths[1] / height, rel=1e-9)
    for axis, (low, high) in ((chart.x, x), (chart.y, y)):
        slack = 1e-9 * (high - low)
        assert axis.ends[0] <= low + slack
        assert axis.ends[1] >= high - slack
        assert len(axis.ticks) >= 2
    figure = chart_panel("", "a", "a", chart, HEIGHT / 72.0, WIDTH / 72.0).figure
    assert figure.charts[0].box == chart.box


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


WIDTHS = (366.0, 700.0, 1000.0)  # px, of a page's column


@given(axes(), axes(), st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)), min_size=1, max_size=4))
def test_a_fluid_chart_at_any_width(x, y, fractions):
    assume(all(len(axis.ticks) > 1 for axis in (x, y)))
    points = [(between(x, across), between(y, up)) for across, up in fractions]
    abscissas, ordinates = (np.array(each) for each in zip(*points, strict=True))
    circles = marks(abscissas, ordinates, marker("o", 4.0, "#0072B2", fill="#ffffff"))
    figure = fluid_figure("a", "a", Chart(NO_BOX, x, y, curves=[circles]), 2.5)
    (chart,) = figure.charts
    root = etree.fromstring(str(figure.svg))
    left, top, right, bottom = chart.fluid.margins
    height = 2.5 * 72.0 * chart.fluid.point
    assert f"height:{height:g}px;padding:{top:g}px {right:g}px {bottom:g}px {left:g}px" in root.get("style")
    elements = root.findall(".//{*}circle")
    assert len(elements) == len(points)
    texts = [each for group in root.iter("{*}g") for each in group.findall("{*}text") if "%" in each.get("x")]
    fine = {each.text for group in root.iter("{*}g") if group.get("class") == "fine" for each in group.iter("{*}text")}
    for width in WIDTHS:
        length = width - left - right

        def px(attribute, left=left, length=length):
            return left + float(attribute.removesuffix("%")) / 100.0 * length

        for element, (across, up) in zip(elements, points, strict=True):
            assert px(element.get("cx")) == pytest.approx(expected(x, across, left, length), abs=0.2)
            assert top + float(element.get("cy")) == pytest.approx(
                expected(y, up, height - bottom, top + bottom - height), abs=0.06
            )
        spans = sorted(
            (px(each.get("x")), text_width(each.text, x.size * chart.fluid.point) / 2.0)
            for each in texts
            if width > 640.0 or each.text not in fine
        )
        assert len(spans) == len(chart.x.few if chart.x.few and width <= 640.0 else x.ticks)
        for at, half in spans:
            assert at - half >= -0.1
            assert at + half <= width + 0.1
        for (before, one), (after, other) in pairwise(spans):
            assert after - before >= one + other + 2.0


def test_few_ticks_are_at_whole_multiples():
    axis = linear_axis((3450.0, 4020.0), 12)
    (chart,) = fluid_figure("a", "a", Chart(NO_BOX, axis, UNIT), 2.5).charts
    assert [chart.x.ticks[index][1] for index in chart.x.few] == ["3500", "3600", "3700", "3800", "3900", "4000"]
    assert fluid_figure("a", "a", Chart(NO_BOX, linear_axis((0.0, 4.0), 5), UNIT), 2.5).charts[0].x.few == []
