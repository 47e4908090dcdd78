"""analysis.reports.stability_page: the numbers on the page and in its figures, and what it says where some are missing.

Truth: python-control's margins and responses of the samples' systems; what is put into a report by hand.
"""

import math
import re
import warnings
from dataclasses import replace

import control
import numpy as np
import pytest
from matplotlib.figure import Figure
from reports.checks import assert_self_contained, data_values, parse, text_of
from stability.report_samples import (
    DIGEST,
    attitude,
    replace_loops,
    sample_report,
    translation,
)

from analysis.reports.quantities import NONE
from analysis.reports.stability_frequency import beside, draw_bode, draw_sensitivity, phase_of
from analysis.reports.stability_nyquist import draw_harmonic_balance, draw_nichols, draw_nyquist
from analysis.reports.stability_page import write_stability_page
from analysis.reports.stability_parts import modes, quantile
from analysis.reports.stability_poles import thinned
from analysis.reports.stability_words import complex_number, in_decibels, plain
from analysis.stability.results import Classical, Curve, Mode, Requirement, StabilityReport


def write(report, page):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        write_stability_page(report, page)
    return page.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def report():
    return sample_report()


@pytest.fixture(scope="module")
def page(report, tmp_path_factory):
    return write(report, tmp_path_factory.mktemp("stability") / "page.html")


def rows_under(page, heading):
    """Cells of the tables in the section with a heading of the second level."""
    (section,) = (part for part in parse(page).xpath("//section") if part.xpath("h2")[0].text == heading)
    return [[cell.text_content() for cell in row.xpath("td")] for row in section.xpath(".//tbody/tr")]


def assert_no_infinities(page):
    assert not re.findall(r"\b(?:nan|inf|infinity|∞|not a number)\b", text_of(page), re.IGNORECASE)
    assert not {value for value in data_values(page) if "nan" in value or "inf" in value}
    assert "np.float" not in page


def test_page_stands_alone_and_has_no_infinities(page):
    assert_self_contained(page)
    assert_no_infinities(page)
    for figure in parse(page).xpath("//*[@class='figure']"):
        assert figure.get("role") == "img"
        assert len(figure.get("aria-label")) > 20
    for table in parse(page).xpath("//table"):
        assert table.xpath("thead/tr/th[@scope='col']")


def test_same_report_same_bytes(report, page, tmp_path):
    assert write(replace(report, seconds=99.0), tmp_path / "again.html") == page  # the time it took is not on it


def test_verdict_comes_first_with_every_requirement(report, page):
    headings = [element.text for element in parse(page).xpath("//h2")]
    assert headings == ["Verdict", "Margins", "Operating points", "Loops", "Over parameters", "What was studied"]
    rows = rows_under(page, "Verdict")
    wanted = [(loop.name, "nominal", item) for loop in report.loops for item in loop.requirements]
    wanted += [(report.loops[1].name, "dispersed", item) for item in report.loops[1].dispersion.requirements]
    wanted += [(report.joint[0].name, "channels at once", item) for item in report.joint[0].requirements]
    words = {True: "✓ pass", False: "✗ fail", None: f"{NONE} not applicable"}

    def shown(value, unit):
        return NONE if value is None else f"{value:.4g} {unit}".removesuffix(" 1")

    for name, scope, item in wanted:
        values = shown(item.value, item.unit), shown(item.limit, item.unit)
        expected = [name, scope, item.quantity, *values, words[item.passed], item.note]
        assert expected in [[row[0], *row[2:]] for row in rows], item
    failing = [item for _, _, item in wanted if item.passed is False]
    assert failing
    assert len(rows) == len(wanted) + len(failing)  # what fails is listed once more on top
    assert text_of(page).count(f"{len(wanted)} requirements: ") == 1


def test_margins_are_those_of_python_control(page):
    for system, name in ((attitude(), "attitude at hold"), (translation(), "translation at far")):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            gain, phase, _, at_gain, at_phase, _ = control.stability_margins(system)
        (row,) = (row for row in rows_under(page, "Margins") if row[0] == name)
        assert float(row[2].removesuffix(" up")) == pytest.approx(20.0 * math.log10(gain), rel=1e-3)
        assert float(row[3]) == pytest.approx(phase, rel=1e-3)
        delay = math.radians(phase) / at_phase
        assert float(row[4]) == pytest.approx(delay, rel=1e-3)
        assert float(row[5]) == pytest.approx(delay / system.dt, rel=1e-3)
        assert repr(float(gain)) in data_values(page)  # the exact factor
        exact = np.array([float(value) for value in data_values(page) if re.fullmatch(r"-?[\d.]+(e-?\d+)?", value)])
        assert np.min(np.abs(exact - at_gain)) < 1e-9


def test_what_is_not_applicable_is_said_with_its_reason(report, page):
    text = text_of(page)
    for loop in report.loops:
        for part, reason in loop.not_applicable.items():
            assert f"{part} is not applicable: {reason}" in text
        for item in loop.requirements:
            assert item.note in text
    assert "none (no crossing)" in text
    assert "not counted" in text
    assert "without limit" in text
    assert "does not change" in text
    assert "Not part of this study for attitude at hold: dispersion, amplitude sweep." in text
    assert "no lasting oscillation" in text


