"""`perilune design transfer` and `perilune design bound`: text, files, exit status, refusals, missing solvers.

Truth: the published programme and numbers of the same plans from other programs; Python's json.
"""

import json
import re
import sys

import pytest

from perilune.analysis.cli import main
from perilune.analysis.design.trajectories import solvers
from perilune.analysis.design.trajectories.stored_bound import PLACE, find_bound
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.declared_bounds import PIECES, declared_system


def run_plan(capsys, *arguments, status=0):
    """Return the JSON of a plan."""
    assert main(["design", *arguments, "--json", "-"]) == status
    return json.loads(capsys.readouterr().out)


def test_the_programme_alone(capsys):
    assert main(["design", "transfer"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    lines = captured.out.splitlines()
    assert lines[1] == (
        "propellant 29.709 kg; propellant fraction 0.049514; duration 77.157 s; relative to vertical descent 1.3072; "
        "programme with first burn"
    )
    texts = [" ".join(line.split()) for line in lines]
    assert "simplified programme 0.049514 29.709 77.16 13.6 to 17, 66.2 to 77.2" in texts
    assert "vertical descent 0.037878 22.727 70.04 59.8 to 70" in texts
    assert "plan t2, s t5, s w, s k tp, s t7, s" in texts
    assert "simplified programme 15.27 63.642 1.697 0.9753 10.989 77.157" in texts
    assert lines[-1] == "pitch of the programme 31.7 to 135.7 deg, largest rate 2.254 deg/s"


def test_a_given_time(capsys):
    programme = run_plan(capsys, "transfer", "--t7", "78")["programme"]
    assert programme["t2_s"] == pytest.approx(15.0086, abs=0.02)
    assert programme["t5_s"] == pytest.approx(64.7012, abs=0.02)
    assert programme["tp_s"] == pytest.approx(10.9309, abs=0.02)
    assert programme["k"] == pytest.approx(0.9744, abs=1e-3)
    assert programme["t7_s"] == 78.0
    assert programme["duration_given"] is True
    assert programme["propellant_fraction"] == pytest.approx(0.04953, abs=2e-5)


def test_margins(capsys):
    actual = run_plan(capsys, "transfer", "--margins")
    assert actual["programme"]["propellant_fraction"] == pytest.approx(0.052518, abs=5e-6)
    assert actual["margins"] == pytest.approx(
        {"maximum_throttle": 0.9, "minimum_throttle": 0.1, "angular_acceleration_deg_s2": 0.7}
    )
    single = ["--maximum-throttle", "0.9", "--minimum-throttle", "0.1", "--angular-acceleration", "0.7"]
    assert run_plan(capsys, "transfer", *single)["programme"] == actual["programme"]
    fewer = run_plan(capsys, "transfer", "--angular-acceleration", "0.7")
    assert fewer["margins"]["minimum_throttle"] == pytest.approx(1.0 / 15.0)


def test_straight_down(capsys):
    programme = run_plan(capsys, "transfer", "--distance", "0")["programme"]
    assert (programme["kind"], programme["k"], programme["over_vertical"]) == ("vertical", None, 1.0)
    assert programme["t7_s"] == pytest.approx(70.04, abs=0.01)
    assert programme["propellant_fraction"] == pytest.approx(0.037878, abs=1e-6)


def test_the_moon_of_the_paper_is_not_stated(capsys):
    """Less gravity, less propellant: the loss is the impulse of the weight, about g t7/c, most of what there is."""
    less = run_plan(capsys, "transfer", "--gravity", "1.62")["programme"]["propellant_fraction"]
    more = run_plan(capsys, "transfer")["programme"]["propellant_fraction"]
    assert less == pytest.approx(0.049485, abs=1e-6)
    assert 0.0 < more / less - 1.0 < 1.622 / 1.62 - 1.0


def test_a_vehicle_that_is_twice_as_large(capsys):
    one = run_plan(capsys, "transfer")
    twice = ["--mass", "1200", "--maximum-thrust", "9414.384", "--minimum-thrust", str(2.0 * 4707.192 / 15.0)]
    two = run_plan(capsys, "transfer", *twice)
    assert two["programme"]["propellant_kg"] == pytest.approx(2.0 * one["programme"]["propellant_kg"])


@pytest.mark.slow
def test_optimum_bound_and_curves(tmp_path, capsys):
    document = tmp_path / "plan.json"
    more = ["--optimum", "--bound", "--curves", "--intervals", "60", "--json", str(document)]
    assert main(["design", "transfer", *more]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(re.match(r"true optimum +0\.0487", line) for line in lines)
    assert any(re.match(r"point-mass bound +0\.0448", line) for line in lines)
    actual = json.loads(document.read_text())
    assert actual["true_optimum"]["propellant_fraction"] == pytest.approx(0.0488, abs=5e-5)
    assert actual["bound"]["propellant_fraction"] == pytest.approx(0.04481, abs=1e-5)
    assert actual["bound"]["intervals"] == 60
    over = actual["over_distance"]
    assert over["propellant_fraction"][over["distance_m"].index(1600.0)] == actual["programme"]["propellant_fraction"]
    assert None not in over["propellant_fraction"]
    assert (
        min(value for value in actual["over_duration"]["propellant_fraction"] if value is not None)
        == (actual["programme"]["propellant_fraction"])
    )


def test_conditions_and_other_programmes(capsys):
    more = ["--optimum", "--adjoint", "--finite-switches", "--free-fall", "--distances", "0,1600", "--intervals", "40"]
    actual = run_plan(capsys, "transfer", *more)
    adjoint, free_fall = actual["adjoint"], actual["free_fall"]
    assert len(adjoint["time_s"]) == len(adjoint["costates"]) == len(adjoint["switching_function"]) == 41
    assert adjoint["costates"][-1][4] == pytest.approx(0.8 / 300.0)  # of the propellant fraction by tm
    assert adjoint["residuals"]["switching_function"] < 1e-3
    programme, optimum = actual["programme"]["propellant_fraction"], actual["true_optimum"]["propellant_fraction"]
    assert optimum < actual["finite_switches"]["propellant_fraction"] < programme
    assert free_fall["duration_s"] == pytest.approx(free_fall["t7_s"] + free_fall["last_burn_s"])
    straight, aside = actual["free_fall_over_distance"]
    assert straight["free_fall"] is None  # nothing to turn
    assert straight["programme"] == actual["vertical"]["propellant_fraction"]
    assert aside == {"distance": 1600.0, "programme": programme, "free_fall": free_fall["propellant_fraction"]}


def test_not_enough_on_board(capsys):
    assert main(["design", "transfer", "--dry-mass", "580"]) == 1
    assert capsys.readouterr().err == "perilune: the programme takes 29.71 kg of propellant; 20 kg are on board\n"


def test_no_programme(capsys):
    assert main(["design", "transfer", "--distance", "10000", "--descent", "500"]) == 1
    error = capsys.readouterr().err
    assert error.startswith("perilune: no simplified programme covers 10000 m in 500 m of descent")
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["transfer", "--mass", "0"], "--mass: 0: not above 0"),
        (["transfer", "--mass", "nan"], "--mass: 'nan': not a finite number of kg"),
        (["transfer", "--maximum-throttle", "1.1"], "--maximum-throttle: 1.1: above 1"),
        (["transfer", "--distance", "-1"], "--distance: -1: below 0"),
        (["transfer", "--bound", "--intervals", "5"], "--intervals: 5: below 10"),
        (["transfer", "--intervals", "50"], "--intervals: 50: has no effect unless --optimum or --bound is given"),
        (["transfer", "--adjoint"], "--adjoint: has no effect unless --optimum is given; also give --optimum"),
        (
            ["transfer", "--distances", "50"],
            "--distances: has no effect unless --free-fall is given; also give --free-fall",
        ),
        (["transfer", "--turn-begun", "0.5"], "--turn-begun: has no effect unless --free-fall is given"),
        (["transfer", "--free-fall", "--turn-begun", "1"], "--turn-begun: 1: above 0.9"),
        (["transfer", "--free-fall", "--distances", "50,-1"], "--distances: -1: below 0"),
        (["transfer", "--free-fall", "--distance", "0"], "--free-fall: a vertical descent, over 0 m, has no turn"),
        (
            ["transfer", "--maximum-thrust", "900"],
            "--maximum-thrust: 900 N: the acceleration at full thrust, 1.5 m/s2, does not exceed",
        ),
        (
            ["transfer", "--minimum-thrust", "1000"],
            "--minimum-thrust: 1000 N: the acceleration at this thrust, 1.667 m/s2, exceeds gravity",
        ),
        (["transfer", "--minimum-thrust", "5000"], "--minimum-thrust: 5000: not below the largest thrust"),
        (["transfer", "--minimum-thrust", "0"], "--minimum-thrust: 0 N: the programme never shuts the engine down"),
        (["transfer", "--minimum-throttle", "0.95", "--margins"], "--minimum-thrust: 4471.83: not below the"),
        (["transfer", "--dry-mass", "600"], "--dry-mass: 600: not below the mass, 600 kg"),
        (["bound", "--speed", "inf"], "--speed: 'inf': not a finite number"),
        (["bound", "--climb", "90"], "--climb: 90: above 89"),
        (["bound", "--store"], "--store: there is no system in which to store the bound; name a system"),
        (["bound", "--parameters", "a.ssv"], "system options: there is no system to which they apply"),
        (["bound", "no_such_system"], "no_such_system: system: neither a system, a folder nor a file"),
        (["nothing"], "argument VERB: invalid choice: 'nothing'"),
        ([], "the following arguments are required: VERB"),
    ],
)
def test_wrong_input(capsys, arguments, words):
    try:
        status = main(["design", *arguments])
    except SystemExit as stop:  # argparse's
        status = stop.code
    error = capsys.readouterr().err
    assert status == 2
    assert words in error
    assert error.count("\n") == 1


