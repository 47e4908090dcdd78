"""Time limit: rows until then are retained, a batch continues, and a step that hangs does not block the process.

Truth: the same simulation without a limit, bit for bit; the duration of the FMU's sleep.
"""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.cli import main
from perilune.analysis.runtime.flight.interruptible import StuckError, fly, run
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions, Watch
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.lengths import either
from tests.support.lone_fmus import build_lone_fmu

CAMPAIGN = """
system = "Hanging"
trials = 4
seed = 1

[draw."Hanging.pause"]
distribution = "choice"
values = [0.0, {pause}]

[metric.last]
expression = "Hanging.y"
reduction = "final"

[success]
expression = "last > 0"
"""


@pytest.fixture(scope="module")
def hanging(tmp_path_factory):
    return build_lone_fmu("Hanging", tmp_path_factory.mktemp("hanging"), 'stopTime="1" stepSize="0.25"')


@pytest.fixture
def short_patience(monkeypatch):
    monkeypatch.setattr("perilune.analysis.runtime.flight.interruptible.PATIENCE", 0.05)


def test_what_was_flown_is_kept(hanging):
    values = {"Hanging.at": 0.5, "Hanging.pause": 0.8}
    limited = perilune.simulate(hanging, set=values, timeout=0.5)
    whole = perilune.simulate(hanging, set=values)
    assert limited.status == "timed_out"
    assert not limited.complete
    assert limited.message == "took longer than its time limit of 0.5 s: ended at t = 0.75 s"
    assert limited.time.tolist() == [0.0, 0.25, 0.5, 0.75]
    assert np.array_equal(limited["Hanging.y"], whole["Hanging.y"][:4])
    assert perilune.simulate(hanging, timeout=60.0).status == "stop_time"


def test_the_next_flight_of_a_simulation_is_whole(hanging):
    prepared = prepare_system(hanging, SystemOptions(set={"Hanging.at": 0.5}))
    with Simulation(prepared, varied=["Hanging.pause"]) as simulation:
        assert run(simulation, {"Hanging.pause": 0.8}, 0.5).status == "timed_out"
        assert run(simulation, {"Hanging.pause": 0.0}, 60.0).status == "stop_time"


def test_a_flight_that_ends_late_does_not_end_the_next(hanging):
    prepared = prepare_system(hanging, SystemOptions(set={"Hanging.at": 0.75}))
    with Simulation(prepared, varied=["Hanging.pause"]) as simulation:
        late = run(simulation, {"Hanging.pause": 0.8}, 0.5)  # in its last step: all of it was flown
        assert (late.status, late.time[-1]) == ("stop_time", 1.0)
        assert run(simulation, {"Hanging.pause": 0.0}, 60.0).time.size == 5


def test_native_fmus(fmus):
    prepared = prepare_system("lunar_landing", SystemOptions(flavour="native", step=0.0005))
    with Simulation(prepared, requested=["plant.mass"]) as simulation:
        result = fly(simulation, 0.05)
        assert result.status == "timed_out"
        flown = result["plant.mass"].copy()
        assert np.array_equal(simulation.advance(-1, flown.size - 1)["plant.mass"], flown)


@pytest.mark.usefixtures("short_patience")
def test_a_step_that_hangs_is_given_up(hanging):
    prepared = prepare_system(hanging, SystemOptions(set={"Hanging.at": 0.5, "Hanging.pause": 2.0}))
    with Simulation(prepared) as simulation, pytest.raises(StuckError, match=r"way to t = 0.75 s, the last .* Hanging"):
        fly(simulation, 0.5)


def plan_of(hanging, folder, pause, timeout):
    (folder / "c.toml").write_text(CAMPAIGN.format(pause=pause))
    options = SystemOptions(set={"Hanging.at": 0.5})
    return read_plan(hanging, str(folder / "c.toml"), options, watch=Watch(timeout=timeout))


