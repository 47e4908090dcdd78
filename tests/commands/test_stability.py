"""`perilune stability`: output, exit status, margins over a campaign, and the command for the worst trial.

Truth: margins by python-control on support/loops/exact_systems.py with the gain that was drawn; the robot's gain margin
is proportional to its mass; the documented exit status: 0, 1 for a limit that is missed, 2 for wrong input, with one
line each.
"""

import json
import re
import shlex
from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.cli import main
from tests.support.lengths import either
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_robot import translation_loop
from tests.support.loops.exact_systems import late_double_integrator

DECIBEL = 20.0 / np.log(10.0)
LATE = late_double_integrator()
# Cut at the plant's output instead: the same loop.
TWO = '<Loop name="sensed" cut="plant.position" points="there"/>'
NUMBERS = ("gain_margin_db", "phase_margin_deg", "delay_margin_s", "modulus_margin", "disk_margin")
TRIALS = either(6, 4)
CAMPAIGN = f"""
system = "late_double_integrator"
trials = {TRIALS}
seed = 11

[draw."control.proportional"]
distribution = "uniform"
low = 0.01
high = 0.03

[metric.position]
expression = "plant.position"
reduction = "final"

[success]
expression = "abs(position) < 100"
"""


@pytest.fixture(scope="module")
def packed(exact_fmus, tmp_path_factory):
    """Return a packer of the late double integrator with more in its declaration."""

    def pack(limits="", loops=""):
        ssd = LATE.ssd.replace("<Point", f"<Limits {limits}/>\n<Point", 1).replace(
            "</Stability>", f"{loops}</Stability>"
        )
        return str(replace(LATE, ssd=ssd).packed(tmp_path_factory.mktemp("late"), exact_fmus))

    return pack


@pytest.fixture(scope="module")
def plain(packed):
    return packed()


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    path = tmp_path_factory.mktemp("campaign") / "gains.toml"
    path.write_text(CAMPAIGN)
    return str(path)


def strict(text):
    """Parse JSON and refuse numbers outside the standard."""

    def refuse(name):
        raise AssertionError(f"{name} in the JSON")

    return json.loads(text, parse_constant=refuse)


def run(capsys, *arguments, status=0):
    """Return standard output as JSON, and the lines on standard error; ``status`` None: whatever the verdict."""
    assert main(["stability", *arguments, "--json", "-"]) in ((0, 1) if status is None else (status,))
    captured = capsys.readouterr()
    return strict(captured.out), captured.err.splitlines()


def nearest(gains):
    """Return the gain margin in dB."""
    return np.min(abs(DECIBEL * np.log(gains)))


def test_json_on_standard_output(plain, capsys):
    actual, errors = run(capsys, plain)
    assert errors == []
    assert (actual["system"], actual["verdict"]) == ("late_double_integrator", "pass")
    (loop,) = actual["loops"]
    gain, phase, frequency = crossings(LATE.loop)
    assert loop["gain_margin_db"] == pytest.approx(nearest(gain), abs=1e-3)
    assert loop["phase_margin_deg"] == pytest.approx(np.degrees(np.min(abs(phase))), abs=1e-3)
    assert loop["delay_margin_s"] == pytest.approx(np.min(phase % (2.0 * np.pi) / frequency), rel=1e-4)
    assert loop["disk_margin"] == pytest.approx(disk_margin(LATE.loop), rel=1e-4)
    z = np.exp(1j * np.linspace(1e-3, np.pi, 20_001))
    response = LATE.loop(z)
    assert loop["modulus_margin"] == pytest.approx(np.min(abs(1.0 + response)), rel=1e-4)
    poles = np.array([complex(*pole) for pole in loop["poles_z"]])
    for pole in LATE.closed:
        assert np.min(abs(poles - pole)) < 1e-8
    assert (loop["name"], loop["point"], loop["cut"], loop["verdict"]) == ("loop", "there", "control.y", "pass")
    assert actual["limits"]["gain_margin_db"] == 6.0
    assert {item["quantity"] for item in loop["requirements"] if item["passed"]} >= {"gain margin", "phase margin"}
    assert len(actual["provenance"]["system_sha256"]) == 64