def test_worst_case_can_be_flown_again(report, page):
    found = report.loops[1].dispersion
    assert found.replay in text_of(page)
    assert f"trial {found.worst}, the worst" in text_of(page)
    assert repr(float(np.min(found.disk_margin))) in data_values(page)
    assert repr(float(np.quantile(np.abs(found.phase_margin), 0.5, method="inverted_cdf"))) in data_values(page)


def test_provenance(report, page):
    text = text_of(page)
    for word in (DIGEST, DIGEST[::-1], "plant.inertia[39]", "0.1.0", control.__version__, "gain_margin_db = 6"):
        assert word in text
    assert "500.3333333" in text


def test_text_of_others_is_escaped(report, tmp_path):
    nasty = "<b>$x_1$ & 'y'</b>"
    loop = report.loops[2]
    requirement = Requirement(nasty, 1.0, 2.0, nasty, False, nasty)
    strange = replace(
        loop, name=nasty, loop=nasty, point=nasty, cut=nasty, sign=nasty, closed=(nasty,),
        not_applicable={nasty: nasty}, requirements=(requirement,), nonlinearities=(),
    )  # fmt: skip
    point = replace(
        report.points[0], name=nasty, phase=nasty, settings={nasty: nasty}, trim=((nasty, 1.0, 2.0, nasty),)
    )
    joint = replace(report.joint[0], name=nasty, channels=(nasty,))
    sweep = replace(report.sweeps[0], name=nasty, parameter=nasty, crossings={nasty: 2.0})
    provenance = {nasty: nasty, "parameters": {nasty: nasty}, "fmus": {nasty: {"fmu": nasty, "sha256": nasty}}}
    page = write(
        StabilityReport(nasty, provenance, {nasty: 1.0}, (point,), (strange,), (joint,), (sweep,), (), 0.0),
        tmp_path / "page.html",
    )
    assert_self_contained(page)
    assert "<b>$" not in page
    assert text_of(page).count(nasty) > 20


def extreme(report):
    """No crossing, no limit, nothing known; an unstable loop; poles at zero; all trials without margins."""
    loop, dispersed = report.loops[0], report.loops[1]
    nothing = Classical((), (), math.inf, math.nan, None)
    robust = replace(loop.robust, disk_margin=2.5, disk_gain=math.inf, disk_phase=math.inf, complementary_peak=0.0)
    deadbeat = Mode(0j, complex(-math.inf, 0.0), math.nan, math.inf, "neither", 0.0, 0.0)
    free = replace(
        loop, name="free", classical=nothing, robust=robust, modes=(deadbeat,), poles_z=np.array([0j, 1.3]), step=None,
        requirements=(Requirement("gain margin", math.inf, 6.0, "dB", True), Requirement("x", None, 1.0, "1", True)),
        nonlinearities=(), sampling=(), stable=False,
    )  # fmt: skip
    found = dispersed.dispersion
    none = np.full(found.trials, np.nan)
    lost = replace(found, gain_margin=none, phase_margin=none, stable=np.zeros(found.trials, dtype=bool))
    some = replace(found, stable=np.arange(found.trials) % 3 > 0, poles=found.poles * 1.1)
    start = replace(loop.classical.gain[0], value=0.9, frequency=0.0)  # L crosses the ray at its start
    zero = replace(loop.classical, gain=(*loop.classical.gain, start))
    bare = replace(
        loop, name="bare", classical=zero, curve=Curve(np.array([0.1, 1.0]), np.array([1.0 + 0j, 0.5 - 0.5j])),
        route_a=None, route_b=None, agreement=None, modes=(), poles_z=np.zeros(0), structure=None, step=None,
        nonlinearities=(), sampling=(), requirements=(),
    )  # fmt: skip
    sweep = replace(report.sweeps[0], loop="nobody", gain_margin=np.full(25, np.nan), crossings={"limit": math.nan})
    point = replace(report.points[0], drift=None, holds=None)
    loops = (
        free,
        replace(dispersed, name="lost", dispersion=lost),
        replace(dispersed, name="s", dispersion=some),
        bare,
    )
    return StabilityReport("x", {"faults": [], "seed": None}, {}, (point,), loops, (), (sweep,), (), 0.0)


def test_extremes(report, tmp_path):
    page = write(extreme(report), tmp_path / "page.html")
    assert_self_contained(page)
    assert_no_infinities(page)
    text = text_of(page)
    assert "0 of 80 trials are stable" in text
    assert "The closed loop is unstable: its crossings are not margins." in text
    assert "The study names no file." in text


def test_empty_study(tmp_path):
    page = write(StabilityReport("x", {}, {}, (), (), (), (), (), 0.0), tmp_path / "page.html")
    assert_self_contained(page)
    for words in (f"{NONE} not applicable", "No requirement is set", "The study has no loop.", "No operating point."):
        assert words in text_of(page)


