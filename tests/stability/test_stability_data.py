"""Loop responses and linear models as files, readable by python-control and in MATLAB's format.

Truth: python-control's loop gains of tests/support/loops/exact_systems.py, which are independent of FMUs; a lifted loop
whose state space at every sample is known; a recurrence that changes from sample to sample.
"""

import csv
import json
import os
import time
from dataclasses import replace

import control
import numpy as np
import pytest
from scipy.io import loadmat

import perilune
from perilune.analysis.stability.point.lifted import LiftedModel, SampledChannel, StateVariable
from perilune.analysis.stability.point.open_loop import open_loop
from perilune.analysis.stability.request.channels import Channel
from perilune.analysis.stability.results.data import mat_bytes
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_periodic import exact_model
from tests.support.loops.sampled_loops import held, response_of
from tests.support.loops.studies import LATE, PAIR

DECIBEL = 20.0 / np.log(10.0)
MATRICES = ("A", "B", "C", "D")


@pytest.fixture(scope="module")
def folder(studies, tmp_path_factory):
    path = tmp_path_factory.mktemp("data") / "new"
    studies.everything.write_data(path)
    return path


@pytest.fixture(scope="module")
def content(folder):
    return json.loads((folder / "loops.json").read_text())


@pytest.fixture(scope="module")
def structs(folder):
    """Return the result of MATLAB's load."""
    return loadmat(folder / "loops.mat", simplify_cells=True)


def named(loops, name):
    (actual,) = (loop for loop in loops if loop["name"] == name)
    return actual


def state_space(loop):
    """Return the state space as docs/stability.md constructs it."""
    names = {
        key: [name.replace(".", "_") for name in np.atleast_1d(loop[f"{key[:-1]}_names"])]
        for key in ("states", "inputs", "outputs")
    }
    inputs, outputs, states = (len(names[key]) for key in ("inputs", "outputs", "states"))
    shapes = (states, states), (states, inputs), (outputs, states), (outputs, inputs)  # scipy drops columns of one
    matrices = (np.reshape(loop[key], shape) for key, shape in zip(MATRICES, shapes, strict=True))
    return control.ss(*matrices, loop["model_period_s"], **names)


def assert_late(loop):
    """Assert the state space of the late double integrator: its response, its margins by python-control, its period."""
    system = state_space(loop)
    assert (system.dt, loop["samples"], loop["sample_period_s"]) == (LATE.period, 1, LATE.period)
    frequency = np.geomspace(1e-2, 0.99, 200) * np.pi / LATE.period
    exact = response_of(LATE.loop)(frequency)
    np.testing.assert_allclose(response_of(system)(frequency), exact, rtol=1e-6)
    gain, phase, _ = crossings(LATE.loop)
    actual, angle, _, _ = control.margin(control.frd(system, frequency))
    assert DECIBEL * np.log(actual) == pytest.approx(np.min(abs(DECIBEL * np.log(gain))), abs=0.02)
    assert angle == pytest.approx(np.degrees(np.min(abs(phase))), abs=0.02)
    assert loop["gain_margin_db"] == pytest.approx(DECIBEL * np.log(actual), abs=0.02)
    assert loop["phase_margin_deg"] == pytest.approx(angle, abs=0.02)


def test_python_control_reads_the_loop(content):
    assert_late(named(content["loops"], "late"))


def test_matlab_reads_the_same(content, structs):
    assert_late(named(structs["loops"], "late"))
    for one, other in zip(content["loops"], structs["loops"], strict=True):
        assert set(one) == set(other)
        for key, value in one.items():
            if key in ("L", "measured_L"):
                np.testing.assert_array_equal(np.reshape(value, (-1, 2)) @ [1.0, 1.0j], np.atleast_1d(other[key]))
            elif key in MATRICES:
                np.testing.assert_array_equal(np.ravel(value), np.ravel(other[key]))
            elif isinstance(value, list):
                assert value == np.atleast_1d(other[key]).tolist(), key
            else:
                assert value == (other[key] if np.size(other[key]) else ""), key  # scipy reads '' as an empty array
    assert "critical point is -1" in structs["sign"]
    assert structs["sign"] == content["sign"]


