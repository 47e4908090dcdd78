"""Phases, budgets, limits, paths and curves on the page of a run.

Truth: a hand-written run with known phases, sums and positions.
"""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from lxml import etree, html

from perilune.analysis.documents.figures.declared import Arc, BoundValues, SampleRange
from perilune.analysis.documents.of.simulation.figures.limits import limit_entries, limit_lines
from perilune.analysis.documents.of.simulation.figures.phase_figure import spans_of, statuses_of
from perilune.analysis.documents.of.simulation.figures.section import align
from perilune.analysis.documents.render.cell_markup import cell_markup
from tests.support.documents.run_page import write_run_report
from tests.support.documents.subsections import figure_sections
from tests.support.pages.checks import assert_self_contained, parse, section_of
from tests.support.pages.mission_samples import (
    BUDGET,
    CURVE,
    FIGURES,
    LIMITS,
    METRE,
    PATH,
    PHASES,
    SPANS,
    WHERE,
    mission,
)
from tests.support.pages.own_samples import ERROR, SECOND, TIME, scalar, vector

MINUS = "\N{MINUS SIGN}"


def plain(markup):
    return html.fromstring(f"<p>{markup}</p>").text_content()


def one(figure, result):
    (section,) = figure_sections([figure], result)
    return section


def notes(section):
    return [plain(words) for words in section.notes]


def findings(section):
    return [plain(words) for words in section.findings]


def cells(section):
    return [[plain(cell) for cell in row] for row in section.table.rows]


def aligned(values, unit):
    return [plain(cell_markup(cell)) for cell in align(values, unit)]


def texts(figure):
    return [text.strip() for text in etree.fromstring(figure).xpath("//*[local-name()='text']/text()")]


def test_all_of_them_are_on_a_page(tmp_path):
    write_run_report(mission(), tmp_path / "run.html", "Mission", FIGURES)
    page = (tmp_path / "run.html").read_text(encoding="utf-8")
    assert_self_contained(page)
    section = section_of(page, "ship")
    assert [part.text for part in section.xpath(".//h3")] == ["Phases", "Budget", "Plan view", "Tilt"]
    tables = [*section.xpath(".//table"), *parse(page).xpath("//header//table")]
    assert [len(table.xpath("tbody/tr")) for table in tables] == [6, 5, 3]
    assert tables[0].xpath("thead/tr/th/text()") == ["phase", "start, s", "duration, s", "propellant, kg"]


def test_phases_as_they_were_flown():
    actual = spans_of(PHASES, mission())
    assert [(span.name, span.begin, span.end) for span in actual] == [row[:3] for row in SPANS]
    assert [span.spent for span in actual] == pytest.approx([row[3] for row in SPANS], abs=1e-12)


def test_a_part_that_never_ends_one_that_is_over_at_once_and_a_value_without_name():
    never = [span.name for span in spans_of(PHASES, mission(done=0.0 * TIME))]
    assert never == ["burn", "coast", "capture", "descent"]
    at_once = [span.name for span in spans_of(PHASES, mission(done=1.0 + 0.0 * TIME))]
    assert at_once == ["burn", "coast", "hover", "descent"]
    (nameless,) = spans_of(replace(PHASES, spent=None), mission(phase=7.0 + 0.0 * TIME))
    assert (nameless.name, nameless.begin, nameless.end, nameless.spent) == ("ship.phase 7", 0.0, 200.0, None)


def test_a_phase_that_comes_again():
    phase = np.where((TIME >= 50.0) & (TIME < 60.0), 5, 1)
    actual = [(span.name, span.begin, span.end) for span in spans_of(PHASES, mission(phase=phase))]
    assert actual == [("burn", 0.0, 50.0), ("descent", 50.0, 60.0), ("burn", 60.0, 200.0)]


def test_statuses_where_they_rise():
    assert statuses_of(PHASES, mission()) == [(2, 30.0), (6, 190.0)]  # 2 is over at 40 s, which is no rise
    section = one(PHASES, mission())
    assert findings(section) == ["Status 2 at 30 s: the plan was late.", "Status 6 at 190 s: no probe."]
    assert findings(one(replace(PHASES, meanings={}), mission()))[1] == "Status 6 at 190 s."
    assert findings(one(PHASES, mission(status=0.0 * TIME))) == ["Status 0 throughout."]
    assert findings(one(replace(PHASES, status=None), mission())) == []