def test_page_json_file_and_talk_to_the_terminal(plain, tmp_path, capsys):
    page, file = tmp_path / "new" / "report.html", tmp_path / "new" / "report.json"
    assert main(["stability", plain, "--report", str(page), "--json", str(file)]) == 0
    captured = capsys.readouterr()
    (loop,) = strict(file.read_text())["loops"]
    line, tightest, last, written = captured.out.splitlines()
    assert written == f"written: {page}, {file}"
    assert line.startswith(
        f"loop at there: gain margin {loop['gain_margin_db']:.2f} dB, phase margin {loop['phase_margin_deg']:.2f} deg, "
    )
    assert line.endswith("linearised and measured responses agree: pass")
    assert tightest.startswith("tightest margin: loop at there, ")
    assert re.fullmatch(r"late_double_integrator: pass, \d+\.\d s", last)
    assert captured.err == ""
    assert page.read_text().lower().startswith("<!doctype html")
    assert sorted(path.name for path in page.parent.iterdir()) == ["report.html", "report.json"]


def test_the_command_of_a_page_writes_the_same_page(plain, tmp_path):
    first, second = tmp_path / "first.html", tmp_path / "second.html"
    assert main(["stability", plain, "--at", "2", "--workers", "1", "--report", str(first)]) in (0, 1)
    (command,) = re.findall(r'Repeat: <code class="command">([^<]+)</code>', first.read_text(encoding="utf-8"))
    program, *words = shlex.split(command)
    assert program == "perilune"
    assert main([*words, "--report", str(second)]) in (0, 1)
    assert second.read_bytes() == first.read_bytes()


def test_a_line_for_every_limit_that_is_missed(packed, capsys):
    limits = 'gain_margin_db="40" phase_margin_deg="10" modulus_margin="0.99"'
    actual, errors = run(capsys, packed(limits), status=1)
    (loop,) = actual["loops"]
    assert loop["verdict"] == actual["verdict"] == "fail"
    assert errors == [
        f"perilune: loop loop at there: gain margin {nearest(crossings(LATE.loop)[0]):.4g} dB misses the limit 40 dB",
        f"perilune: loop loop at there: modulus margin {loop['modulus_margin']:.4g} misses the limit 0.99",
    ]
    missed = {item["quantity"] for item in loop["requirements"] if item["passed"] is False}
    assert missed == {"gain margin", "modulus margin"}


def test_a_setting_that_eats_the_margin(plain, capsys):
    """Without derivative a double integrator with delay is unstable: that is the one line, it has no margins."""
    actual, errors = run(capsys, plain, "--set", "control.derivative=0", status=1)
    (loop,) = actual["loops"]
    assert (loop["stable"], loop["verdict"]) == (False, "fail")
    (error,) = errors
    largest = max(abs(complex(*pole)) for pole in loop["poles_z"])
    assert largest > 1.0
    note = "the closed loop is unstable"
    assert error == f"perilune: loop loop at there: spectral radius {largest:.4g} misses the limit 1: {note}"
    assert {loop[name] for name in NUMBERS} == {"unstable"}


def test_loops_are_picked_by_name_or_connector(packed, capsys):
    path = packed(loops=TWO)
    everything, _ = run(capsys, path)
    assert [loop["name"] for loop in everything["loops"]] == ["loop", "sensed"]
    one, _ = run(capsys, path, "--loop", "sensed")
    assert [loop["name"] for loop in one["loops"]] == ["sensed"]
    cut, _ = run(capsys, path, "--loop", "plant.u", "--at", "20")
    (loop,) = cut["loops"]
    assert (loop["name"], loop["point"], loop["cut"]) == ("plant.u", "t = 20 s", "plant.u")
    assert cut["points"][0]["time_s"] == pytest.approx(20.0)
    for actual in (*everything["loops"], *one["loops"], loop):
        for name in NUMBERS:
            assert actual[name] == pytest.approx(everything["loops"][0][name], rel=1e-4)


@pytest.mark.slow
def test_a_declared_loop_at_several_times(packed, tmp_path, capsys):
    """A system that does not change has the margins of python-control all the time."""
    page = tmp_path / "page.html"
    actual, _ = run(capsys, packed(loops=TWO), "--loop", "loop", "--at", "30,20.5", "--report", str(page))
    assert [(point["name"], point["time_s"]) for point in actual["points"]] == [
        ("there, t = 20.5 s", 20.5),
        ("there, t = 30 s", 30.0),
    ]
    assert [(loop["name"], loop["point"]) for loop in actual["loops"]] == [
        ("loop", point["name"]) for point in actual["points"]
    ]
    gain, phase, _ = crossings(LATE.loop)
    for loop in actual["loops"]:
        assert loop["gain_margin_db"] == pytest.approx(nearest(gain), abs=1e-3)
        assert loop["phase_margin_deg"] == pytest.approx(np.degrees(np.min(abs(phase))), abs=1e-3)
    text = page.read_text(encoding="utf-8")
    assert text.index("Margins over the time of flight") < text.index("<h2>Verdict</h2>")


