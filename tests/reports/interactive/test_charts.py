"""Figures as numbers: what matplotlib drew, with its units, marks and ends.

Truth: what was handed to matplotlib.
"""

import numpy as np
import pytest

from perilune.analysis.reports.common.lines import plot_path, plot_quantity
from perilune.analysis.reports.common.style import house_style, new_figure
from perilune.analysis.reports.common.svg import inline_svg

TIME = np.linspace(0.0, 10.0, 3001)
ANGLE = np.sin(TIME)


def charts_of(draw, *, count=1, reduced=False):
    with house_style():
        figure = new_figure(2.0 * count, 4.0)
        draw(*np.atleast_1d(figure.subplots(count, 1, sharex=True)))
        return inline_svg(figure, "x", "a figure", reduced=reduced).charts


def test_a_line_has_every_row_in_si():
    def draw(axes):
        plot_quantity(axes, TIME, ANGLE, "ship.angles[2]", "rad", 1)
        axes.set_xlim(2.0, 8.0)
        axes.set_title("deg", loc="left")
        axes.set_xlabel("time, s")

    (chart,) = charts_of(draw)
    (curve,) = chart.curves
    assert np.array_equal(curve.x, TIME)
    assert np.array_equal(curve.y, ANGLE)
    assert (curve.factor, curve.unit, curve.name) == (pytest.approx(180.0 / np.pi), "deg", "ship.angles[2]")
    assert (chart.x.label, chart.x.ends, chart.title) == ("time, s", (2.0, 8.0), "deg")
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
        below.barh([0], [2.0], left=[5.0])

    chart, bars = charts_of(draw, count=2)
    assert [(rule.at, bool(rule.upright), len(rule.dashes)) for rule in chart.rules] == [
        (0.5, False, 2),
        (7.0, True, 0),
    ]
    span, band, fill = chart.areas
    assert (sorted(set(span.x)), span.of_axes, span.opacity, span.colour) == (
        [1.0, 2.0],
        (False, True),
        0.25,
        "#00ff00",
    )
    assert (sorted(set(band.y)), band.of_axes) == ([-0.5, 0.5], (True, False))
    assert (set(fill.y), fill.of_axes) == ({0.0, 1.0}, (False, False))
    assert [(note.text, note.at, note.of_axes, note.offset) for note in chart.notes] == [
        ("here", (3.0, 0.25), False, (4.0, -5.0)),
        ("above", (0.5, 0.9), True, (0.0, 0.0)),
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


def test_what_has_no_form_here_remains_a_picture():
    charts = charts_of(lambda one, other: (one.scatter(TIME, ANGLE), other.imshow(np.eye(3))), count=2)
    assert charts == [None, None]