def test_statuses_with_times_of_their_own():
    """The second of three statuses was first, and the third never."""
    requested = replace(PHASES, status=None, status_times=vector("ship.times", 3, SECOND))
    times = np.stack([np.where(TIME < 60.0, -1.0, 60.0), np.where(TIME < 30.0, -1.0, 30.0), np.full(TIME.size, -1.0)])
    assert statuses_of(requested, mission(times=times)) == [(2, 30.0), (1, 60.0)]


def test_the_table_of_phases():
    actual = cells(one(PHASES, mission()))
    expected = [[name, f"{begin:g}", f"{end - begin:g}", f"{spent:.3f}"] for name, begin, end, spent in SPANS]
    assert actual == [*expected, ["total", "0", "200", "24.000"]]
    assert one(replace(PHASES, spent=None), mission()).table.heads == ("phase", "start, s", "duration, s")


def bars(figure):
    """Begin and end (s) of all bars by their lane."""
    (chart,) = figure.charts
    actual = {name: [] for _, name in chart.y.ticks}
    for area in chart.areas[:-1]:
        actual[chart.y.ticks[round(area.y.mean())][1]].append((float(area.x.min()), float(area.x.max())))
    return {name: sorted(lane) for name, lane in actual.items()}


def test_the_long_phase_is_cut():
    """From the status at 30 s to the end of the coast, 120 of 200 s, nothing happens; 6 % of the other 80 s is left."""
    section = one(PHASES, mission())
    assert notes(section) == [
        "Bars: phases with their duration, s. Dashed lines: status. Between the panels 110.4 s are omitted."
    ]
    before, after = (panel.figure for panel in section.panels)
    assert [panel.label for panel in section.panels] == ["0 to 34.8 s", "145.2 to 200 s"]
    assert {name: lane for name, lane in bars(before).items() if lane} == {
        "burn": [(0.0, 20.0)],
        "coast": [(20.0, pytest.approx(34.8))],
    }
    assert bars(after) == {
        "burn": [],
        "coast": [(pytest.approx(145.2), 150.0)],
        "capture": [(150.0, 165.0)],
        "hover": [(165.0, 180.0)],
        "descent": [(180.0, 200.0)],
    }
    assert [rule.at for rule in before.charts[0].rules + after.charts[0].rules] == [30.0, 190.0]
    durations = [[note.text for note in figure.charts[0].notes] for figure in (before, after)]
    assert durations == [["20", "2"], ["130", "15", "15", "20", "6"]]
    assert {"burn", "coast", "capture", "hover", "descent", "20", "2"} <= set(texts(before.svg))


def test_phases_of_like_length_are_not_cut():
    section = one(PHASES, mission(phase=np.where(TIME < 100.0, 1, 2), status=0.0 * TIME))
    assert notes(section) == ["Bars: phases with their duration, s."]
    assert bars(section.plot) == {"burn": [(0.0, 100.0)], "coast": [(100.0, 200.0)]}


def test_a_budget_beside_its_bound():
    """9.5; 3 + 8 - 9.5; 3: together 14, which is what these phases used up."""
    section = one(BUDGET, mission())
    assert section.table.heads == ("item", "kg", "sum of")
    assert cells(section) == [
        ["bound", "9.500", "bound of landing"],
        ["capture and descent over it", "1.500", "capture + descent \N{MINUS SIGN} bound of landing"],
        ["hover", "3.000", "hover"],
        ["total", "14.000", ""],
        ["consumption in these phases", "14.000", "capture, descent, hover"],
    ]


def test_a_budget_without_bound_and_of_phases_that_were_not_flown():
    bare = one(replace(BUDGET, bound=BoundValues(("landing",), {}, "it is not there; make it")), mission())
    assert [row[1] for row in cells(bare)] == ["\N{EN DASH}", "\N{EN DASH}", "3.000", "\N{EN DASH}", "14.000"]
    assert notes(bare) == ["Bound not available: it is not there; make it."]
    short = one(BUDGET, mission(done=0.0 * TIME))
    assert notes(short) == ["Phase did not occur: hover."]
    assert [row[1] for row in cells(short)][2:] == ["\N{EN DASH}"] * 3