def test_a_time_behind_the_end_of_a_point_is_refused(packed, refusal):
    end = '<Point name="brief" time="10" until="15"/><Loop name="short" cut="plant.position" points="brief"/>'
    path = packed(loops=end)
    assert "--at: 15: point brief ends at 15 s; " in refusal(["stability", path, "--loop", "short", "--at", "12,15"])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--loop", "lop"], "--loop: lop: the SSD declares no such loop; "),
        (["--loop", "plant.q"], "no connector plant.q"),
        (["--at", "3,-1"], "--at: -1: not a time of the simulation; give 0 s or later"),
        (["--data", "/dev/null/x"], "--data: /dev/null/x: /dev/null is a file; give another folder"),
        (["--trial", "0"], "--trial: 0: needs a campaign"),
        (["--trials", "3"], "--trials: 3: needs a campaign"),
        (["--seed", "3"], "--seed: 3: needs a campaign"),
        (["--campaign", "none"], "--campaign: neither the system nor the working folder has a file none"),
        (["--campaign", "CAMPAIGN", "--trial", "6"], f"--trial: 6: the campaign has trials 0 to {TRIALS - 1}"),
        (["--campaign", "CAMPAIGN", "--trial", "-1"], f"--trial: -1: the campaign has trials 0 to {TRIALS - 1}"),
        (["--set", "control.gain=1"], "control.gain"),
    ],
)
def test_wrong_input(plain, campaign, tmp_path, monkeypatch, capsys, arguments, words):
    monkeypatch.chdir(tmp_path)
    options = [campaign if token == "CAMPAIGN" else token for token in arguments]
    assert main(["stability", plain, *options, "--report", "page.html", "--json", "found.json"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("perilune: ")
    assert words in captured.err
    assert captured.err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("fmus")
def test_a_system_without_loops(capsys):
    assert main(["stability", "lunar_terminal_guidance"]) == 2
    error = capsys.readouterr().err
    assert "declares no loops; name a loop in the SSD, or cut one with --loop COMPONENT.CONNECTOR --at" in error
    assert error.count("\n") == 1


def test_margins_over_a_campaign_and_its_worst_trial_again(plain, campaign, capsys):
    options = [plain, "--campaign", campaign]
    actual, _ = run(capsys, *options)
    (loop,) = actual["loops"]
    spread = loop["dispersion"]
    assert (spread["trials"], spread["unstable_trials"]) == (TRIALS, 0)
    columns = {name: [] for name in ("gain_margin_db", "phase_margin_deg", "disk_margin")}
    for trial in range(TRIALS):
        one, _ = run(capsys, *options, "--trial", str(trial))
        sampled = late_double_integrator(proportional=one["provenance"]["parameters"]["control.proportional"]).loop
        gain, phase, _ = crossings(sampled)
        (repeated,) = one["loops"]
        assert repeated["gain_margin_db"] == pytest.approx(nearest(gain), abs=1e-3)
        assert repeated["phase_margin_deg"] == pytest.approx(np.degrees(np.min(abs(phase))), abs=1e-3)
        assert "dispersion" not in repeated
        for name, value in zip(
            columns, (nearest(gain), np.degrees(np.min(abs(phase))), disk_margin(sampled)), strict=True
        ):
            columns[name].append(value)
    assert np.ptp(columns["gain_margin_db"]) > 0.1
    for name, values in columns.items():
        expected = dict(
            zip(("least", "5 %", "50 %"), np.quantile(values, (0.0, 0.05, 0.5), method="inverted_cdf"), strict=True)
        )
        assert spread[name] == pytest.approx(expected, rel=1e-4), name
    assert spread["worst_trial"] == np.argmin(columns["disk_margin"])
    command, *replay = shlex.split(spread["replay"])
    assert command == "perilune"
    assert main([*replay, "--json", "-"]) == 0
    (worst,) = strict(capsys.readouterr().out)["loops"]
    assert worst["disk_margin"] == pytest.approx(spread["disk_margin"]["least"], rel=1e-5)


@pytest.mark.slow
def test_unstable_trials_are_counted_and_the_worst_is_named(plain, tmp_path, capsys):
    """Truth: the closed loop's poles by python-control for the gain that was drawn."""
    path = tmp_path / "wild.toml"
    path.write_text(CAMPAIGN.replace("high = 0.03", "high = 0.4"))
    options = [plain, "--campaign", str(path)]
    actual, errors = run(capsys, *options, status=1)
    (loop,) = actual["loops"]
    spread = loop["dispersion"]
    largest = []
    for trial in range(TRIALS):
        one, _ = run(capsys, *options, "--trial", str(trial), status=None)
        sampled = late_double_integrator(proportional=one["provenance"]["parameters"]["control.proportional"])
        largest.append(np.max(abs(sampled.closed)))
        assert one["loops"][0]["stable"] == (largest[-1] < 1.0)
    unstable = int(np.sum(np.array(largest) > 1.0))
    assert 0 < unstable < TRIALS
    assert (spread["unstable_trials"], spread["worst_trial"]) == (unstable, int(np.argmax(largest)))
    assert {spread[name]["least"] for name in ("gain_margin_db", "phase_margin_deg", "disk_margin")} == {"unstable"}
    fraction = f"share of stable trials {1.0 - unstable / TRIALS:.4g} misses the limit 1"
    assert errors == [
        f"perilune: loop loop at there: {fraction}: {unstable} of {TRIALS} trials unstable; "
        f"replay the worst: {spread['replay']}"
    ]
    assert main(["stability", *options]) == 1
    assert f"{unstable} of {TRIALS} trials unstable; worst trial {spread['worst_trial']}: " in capsys.readouterr().out


@pytest.mark.slow
def test_the_same_numbers_twice_whatever_the_workers(packed, campaign, capsys):
    """Two points, so that there is something to share."""
    there = '<Point name="later" time="30"/>'
    path = packed(loops=f"{there}{TWO.replace('there', 'later')}")
    texts = []
    for workers in ("1", "2"):
        assert (
            main(["stability", path, "--campaign", campaign, "--trials", "2", "--workers", workers, "--json", "-"]) == 0
        )
        texts.append(capsys.readouterr().out)
    assert texts[0] == texts[1]


def test_fewer_trials_and_another_seed_draw_others(plain, campaign, capsys):
    sampled = []
    for seed in ("11", "12"):
        actual, _ = run(capsys, plain, "--campaign", campaign, "--trials", "2", "--seed", seed)
        (loop,) = actual["loops"]
        assert loop["dispersion"]["trials"] == 2
        assert f"--seed {seed}" in loop["dispersion"]["replay"]
        sampled.append(loop["dispersion"]["gain_margin_db"]["least"])
    assert sampled[0] != sampled[1]


def test_dispersed_limits_fail_with_a_line_of_their_own(packed, campaign, capsys):
    actual, errors = run(
        capsys, packed('dispersed_gain_margin_db="30"'), "--campaign", campaign, "--trials", "2", status=1
    )
    (loop,) = actual["loops"]
    minimum = loop["dispersion"]["gain_margin_db"]["least"]
    assert errors == [
        f"perilune: loop loop at there: dispersed gain margin {minimum:.4g} dB misses the limit 30 dB",
    ]
    assert actual["verdict"] == "fail"


@pytest.mark.usefixtures("fmus")
@pytest.mark.slow
def test_the_robot_s_margins_over_its_uncertain_inertia(capsys):
    options = ["robot_rendezvous", "--parameters", "paper.ssv", "--loop", "translation_4s"]
    actual, _ = run(capsys, *options, "--campaign", "inertia", "--trials", "3")
    exact = translation_loop(4.0).margins
    assert [loop["name"] for loop in actual["loops"]] == [f"translation_4s[{axis}]" for axis in (1, 2, 3)]
    worst = {loop["dispersion"]["worst_trial"] for loop in actual["loops"]}
    assert len(worst) == 1  # the lightest robot
    _, *replay = shlex.split(actual["loops"][0]["dispersion"]["replay"])
    assert main([*replay, "--json", "-"]) == 0
    repeated = strict(capsys.readouterr().out)
    mass = repeated["provenance"]["parameters"]["robot.mass"]
    for loop, one in zip(actual["loops"], repeated["loops"], strict=True):
        spread = loop["dispersion"]
        assert (spread["trials"], spread["unstable_trials"]) == (3, 0)
        assert one["gain_margin_db"] == pytest.approx(exact.gain + DECIBEL * np.log(mass / 1000.0), abs=1e-3)
        for name in ("gain_margin_db", "phase_margin_deg"):
            assert spread[name]["least"] == spread[name]["5 %"] < spread[name]["50 %"]  # of three trials
            assert spread[name]["least"] == pytest.approx(one[name], abs=0.01)
        assert spread["disk_margin"]["least"] == pytest.approx(one["disk_margin"], rel=1e-3)
