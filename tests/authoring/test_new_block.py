"""`perilune new block`: the template for each slot builds and runs in the system that the command names.

Truth: the task of each slot (target reached, angles within their band, declared error, throttle in whole steps);
python-control; ruff.
"""

import math

import control
import numpy as np
import pytest

import perilune
from perilune.analysis.authoring.block_template import block_slots, find_smallest_system
from perilune.analysis.cli import main
from tests.support.lengths import either
from tests.support.loops.exact_margins import crossings
from tests.support.own_style import assert_in_style

pytestmark = pytest.mark.usefixtures("fmus")


def meets_its_target(flight):
    assert flight.status == "finished"
    final = flight.final()
    assert math.dist([final[f"plant.position[{i}]"] for i in (1, 2, 3)], [0.0, 0.0, 2000.0]) < 1.0
    assert math.hypot(*(final[f"plant.velocity[{i}]"] for i in (1, 2, 3))) < 1.0


def holds_the_orbital_frame(flight):
    last = flight.time > 400.0
    for place in (1, 2, 3):
        assert abs(flight[f"plant.angles[{place}]"][last]).max() < math.radians(0.5)


def holds_its_bank(flight):
    final = flight.final()
    assert abs(final["plant.bank"] - final["programme.reference_bank"]) < math.radians(3.0)


def steps_its_throttle(flight):
    steps = flight["allocation.thrust"] / (5099.0 / 100)
    assert abs(steps - np.round(steps)).max() < 1e-9
    assert steps.max() > 1.0
    assert flight.status == "finished"


def errs_as_declared(flight):
    for place, error in ((1, 50.0), (2, 0.0), (3, 0.0)):
        actual = flight[f"navigation.estimated_position[{place}]"] - flight[f"plant.position[{place}]"]
        assert actual == pytest.approx(error, abs=1e-6)
    assert flight.final()["plant.position[1]"] == pytest.approx(-50.0, abs=2.0)


def is_off_by_the_leak(flight):
    """Assert an offset by torque over stiffness, J w0^2, about the leak's axis."""
    offset = [abs(flight.final()[f"monitor.attitude_error[{axis}]"]) for axis in (1, 2, 3)]
    assert offset[0] == pytest.approx(1e-4 / (180.0 * 0.3**2), rel=0.02)
    assert max(offset[1:]) < 0.02 * offset[0]
    assert flight.status == "finished"


TASKS = {
    "terminal_guidance": meets_its_target,
    "orbital_control": holds_the_orbital_frame,
    "entry_control": holds_its_bank,
    "allocation": steps_its_throttle,
    "navigation": errs_as_declared,
    "spacecraft": is_off_by_the_leak,
}


def test_every_slot_has_a_task():
    assert set(TASKS) == set(block_slots())


@pytest.mark.parametrize("slot", TASKS)
def test_a_block_of_a_slot(slot, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    name = f"own_{slot}"
    assert main(["new", "block", name, "--slot", slot]) == 0
    assert capsys.readouterr().out.splitlines()[-2] == f"  perilune export {name}.py"
    assert main(["export", f"{name}.py"]) == 0
    system, component = find_smallest_system(slot)
    native = perilune.simulate(system, use={component: name}, flavour="native")
    TASKS[slot](native)
    python = perilune.simulate(system, use={component: name}, flavour="python", stop_time=either(None, 2.0))
    for signal, values in python.signals.items():
        assert (values == native[signal][: len(values)]).all(), signal


def test_the_block_of_no_slot_flies_in_a_new_system(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "block", "damper"]) == 0
    commands = [line.strip().split()[1:] for line in capsys.readouterr().out.splitlines()[2:]]
    assert commands[-1] == ["run", "SYSTEM", "--use", "control=damper"]
    for words in commands:  # without an integral the disturbance leaves more of the angle than its limit
        assert main([token.replace("SYSTEM", "axis") for token in words]) == (1 if words[0] == "run" else 0)
    flight = perilune.simulate("axis", use={"control": "damper"}, set={"plant.disturbance": 0.0})
    assert abs(flight["plant.angle"][-1]) < 1e-3 * flight["plant.angle"][0]
    # what a disturbance leaves of the angle without an integral
    held = perilune.simulate("axis", use={"control": "damper"})
    assert held["plant.angle"][-1] == pytest.approx(0.01 / 6.6, rel=1e-2)
    (loop,) = perilune.stability("axis", use={"control": "damper"}).loops
    plant = control.ss([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0 / 500.0]], np.eye(2), np.zeros((2, 1)))
    fraction = 0.5 / (0.5 + 0.5)
    low_pass = control.ss(1.0 - fraction, 1.0 - fraction, fraction, fraction, 0.5)
    exact = low_pass * control.ss([], [], [], [[6.6, 90.0]], 0.5) * control.c2d(plant, 0.5, "zoh")
    gain, phase, _ = crossings(exact)
    assert loop.margins.gain == pytest.approx(gain[np.argmin(abs(np.log(gain)))], rel=1e-4)
    assert loop.margins.phase == pytest.approx(min(abs(phase)), rel=1e-4)


def test_python_is_as_ruff_writes_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for slot in TASKS:
        assert main(["new", "block", f"my_own_{slot}_that_has_a_rather_long_name", "--slot", slot]) == 0
    assert_in_style(tmp_path)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["block", "MyGuidance"], ["MyGuidance", "lower-case letters", "as my_guidance"]),
        (["block", "pd-2"], ["pd-2", "as pd2"]),
        (["system", "class"], ["class", "as my_class"]),
        (["system", "sub/mine"], ["sub/mine", "as sub_mine"]),
        (["block", "math"], ["hides Python's math", "my_math"]),
        (["block", "astar_guidance"], ["astar_guidance is an FMU of this repository", "choose another"]),
        (["block", "lunar_landing"], ["is a system of this repository"]),
        (["system", "lunar_landing"], ["is a system of this repository"]),
        (["block", "mine", "--slot", "terminal_guidence"], ["--slot", "no such slot", "terminal_guidance"]),
        (["block", "mine", "--slot", "gyro_steering"], ["--slot", "no block template", "use one of allocation"]),
        (["block", "taken"], ["taken.py", "already exists and is not overwritten"]),
        (["system", "there"], ["there", "already exists and is not overwritten"]),
        (["block", "built"], ["build/fmus/native/built.fmu already", "remove this file"]),
    ],
)
def test_what_is_refused(arguments, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken.py").write_text("mine")
    (tmp_path / "there").mkdir()
    (tmp_path / "build/fmus/native").mkdir(parents=True)
    (tmp_path / "build/fmus/native/built.fmu").write_text("")
    before = sorted(tmp_path.rglob("*"))
    assert main(["new", *arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith("perilune: ")
    assert error.count("\n") == 1
    for token in words:
        assert token in error
    assert sorted(tmp_path.rglob("*")) == before
    assert (tmp_path / "taken.py").read_text() == "mine"
