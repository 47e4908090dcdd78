"""Figures as data: everything drawn by matplotlib, with units, marks and limits.

Truth: the data passed to matplotlib.
"""

import numpy as np
import pytest
from matplotlib.patches import Rectangle
from matplotlib.ticker import FixedLocator

from perilune.analysis.documents.common.style import house_style, new_figure
from tests.support.figures.axes import label_lanes, log_ticks_x
from tests.support.figures.lines import plot_path, plot_quantity
from tests.support.figures.read_figure import read_charts

TIME = np.linspace(0.0, 10.0, 3001)
ANGLE = np.sin(TIME)


def charts_of(draw, *, count=1, reduced=False):
    with house_style():
        figure = new_figure(2.0 * count, 4.0)
        draw(*np.atleast_1d(figure.subplots(count, 1, sharex=True)))
        return read_charts(figure, reduced=reduced)


def test_a_line_has_every_row_in_si():
    def draw(axes):
        plot_quantity(axes, TIME, ANGLE, "ship.angles[2]", "rad", 1)
        axes.set_xlim(2.0, 8.0)
        axes.set_xlabel("time, s")

    (chart,) = charts_of(draw)
    (curve,) = chart.curves
    assert np.array_equal(curve.x, TIME)
    assert np.array_equal(curve.y, ANGLE)
    assert (curve.factor, curve.unit, curve.name) == (pytest.approx(180.0 / np.pi), "deg", "ship.angles[2]")
    assert (chart.x.label, chart.x.ends) == ("time, s", (2.0, 8.0))
    assert curve.dashes
    assert not curve.reduced


def test_a_folded_line_is_its_envelope():
    (chart,) = charts_of(lambda axes: plot_quantity(axes, TIME, ANGLE, "x", None), reduced=True)
    (curve,) = chart.curves
    assert curve.reduced
    assert curve.y.numbers.size == curve.x.size == 2000
    assert curve.y.numbers.max() == ANGLE.max()


def test_limits_bands_spans_and_bars():
    def draw(axes, below):
        axes.plot(TIME, ANGLE)
        axes.axhline(0.5, color="#ff0000", linestyle=(0, (5, 3)))
        axes.axvline(7.0)
        axes.axvspan(1.0, 2.0, color="#00ff00", alpha=0.25)
        axes.axhspan(-0.5, 0.5)
        axes.fill_between(TIME[:3], 0.0, 1.0)
        axes.annotate("here", (3.0, 0.25), xytext=(4, -5), textcoords="offset points")
        axes.text(0.5, 0.9, "above", transform=axes.transAxes)
        below.set_xlabel("time, s")
        below.plot([5.0, 7.0], [0.0, 0.0])
        below.barh([0], [2.0], left=[5.0])

    chart, bars = charts_of(draw, count=2)
    assert [(rule.at, bool(rule.upright), len(rule.dashes)) for rule in chart.rules] == [
        (0.5, False, 2),
        (7.0, True, 0),
    ]
    fill, span, edge, band = chart.areas
    assert (edge.colour, edge.stroke > 0.0, span.stroke) == ("#00ff00", True, 0.0)
    assert (sorted(set(span.x)), span.of_axes, span.opacity, span.colour) == (
        [1.0, 2.0],
        (False, True),
        0.25,
        "#00ff00",
    )
    assert (sorted(set(band.y)), band.of_axes) == ([-0.5, 0.5], (True, False))
    assert (set(fill.y), fill.of_axes) == ({0.0, 1.0}, (False, False))
    assert [(note.text, note.at, note.of_axes, note.offset) for note in chart.notes] == [
        ("here", (3.0, 0.25), (False, False), (4.0, -5.0)),
        ("above", (0.5, 0.9), (True, True), (0.0, 0.0)),
    ]
    assert chart.x.label == bars.x.label == "time, s"
    (bar,) = bars.areas
    assert (bar.x.min(), bar.x.max()) == (5.0, 7.0)
    assert chart.box[1] + chart.box[3] < bars.box[1]


def test_a_path_knows_its_times():
    (chart,) = charts_of(lambda axes: plot_path(axes, np.cos(TIME), ANGLE, "ship.position", TIME))
    (curve,) = chart.curves
    assert np.array_equal(curve.time, TIME)
    assert np.array_equal(curve.x, np.cos(TIME))


def draw_ticks(axes):
    axes.plot([0.0, 1.0], [0.0, 10000.0])
    axes.xaxis.set_major_locator(FixedLocator([0.0, 0.5, 1.0]))


def draw_names(axes):
    axes.plot([0.0, 1.0], [0.0, 1.0])
    label_lanes(axes, ["false", "true"])


def test_names_on_ticks_and_an_inverted_axis():
    (chart,) = charts_of(draw_names)
    assert chart.y.ticks == [(0.0, "false"), (1.0, "true")]
    assert chart.y.named
    assert chart.y.ends[0] > chart.y.ends[1]
    assert not chart.y.grid
    assert not chart.y.marked
    assert not chart.x.named


