"""Figures declared by a system, on the page of a run.

Truth: hand-written histories with closed-form results; for a simulation, its record, counted here row by row.
"""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from lxml import etree, html

import perilune
from perilune.analysis.documents.figures.declared import PulsesFigure, Signal, UnavailableFigure
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.documents.run_page import write_run_report
from tests.support.documents.subsections import figure_sections, joint_findings
from tests.support.pages.checks import assert_self_contained, data_values, parse, text_of
from tests.support.pages.own_samples import (
    ANGLES,
    DEG,
    DEGREE,
    ERROR,
    PULSES,
    RADIAN,
    ROWS,
    SECOND,
    TIME,
    angles,
    errors,
    flown,
    pulses,
    scalar,
    vector,
)
from tests.support.pages.samples import run_result


def page_of(result, tmp_path, *figures):
    path = tmp_path / "run.html"
    write_run_report(result, path, "Own", figures)
    return path.read_text(encoding="utf-8")


def plain(markup):
    return html.fromstring(f"<p>{markup}</p>").text_content()


def findings(*sections):
    return [plain(words) for section in sections for words in section.findings]


def notes(*sections):
    return [plain(words) for section in sections for words in section.notes]


def captions(section):
    return [panel.label for panel in section.panels]


def values_in(*markups):
    """Return exact numbers in the markup."""
    return {value for markup in markups for value in re.findall(r'<data value="([^"]*)"', markup)}


def texts(figure):
    """Return the texts in a figure."""
    return {text.strip() for text in etree.fromstring(figure).xpath("//*[local-name()='text']/text()")}


def bars(section):
    """Return time, foot and head of all bars by the colour of their sign, panel after panel; the pictures have as
    many."""
    actual = {}
    for panel in section.panels:
        (chart,) = panel.figure.charts
        for area in [each for each in chart.areas if each.stroke == 1.1]:
            path = f"//*[local-name()='path'][@stroke='{area.colour}'][@stroke-width='1.5125']/@d"
            (outline,) = etree.fromstring(panel.figure.svg).xpath(path)
            assert outline.count("M") == area.x.size // 2
            assert np.array_equal(area.x[::2], area.x[1::2])
            actual.setdefault(area.colour, []).append(np.stack([area.x[::2], area.y[::2], area.y[1::2]]))
    return actual


def count_of(section):
    return sum(lane.shape[1] for lanes in bars(section).values() for lane in lanes)


def one(figure, result):
    (section,) = figure_sections([figure], result)
    return section


def test_a_page_without_figures_has_no_such_section(tmp_path):
    headings = [
        [part.text for part in parse(page).xpath("//h2")]
        for page in (page_of(run_result(), tmp_path), page_of(run_result(rows=0, status="failed"), tmp_path, ANGLES))
    ]
    assert "States and commands" in headings[0]
    assert not {"ship", "Angles"} & {*headings[0], *headings[1]}


def test_they_are_on_the_page_above_the_time_histories(tmp_path):
    figures = (ANGLES, PULSES, ERROR, UnavailableFigure("Jets & more", ("lengths: no such signal",)))
    page = page_of(flown(angles=angles(), **pulses(), **errors()), tmp_path, *figures)
    assert_self_contained(page)
    headings = [part.text for part in parse(page).xpath("//h2 | //h3")]
    begin = headings.index("ship")
    assert headings[begin + 1 : begin + 6] == ["Angles", "Jets", "Error", "Jets & more", "Final values"]
    for words in ("Settling time 97.5 s: roll", "20 pulses", "within 1 sigma", "Not plotted: lengths: no such signal."):
        assert words in text_of(page)
    assert {"97.5", "40.5"} <= set(data_values(page))


def test_a_band_says_from_when_on():
    actual = one(ANGLES, flown(angles=angles()))
    assert findings(actual) == ["Settling time 97.5 s: roll 40.5 s, yaw 97.5 s."]
    assert notes(actual) == ["Green: \N{MINUS SIGN}0.5 to 0.5 deg for ship.angles; dotted line: settling time."]
    assert captions(actual) == ["Time history", "Zoom on tolerance band"]
    assert [label for _, label in actual.legend] == ["roll", "yaw"]
    assert {"20", "deg"} <= texts(actual.panels[0].figure.svg)
    close = texts(actual.panels[1].figure.svg)
    assert {"1", "\N{MINUS SIGN}1", "deg"} <= close
    assert "20" not in close