@pytest.mark.parametrize(("workers", "pause"), [(1, 0.9), (1, 5.0)])
@pytest.mark.usefixtures("short_patience")
def test_a_batch_goes_on(hanging, tmp_path, workers, pause):
    plan = plan_of(hanging, tmp_path, pause, 0.5)
    late = plan.draws.columns["Hanging.pause"] > 0.0
    assert 0 < late.sum() < late.size
    trials = run_batch(plan, workers=workers).trials["default"]
    assert trials.statuses == ["hung" if value else "stop_time" for value in late]
    assert np.array_equal(trials.success, ~late)
    assert np.array_equal(trials.metrics["last"][~late], np.ones(late.size)[~late])
    assert set(trials.messages) == set(np.flatnonzero(late))
    assert all("time limit of 0.5 s" in text for text in trials.messages.values())


@pytest.mark.parametrize("name", either(["Hanging", "Holding"], ["Holding"]))
def test_a_process_ends_with_a_step_that_hangs(tmp_path, name):
    """Also where the step keeps the lock, so that no thread of the process could end it; its neighbours fly again."""
    fmu = build_lone_fmu(name, tmp_path, 'stopTime="1" stepSize="0.25"')
    (tmp_path / "c.toml").write_text(CAMPAIGN.replace("Hanging", name).format(pause=600.0))
    options = SystemOptions(set={f"{name}.at": 0.5})
    plan = read_plan(fmu, str(tmp_path / "c.toml"), options, watch=Watch(timeout=0.5))
    late = plan.draws.columns[f"{name}.pause"] > 0.0
    trials = run_batch(plan, workers=2, engine="processes").trials["default"]
    assert trials.statuses == ["hung" if value else "stop_time" for value in late]
    assert np.array_equal(trials.success, ~late)
    assert set(trials.messages) == set(np.flatnonzero(late))
    stuck = f"{name}: on the way to t = 0.75 s: did not return 1.5 s after its time limit of 0.5 s"
    assert all(text == stuck for text in trials.messages.values())


def test_the_command_says_so(hanging, tmp_path, capsys):
    values = ["--set", "Hanging.at=0.5", "--set", "Hanging.pause=0.8", "--timeout", "0.5"]
    output, report = tmp_path / "f.csv", tmp_path / "f.html"
    assert main(["run", str(hanging), *values, "--output", str(output), "--report", str(report)]) == 1
    printed = capsys.readouterr()
    assert printed.out.startswith("Hanging: timed out at t = 0.75 s, 4 samples\n")
    assert printed.err.startswith(
        f"perilune: {hanging}: took longer than its time limit of 0.5 s: ended at t = 0.75 s;"
    )
    assert len(output.read_text().splitlines()) == 5
    assert "wall-clock time limit exceeded" in report.read_text()


def test_the_batch_command_says_so(hanging, tmp_path, capsys):
    (tmp_path / "c.toml").write_text(CAMPAIGN.format(pause=0.9))
    command = ["batch", str(hanging), "--campaign", str(tmp_path / "c.toml"), "--set", "Hanging.at=0.5"]
    assert main([*command, "--workers", "1", "--timeout", "0.5"]) == 1
    assert "simulations took longer than the 0.5 s of --timeout; give a longer one" in capsys.readouterr().err


def test_a_hanging_step_does_not_keep_the_process(hanging, tmp_path):
    output = tmp_path / "f.csv"
    command = [sys.executable, "-m", "perilune", "run", str(hanging), "--set", "Hanging.at=0.5", "--timeout", "0.5"]
    done = subprocess.run([*command, "--output", str(output)], capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "Hanging: on the way to t = 0.75 s: did not return 1.5 s after" in done.stderr
    assert [row.split(",")[0] for row in output.read_text().splitlines()] == ["time", "0", "0.25", "0.5"]


@pytest.mark.parametrize("timeout", [0.0, -1.0, float("nan"), float("inf")])
def test_a_limit_that_is_none(timeout):
    with pytest.raises(InputError, match=r"timeout: .*: not a positive number of seconds"):
        Watch(timeout=timeout)
