"""Figures of a stability study, as drawn and as embedded in its page.

Truth: python-control's margins and responses of the tiny systems that were studied (tests/support/loops/studies.py).
"""

import math
import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from perilune.analysis.documents.chart.marks import SQUARE, hatch
from perilune.analysis.documents.chart.panel import POINTS, stack_panel
from perilune.analysis.documents.common.colours import BLUE, GREEN, VERMILION
from perilune.analysis.documents.common.panels import HALF_WIDTH, PANEL_WIDTH
from perilune.analysis.documents.common.quantities import NONE
from perilune.analysis.documents.font.text import text_width
from perilune.analysis.documents.interactive.measures import LABEL_SIZE
from perilune.analysis.documents.model import Fold
from perilune.analysis.documents.of.stability.charts.bode import bode_charts
from perilune.analysis.documents.of.stability.charts.frequency import (
    WHITE,
    limits_of,
    nearest_phase,
    phase_of,
    sensitivity_chart,
)
from perilune.analysis.documents.of.stability.charts.nyquist import balance_chart, nichols_chart, nyquist_chart
from perilune.analysis.documents.of.stability.charts.poles import thin
from perilune.analysis.documents.of.stability.charts.sets import margin_chart, sweep_charts
from perilune.analysis.documents.of.stability.figures import HEIGHT, loop_figures, overview_figures
from perilune.analysis.documents.of.stability.parts import modes
from perilune.analysis.documents.of.stability.study_cells import complex_number, fold_long, in_decibels, numeral
from perilune.analysis.documents.render.cell_markup import cell_markup
from perilune.analysis.stability.loops.margin_values import MarginQuantity
from perilune.analysis.stability.loops.readings import FrequencyResponse
from perilune.analysis.stability.results.responses import Mode
from tests.support.loops.exact_margins import crossings
from tests.support.loops.exact_systems import end_of_stability
from tests.support.loops.sampled_loops import response_of
from tests.support.loops.studies import LATE, TRIALS
from tests.support.pages.checks import data_values, parse

DECIBEL = 20.0 / np.log(10.0)


def test_summary_leads_to_every_loop(report, page):
    tree = parse(page)
    cards = tree.xpath("//article[@class='loop']")
    assert len(cards) == len(report.loops)
    assert {link.get("href")[1:] for link in tree.xpath("//table//a")} == {card.get("id") for card in cards}
    assert len(page) < 250_000 * len(cards)  # ten loops stay a few megabytes


def test_bode_and_nichols_of_each_loop_are_seen_at_first_sight(report, page):
    """Above what is folded away; a figure that is another loop's, too, stands with that one, under both names."""
    cards = parse(page).xpath("//article")
    captions = [card.xpath("./div[contains(@class, 'halves')]/figure/figcaption") for card in cards]
    for loop, actual in zip(report.loops, captions, strict=True):
        kinds = [caption.text_content().partition(":")[0].strip() for caption in actual]
        assert kinds == ["Bode", "Nichols"], loop.name
    assert not parse(page).xpath("//article//details[@open]")


def test_many_modes_fold_away(report):
    actual = tuple(Mode(complex(0.5 + k / 100), complex(-0.1), 1.0, 0.1, "loop", 1.0, 1.0) for k in range(40))
    table = modes(replace(report.loops[0], modes=actual)).table
    assert len(table.rows) == 40
    assert fold_long(table, "modes") == Fold("All 40 modes", [table])
    short = modes(replace(report.loops[0], modes=actual[:30])).table
    assert fold_long(short, "modes") is short


def bars(chart):
    """Return left and right end and height of the filled rectangles of a histogram, by colour."""
    filled = [area for area in chart.areas if not area.stroke]
    return {
        colour: [(area.x.min(), area.x.max(), area.y.max()) for area in filled if area.colour == colour.lower()]
        for colour in (BLUE, WHITE)
    }


