"""Satellite with a wheel whose lag is an FMU in C without `dependencies`: margins for both orders of stepping.

Truth: python-control. The lag and the satellite are one continuous plant behind the hold of the control's command; in
either order the response of the lag is shifted by less than one step. At the control rate the two orders are known
exactly: they differ by one step.
"""

import itertools
import json
from dataclasses import replace

import control
import numpy as np
import pytest
from scipy.io import loadmat

import perilune
from perilune.analysis.cli import main
from perilune.analysis.documents.of.stability.orders import order_sentences, withheld_line
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.stability.loops.margin_values import MARGINS, MarginQuantity
from perilune.analysis.stability.orders import study_both_orders
from perilune.analysis.stability.point.bench import StudyError
from perilune.analysis.stability.request.request import read_request
from perilune.analysis.stability.results.requirement import MarginVerdict
from tests.support.builders import component, connection, document, inline, pack, system
from tests.support.foreign.lag import lag_fmu
from tests.support.loops.exact_systems import difference, with_stability
from tests.support.loops.sampled_loops import response_of

PERIOD, PROPORTIONAL, DERIVATIVE, LAG = 0.1, 0.2, 2.5, 0.5  # s, 1/s2, 1/s, s
SATELLITE = control.ss(control.tf(1.0, [1.0, 0.0, 0.0]))
CONTROL = difference(PROPORTIONAL, DERIVATIVE, PERIOD)
THREE = (MarginQuantity.GAIN, MarginQuantity.PHASE, MarginQuantity.MODULUS)
ENDS = "input u Real; output y Real"


def margins_by_control(loop):
    """Return gain margin upwards (dB), phase margin (deg) and modulus margin, from a fine response."""
    frequency = np.geomspace(0.05, np.pi / PERIOD, 40001)
    value = response_of(loop)(frequency)
    gain, phase = abs(value), np.unwrap(np.angle(value))
    phase += -2.0 * np.pi * np.round((phase[np.argmin(abs(gain - 1.0))] + 0.7 * np.pi) / (2.0 * np.pi))
    over = np.flatnonzero((phase[:-1] > -np.pi) & (phase[1:] <= -np.pi))[-1]
    down = np.flatnonzero((gain[:-1] > 1.0) & (gain[1:] <= 1.0))[-1]
    return {
        MarginQuantity.GAIN: -20.0 * np.log10(gain[over]),
        MarginQuantity.PHASE: 180.0 + np.degrees(phase[down]),
        MarginQuantity.MODULUS: np.min(abs(1.0 + value)),
    }


def wheel_satellite(folder, fmus, step, extra=""):
    lag_fmu(folder, LAG)
    for name in ("difference", "held_mass"):
        (folder / f"{name}.fmu").write_bytes((fmus / f"{name}.fmu").read_bytes())
    gains = f"proportional=Real:{PROPORTIONAL}; derivative=Real:{DERIVATIVE}; sample_period=Real:{PERIOD}"
    parts = (
        component("control", "difference", ENDS, inline(gains)),
        component("wheel", "lag", ENDS).replace("</ssd:Component>", f"{extra}</ssd:Component>"),
        component("satellite", "held_mass", "input u Real; output position Real"),
    )
    wires = (
        connection("control.y", "wheel.u")
        + connection("wheel.y", "satellite.u")
        + connection("satellite.position", "control.u")
    )
    ssd = document(system(*parts, connections=wires), stop=60.0, step=step)
    loop = f'<Point name="there" time="20"/>\n<Loop name="attitude" cut="control.y" points="there" period="{PERIOD}"/>'
    return pack(folder / f"wheel_{step:g}.ssp", folder, with_stability(ssd, loop))


def both(report):
    """Return margins without feedthrough and with it."""
    (without,), (direct,) = report.loops, report.orders.report.loops
    return without, direct


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("wheel")


@pytest.fixture(scope="module")
def reports(folder, exact_fmus):
    return {
        fraction: perilune.stability(wheel_satellite(folder, exact_fmus, PERIOD / fraction), workers=1)
        for fraction in (1, 2, 4)
    }


