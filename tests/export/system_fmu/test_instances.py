"""Instances of a system's FMU: states, steps, termination, several at once, in threads and in other processes.

Truth: one complete simulation by the same FMU; FMI 2.0 for return values of calls.
"""

import pickle
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2LastSuccessfulTime, fmi2Terminated

from tests.support.builders import component, connection, document, pack, system
from tests.support.native.system_fmus import Slave, build_one, fly_one

ROOT = Path(__file__).parents[3]
STEP = 0.1  # s, of lunar_terminal_guidance
SIGNALS = ("plant.position[1]", "plant.velocity[3]", "guidance.time_to_go", "navigation.estimated_position[1]")
EXPOSED = ("plant.position", "plant.velocity", "guidance.time_to_go", "navigation.estimated_position")


@pytest.fixture(scope="module")
def fmu(fmus, tmp_path_factory):
    path = tmp_path_factory.mktemp("one") / "one.fmu"
    slots = {"guidance": ["analytic_guidance", "astar_guidance"]}
    return build_one(path, "lunar_terminal_guidance", slots, EXPOSED, parameters=("noisy",))


def fly(slave, steps, size=STEP):
    rows = []
    for _ in range(steps):
        slave.step(size)
        rows.append([slave.get(name) for name in SIGNALS])
    return np.array(rows)


def test_a_state_goes_on_in_another_process(fmu, tmp_path):
    """Bytes are all that it receives."""
    slave = Slave(fmu, tmp_path / "one", **{"guidance.use": 2, "navigation.seed": 5})
    fly(slave, 300)
    state = slave.fmu.getFMUstate()
    serialised = slave.fmu.serializeFMUstate(state)
    whole = fly(slave, 200)
    program = (
        "import pickle, sys; from pathlib import Path\n"
        "from tests.support.native.system_fmus import Slave\n"
        "from tests.export.system_fmu.test_instances import fly\n"
        "path, folder, time, state = pickle.load(sys.stdin.buffer)\n"
        "slave = Slave(path, folder)\n"
        "slave.fmu.setFMUstate(slave.fmu.deSerializeFMUstate(state)); slave.time = time\n"
        "sys.stdout.buffer.write(pickle.dumps(fly(slave, 200)))\n"
    )
    values = pickle.dumps((fmu, tmp_path / "other", slave.time - 200 * STEP, serialised))
    ended = subprocess.run([sys.executable, "-c", program], input=values, stdout=subprocess.PIPE, check=True, cwd=ROOT)
    assert np.array_equal(pickle.loads(ended.stdout), whole)
    slave.fmu.setFMUstate(state)
    slave.time -= 200 * STEP
    assert np.array_equal(fly(slave, 200), whole)


def test_reset_and_many_instances(fmu, tmp_path):
    """Three in one process, step by step in turn: each as if it were alone; after a reset as at first."""
    seeds = [1, 2, 3]
    alone = []
    for seed in seeds:
        slave = Slave(fmu, tmp_path / f"alone{seed}", **{"navigation.seed": seed})
        alone.append(fly(slave, 50))
        slave.fmu.reset()
        slave.initialise(**{"navigation.seed": seed})
        assert np.array_equal(fly(slave, 50), alone[-1])
    slaves = [Slave(fmu, tmp_path / f"turn{seed}", **{"navigation.seed": seed}) for seed in seeds]
    in_turn = np.array([[fly(slave, 1)[0] for slave in slaves] for _ in range(50)])
    for column, expected in enumerate(alone):
        assert np.array_equal(in_turn[:, column], expected)
    with ThreadPoolExecutor(3) as pool:
        slaves = [Slave(fmu, tmp_path / f"thread{seed}", **{"navigation.seed": seed}) for seed in seeds]
        for flown, expected in zip(pool.map(lambda slave: fly(slave, 50), slaves), alone, strict=True):
            assert np.array_equal(flown, expected)


def test_several_whole_steps_at_once(fmu, tmp_path):
    one, many = (Slave(fmu, tmp_path / name, **{"navigation.seed": 3}) for name in ("one", "many"))
    expected = fly(one, 60)
    flown = []
    for count in (1, 2, 3, 14, 40):
        many.step(count * STEP)
        flown.append([many.get(name) for name in SIGNALS])
    assert np.array_equal(flown, expected[[0, 2, 5, 19, 59]])