def test_figures_show_what_is_unstable(studies):
    """The hatched bar of a histogram counts the unstable trials; the hatched band of a sweep begins where they do."""
    (loop,) = studies.late.loops
    chart = margin_chart(loop.dispersion, MarginQuantity.GAIN, 3.0)
    ((left, right, height),) = bars(chart)[WHITE]
    assert height == 3
    sizes = loop.dispersion.sizes(MarginQuantity.GAIN)
    for low, high, count in bars(chart)[BLUE]:
        assert count == np.sum((sizes >= low) & (sizes < high + 1e-9 * (high - low)))
    assert sum(count for _, _, count in bars(chart)[BLUE]) == TRIALS - 3
    assert right <= min(low for low, _, _ in bars(chart)[BLUE])
    ((limit,),) = ([rule.at for rule in chart.rules],)
    assert limit == 3.0
    (mark,) = chart.curves
    assert left < mark.x[0] < right  # the worst trial is unstable
    (sweep,) = studies.late.sweeps
    for chart in sweep_charts(sweep, limits_of(loop)):
        (band,) = (area for area in chart.areas if not area.stroke)
        assert band.of_axes == (False, True)
        assert band.x.min() == pytest.approx(end_of_stability(), rel=1e-3)
        assert band.x.max() == pytest.approx(2.5)


def test_hatches_lie_in_what_they_fill():
    """Hatches of a diamond and a rectangle: within their edges, parallel, and both ends on an edge."""
    diamond = np.array([-1.0, 0.0, 1.0, 0.0, -1.0]), np.array([0.0, 2.0, 0.0, -2.0, 0.0])
    strokes = hatch(*diamond, VERMILION, 1.0)
    np.testing.assert_allclose(np.abs(strokes.x) + np.abs(strokes.y) / 2.0, 1.0)
    square = hatch(*(4.0 * SQUARE.T + 1.0), VERMILION, 1.0)
    for area in (strokes, square):
        run, rise = area.x[1::2] - area.x[::2], area.y[1::2] - area.y[::2]
        np.testing.assert_allclose(rise / run, np.ptp(area.y) / np.ptp(area.x), rtol=0.5)
        assert run.size > 6
    on_edge = (
        np.isclose(square.x, 1.0) | np.isclose(square.x, 5.0) | np.isclose(square.y, 1.0) | np.isclose(square.y, 5.0)
    )
    assert np.all(on_edge)


def test_bode_diagram_is_python_controls(report):
    loop = report.loops[0]
    above, below = bode_charts(loop)
    response = response_of(LATE.loop)(loop.curve.frequency)
    gain, phase = above.curves[0], below.curves[0]
    np.testing.assert_allclose(gain.y[:-1], 20.0 * np.log10(abs(response[:-1])), atol=1e-3)  # the last one is a zero
    np.testing.assert_allclose(gain.x, loop.curve.frequency)
    difference = phase.y - np.degrees(np.unwrap(np.angle(response)))
    visible = abs(response) > 1e-3  # below, the differences of flights lose the phase
    np.testing.assert_allclose(difference[visible], 360.0 * np.round(difference[0] / 360.0), atol=1e-4)
    margin = loop.classical.phase_margin
    at = np.interp(margin.frequency, phase.x, phase.y)
    assert at == pytest.approx(-180.0 + math.degrees(margin.value), abs=0.02)


def test_bode_diagram_marks_margins_crossovers_and_what_is_required(report):
    """Truth: python-control's crossings; 6 dB and 30 deg are what the study requires."""
    loop = report.loops[0]
    both = bode_charts(loop)
    gain, phase, at = crossings(LATE.loop)
    nearest = np.argmin(abs(phase))
    crossover, margin = at[nearest], math.degrees(phase[nearest])
    decisive = loop.classical.gain_margin
    assert decisive.value == pytest.approx(gain[np.argmin(abs(np.log(gain)))], rel=1e-4)
    for chart in both:
        dotted = {rule.at for rule in chart.rules if rule.upright}
        assert sorted(dotted) == pytest.approx(sorted([crossover, decisive.frequency]), rel=1e-4)
    for chart, required in zip(both, (-6.0, -150.0), strict=True):
        (dashed,) = (curve for curve in chart.curves if curve.dashes)
        assert dashed.x[0] < (decisive.frequency if chart is both[0] else crossover) < dashed.x[1]
        turns = (dashed.y - required) / 360.0
        assert turns == pytest.approx(np.round(turns), abs=1e-3)
    assert both[0].title.startswith(f"gain, dB: upper margin {DECIBEL * np.log(decisive.value):.3g} dB at ")
    assert both[1].title.startswith(f"phase, deg: margin {margin:.3g}° at {crossover:.3g}")


