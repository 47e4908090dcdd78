"""Page of a stability study: numbers, figures, and statements on missing results.

Truth: python-control's margins and responses of the tiny systems that were studied (tests/support/loops/studies.py).
"""

import math
import re
import shlex
import warnings
from dataclasses import replace

import numpy as np
import pytest

from perilune import StabilityReport
from perilune.analysis.cli import main
from perilune.analysis.documents.common.quantities import NONE
from perilune.analysis.documents.of.stability.charts.sets import joint_chart
from perilune.analysis.stability.loops.margin_values import UNLIMITED, UNSTABLE, MarginQuantity
from perilune.analysis.stability.loops.readings import Classical, FrequencyResponse
from perilune.analysis.stability.results.requirement import MarginRequirement, Scope
from perilune.analysis.stability.results.responses import Mode
from tests.support.lengths import either
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_systems import end_of_stability, late_double_integrator
from tests.support.loops.studies import LATE, PAIR, TRIALS
from tests.support.pages.checks import assert_self_contained, data_values, parse, section_of, text_of

DECIBEL = 20.0 / np.log(10.0)


def write(report, page):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report.report(page)
    return page.read_text(encoding="utf-8")


def rows_in(place):
    return [[cell.text_content() for cell in row.xpath("td")] for row in place.xpath(".//tbody/tr")]


def rows_under(page, heading):
    return rows_in(section_of(page, heading))


def assert_no_infinities(page):
    assert not re.findall(r"\b(?:nan|inf|infinity|∞|not a number)\b", text_of(page), re.IGNORECASE)
    assert not {value for value in data_values(page) if "nan" in value or "inf" in value}
    assert "np.float" not in page


def test_page_stands_alone_and_has_no_infinities(page):
    assert_self_contained(page)
    assert_no_infinities(page)
    figures = parse(page).xpath("//*[@class='figure']")
    assert len(figures) > 20
    for figure in figures:
        assert figure.get("role") == "img"
        assert len(figure.get("aria-label")) > 20
    for table in parse(page).xpath("//table"):
        assert table.xpath("thead/tr/th[@scope='col']")


def test_same_report_same_bytes(report, page, studies, tmp_path):
    report, page = either((report, page), (studies.relay, write(studies.relay, tmp_path / "page.html")))
    assert write(replace(report, seconds=99.0), tmp_path / "again.html") == page  # the time it took is not on it


def test_verdict_comes_first_with_every_requirement(report, page):
    headings = [element.text for element in parse(page).xpath("//h2")]
    assert headings == ["Verdict", "Margins", "Operating points", "Loops", "Over parameters", "What was studied"]
    required = [item for loop in report.loops for item in loop.requirements]
    required += [item for loop in report.loops if loop.dispersion for item in loop.dispersion.requirements]
    required += [item for joint in report.joint for item in joint.requirements]
    failing = [item for item in required if item.passed is False]
    assert (len(required), len(failing)) == (25, 6)  # 3 of the campaign, 3 of the relay's loop
    tables = section_of(page, "Verdict").xpath(".//table")
    for table, items in zip(tables, (failing, required), strict=True):
        listed = [(row[3], row[5], row[6]) for row in rows_in(table)]
        words = {True: "✓ pass", False: "✗ fail", None: f"{NONE} not applicable"}
        units = {"1": "", "dB": " dB", "deg": " deg"}
        expected = [(item.title, f"{item.limit:g}{units[item.unit]}", words[item.passed]) for item in items]
        assert sorted(listed) == sorted(expected)
    assert text_of(page).count("18 of 25 requirements met, 6 violated, 1 not applicable.") == 1