def test_a_band_that_is_left_again_or_never_is():
    values = angles()
    inside = one(ANGLES, flown(angles=0.0 * values))
    assert findings(inside) == ["Settled throughout: roll throughout, yaw throughout."]
    assert captions(inside) == ["Time history"]  # nothing to zoom in on
    values[0, -1] = np.nan
    assert findings(one(ANGLES, flown(angles=values))) == ["Not settled at the end: roll not at the end, yaw 97.5 s."]
    values[:, :] = np.nan
    assert findings(one(ANGLES, flown(angles=values))) == [
        "Not settled at the end: roll not at the end, yaw not at the end."
    ]


def test_what_is_subtracted_and_a_single_limit():
    """The rate is 0.002 rad/s less than about, -0.05 rad/s, to 20 s, and then equal to it."""
    rate = np.where(TIME < 20.0, -0.052, -0.05)
    signal = Signal("ship.rate", ("ship.rate",), RADIAN, 1.0, (0.05,))
    band = replace(ANGLES, signal=signal, low=-0.001, high=None, about=(-0.05,), labels=("",), name="within the band")
    actual = one(band, flown(rate=rate))
    assert findings(actual) == ["Settling time 20 s (within the band)."]
    (note,) = notes(actual)
    assert note.startswith(
        "Green: at least \N{MINUS SIGN}0.0573 deg for ship.rate minus (\N{MINUS SIGN}2.865) deg; dotted"
    )
    assert values_in(*actual.notes) == {"-0.001", "-0.05"}


def test_bands_of_one_name_are_told_together():
    first = replace(ANGLES, signal=scalar("ship.angles[1]", DEG, 1.0 / DEGREE), labels=("",))
    second = replace(first, signal=scalar("ship.angles[2]", DEG, 1.0 / DEGREE))
    result = flown(angles=angles())
    words = [plain(actual) for actual in joint_findings([first, second, replace(first, name="calm"), PULSES], result)]
    assert words == ["Both bands: settling time 97.5 s."]
    words = [plain(actual) for actual in joint_findings([first, first, first], result)]
    assert words == ["All 3 bands: settling time 40.5 s."]


def test_a_bar_for_each_pulse():
    """81 ticks: x fires up in 8 and down in 8 of them, y in the first 4; the last row's tick never acts."""
    actual = one(PULSES, flown(**pulses()))
    assert findings(actual) == ["Total 20 pulses, 2.4 s (x 16 pulses, 1.6 s; y 4 pulses, 0.8 s)."]
    plotted = bars(actual)
    (x_up, y_up), (x_down,) = plotted["#0072b2"], plotted["#d55e00"]
    for part, count, length in ((x_up, 8, 0.05), (x_down, 8, -0.15), (y_up, 4, 0.2)):
        assert part.shape == (3, count)
        np.testing.assert_array_equal(part[1], 0.0)
        np.testing.assert_allclose(part[2], length)
    np.testing.assert_allclose(np.diff(y_up[0]), 2.5)
    np.testing.assert_allclose(np.diff(x_up[0])[0], 25.0)
    assert captions(actual) == ["x, s", "y, s", "ship.spent, s"]
    charts = [panel.figure.charts[0] for panel in actual.panels]
    assert charts[0].y.ends == charts[1].y.ends
    assert all(chart.x.ends == (TIME[0], TIME[-1]) for chart in charts)
    assert "thin line: ship.rest" in notes(actual)[0]
    (line, *_), remainders = charts[0].areas, 0.01 * np.sin(TIME)
    np.testing.assert_array_equal([line.y[::2], line.y[1::2]], [remainders[:-1], remainders[1:]])
    assert len(charts[1].areas) == 1  # the other remainder is 0
    gap = {**pulses(), "rest": [np.where(TIME[7] == TIME, np.nan, remainders), 0.0 * TIME]}
    (line, *_) = one(PULSES, flown(**gap)).panels[0].figure.charts[0].areas
    assert line.x.size == 2 * (TIME.size - 1) - 4
    assert TIME[7] not in line.x


def test_without_a_count_every_row_has_new_pulses():
    lengths = np.where(np.arange(ROWS) == 7, -0.1, 0.0)
    lengths[[20, 21]] = 0.3
    signal = scalar("ship.lengths", SECOND)
    alone = replace(PULSES, lengths=signal, count=None, remainder=None, total=None, labels=("",))
    actual = one(alone, flown(lengths=lengths))
    assert findings(actual) == ["3 pulses, 0.7 s."]
    assert {colour: [lane.shape[1] for lane in lanes] for colour, lanes in bars(actual).items()} == {
        "#0072b2": [2],
        "#d55e00": [1],
    }
    still = one(alone, flown(lengths=0.0 * lengths))
    assert findings(still) == ["No pulse was fired."]
    assert still.panels == []