@pytest.mark.parametrize("name", ["late", "pair", "relay", "weak", "unstable", "foreign"])
def test_titles_have_room(studies, name):
    """Above the axes of a panel, also at the longest numbers."""
    for loop in getattr(studies, name).loops:
        for chart in (*bode_charts(loop), nichols_chart(loop)):
            assert text_width(chart.title, LABEL_SIZE) < POINTS * HALF_WIDTH - 50.0


def test_phase_of_measured_points_is_on_the_curves_branch():
    curve = FrequencyResponse(np.array([1.0, 2.0, 3.0, 4.0]), np.exp(-1j * np.array([3.0, 5.5, 8.0, 10.0])))
    phase = phase_of(curve, None)
    assert -360.0 < phase[2] <= 0.0
    np.testing.assert_allclose(nearest_phase(curve, phase, curve), phase)


def test_nyquist_circle_touches_the_curve(report):
    for loop in report.loops:
        (circle,) = (curve for curve in nyquist_chart(loop).curves if curve.colour == GREEN.lower())
        radius = np.abs(circle.x + 1.0 + 1j * circle.y)
        np.testing.assert_allclose(radius, np.min(np.abs(1.0 + loop.curve.value)), rtol=1e-4)  # refined between points


def test_nyquist_arrow_points_to_higher_frequencies(report):
    """Its head lies on the curve and along the chord of the neighbours."""
    for loop in report.loops:
        response = loop.curve.value
        (head,) = (curve for curve in nyquist_chart(loop).curves if curve.marker and len(curve.marker.outline) == 1
                   and len(curve.marker.outline[0]) == 16)  # fmt: skip
        row = int(np.argmin(np.abs(response - (head.x[0] + 1j * head.y[0]))))
        chord = response[row + 1] - response[row - 1]
        tip = np.reshape(head.marker.outline[0], (-1, 2))[3]
        assert tip @ (chord.real, chord.imag) == pytest.approx(abs(chord), rel=1e-3)


def test_nichols_zone_is_made_of_the_limits(report):
    loop = report.loops[0]
    chart = nichols_chart(loop)
    (zone,) = (area for area in chart.areas if not area.stroke)
    assert set(zip(zone.x, zone.y, strict=True)) == {(-210, 0), (-150, 0), (-180, 6), (-180, -6)}
    oval, curve = chart.curves[:2]
    points = 10.0 ** (oval.y / 20.0) * np.exp(1j * np.radians(oval.x))
    np.testing.assert_allclose(np.abs(1.0 + points), 0.5)
    plotted = 10.0 ** (curve.y / 20.0) * np.exp(1j * np.radians(curve.x))
    np.testing.assert_allclose(plotted[np.isfinite(plotted)], loop.curve.value, rtol=1e-9, atol=2e-12)


def test_sensitivities_meet_their_peaks(report):
    loop = report.loops[0]
    chart = sensitivity_chart(loop)
    peak = np.max(np.abs(1.0 / (1.0 + response_of(LATE.loop)(loop.curve.frequency))))
    assert np.max(chart.curves[0].y) == pytest.approx(20.0 * math.log10(peak), abs=1e-6)
    assert any(np.isclose(rule.at, 20.0 * math.log10(2.0)) for rule in chart.rules)  # limit 0.5 on 1/|S|


