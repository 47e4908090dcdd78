"""The figures of a stability study, as they are drawn and as its page has them.

Truth: python-control's margins and responses of the tiny systems that were studied (tests/support/loops/studies.py).
"""

import math
import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from matplotlib.figure import Figure

from perilune.analysis.reports.common.panels import PANEL_WIDTH
from perilune.analysis.reports.common.quantities import NONE
from perilune.analysis.reports.common.style import FAINT, VERMILION, house_style, new_figure
from perilune.analysis.reports.stability.bode import draw_bode
from perilune.analysis.reports.stability.figures import HEIGHT
from perilune.analysis.reports.stability.frequency import beside, draw_sensitivity, limits_of, phase_of
from perilune.analysis.reports.stability.nyquist import draw_harmonic_balance, draw_nichols, draw_nyquist
from perilune.analysis.reports.stability.parts import modes
from perilune.analysis.reports.stability.poles import draw_poles, thin
from perilune.analysis.reports.stability.sets import draw_histogram, draw_sweep
from perilune.analysis.reports.stability.words import complex_number, in_decibels, numeral
from perilune.analysis.stability.loops.margin_values import Quantity
from perilune.analysis.stability.loops.readings import Curve
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
    assert table.is_long
    assert not modes(replace(report.loops[0], modes=actual[:30])).table.is_long


def axes_pair():
    return Figure().subplots(2, 1)


def test_figures_show_what_is_unstable(studies):
    """The hatched bar of a histogram counts the unstable trials; the hatched band of a sweep begins where they do."""
    (loop,) = studies.late.loops
    axes = Figure().subplots()
    draw_histogram(loop.dispersion.sizes(Quantity.GAIN), axes, "gain margin, dB", 3.0, loop.dispersion.worst)
    (bar,) = (patch for patch in axes.patches if patch.get_hatch())
    assert bar.get_height() == 3
    assert sum(patch.get_height() for patch in axes.patches if not patch.get_hatch()) == TRIALS - 3
    assert any(np.allclose(line.get_xdata(), 3.0) for line in axes.lines if len(line.get_xdata()) == 2)
    above, below = axes_pair()
    (sweep,) = studies.late.sweeps
    draw_sweep(sweep, limits_of(loop), above, below)
    for axes in (above, below):
        (band,) = axes.patches
        assert band.get_x() == pytest.approx(end_of_stability(), rel=1e-3)
        assert band.get_x() + band.get_width() == pytest.approx(2.5)


def test_bode_diagram_is_python_controls(report):
    loop = report.loops[0]
    above, below = axes_pair()
    draw_bode(loop, above, below)
    response = response_of(LATE.loop)(loop.curve.frequency)
    x, y = above.lines[0].get_data()
    np.testing.assert_allclose(y[:-1], 20.0 * np.log10(abs(response[:-1])), atol=1e-3)  # the last one is a zero
    np.testing.assert_allclose(x, loop.curve.frequency)
    difference = below.lines[0].get_ydata() - np.degrees(np.unwrap(np.angle(response)))
    visible = abs(response) > 1e-3  # below, the differences of flights lose the phase
    np.testing.assert_allclose(difference[visible], 360.0 * np.round(difference[0] / 360.0), atol=1e-4)
    margin = loop.classical.phase_margin
    at = np.interp(margin.frequency, x, below.lines[0].get_ydata())
    assert at == pytest.approx(-180.0 + math.degrees(margin.value), abs=0.02)


def test_bode_diagram_marks_margins_crossovers_and_what_is_required(report):
    """Truth: python-control's crossings; 6 dB and 30 deg are what the study requires."""
    loop = report.loops[0]
    axes = axes_pair()
    draw_bode(loop, *axes)
    gain, phase, at = crossings(LATE.loop)
    nearest = np.argmin(abs(phase))
    crossover, margin = at[nearest], math.degrees(phase[nearest])
    decisive = loop.classical.gain_margin
    assert decisive.value == pytest.approx(gain[np.argmin(abs(np.log(gain)))], rel=1e-4)
    for one in axes:
        dotted = {line.get_xdata()[0] for line in one.lines if line.get_color() == FAINT}
        assert sorted(dotted) == pytest.approx(sorted([crossover, decisive.frequency]), rel=1e-4)
    for one, required in zip(axes, (-6.0, -150.0), strict=True):
        (dashed,) = (line for line in one.lines if line.get_linestyle() == "--" and line.get_color() == VERMILION)
        low, high = dashed.get_xdata()
        assert low < (decisive.frequency if one is axes[0] else crossover) < high
        height = dashed.get_ydata()
        assert (height - required) / 360.0 == pytest.approx(np.round((height - required) / 360.0), abs=1e-3)
    titles = [one.get_title("right") for one in axes]
    assert titles[0].startswith(f"upper gain margin {DECIBEL * np.log(decisive.value):.3g} dB at ")
    assert titles[1].startswith(f"phase margin {margin:.3g}° at {crossover:.3g}")