def test_ticks_are_those_of_the_picture():
    (chart,) = charts_of(draw_ticks)
    assert chart.x.ticks == [(0.0, "0.0"), (0.5, "0.5"), (1.0, "1.0")]
    assert chart.y.ticks[-1] == (10000.0, "10000")
    (chart,) = charts_of(lambda axes: (axes.plot([1e-3, 1e4], [0.0, 1.0]), log_ticks_x(axes)))
    assert {round(np.log10(at)): text for at, text in chart.x.ticks} == {-2: "0.01", 0: "1", 2: "100", 4: "10⁴"}
    assert chart.x.logarithmic


def test_stairs_are_steps():
    (chart,) = charts_of(lambda axes: axes.stairs([1.0, 0.0, 1.0], [0.0, 2.0, 5.0, 6.0], baseline=None))
    (curve,) = chart.curves
    assert curve.steps
    assert (list(curve.x), list(curve.y)) == ([0.0, 2.0, 5.0, 6.0], [1.0, 0.0, 1.0, 1.0])


def test_steps_before_their_points_are_steps_after_them():
    (chart,) = charts_of(lambda axes: axes.step([0.0, 1.0, 2.0], [5.0, 6.0, 7.0], where="pre"))
    (curve,) = chart.curves
    assert curve.steps
    assert (list(curve.x), list(curve.y)) == ([0.0, 0.0, 1.0, 2.0], [5.0, 6.0, 7.0, 7.0])


def test_every_point_of_an_area_is_there():
    """Points that are nearer to each other than 1 in units of the data."""
    x = np.linspace(0.0, 1e-3, 200)
    (chart,) = charts_of(lambda axes: (axes.plot(x, x), axes.fill_between(x, x, 2.0 * x + 1e-6)))
    (area,) = chart.areas
    assert set(x) <= set(area.x)


def test_a_label_across_data_and_axes():
    def draw(axes):
        axes.plot([0.0, 1.0], [0.0, 1.0])
        axes.annotate("97 %", (1.02, 0.5), xycoords=("axes fraction", "data"), fontsize=8.0)

    (chart,) = charts_of(draw)
    (note,) = chart.notes
    assert (note.at, note.of_axes, note.size) == ((1.02, 0.5), (True, False), 8.0)


def test_marks_have_their_shapes_and_colours():
    def draw(axes):
        axes.plot([0.5], [0.5], "D", color="#0072b2", markeredgecolor="white", markersize=5, alpha=0.5, clip_on=False)
        axes.plot([0.5], [0.5], "x", color="#d55e00")
        axes.plot([0.5], [0.5], "o", markerfacecolor="none")

    (chart,) = charts_of(draw)
    diamond, cross, ring = chart.curves
    assert (diamond.opacity, diamond.beyond) == (0.5, True)
    assert (diamond.marker.fill, diamond.marker.edge, diamond.marker.size) == ("#0072b2", "#ffffff", 5.0)
    corners = np.array(diamond.marker.outline[0]).reshape(-1, 2)
    assert np.allclose(np.abs(corners).sum(axis=1), np.sqrt(0.5), atol=1e-3)
    assert (cross.marker.fill, len(cross.marker.outline)) == ("", 2)
    assert (ring.marker.outline, ring.marker.fill) == ([], "")


def draw_arrow(axes):
    axes.plot([0.0, 1.0], [0.0, 1.0])
    axes.annotate("", (0.2, 0.2), (0.5, 0.5), arrowprops={"arrowstyle": "->"})


UNSTATED = {
    "scattered dots": lambda axes: axes.scatter(TIME, ANGLE),
    "image": lambda axes: axes.imshow(np.eye(3)),
    "arrows": lambda axes: (axes.plot(TIME, ANGLE), axes.quiver([0.0], [0.0], [1.0], [1.0])),
    "arrow of a text": draw_arrow,
    "hatches": lambda axes: (axes.plot(TIME, ANGLE), axes.add_patch(Rectangle((0, 0), 1, 1, hatch="//"))),
    "formatter": lambda axes: (axes.plot(TIME, ANGLE), axes.yaxis.set_major_formatter(lambda at, _: f"{at} m")),
    "offset of ticks": lambda axes: axes.plot(TIME, 1e9 + ANGLE),
    "minor ticks": lambda axes: (axes.plot([1.0, 1e3], [0.0, 1.0]), axes.set_xscale("log")),
    "abscissa to the left": lambda axes: (axes.plot(TIME, ANGLE), axes.invert_xaxis()),
    "transform": lambda axes: axes.plot([0.0, 1.0], [0.0, 1.0], transform=axes.transAxes),
    "turned text": lambda axes: (axes.plot(TIME, ANGLE), axes.text(1.0, 0.0, "up", rotation=90)),
    "second axis": lambda axes: (axes.plot(TIME, ANGLE), axes.secondary_xaxis("top")),
    "edge at the top": lambda axes: (axes.plot(TIME, ANGLE), axes.spines["top"].set_visible(True)),
    "bars alone": lambda axes: axes.bar([0.0, 1.0], [1.0, 2.0]),
}


@pytest.mark.parametrize("draw", UNSTATED.values(), ids=UNSTATED)
def test_what_is_not_stated_in_full_remains_a_picture(draw):
    charts = charts_of(lambda one, other: (one.plot(TIME, ANGLE), draw(other)), count=2)
    assert [chart.picture for chart in charts] == [True, True]
    assert not any(chart.curves or chart.areas for chart in charts)