def test_responses_are_those_of_the_study_by_both_methods(studies, content, folder):
    exact = response_of(LATE.loop)
    late = named(content["loops"], "late")
    for kind, maximum in (("", 1e-6), ("measured_", 2e-3)):
        frequency = np.array(late[f"{kind}frequency_rad_s"])
        value = np.array(late[f"{kind}L"]) @ [1.0, 1.0j]
        low = frequency < 0.5 * np.pi / LATE.period
        assert np.max(abs(value / exact(frequency) - 1.0)[low]) < maximum
    with (folder / "responses.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["loop"] == "late"]
    assert {row["response"] for row in rows} == {"linearised", "measured"}
    table = [complex(float(row["real"]), float(row["imaginary"])) for row in rows if row["response"] == "linearised"]
    assert table == studies.late.loops[0].curve.value.tolist()


def test_a_spreadsheet_takes_no_name_for_a_formula(studies, tmp_path):
    """And every number still for a number."""
    loop, *others = studies.late.loops
    replace(studies.late, loops=(replace(loop, name="=cmd()"), *others)).write_data(tmp_path)
    with (tmp_path / "responses.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["loop"] == "'=cmd()"]
    assert min(float(row["real"]) for row in rows) < 0.0
    assert json.loads((tmp_path / "loops.json").read_text())["loops"][0]["name"] == "=cmd()"


def test_names_and_units_of_states_and_signals(content):
    late = named(content["loops"], "late")
    assert len(late["state_names"]) == len(late["state_units"]) == len(late["A"])
    units = dict(zip(late["state_names"], late["state_units"], strict=True))
    assert all(name.split(".")[0] in ("control", "late", "plant") for name in units)
    assert units["plant.position"] in ("m", "1")
    assert (late["input_names"], late["output_names"]) == (["late in"], ["late returned, negative"])
    assert late["broken_at"] == "control.y"


def test_all_channels_of_a_loop_at_once(content, structs):
    (joint,) = content["joint"]
    assert joint["channels"] == ["pair[1]", "pair[2]"]
    system = state_space(joint)
    assert (
        disk_margin(system)
        == pytest.approx(disk_margin(PAIR.loop), rel=1e-3)
        == pytest.approx(joint["disk_margin"], rel=1e-2)
    )
    np.testing.assert_array_equal(structs["joint"]["A"], joint["A"])


def test_a_foreign_loop_has_its_measurement_and_says_why_there_is_no_model(content):
    (foreign,) = (loop for loop in content["loops"] if loop["name"] == "law.y")
    assert foreign["A"] == foreign["L"] == []
    assert len(foreign["measured_L"]) > 3
    assert "linearisation" in foreign["note"]


def test_an_unstable_loop_has_its_response_and_no_margins(studies, tmp_path):
    studies.unstable.write_data(tmp_path)
    (loop,) = json.loads((tmp_path / "loops.json").read_text())["loops"]
    assert (loop["stable"], loop["gain_margin_db"], loop["phase_margin_deg"]) == ("no", "unstable", "unstable")
    system = state_space(loop)
    assert np.max(abs(control.feedback(system).poles())) > 1.0


def test_the_same_study_gives_the_same_bytes(studies, folder, tmp_path, monkeypatch):
    monkeypatch.setattr(time, "asctime", lambda *_: "another day")
    monkeypatch.setattr(os, "name", "another system")
    replace(studies.everything, seconds=99.0).write_data(tmp_path)
    for path in folder.iterdir():
        assert (tmp_path / path.name).read_bytes() == path.read_bytes()
    assert sorted(path.name for path in folder.iterdir()) == ["loops.json", "loops.mat", "responses.csv"]


def test_a_mat_file_says_nothing_of_when_and_where():
    content = mat_bytes({"x": 1.0})
    assert content.startswith(b"MATLAB 5.0 MAT-file, written by Perilune")
    assert b"Created" not in content


def lifted(loop, samples):
    """Return the closed loop of a state space over several samples, as the linearisation has it; states in other
    units."""
    back = np.linalg.solve(np.eye(1) + loop.D, np.hstack([-loop.C, -loop.D]))
    c, d = back[:, : loop.nstates], back[:, loop.nstates :]
    a, b = loop.A + loop.B @ c, loop.B @ (np.eye(1) + d)
    powers = [np.linalg.matrix_power(a, place) for place in range(samples + 1)]
    below = [
        [c @ powers[row - column - 1] @ b if row > column else d * (row == column) for column in range(samples)]
        for row in range(samples)
    ]
    scale = 10.0 ** np.arange(loop.nstates)
    cv = np.vstack([c @ power for power in powers[:-1]]) * scale
    whole = np.hstack([power @ b for power in reversed(powers[:-1])]) / scale[:, None]
    names = tuple(f"part.state[{index}]" for index in range(loop.nstates))
    port = SampledChannel(Channel("c", "c", ("c.y",), None, None, 1, None, "N"), loop.dt, 0, samples)
    return LiftedModel(
        powers[-1] * scale / scale[:, None], whole, cv, np.block(below) + np.eye(samples), cv, np.block(below), names,
        samples * loop.dt, (port,), {name: StateVariable(size, "m") for name, size in zip(names, scale, strict=True)},
    )  # fmt: skip


@pytest.mark.parametrize("samples", [1, 3, 8])
def test_a_loop_of_several_samples_is_given_at_its_own_sample_period(samples):
    """The model of the hyperperiod reproduces the original matrices."""
    loop = control.ss(0.5, 1.0, 0.3, 0.6, 0.5) * held(control.tf([1.0], [1.0, 0.4, 0.0]), 0.5)
    model = lifted(loop, samples)
    actual = open_loop(model, model.ports)
    assert (actual.samples, actual.period) == (1, pytest.approx(0.5))
    assert actual.error < 1e-9
    for one, other in zip((actual.a, actual.b, actual.c, actual.d), (loop.A, loop.B, loop.C, loop.D), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-9)
    assert (actual.state_units, actual.signal_units) == (("m",) * loop.nstates, ("N",))


def test_a_loop_that_changes_from_sample_to_sample_is_given_over_its_hyperperiod():
    model = exact_model()
    model = replace(model, variables={name: StateVariable(1.0, None) for name in model.names})
    port = model.ports[0]
    actual = open_loop(model, (port,))
    assert (actual.samples, actual.period) == (port.count, model.period)
    assert 1e-6 < actual.error < 1e-2  # what returns at other frequencies, and comes round again
    assert actual.inputs == tuple(f"first in at sample {index + 1}" for index in range(port.count))
    wave = np.exp(1j * 0.8 * port.seconds * np.arange(port.count))
    value = wave.conj() @ actual.response(np.array([0.8]))[0] @ wave / port.count
    flown = model.response((port,), np.array([0.8]))[0, 0, 0]
    assert abs(value / flown - 1.0) < 1e-3


def test_python_writes_what_the_command_writes(exact_fmus, tmp_path, capsys):
    from perilune.analysis.cli import main

    path = str(LATE.packed(tmp_path, exact_fmus))
    assert main(["stability", path, "--data", str(tmp_path / "command")]) == 0
    assert "command" in capsys.readouterr().out
    perilune.stability(path).write_data(tmp_path / "python")
    for name in ("loops.json", "loops.mat", "responses.csv"):
        assert (tmp_path / "command" / name).read_bytes() == (tmp_path / "python" / name).read_bytes()