def test_the_truth_lies_between_the_orders_which_close_in_on_it(reports):
    truth = margins_by_control(CONTROL * control.c2d(control.ss(control.tf(1.0, [LAG, 1.0])) * SATELLITE, PERIOD))
    distance = []
    for report in reports.values():
        without, direct = both(report)
        low, high = ({kind: loop.margins.size(kind) for kind in THREE} for loop in (without, direct))
        for kind in THREE:
            assert low[kind] < truth[kind] < high[kind], kind
        distance.append({kind: high[kind] - low[kind] for kind in THREE})
    for kind in THREE:
        assert distance[1][kind] < 0.6 * distance[0][kind]
        assert distance[2][kind] < 0.6 * distance[1][kind]


def test_each_order_is_the_one_it_says(reports):
    """At the control's own rate: a lag of u(t_n), and the same a step earlier."""
    keep = np.exp(-PERIOD / LAG)
    late = CONTROL * control.ss(keep, 1.0 - keep, 1.0, 0.0, PERIOD) * control.c2d(SATELLITE, PERIOD)
    # z (1 - keep)/(z - keep) = (1 - keep) (1 + keep/(z - keep))
    early = CONTROL * control.ss(keep, keep, 1.0 - keep, 1.0 - keep, PERIOD) * control.c2d(SATELLITE, PERIOD)
    for loop, exact in zip(both(reports[1]), (late, early), strict=True):
        expected = margins_by_control(exact)
        for kind in THREE:
            assert loop.margins.size(kind) == pytest.approx(expected[kind], rel=2e-3), kind


def test_withheld_where_the_orders_disagree_and_failed_where_both_do(reports):
    def modulus(report):
        (loop,) = report.loops
        return next(item for item in loop.requirements if item.quantity is MarginQuantity.MODULUS)

    coarse, fine = modulus(reports[1]), modulus(reports[4])
    assert (coarse.passed, coarse.as_feedthrough.passed) == (False, True)
    assert (coarse.verdict, reports[1].verdict) == (MarginVerdict.WITHHELD, MarginVerdict.WITHHELD)
    assert (fine.passed, fine.as_feedthrough.passed) == (False, False)
    assert (fine.verdict, reports[4].verdict) == (MarginVerdict.FAIL, MarginVerdict.FAIL)


def test_said_either_way_there_is_one_order(folder, exact_fmus, reports):
    path = wheel_satellite(folder, exact_fmus, PERIOD)
    for options, expected in (
        ({"no_feedthrough": ["wheel"]}, reports[1].loops[0]),
        ({"feedthrough": ["wheel"]}, reports[1].orders.report.loops[0]),
    ):
        report = perilune.stability(path, workers=1, **options)
        assert report.orders is None
        assert [report.loops[0].margins.size(kind) for kind in MARGINS] == [
            expected.margins.size(kind) for kind in MARGINS
        ]
    assert report.verdict is MarginVerdict.PASS


def test_files_have_both_orders(reports, tmp_path):
    without, direct = both(reports[1])
    reports[1].write_data(tmp_path)
    content = json.loads((tmp_path / "loops.json").read_text())
    structs = loadmat(tmp_path / "loops.mat", simplify_cells=True)
    assert "Without declared dependencies of outputs on inputs, wheel (FMU lag)" in content["feedthrough"]
    assert structs["feedthrough"] == content["feedthrough"]
    for name, loop in (("loops", without), ("loops_with_feedthrough", direct)):
        (record,) = content[name]
        assert record["modulus_margin"] == structs[name]["modulus_margin"] == loop.margins.size(MarginQuantity.MODULUS)
    assert (content["loops"][0]["verdict"], content["loops_with_feedthrough"][0]["verdict"]) == ("withheld", "pass")
    rows = (tmp_path / "responses.csv").read_text().splitlines()[1:]
    assert {row.split(",")[2] for row in rows} == {"measured", "measured_with_feedthrough"}