def test_harmonic_balance_meets_where_the_gain_margin_is(studies):
    (loop,) = studies.relay.loops
    chart = balance_chart(loop, loop.nonlinearities[0])
    rings = [curve for curve in chart.curves if curve.marker and not curve.marker.outline]
    assert len(rings) == 2
    for ring in rings:
        assert ring.x[0] == pytest.approx(-1.0 / loop.classical.gain_margin.value, rel=1e-2)


@pytest.mark.parametrize("distance", [0.3, 0.05, 1e-3, 1e-5, 1e-7])
def test_ticks_near_1_do_not_touch(report, distance):
    """The labels have as many decimals as the distance needs; a panel of the page has room for two at least."""
    poles = 1.0 - distance * np.array([1.0, 0.4 + 0.3j, 0.4 - 0.3j])
    loop = replace(report.loops[0], modes=(), poles_z=poles)
    (chart,) = (figure.chart for figure in loop_figures(loop, "a") if figure.label == "Poles near z = 1")
    low, high = chart.x.ends
    width = POINTS * PANEL_WIDTH * chart.box[2]
    middles = [(at - low) / (high - low) * width for at, _ in chart.x.ticks]
    halves = [text_width(text, chart.x.size) / 2.0 for _, text in chart.x.ticks]
    assert len(middles) >= 2
    for (one, half), (other, more) in pairwise(zip(middles, halves, strict=True)):
        assert one + half + 2.0 < other - more


def test_planes_have_one_scale(report):
    """A unit is as long along the real axis as along the imaginary one; the texts of ticks lie within the panel."""
    for figure in loop_figures(report.loops[0], "a"):
        if figure.label not in ("Nyquist", "Poles", "Poles near z = 1"):
            continue
        chart = figure.chart
        across = POINTS * PANEL_WIDTH * chart.box[2] / (chart.x.ends[1] - chart.x.ends[0])
        up = POINTS * HEIGHT * chart.box[3] / (chart.y.ends[1] - chart.y.ends[0])
        assert across == pytest.approx(up, rel=1e-3)


def test_axes_of_a_bode_diagram_lie_above_each_other(report):
    (bode, _) = overview_figures(report.loops[0], "a")
    panel = stack_panel(bode.label, bode.name, bode.words, (bode.chart, bode.below), bode.height, HALF_WIDTH)
    gain, phase = (chart for drawing in panel.figure.drawings for chart in drawing.charts)
    assert (gain.box[0], gain.box[2]) == (phase.box[0], phase.box[2])
    assert gain.x.label == phase.x.label == "rad/s"
    assert gain.x.bare
    assert not phase.x.bare


def test_clouds_are_thinned_without_losing_their_outline():
    generator = np.random.default_rng(1)
    poles = generator.normal(size=200_000) * 0.2 + 1j * generator.normal(size=200_000) * 0.2
    retained = thin(poles, 1.12)
    assert retained.size < 5000
    assert set(retained) <= set(poles)
    assert np.max(retained.real) == pytest.approx(np.max(poles.real), abs=0.05)


def test_words():
    assert cell_markup(in_decibels(2.0)) == '<data value="2.0">6.021</data>'
    assert in_decibels(math.inf) == in_decibels(0.0) == "none (no crossing)"
    assert cell_markup(numeral(np.float64(0.5))) == '<data value="0.5">0.5</data>'
    assert numeral(math.nan) == NONE
    assert cell_markup(complex_number(0.5 + 0.25j)) == '<data value="0.5+0.25j">0.5 ± 0.25 j</data>'


def test_lower_half_of_pairs_is_left_out(report, page):
    poles = LATE.closed[abs(LATE.closed) > 1e-6]
    assert np.any(poles.imag > 1e-9)
    assert len(modes(report.loops[0]).table.rows) == np.sum(poles.imag > -1e-9)
    assert not [value for value in data_values(page) if re.fullmatch(r"0\.\d+-0\.\d+j", value)]