def test_limits_at_the_end():
    section = one(LIMITS, mission())
    assert findings(section) == ["1 of 3 limits met; violated: tilt, mass."]
    assert cells(section) == [
        ["tilt", "7.5", "at most 5", "deg", "FAIL, tightest"],
        ["mass", "76", "at least 80", "kg", "FAIL"],
        ["east", "8", f"{MINUS}10 to 10", "m", "PASS"],
    ]
    assert findings(one(replace(LIMITS, limits=LIMITS.limits[2:]), mission())) == ["1 of 1 limits met."]
    lost = one(LIMITS, mission(x=np.full(TIME.size, np.nan)))
    assert findings(lost) == ["0 of 3 limits met; violated: tilt, mass, east."]


@pytest.mark.parametrize(
    ("changed", "ended", "why"),
    [
        ({"done": 0.0 * TIME}, "finished", "ship.done is 0 at the end"),
        ({"done": TIME > 1.0}, "nonfinite", "the flight did not reach its end: nonfinite"),
        ({"done": TIME > 1.0}, "interrupted", "the flight did not reach its end: interrupted"),
    ],
)
def test_limits_that_are_not_evaluated(changed, ended, why):
    """Values of the last row of a flight without the event, or without an end, are compared with no limit."""
    requested = replace(LIMITS, when=scalar("ship.done"))
    flight = replace(mission(**changed), status=ended)
    section = one(requested, flight)
    assert findings(section) == [f"Not evaluated: {why}."]
    assert [(row[1], row[4]) for row in cells(section)] == [("\N{EN DASH}", "not evaluated")] * 3
    assert limit_lines(requested, flight)[0] == f"tilt (at most 5 deg): not evaluated, {why}"
    facts = limit_entries(requested, flight)
    assert [(fact["value"], fact["verdict"], fact["reason"]) for fact in facts] == [(None, "not evaluated", why)] * 3
    landed = one(requested, mission(done=TIME > 1.0))
    assert findings(landed) == ["1 of 3 limits met; violated: tilt, mass."]


def test_a_path_has_one_scale_and_its_site_twice():
    """From (500, 300) to (8, 0) m, where the phase is 4 or more."""
    section = one(PATH, mission())
    assert notes(section) == [
        "Circle: end; marks: site (ship.site_x, ship.site_y), large: final; samples where ship.phase is at least 4; "
        "equal scales."
    ]
    ((ordinate, figure, _),) = section.panels
    (chart,) = figure.charts
    size = map(float, re.search(r"aspect-ratio:([\d.]+)/([\d.]+)", figure.svg).groups())
    across, up = (length / (axis.ends[1] - axis.ends[0]) for length, axis in zip(size, (chart.x, chart.y), strict=True))
    assert across == pytest.approx(up, rel=1e-3)
    line, end, sites, final = chart.curves
    assert (line.x[0], line.y[0], line.x[-1], line.y[-1]) == pytest.approx((500.0, 300.0, 8.0, 0.0))
    assert (end.x, end.y) == (line.x[-1:], line.y[-1:])
    assert [each.x.size for each in (sites, final)] == [2, 1]  # both of them, the last one large
    assert final.marker.size > sites.marker.size
    assert (ordinate, "ship.x, m" in texts(figure.svg)) == ("ship.y, m", True)
    assert [label for _, label in section.legend] == ["site"]


def test_a_long_path_is_in_km_and_keeps_its_detail():
    y = 2e4 * np.sin(TIME)
    section = one(replace(PATH, rows=None, points=(), equal=False), mission(x=TIME, y=y))
    assert "ship.y, km" in texts(section.plot.svg)
    assert "ship.x, m" in texts(section.plot.svg)
    root = etree.fromstring(section.plot.svg)
    path = max(root.xpath("//*[local-name()='path'][@stroke='#0072b2']/@d"), key=len)
    moves = np.array(re.findall(r"-?(?:\d+(?:\.\d+)?|\.\d+)", path), dtype=float).reshape(-1, 2)[1:]
    turns = np.count_nonzero(np.diff(np.sign(moves[:, 1])))
    assert turns >= np.count_nonzero(np.diff(np.sign(np.diff(y)))) > 60