def test_phase_of_measured_points_is_on_the_curves_branch():
    curve = Curve(np.array([1.0, 2.0, 3.0, 4.0]), np.exp(-1j * np.array([3.0, 5.5, 8.0, 10.0])))
    phase = phase_of(curve, None)
    assert -360.0 < phase[2] <= 0.0
    np.testing.assert_allclose(beside(curve, phase, curve), phase)


def test_nyquist_circle_touches_the_curve(report):
    for loop in report.loops:
        axes = Figure().subplots()
        draw_nyquist(loop, axes)
        (circle,) = (line for line in axes.lines if line.get_color() == "#009E73")
        radius = np.abs(circle.get_xdata() + 1.0 + 1j * circle.get_ydata())
        np.testing.assert_allclose(radius, np.min(np.abs(1.0 + loop.curve.value)), rtol=1e-4)  # refined between points


def test_nichols_zone_is_made_of_the_limits(report):
    loop = report.loops[0]
    axes = Figure().subplots()
    draw_nichols(loop, axes)
    (zone,) = axes.patches
    assert {tuple(corner) for corner in zone.get_xy()} == {(-210, 0), (-150, 0), (-180, 6), (-180, -6)}
    oval = axes.lines[0]
    points = 10.0 ** (oval.get_ydata() / 20.0) * np.exp(1j * np.radians(oval.get_xdata()))
    np.testing.assert_allclose(np.abs(1.0 + points), 0.5)
    curve = axes.lines[1]
    plotted = 10.0 ** (curve.get_ydata() / 20.0) * np.exp(1j * np.radians(curve.get_xdata()))
    np.testing.assert_allclose(plotted[np.isfinite(plotted)], loop.curve.value, rtol=1e-9, atol=2e-12)


def test_sensitivities_meet_their_peaks(report):
    loop = report.loops[0]
    axes = Figure().subplots()
    draw_sensitivity(loop, axes, 0.5)
    peak = np.max(np.abs(1.0 / (1.0 + response_of(LATE.loop)(loop.curve.frequency))))
    assert np.max(axes.lines[0].get_ydata()) == pytest.approx(20.0 * math.log10(peak), abs=1e-6)
    assert any(np.allclose(line.get_ydata(), 20.0 * math.log10(2.0)) for line in axes.lines)  # limit 0.5 on 1/|S|


def test_harmonic_balance_meets_where_the_gain_margin_is(studies):
    (loop,) = studies.relay.loops
    axes = Figure().subplots()
    draw_harmonic_balance(loop, loop.nonlinearities[0], axes)
    marks = [line for line in axes.lines if line.get_marker() == "o"]
    assert len(marks) == 2
    for mark in marks:
        assert mark.get_xdata()[0] == pytest.approx(-1.0 / loop.classical.gain_margin.value, rel=1e-2)


@pytest.mark.parametrize("distance", [0.3, 0.05, 1e-3, 1e-5, 1e-7])
def test_ticks_near_1_do_not_touch(report, distance):
    """The labels have as many decimals as the distance needs; a panel of the page has room for two at least."""
    poles = 1.0 - distance * np.array([1.0, 0.4 + 0.3j, 0.4 - 0.3j])
    loop = replace(report.loops[0], modes=(), poles_z=poles)
    with house_style():
        figure = new_figure(HEIGHT, PANEL_WIDTH)
        axes = figure.subplots()
        draw_poles(loop, axes, near=True)
        figure.canvas.draw()
        low, high = axes.get_xlim()
        boxes = [
            text.get_window_extent()
            for at, text in zip(axes.get_xticks(), axes.get_xticklabels(), strict=True)
            if low <= at <= high
        ]
    assert len(boxes) >= 2
    assert all(one.x1 + 2.0 < other.x0 for one, other in pairwise(boxes))


def test_clouds_are_thinned_without_losing_their_outline():
    generator = np.random.default_rng(1)
    poles = generator.normal(size=200_000) * 0.2 + 1j * generator.normal(size=200_000) * 0.2
    retained = thin(poles, 1.12)
    assert retained.size < 5000
    assert set(retained) <= set(poles)
    assert np.max(retained.real) == pytest.approx(np.max(poles.real), abs=0.05)


def test_words():
    assert in_decibels(2.0) == '<data value="2.0">6.021</data>'
    assert in_decibels(math.inf) == "<span>none (no crossing)</span>"
    assert in_decibels(0.0) == "<span>none (no crossing)</span>"
    assert numeral(np.float64(0.5)) == '<data value="0.5">0.5</data>'
    assert numeral(math.nan) == f"<span>{NONE}</span>"
    assert "0.5 ± 0.25 j" in complex_number(0.5 + 0.25j)


def test_lower_half_of_pairs_is_left_out(report, page):
    poles = LATE.closed[abs(LATE.closed) > 1e-6]
    assert np.any(poles.imag > 1e-9)
    assert len(modes(report.loops[0]).table.rows) == np.sum(poles.imag > -1e-9)
    assert not [value for value in data_values(page) if re.fullmatch(r"0\.\d+-0\.\d+j", value)]