@pytest.fixture
def no_solvers(monkeypatch):
    for name in ("casadi", "clarabel"):
        monkeypatch.setitem(sys.modules, name, None)
    solvers.casadi.cache_clear()
    solvers.clarabel.cache_clear()


@pytest.mark.usefixtures("no_solvers")
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["transfer", "--optimum"],
            "plan: casadi: the true optimum needs this package, which is not installed; pip install",
        ),
        (["transfer", "--bound"], "plan: clarabel: the bound needs this package, which is not installed; pip install"),
        (
            ["bound"],
            "plan: clarabel: the bound needs this package, which is not installed; pip install 'perilune[plan]'",
        ),
    ],
)
def test_without_a_solver(capsys, arguments, words):
    assert main(["design", *arguments]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert error.count("\n") == 1


@pytest.mark.usefixtures("no_solvers")
def test_the_programme_needs_no_solver(tmp_path, capsys):
    page = tmp_path / "new" / "plan.html"
    assert run_plan(capsys, "transfer", "--distance", "0", "--report", str(page))["true_optimum"] is None
    assert "Not computed: true optimum, point-mass bound." in page.read_text()


def test_landing(capsys):
    actual = run_plan(capsys, "bound", "--direct", "--intervals", "60")
    assert actual["bound"]["propellant_kg"] == pytest.approx(400.82, abs=0.01)
    assert actual["direct_method"]["propellant_kg"] == pytest.approx(400.82, abs=0.01)
    assert actual["bound"]["looseness_m_s2"] < 3e-7
    assert actual["landing"]["range"] == 285e3
    assert "angular_acceleration_deg_s2" not in actual["vehicle"]


def test_landing_in_words(capsys):
    assert main(["design", "bound", "--direct", "--intervals", "40", "--dry-mass", "600"]) == 1
    captured = capsys.readouterr()
    assert "\npropellant 400.8" in captured.out
    assert "\ndirect method, without the convex form: 400.8" in captured.out
    assert captured.err.startswith("perilune: the bound takes 400.8")


@pytest.mark.usefixtures("fmus")
def test_a_systems_bound_is_stored(tmp_path, capsys):
    place = declared_system(tmp_path, PIECES)
    arguments = ["design", "bound", str(place), "--intervals", "20"]
    assert main([*arguments, "--store", "--json", str(tmp_path / "bound.json")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[3].startswith("braking alone: ")
    assert lines[-2:] == [f"stored: {place / PLACE}", f"written: {tmp_path / 'bound.json'}"]
    stored = find_bound(prepare_system(place, SystemOptions()))
    actual = json.loads((tmp_path / "bound.json").read_text())
    assert stored.propellant == actual["bound"]["propellant_kg"]
    assert stored.pieces == actual["pieces_kg"]
    assert stored.pieces["braking"] < stored.propellant
    assert stored.duration == actual["bound"]["duration_s"]
    assert actual["vehicle"]["mass"] == 940.0
    assert main(["validate", str(place)]) == 0


@pytest.mark.usefixtures("fmus")
def test_what_is_not_stored(tmp_path, capsys):
    place = declared_system(tmp_path)
    for arguments, words in (
        (
            [str(place), "--mass", "900", "--store"],
            "--store: --mass: a stored bound uses the system's own values",
        ),
        (["lunar_landing"], "no annotation org.perilune.bound"),
    ):
        assert main(["design", "bound", *arguments]) == 2
        error = capsys.readouterr().err
        assert words in error
        assert error.count("\n") == 1
    assert main(["validate", str(place)]) == 0
    assert "no extra/bound.json in the system" in " ".join(capsys.readouterr().out.split())