def test_a_path_over_the_ground():
    """Straight up above a point a quarter round the sphere, and above the origin."""
    arc = Arc(vector("ship.place", 3, METRE), 1000.0)
    place = np.zeros((3, TIME.size))
    place[0], place[2] = 1000.0 + TIME, -1000.0
    section = one(replace(PATH, x=arc, points=(), equal=False), mission(place=place))
    np.testing.assert_allclose(np.abs(arc.plot_values(mission(place=place))), 500.0 * math.pi, rtol=1e-15)
    np.testing.assert_array_equal(arc.plot_values(mission(place=np.stack([0.0 * TIME, 0.0 * TIME, TIME]))), 0.0)
    assert notes(section)[0].endswith(
        "downrange: distance of ship.place along the great circle of its track, 0 at the origin and increasing "
        "in the direction of flight."
    )
    assert section.plot.charts[0].rules == []
    surface = one(replace(PATH, x=arc, y=scalar("ship.altitude", METRE), points=(), equal=False),
                  mission(place=place, altitude=5.0 + TIME))  # fmt: skip
    (chart,) = surface.plot.charts
    assert [rule.at for rule in chart.rules] == [0.0]
    assert chart.y.ends[0] < 0.0


def test_downrange_goes_on_beyond_half_the_circumference():
    """Once round from 1.2 half circumferences away, in the plane of the origin or a little off it."""
    angle = np.linspace(1.2 * math.pi, 0.0, TIME.size)
    radius = 1000.0
    for across in (0.0, 1e-4):
        place = np.stack([radius * np.sin(angle), np.full(TIME.size, radius * across), radius * (np.cos(angle) - 1.0)])
        displayed = Arc(vector("ship.place", 3, METRE), radius).plot_values(mission(place=place))[0]
        np.testing.assert_allclose(displayed, -radius * angle, atol=2.0 * radius * across)
        assert np.all(np.diff(displayed) > 0.0)


def test_curves_each_and_together():
    apart = one(CURVE, mission())
    assert [panel.label for panel in apart.panels] == ["tilt", "lean"]
    assert notes(apart) == ["Line: ship.tilt, ship.lean; dashed: limits 5 deg; samples where ship.phase is at least 4."]
    joined = one(replace(CURVE, together=True), mission())
    assert joined.panels == []
    assert [label for _, label in joined.legend] == ["tilt", "lean"]
    alone = one(replace(CURVE, signals=CURVE.signals[:1], labels=("tilt",)), mission())
    assert alone.legend == []
    words = texts(alone.plot.svg)
    ticks = [float(text.replace(MINUS, "-")) for text in words if re.fullmatch(rf"{MINUS}?[\d.]+", text)]
    assert 160.0 in ticks
    assert not any(100.0 < tick < 150.0 for tick in ticks)  # 150 s is where phase 4 begins


@pytest.mark.parametrize("figure", [PATH, CURVE, replace(ERROR, rows=WHERE)])
def test_where_nothing_was_flown(figure):
    section = one(replace(figure, rows=SampleRange(scalar("ship.phase"), 8.0, 9.0)), mission())
    assert notes(section) == ["Not plotted: no sample where ship.phase is 8 to 9."]
    assert section.plot is None
    assert section.panels == []


def test_an_error_in_some_rows_only():
    """Inside sigma in the rows from 150 s on, and never before."""
    estimate = np.where(TIME < 150.0, 5.0, 0.5) + 1e-6 * TIME
    result = mission(estimate=estimate, truth=0.0 * TIME, sigma=1.0 + 0.0 * TIME)
    assert findings(one(replace(ERROR, after=None, rows=WHERE), result))[0].startswith(
        "From 150 s, 100 % of the samples"
    )
    assert findings(one(replace(ERROR, after=None), result))[0].startswith("From 0 s, 25.2 % of the samples")


@pytest.mark.parametrize("rows", [1, 2])
def test_short_runs(rows):
    short = {name: values[:rows] for name, values in mission().signals.items()}
    figures = [replace(figure, rows=None) if hasattr(figure, "rows") else figure for figure in FIGURES]
    result = replace(mission(), time=TIME[:rows], signals=short)
    assert len(figure_sections(figures, result)) == len(figures)


def test_columns_have_the_decimals_of_their_largest():
    assert aligned([400.821, 0.00234, -7.5, None, 0.0], "kg") == [
        "400.82", "0.00", f"{MINUS}7.50", "\N{EN DASH}", "0.00"
    ]  # fmt: skip
    assert aligned([123456.7, 1.0, math.inf], "kg") == ["123457", "1", "\N{INFINITY}"]
    assert aligned([math.pi], "rad") == ["180.00"]
    assert cell_markup(align([math.pi], "rad")[0]).startswith(f'<data value="{math.pi!r}">')