def test_many_pulses_stay_small():
    rows = 2501
    lengths = np.random.default_rng(1).uniform(-0.2, 0.2, (3, rows))
    signal = vector("ship.lengths", 3, SECOND)
    signals = dict(zip(signal.names, lengths, strict=True))
    result = replace(run_result(), time=0.2 * np.arange(rows), signals=signals)
    actual = one(PulsesFigure("Jets", (), signal, None, None, None, ("x", "y", "z")), result)
    assert count_of(actual) == 3 * (rows - 1)
    assert sum(len(panel.figure.svg) for panel in actual.panels) < 20 * 3 * rows  # a bar is two points of few letters


def test_an_error_within_its_sigma():
    """One of four rows is within sigma and three within three of it; 301 rows from 50 s on begin with the first."""
    actual = one(ERROR, flown(**errors()))
    inside = sum(1 for row in range(100, ROWS) if row % 4 == 0) / 301
    within = sum(1 for row in range(100, ROWS) if row % 4 != 3) / 301
    assert {repr(inside), repr(within)} <= values_in(*actual.findings)
    assert findings(actual) == [
        "From 50 s, 25.2 % of the samples within 1 sigma (normal distribution: "
        f"{100.0 * math.erf(math.sqrt(0.5)):.3g} %), 75.1 % within 3 sigma."
    ]
    assert notes(actual) == ["Line: ship.estimate minus ship.truth; shaded: ±1 and ±3 ship.sigma where it is not 0."]
    assert captions(actual) == ["Time history", "Scaled to the last quarter"]  # 11.5 deg first, then 0.35 deg


def test_an_estimate_that_is_held_counts_where_it_changed():
    """A filter of every fourth row: in between the truth moves on, and the error says nothing of the filter.

    Of 40 samples that are taken every fifth is off by two sigma, the first of them included.
    """
    steps = np.arange(ROWS)
    sampled = steps // 10
    off = np.where(sampled % 5 == 0, 2.0, 0.5)
    truth = 1e-3 * steps
    signals = {"truth": truth, "estimate": 1e-2 * sampled + 1e-3 * off, "sigma": np.full(ROWS, 1e-3)}
    (finding,) = findings(one(replace(ERROR, after=None), flown(**signals)))
    count = sampled[-1] + 1
    within = 100.0 * np.mean(np.arange(count) % 5 != 0)
    assert f"{within:.3g} % of the {count} samples at which the estimate changed within 1 sigma" in finding
    assert finding.endswith("100 % within 3 sigma.")


def test_an_error_without_sigma():
    signals = errors()
    actual = one(ERROR, flown(**(signals | {"sigma": 0.0 * TIME})))
    assert findings(actual) == []
    assert notes(actual) == ["Line: ship.estimate minus ship.truth; ship.sigma is 0 throughout, no standard deviation."]
    bare = one(replace(ERROR, sigma=None, notes=("Left out: sigma.",)), flown(**signals))
    assert notes(bare) == ["Line: ship.estimate minus ship.truth.", "Left out: sigma."]
    assert findings(one(replace(ERROR, after=1000.0), flown(**signals))) == []


def test_errors_of_a_vector():
    result = flown(**{name: [values] * 2 for name, values in errors().items()})
    parts = {name: vector(f"ship.{name}", 2, RADIAN) for name in ("estimate", "truth", "sigma")}
    actual = one(replace(ERROR, **parts, labels=("[1]", "[2]")), result)
    assert [words[:12] for words in findings(actual)] == ["[1]: from 50", "[2]: from 50"]
    assert captions(actual)[2:] == ["[2], time history", "[2], scaled to the last quarter"]


@pytest.mark.parametrize("rows", [1, 2])
def test_short_runs(rows):
    values = {"angles": angles(), **pulses(), **errors()}
    result = flown(**{name: np.atleast_2d(actual)[:, :rows] for name, actual in values.items()})
    result["ship.estimate"][-1] = np.inf
    result["ship.lengths[1]"][-1] = np.nan
    assert len(figure_sections([ANGLES, PULSES, ERROR], result)) == 3


