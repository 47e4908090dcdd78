"""Loop of foreign FMUs, hand-written in C and by stock pythonfmu, without state access or units: injection only.

The law declares no dependencies; it is treated as having feedthrough, so that only its internal delay of one step
remains. Truth: an integrator over one step of delay. With g = gain times step and a = w step, |L| = g/(2 sin(a/2)) and
its phase is -pi/2
- 3a/2, so the gain margin is 1/g and the phase margin pi/2 - 3 asin(g/2).
"""

import json
import math

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.stability.loops.readings import decibel_size, degree_size
from tests.support.builders import component, connection, document, pack, system
from tests.support.loops.foreign_fmus import build_foreign_fmus

STEP, GAIN = 0.1, 4.0
G = GAIN * STEP
GAIN_MARGIN, PHASE_MARGIN = -20.0 * math.log10(G), math.degrees(0.5 * math.pi - 3.0 * math.asin(0.5 * G))
DIRECT = ["--feedthrough", "law"]
ENDS = "input u Real; output y Real"


@pytest.fixture(scope="module")
def foreign(tmp_path_factory):
    return build_foreign_fmus(tmp_path_factory.mktemp("foreign"))


@pytest.fixture(scope="module")
def path(foreign):
    wires = connection("law.y", "plant.u") + connection("plant.y", "law.u")
    parts = component("law", "law", ENDS), component("plant", "integrator", ENDS)
    return pack(foreign / "foreign.ssp", foreign, document(system(*parts, connections=wires), stop=10.0, step=STEP))


def assert_margins(loop):
    assert decibel_size(loop.classical.gain_margin.value) == pytest.approx(GAIN_MARGIN, abs=0.01)
    assert degree_size(loop.classical.phase_margin.value) == pytest.approx(PHASE_MARGIN, abs=0.05)


@pytest.mark.parametrize("cut", ["law.y", "plant.y", "law.u"])
def test_by_injection_wherever_it_is_cut(path, cut):
    report = perilune.stability(path, loops=[cut], at=1.0, feedthrough=["law"])
    (loop,) = report.loops
    assert_margins(loop)
    assert (loop.cut, loop.unit, loop.sample_period) == (cut, None, pytest.approx(STEP))
    assert loop.classical.gain_margin.frequency == pytest.approx(math.pi / 3.0 / STEP, rel=1e-4)
    assert loop.measured_response.half_amplitude_change < 1e-9
    assert loop.measured_response.unexcited < 1e-9
    frequency, value = loop.measured_response.curve.frequency, loop.measured_response.curve.value
    z = np.exp(1j * frequency * STEP)
    assert abs(value * z * (z - 1.0) / G - 1.0).max() < 1e-4


def test_linearised_is_not_applicable_and_says_why(path):
    report = perilune.stability(path, loops=["law.y"], at=1.0, feedthrough=["law"])
    (loop,) = report.loops
    assert "law.fmu" in loop.not_applicable["linearisation"]
    assert "does not document how it serialises its state" in loop.not_applicable["linearisation"]
    assert (loop.linearised, loop.agreement, loop.structure, loop.dispersion) == (None, None, None, None)
    assert (loop.modes, loop.sampling, len(loop.poles_z)) == ((), (), 0)
    assert (loop.stable, loop.unstable_open, loop.classical.encirclements) == (None, None, None)
    judged = {requirement.title: requirement.passed for requirement in loop.requirements}
    assert judged == {"spectral radius": None, "gain margin": True, "phase margin": True, "modulus margin": True}
    assert loop.verdict == report.verdict == "pass"


def test_the_command_line(path, tmp_path, capsys):
    page, file = tmp_path / "report.html", tmp_path / "report.json"
    options = ["--loop", "law.y", "--at", "1", "--feedthrough", "law", "--report", str(page), "--json", str(file)]
    assert main(["stability", str(path), *options]) == 0
    actual = json.loads(file.read_text())
    (loop,) = actual["loops"]
    assert loop["cut"] == "law.y"
    assert loop["gain_margin_db"] == pytest.approx(GAIN_MARGIN, abs=0.01)
    assert loop["phase_margin_deg"] == pytest.approx(PHASE_MARGIN, abs=0.05)
    assert loop["delay_margin_s"] == pytest.approx(math.radians(PHASE_MARGIN) * STEP / (2.0 * math.asin(0.5 * G)), 1e-3)
    assert "law.fmu" in loop["not_applicable"]["linearisation"]
    assert loop["poles_z"] == []
    assert page.read_text().lower().startswith("<!doctype html")
    assert "law.y at t = 1 s: gain margin 7.96 dB, phase margin 55.39 deg" in capsys.readouterr().out


def test_exit_status_1_and_one_line_per_failed_requirement(path, capsys):
    """With g = 0.8 the margins are 1.9 dB and 19.3 deg, and -1 is as near as this."""
    z = np.exp(1j * np.linspace(0.1, math.pi, 100001))
    modulus = np.min(abs(1.0 + 0.8 / (z * (z - 1.0))))
    assert main(["stability", str(path), "--loop", "law.y", "--set", "law.gain=8", *DIRECT]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert [line.partition(": loop law.y at t = 0 s: ")[2] for line in lines] == [
        "gain margin 1.938 dB misses the limit 6 dB",
        "phase margin 19.27 deg misses the limit 30 deg",
        f"modulus margin {modulus:.4g} misses the limit 0.5",
    ]


@pytest.mark.parametrize("gain", [10.05, 10.5, 21.0])
def test_an_unstable_loop_reads_unstable_with_its_growth(path, capsys, gain):
    """z (z - 1) + g = 0 has its roots outside of the unit circle for g above 1, at the distance sqrt(g) from 0.

    The last one overflows, the others have grown by up to 1e35 when the flight ends.
    """
    report = perilune.stability(path, loops=["law.y"], at=1.0, set={"law.gain": gain}, feedthrough=["law"])
    (lost,) = report.unstudied
    expected = f"unstable: the response grows {math.sqrt(gain * STEP):.5g}-fold per sample"
    assert (report.loops, lost.name, lost.what, lost.reason) == ((), "law.y", "loop", expected)
    assert (lost.verdict, report.verdict) == ("fail", "fail")
    assert report.to_json()["unstudied"][0]["verdict"] == "fail"
    assert main(["stability", str(path), "--loop", "law.y", "--at", "1", "--set", f"law.gain={gain}", *DIRECT]) == 1
    captured = capsys.readouterr()
    assert captured.err.splitlines() == [f"perilune: loop law.y at t = 1 s: {expected}"]
    assert captured.out.splitlines()[0] == f"law.y at t = 1 s: {expected}: fail"


def test_a_loop_that_is_unstable_in_one_order_only_is_withheld(path):
    """Without its feedthrough the law is a step later: z^2 (z - 1) + g = 0 is stable below g = 0.618."""
    report = perilune.stability(path, loops=["law.y"], at=1.0, set={"law.gain": 7.0})
    (lost,) = report.unstudied
    assert (lost.verdict, report.verdict) == ("withheld", "withheld")
    assert "with the other evaluation order the verdict is not known" in report.problems()[0]


@pytest.mark.parametrize(
    ("loop", "words"),
    [
        ("law.z", r"no connector law\.z"),
        ("law", "the SSD declares no such loop"),
        ("plant.y[1]", "no connector"),
    ],
)
def test_a_cut_that_is_not_there(path, loop, words):
    with pytest.raises(perilune.InputError, match=words):
        perilune.stability(path, loops=[loop])


def test_a_system_without_loops(path):
    with pytest.raises(perilune.InputError, match=r"declares no loops.*loops?"):
        perilune.stability(path)