def test_summary_leads_to_every_loop(report, page):
    tree = parse(page)
    cards = tree.xpath("//article[@class='loop']")
    assert len(cards) == len(report.loops)
    assert {link.get("href")[1:] for link in tree.xpath("//table//a")} == {card.get("id") for card in cards}
    assert len(page) < 250_000 * len(cards)  # ten loops stay a few megabytes


def test_few_and_failing_loops_are_open(report, page, tmp_path):
    def opened(page):
        return [bool(card.xpath("details[@open]")) for card in parse(page).xpath("//article")]

    assert opened(page) == [loop.verdict == "fail" for loop in report.loops] == [False, True, False]
    assert opened(write(replace_loops(report, report.loops[:1]), tmp_path / "one.html")) == [True]


def test_many_modes_fold_away(report):
    found = tuple(Mode(complex(0.5 + k / 100), complex(-0.1), 1.0, 0.1, "loop", 1.0, 1.0) for k in range(40))
    table = modes(replace(report.loops[0], modes=found)).table
    assert len(table.rows) == 40
    assert table.is_long
    assert not modes(replace(report.loops[0], modes=found[:30])).table.is_long


def axes_pair():
    return Figure().subplots(2, 1)


def test_bode_diagram_is_python_controls(report):
    loop, system = report.loops[0], attitude()
    above, below = axes_pair()
    draw_bode(loop, above, below)
    response = control.frequency_response(system, loop.curve.frequency)
    x, y = above.lines[0].get_data()
    np.testing.assert_allclose(y[:-1], 20.0 * np.log10(response.magnitude[:-1]), atol=1e-6)  # the last one is a zero
    np.testing.assert_allclose(x, loop.curve.frequency)
    difference = below.lines[0].get_ydata() - np.degrees(np.unwrap(response.phase))
    np.testing.assert_allclose(difference[:-1], 360.0 * np.round(difference[0] / 360.0), atol=1e-6)
    margin = loop.classical.phase_margin
    at = np.interp(margin.frequency, x, below.lines[0].get_ydata())
    assert at == pytest.approx(-180.0 + math.degrees(margin.value), abs=0.02)


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
        np.testing.assert_allclose(radius, np.min(np.abs(1.0 + loop.curve.value)), rtol=1e-12)


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
    drawn = 10.0 ** (curve.get_ydata() / 20.0) * np.exp(1j * np.radians(curve.get_xdata()))
    np.testing.assert_allclose(drawn[np.isfinite(drawn)], loop.curve.value, rtol=1e-9, atol=2e-12)


def test_sensitivities_meet_their_peaks(report):
    loop = report.loops[0]
    axes = Figure().subplots()
    draw_sensitivity(loop, axes, 0.5)
    closed = control.feedback(1, attitude())
    peak = np.max(np.abs(closed(np.exp(1j * loop.curve.frequency * 0.25))))
    assert np.max(axes.lines[0].get_ydata()) == pytest.approx(20.0 * math.log10(peak), abs=1e-6)
    assert any(np.allclose(line.get_ydata(), 20.0 * math.log10(2.0)) for line in axes.lines)  # limit 0.5 on 1/|S|


def test_harmonic_balance_meets_where_the_gain_margin_is(report):
    loop = report.loops[0]
    axes = Figure().subplots()
    draw_harmonic_balance(loop, loop.nonlinearities[0], axes)
    marks = [line for line in axes.lines if line.get_marker() == "o"]
    assert len(marks) == 2
    for mark in marks:
        assert mark.get_xdata()[0] == pytest.approx(-1.0 / loop.classical.gain_margin.value, rel=1e-2)


def test_quantiles_count_trials_without_a_crossing_as_without_limit():
    values, stable = np.array([np.nan, 3.0, 1.0, 2.0]), np.array([True, True, False, True])
    assert quantile(values, stable, 0.0) == 2.0
    assert quantile(values, stable, 1.0) == math.inf
    assert math.isnan(quantile(values, np.zeros(4, dtype=bool), 0.5))


def test_clouds_are_thinned_without_losing_their_outline():
    generator = np.random.default_rng(1)
    poles = generator.normal(size=200_000) * 0.2 + 1j * generator.normal(size=200_000) * 0.2
    kept = thinned(poles, 1.12)
    assert kept.size < 5000
    assert set(kept) <= set(poles)
    assert np.max(kept.real) == pytest.approx(np.max(poles.real), abs=0.05)


def test_words():
    assert in_decibels(2.0) == '<data value="2.0">6.021</data>'
    assert in_decibels(math.inf) == "<span>none (no crossing)</span>"
    assert in_decibels(0.0) == "<span>none (no crossing)</span>"
    assert plain(np.float64(0.5)) == '<data value="0.5">0.5</data>'
    assert plain(math.nan) == f"<span>{NONE}</span>"
    assert "0.5 ± 0.25 j" in complex_number(0.5 + 0.25j)


def test_lower_half_of_pairs_is_left_out(report, page):
    poles = control.feedback(attitude(), 1).poles()
    assert np.any(poles.imag > 0.0)
    assert len(modes(report.loops[0]).table.rows) == np.sum(poles.imag >= 0.0) + 1  # and the filter's
    assert not [value for value in data_values(page) if re.fullmatch(r"0\.\d+-0\.\d+j", value)]