def test_margins_are_those_of_python_control(page):
    gain, phase, frequency = crossings(LATE.loop)
    (row,) = (row for row in rows_under(page, "Margins") if row[0].startswith("late"))
    assert float(row[2].removesuffix(" (upper)")) == pytest.approx(np.min(abs(DECIBEL * np.log(gain))), rel=1e-3)
    assert float(row[3]) == pytest.approx(np.degrees(np.min(abs(phase))), rel=1e-3)
    delay = np.min(phase % (2.0 * np.pi) / frequency)
    assert float(row[4]) == pytest.approx(delay, rel=1e-3)
    assert float(row[5]) == pytest.approx(delay / LATE.period, rel=1e-3)
    assert float(row[7]) == pytest.approx(disk_margin(LATE.loop), rel=1e-2)
    exact = np.array([float(value) for value in data_values(page) if re.fullmatch(r"-?[\d.]+(e-?\d+)?", value)])
    for value in (*gain, *phase, *frequency):
        assert np.min(np.abs(exact - value)) < 1e-5 * abs(value)


def test_what_is_not_applicable_is_said_with_its_reason(report, page, studies, tmp_path):
    text = text_of(page)
    reasons = [(part, reason) for loop in report.loops for part, reason in loop.not_applicable.items()]
    assert reasons
    for part, reason in reasons:
        assert f"{part.capitalize()} is not applicable: {reason}." in text
    for words in (
        "poles are not known without a linearisation",
        "not counted",
        "Not part of this study for late: nonlinear elements.",
        "no lasting oscillation",
    ):
        assert words in text
    weak = text_of(write(studies.weak, tmp_path / "weak.html"))
    assert "none (no crossing)" in weak
    (loop,) = studies.weak.loops
    assert loop.margins.size(MarginQuantity.PHASE) == UNLIMITED