def test_withheld_where_no_flight_with_feedthrough_can_be_studied(folder, exact_fmus, reports):
    path = wheel_satellite(folder, exact_fmus, PERIOD)
    reason = "the simulation for point there ended early"

    def make(request):
        if request.options.chosen["feedthrough"]:
            raise StudyError(reason)
        return replace(reports[1].orders.report)  # any report in one order; this one passes

    report = study_both_orders(read_request(path, SystemOptions()), make)
    assert report.verdict is MarginVerdict.WITHHELD
    assert {item.requirement.as_feedthrough.note for item in report.judgements()} == {"not studied"}
    assert any(sentence.endswith(f"is not studied: {reason}") for sentence in order_sentences(report))
    subject, requirement = next(report.judgements())
    assert ", not studied with it, limit " in withheld_line(report, subject, requirement)


def ring_of_lags(folder, *names):
    """Write lags in a ring with a control that answers at once: all of them direct they would close an algebraic
    loop."""
    parts = [component("control", "difference", ENDS, inline("proportional=Real:0.5; derivative=Real:0"))]
    parts += [component(name, "lag", ENDS) for name in names]
    around = ["control", *names, "control"]
    wires = "".join(connection(f"{here}.y", f"{there}.u") for here, there in itertools.pairwise(around))
    path = folder / f"{'_'.join(names)}.ssp"
    return pack(path, folder, document(system(*parts, connections=wires), stop=20.0, step=0.1))


def test_what_cannot_be_direct_has_one_order(folder, reports):
    report = perilune.stability(ring_of_lags(folder, "wheel"), loops=["control.y"], at=5.0, workers=1)
    assert report.orders.undeclared == {"wheel": "lag"}
    assert (report.orders.direct, report.orders.without, report.orders.report) == ((), ("wheel",), None)
    assert report.orders.cuts == ("control.y -> wheel.u",)
    assert {item.as_feedthrough for item in report.loops[0].requirements} == {None}


def test_where_not_all_can_be_direct_all_but_one_are(folder, reports):
    report = perilune.stability(ring_of_lags(folder, "first", "second"), loops=["control.y"], at=5.0, workers=1)
    orders = report.orders
    assert (orders.direct, orders.without, orders.cuts) == (("second",), ("first",), ("control.y -> first.u",))
    (without,), (direct,) = report.loops, orders.report.loops
    frequency, slow = without.measured_response.curve.frequency, without.measured_response.curve.value
    quick = np.interp(frequency, direct.measured_response.curve.frequency, direct.measured_response.curve.value)
    assert np.max(abs(quick * np.exp(-0.1j * frequency) / slow - 1.0)) < 0.01  # a step apart


def test_text_json_page_and_exit_status(folder, exact_fmus, tmp_path, capsys):
    path = wheel_satellite(folder, exact_fmus, PERIOD)
    page, file = tmp_path / "page.html", tmp_path / "report.json"
    assert main(["stability", str(path), "--report", str(page), "--json", str(file), "--workers", "1"]) == 1
    reported = capsys.readouterr()
    assert "  as feedthrough: " in reported.out
    assert (
        "note: direct dependencies of outputs on inputs are not declared by wheel (FMU lag): none are assumed"
        in reported.out
    )
    (line,) = [line for line in reported.err.splitlines() if "modulus margin withheld" in line]
    assert line.startswith("perilune: loop attitude at there: modulus margin withheld: 0.3963 without")
    assert line.endswith("limit 0.5; give --feedthrough wheel or --no-feedthrough wheel, or use a smaller step")
    actual = json.loads(file.read_text())
    assert actual["verdict"] == "withheld"
    orders = actual["feedthrough_orders"]
    assert (orders["undeclared"], orders["direct"]) == ({"wheel": "lag"}, ["wheel"])
    assert orders["as_feedthrough"]["loops"][0]["modulus_margin"] > 0.5
    (judged,) = [item for item in actual["loops"][0]["requirements"] if item["quantity"] == "modulus margin"]
    assert (judged["passed"], judged["verdict"], judged["as_feedthrough"]["passed"]) == (None, "withheld", True)
    text = page.read_text(encoding="utf-8")
    assert "Undeclared dependencies" in text
    assert "Violated or withheld requirements" in text