def settled(time, *conditions):
    """Return the time of the first row from which on all conditions hold to the last one."""
    row = len(time)
    while row and all(condition[row - 1] for condition in conditions):
        row -= 1
    return float(time[row])


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize(
    ("use", "parameters"),
    [
        ({}, ["noisy.ssv"]),
        ({"observer": "orbital_observer_discrete", "regulator": "orbital_modal_control"}, []),
        ({}, ["tick_1s.ssv"]),
    ],
    ids=["filter", "observer", "pulses held over five rows"],
)
def test_a_flight_of_the_orbital_attitude(use, parameters):
    result = perilune.simulate("orbital_attitude", use=use, parameters=parameters)
    figures = read_figures(prepare_system("orbital_attitude"))
    sections = figure_sections(figures, result)
    displayed = [*joint_findings(figures, result), *(words for section in sections for words in section.findings)]
    time, values = result.time, values_in(*displayed)
    angles = [np.abs(result[f"plant.angles[{k}]"]) <= 0.5 * DEGREE for k in (1, 2, 3)]
    rates = [result[f"plant.angular_velocity[{k}]"] + (0.0011 if k == 3 else 0.0) for k in (1, 2, 3)]
    rates = [np.abs(rate) <= 0.05 * DEGREE for rate in rates]
    for conditions in ([*angles, *rates], angles, rates, *([row] for row in [*angles, *rates])):
        assert repr(settled(time, *conditions)) in values
    fired = np.array([result[f"pulses.pulse_lengths[{k}]"] for k in (1, 2, 3)])[:, :-1]
    fired[:, 1:] *= np.diff(result["pulses.pulse_count"])[:-1] != 0
    assert count_of(sections[2]) == np.count_nonzero(fired) > 20
    (reported,) = re.findall(r'pulses, <data value="([^"]+)">[^<]+</data> s ', sections[2].findings[0])
    assert float(reported) == pytest.approx(result["plant.jet_seconds"][-1], abs=1e-9)  # what is drawn was fired
    later = (time >= 60.0) & (result["observer.yaw_sigma"] > 0.0)
    off = np.abs(result["observer.estimated_angles[2]"] - result["plant.angles[2]"])
    assert len(sections[3].findings) == later.any()
    for times in (1.0, 3.0) if later.any() else ():
        within = sum(off[row] <= times * result["observer.yaw_sigma"][row] for row in np.flatnonzero(later))
        assert repr(int(within) / int(later.sum())) in values
    assert sum(len(panel.figure.svg) for section in sections for panel in section.panels) < 300_000


def test_a_band_less_a_signal_shaded_and_against_another():
    """Roll follows a target within 0.2 deg from 50 s on; shaded while the clock is below 20; two panels more."""
    roll = np.where(TIME < 50.0, 5.0, 0.2) * DEGREE
    band = replace(
        ANGLES,
        signal=scalar("ship.roll", DEG, 1.0 / DEGREE),
        labels=("",),
        less=scalar("ship.target", DEG, 1.0 / DEGREE),
        shade=scalar("ship.clock"),
        shade_below=20.0,
        against=(scalar("ship.pressure"), scalar("ship.height")),
    )
    result = flown(
        roll=roll + 0.3, target=np.full(ROWS, 0.3), clock=TIME, pressure=np.exp(0.1 * TIME), height=1e5 - TIME
    )
    (section,) = figure_sections([band], result)
    assert 'time <data value="50.0">50</data> s' in str(section.findings[0])
    assert [panel.label for panel in section.panels][-2:] == ["Versus pressure", "Versus height"]
    words = " ".join(map(str, section.notes))
    assert "minus ship.target" in words
    assert "grey: ship.clock below" in words
    (pressure,), (height,) = (panel.figure.charts for panel in section.panels[-2:])
    assert pressure.x.logarithmic
    assert not height.x.logarithmic
    decades = np.log10([at for at, _ in pressure.x.ticks])
    np.testing.assert_allclose(decades, np.arange(0.0, 9.0, 2.0), atol=1e-12)
    assert pressure.x.ends[0] < np.exp(0.1 * TIME[0]) < np.exp(0.1 * TIME[-1]) < pressure.x.ends[1]
    for chart, abscissa in ((pressure, np.exp(0.1 * TIME)), (height, 1e5 - TIME)):
        (line,) = chart.curves
        np.testing.assert_allclose(line.x, abscissa)
        np.testing.assert_array_equal(line.time, TIME)
        np.testing.assert_allclose(line.displayed, np.degrees(roll))
        assert [rule.at for rule in chart.rules] == pytest.approx([-0.5, 0.5])