@pytest.mark.parametrize("size", [0.05, 0.15, 0.1002])
def test_other_steps_are_refused(fmu, tmp_path, size):
    slave = Slave(fmu, tmp_path / "one")
    with pytest.raises(FMICallException):
        slave.step(size)
    assert f"step of {size} s is no whole number of the system's steps of 0.1 s; use a multiple" in slave.messages[0]


def test_steps_that_drift_away_are_refused(fmu, tmp_path):
    """Each is a little too long; together they would be a step of the system too many."""
    slave = Slave(fmu, tmp_path / "one")
    with pytest.raises(FMICallException):
        fly(slave, 2000, STEP * 1.0001)
    assert slave.time < 20 * STEP
    pattern = (
        r"the step begins at (\S+) s, and the FMU is at (\S+) s; continue from there, or restore the state at the st"
    )
    begins, here = map(float, re.search(pattern, slave.messages[0]).groups())
    assert begins > here == pytest.approx(round(here / STEP) * STEP)


def test_values_stay_behind_the_end(fmu, tmp_path):
    """The importer learns of the end by asking for it; steps go on as if nothing were."""
    slave = Slave(fmu, tmp_path / "one")
    assert not slave.fmu.getBooleanStatus(fmi2Terminated)
    rows = fly(slave, 4000)
    assert slave.get("finished")
    assert slave.fmu.getBooleanStatus(fmi2Terminated)
    assert slave.fmu.getRealStatus(fmi2LastSuccessfulTime) == pytest.approx(400.0)
    end = np.flatnonzero((rows[1:] != rows[:-1]).any(axis=1))[-1] + 1
    assert 2000 < end < 2200
    assert (rows[end:] == rows[-1]).all()


def test_an_unknown_candidate(fmu, tmp_path):
    with pytest.raises(FMICallException):
        Slave(fmu, tmp_path / "one", **{"guidance.use": 3})
    other = Slave(fmu, tmp_path / "other", **{"guidance.use": 2})
    with pytest.raises(FMICallException):
        other.set({"guidance.use": 1})
    assert other.messages == [
        "fmi2SetInteger: guidance.use is a parameter, fixed after initialisation",
    ]


def test_a_failing_line_names_its_component(tiny_folder, tmp_path):
    path = pack(
        tmp_path / "s.ssp",
        tiny_folder / "native",
        document(
            system(
                component("fine", "ramp", "output y Real m"),
                component("t", "trouble", "output y Real m"),
                connections=connection("t.y", "out"),
                declared="output out Real m",
            )
        ),
    )
    slave = Slave(build_one(tmp_path / "one.fmu", path, set={"t.kind": 1}), tmp_path / "one")
    slave.step(0.25)
    slave.step(0.25)
    with pytest.raises(FMICallException):
        slave.step(0.25)
    (message,) = slave.messages
    assert message.startswith('t: File "')
    assert message.endswith(": ZeroDivisionError: division by zero, in the step from t = 0.5 s over h = 0.25 s")
    with pytest.raises(FMICallException):
        slave.step(0.25)
    other = Slave(tmp_path / "one.fmu", tmp_path / "other", **{"t.kind": 2})
    other.step(0.25)
    other.step(0.25)
    with pytest.raises(FMICallException):
        other.step(0.25)
    assert other.messages == ["t.y: its value is not finite, in the step from t = 0.5 s over h = 0.25 s"]


def test_flown_by_perilune(fmu, tmp_path):
    """Alone, and reset between trials."""
    from perilune.analysis.runtime.flight.simulation import Simulation
    from perilune.analysis.runtime.system.options import SystemOptions
    from perilune.analysis.runtime.system.prepared import prepare_system

    name = "lunar_terminal_guidance"
    prepared = prepare_system(fmu, SystemOptions(set={f"{name}.guidance.use": 2}))
    expected = fly_one(fmu, {"guidance.use": 2})
    with Simulation(prepared, requested=[f"{name}.finished", f"{name}.plant.position[1]"]) as simulation:
        for _ in range(2):
            flight = simulation.fly()
            assert np.array_equal(flight[f"{name}.plant.position[1]"], expected["plant.position[1]"])