def test_worst_case_can_be_flown_again(report, page, capsys):
    actual = report.loops[0].dispersion
    assert actual.replay in text_of(page)
    assert f"trial {actual.worst}, the worst" in text_of(page)
    assert main([*shlex.split(actual.replay)[1:], "--json", "-"]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert "the closed loop is unstable" in line
    assert actual.margins[actual.worst].unstable


def test_unstable_trials_are_worse_than_any_number(studies, page):
    """The page's least margin, the requirement, the count; the median is that of a trial, unstable ones below all."""
    (loop,) = studies.late.loops
    spread = loop.dispersion
    assert (spread.trials, spread.unstable) == (TRIALS, 3)
    rows = {row[0]: row[1:] for row in rows_under(page, "Loops") if len(row) == 5}
    for quantity, head in ((MarginQuantity.GAIN, "gain margin, dB"), (MarginQuantity.PHASE, "phase margin, deg")):
        sizes = sorted(item.size(quantity) for item in spread.margins)
        assert sizes[:3] == [UNSTABLE] * 3 != sizes[3]
        minimum, low, median, worst = rows[head]
        assert (minimum, low, worst) == ("unstable",) * 3
        assert float(median) == pytest.approx(sizes[TRIALS // 2 - 1], rel=1e-3)
    assert f"3 of {TRIALS} trials are unstable" in text_of(page)
    actual = {item.quantity: item for item in spread.requirements}
    assert actual[MarginQuantity.STABILITY].value == pytest.approx(1.0 - 3 / TRIALS)
    assert spread.replay in actual[MarginQuantity.STABILITY].note
    assert [actual[key].value for key in (MarginQuantity.GAIN, MarginQuantity.PHASE)] == [UNSTABLE] * 2
    assert {item.passed for item in spread.requirements} == {False}


def test_a_campaign_without_a_stable_trial(studies, tmp_path):
    page = write(studies.lost, tmp_path / "page.html")
    assert_self_contained(page)
    assert_no_infinities(page)
    assert "3 of 3 trials are unstable" in text_of(page)
    rows = {row[0]: row[1:] for row in rows_under(page, "Loops") if len(row) == 5}
    assert rows["disk margin"] == ["unstable"] * 4


def test_an_unstable_loop_has_no_margins(studies, tmp_path):
    page = write(studies.unstable, tmp_path / "page.html")
    assert_self_contained(page)
    assert_no_infinities(page)
    (row,) = rows_under(page, "Margins")
    assert row[2:] == ["unstable"] * 7 + ["✗ fail"]
    assert {row[4] for row in rows_in(section_of(page, "Verdict").xpath(".//table")[0])} > {"unstable"}
    assert "The closed loop is unstable: its crossings are not margins." in text_of(page)
    names = [row[0] for row in rows_under(page, "Loops")]
    assert "upper gain crossing" in names
    assert not [name for name in names if name.startswith(("gain margin", "phase margin"))]
    labels = [figure.get("aria-label") for figure in parse(page).xpath("//*[@class='figure']")]
    assert sum("unstable" in label for label in labels) >= 3


def test_joint_margins_ask_for_stability(studies, page, tmp_path):
    (joint,) = studies.pair.joint
    (row,) = (row for row in rows_under(page, "Margins") if "pair[1], pair[2]" in row[0])
    assert float(row[2]) == pytest.approx(disk_margin(PAIR.loop), rel=1e-2)
    wild = write(studies.wild_pair, tmp_path / "page.html")
    assert_no_infinities(wild)
    (row,) = (row for row in rows_under(wild, "Margins") if "pair[1], pair[2]" in row[0])
    assert row[2:] == ["unstable"] * 3 + [NONE, "✗ fail"]
    assert {item.value for item in studies.wild_pair.joint[0].requirements} == {UNSTABLE}
    (limit,) = joint_chart(joint).rules
    gain, phase = 10.0 ** (3.0 / 20.0), math.radians(20.0)
    required = max(2.0 * (gain - 1.0) / (gain + 1.0), 2.0 * math.tan(phase / 2.0))
    assert limit.at == pytest.approx(required)


def test_a_sweep_into_instability(studies, page):
    (sweep,) = studies.late.sweeps
    (edge,) = (item for item in sweep.crossings if item.quantity is MarginQuantity.STABILITY)
    end = end_of_stability()
    assert edge.value == pytest.approx(end, rel=1e-3)
    assert not edge.below
    assert [item.unstable for item in sweep.margins] == (sweep.values > end).tolist()
    rows = rows_under(page, "Over parameters")
    assert sum(row[0] == "unstable" and row[1] == "above" for row in rows) == 1
    assert [row[1] for row in rows if len(row) == 4][-2:] == ["unstable"] * 2
    limits = {MarginQuantity.GAIN: 6.0, MarginQuantity.PHASE: 30.0}
    reached = [item for item in sweep.crossings if item.quantity in limits]
    assert {item.quantity for item in reached} == set(limits)
    for item in reached:
        gain, phase, _ = crossings(late_double_integrator(derivative=item.value).loop)
        sizes = {
            MarginQuantity.GAIN: np.min(abs(DECIBEL * np.log(gain))),
            MarginQuantity.PHASE: np.degrees(np.min(abs(phase))),
        }
        assert sizes[item.quantity] == pytest.approx(limits[item.quantity], rel=5e-3)


@pytest.mark.parametrize("where", ["settings", "parameters"])
def test_a_frozen_plan_is_valid_for_its_time_to_go_at_most(studies, tmp_path, where):
    report, frozen = studies.late, {"guidance.frozen_time_to_go": 10.0}
    point = replace(report.points[0], holds=106600.0, settings=frozen if where == "settings" else {})
    provenance = {**report.provenance, "parameters": frozen if where == "parameters" else {}}
    page = write(replace(report, points=(point,), provenance=provenance), tmp_path / "page.html")
    assert rows_under(page, "Operating points")[0][-1] == "10 (frozen plan)"
    free = write(replace(report, points=(replace(point, settings={}),)), tmp_path / "free.html")
    assert float(rows_under(free, "Operating points")[0][-1]) == 106600.0


def test_provenance(report, page):
    text = text_of(page)
    provenance = report.provenance
    hashes = [provenance["system_sha256"], *(fmu["sha256"] for fmu in provenance["fmus"].values())]
    assert len(hashes) == 4
    for token in (*hashes, *provenance["parameters"], provenance["perilune"], "gain_margin_db = 6"):
        assert token in text
    for value in provenance["parameters"].values():
        assert repr(value) in data_values(page)


def test_text_of_others_is_escaped(report, studies, tmp_path):
    nasty = "<b>$x_1$ & 'y'</b>"
    requirement = MarginRequirement(Scope.NOMINAL, MarginQuantity.GAIN, 1.0, 2.0, False, nasty)
    strange = replace(
        studies.foreign.loops[0], name=nasty, loop=nasty, point=nasty, cut=nasty, sign=nasty, closed=(nasty,),
        not_applicable={nasty: nasty}, requirements=(requirement,), nonlinearities=(),
    )  # fmt: skip
    point = replace(
        report.points[0], name=nasty, phase=nasty, settings={nasty: nasty}, trim=((nasty, 1.0, 2.0, nasty),)
    )
    joint = replace(report.joint[0], name=nasty, channels=(nasty,))
    sweep = replace(report.sweeps[0], name=nasty, parameter=nasty)
    provenance = {nasty: nasty, "parameters": {nasty: nasty}, "fmus": {nasty: {"fmu": nasty, "sha256": nasty}}}
    page = write(
        StabilityReport(nasty, provenance, {nasty: 1.0}, (point,), (strange,), (joint,), (sweep,), (), 0.0),
        tmp_path / "page.html",
    )
    assert_self_contained(page)
    assert "<b>$" not in page
    assert text_of(page).count(nasty) > 20


def extreme(studies):
    """Return a report without crossing, limit or any known value; poles at zero: cases that no tiny system has."""
    loop = studies.late.loops[0]
    nothing = Classical((), (), math.inf, math.nan, None)
    robust = replace(loop.robust, disk_margin=2.5, disk_gain=math.inf, disk_phase=math.inf, complementary_peak=0.0)
    deadbeat = Mode(0j, complex(-math.inf, 0.0), math.nan, math.inf, "neither", 0.0, 0.0)
    free = replace(
        loop, name="free", classical=nothing, robust=robust, modes=(deadbeat,), poles_z=np.array([0j, 1.3]), step=None,
        requirements=(MarginRequirement.at_least(Scope.NOMINAL, MarginQuantity.GAIN, UNLIMITED, 6.0),), dispersion=None,
        nonlinearities=(), sampling=(),
    )  # fmt: skip
    start = replace(loop.classical.gain[0], value=0.9, frequency=0.0)  # L crosses the ray at its start
    zero = replace(loop.classical, gain=(*loop.classical.gain, start))
    bare = replace(
        loop, name="bare", classical=zero,
        curve=FrequencyResponse(np.array([0.1, 1.0]), np.array([1.0 + 0j, 0.5 - 0.5j])),
        linearised=None, measured_response=None, agreement=None, modes=(), poles_z=np.zeros(0), structure=None,
        step=None, nonlinearities=(), sampling=(), requirements=(), dispersion=None,
    )  # fmt: skip
    point = replace(studies.late.points[0], drift=None, holds=None)
    return StabilityReport("x", {"faults": [], "seed": None}, {}, (point,), (free, bare), (), (), (), 0.0)


def test_extremes(studies, tmp_path):
    page = write(extreme(studies), tmp_path / "page.html")
    assert_self_contained(page)
    assert_no_infinities(page)
    text = text_of(page)
    for words in ("without limit", "not counted", "none (no crossing)", "The study uses no file."):
        assert words in text


def test_empty_study(tmp_path):
    page = write(StabilityReport("x", {}, {}, (), (), (), (), (), 0.0), tmp_path / "page.html")
    assert_self_contained(page)
    for words in (
        f"{NONE} not applicable",
        "The system declares no requirement.",
        "The study has no loop.",
        "No operating point.",
    ):
        assert words in text_of(page)
