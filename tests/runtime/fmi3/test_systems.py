"""Systems of FMUs of FMI 2.0 and FMI 3.0, which exchange values element by element."""

import shutil

import fmpy
import numpy as np
import pytest
from scipy.linalg import expm

import perilune
from tests.support.builders import component, connection, document, pack, system
from tests.support.fmi3.reference import reference_fmu
from tests.support.fmi3.strict_fmu import strict_fmu

EULER = 1e-3  # s, of StateSpace


def folder_with(tmp_path, **fmus):
    """Return the folder, with Reference-FMUs under these names."""
    for name, (version, model) in fmus.items():
        shutil.copy(reference_fmu(version, model), tmp_path / f"{name}.fmu")
    return tmp_path


def packed(folder, *elements, wires, stop=2.0, step=0.125):
    """Write an .ssp of components connected by pairs of names."""
    lines = "".join(connection(start, end) for start, end in wires)
    return str(pack(folder / "t.ssp", folder, document(system(*elements, connections=lines), stop=stop, step=step)))


def extended(matrix, drive):
    """Return the matrix of (x, 1) where x' = A x + b with a constant b."""
    return np.block([[matrix, drive[:, None]], [np.zeros((1, drive.size + 1))]])


def solved(matrix, drive, time):
    """Return x after ``time`` seconds from 0, by Euler's steps of EULER s."""
    step = np.eye(drive.size + 1) + EULER * extended(matrix, drive)
    return np.linalg.matrix_power(step, round(time / EULER))[: drive.size, drive.size]


@pytest.mark.parametrize("versions", [(2, 3), (3, 2), (3, 3)])
def test_oscillator_through_feedthroughs_of_both_versions(tmp_path, versions):
    """Each passes a Real and an Integer on in the same communication point: the values are FMPy's of the sources."""
    folder = folder_with(
        tmp_path,
        pol=(3, "VanDerPol"),
        stair=(2, "Stair"),
        first=(versions[0], "Feedthrough"),
        second=(versions[1], "Feedthrough"),
    )
    passes = "; ".join(
        f"{kind} {name}_{kind} {type_name}"
        for name, type_name in (("Float64_continuous", "Real"), ("Int32", "Integer"))
        for kind in ("input", "output")
    )
    path = packed(
        folder,
        component("pol", "pol", "output x0 Real"),
        component("stair", "stair", "output counter Integer"),
        component("first", "first", passes),
        component("second", "second", passes),
        wires=[
            ("pol.x0", "first.Float64_continuous_input"),
            ("stair.counter", "first.Int32_input"),
            ("first.Float64_continuous_output", "second.Float64_continuous_input"),
            ("first.Int32_output", "second.Int32_input"),
        ],
    )
    flight = perilune.simulate(path)
    pol = fmpy.simulate_fmu(str(reference_fmu(3, "VanDerPol")), output_interval=0.125, stop_time=2.0)
    stair = fmpy.simulate_fmu(str(reference_fmu(3, "Stair")), output_interval=0.125, stop_time=2.0)
    assert np.array_equal(flight.signals["second.Float64_continuous_output"], pol["x0"])
    assert np.array_equal(flight.signals["second.Int32_output"], stair["counter"])


def test_elements_of_an_array_from_fmus_of_both_versions(tmp_path):
    """Elements of x' = A x + u as StateSpace solves it; u[3] is unconnected and keeps its start."""
    folder = folder_with(tmp_path, two=(2, "Feedthrough"), three=(3, "Feedthrough"), space=(3, "StateSpace"))
    passes = "input Float64_continuous_input Real; output Float64_continuous_output Real"
    path = packed(
        folder,
        component("two", "two", passes),
        component("three", "three", passes),
        component("space", "space", "input u[1] Real; input u[2] Real; output y[1] Real; output y[3] Real"),
        wires=[
            ("two.Float64_continuous_output", "space.u[1]"),
            ("three.Float64_continuous_output", "space.u[2]"),
        ],
        stop=4.0,
        step=1.0,
    )
    settings = {
        "two.Float64_continuous_input": 5.0,
        "three.Float64_continuous_input": -1.0,
        "space.A": [0, 1, 0, 0, 0, 1, 0, 0, 0],
        "space.D": [0] * 9,
    }
    flight = perilune.simulate(path, set=settings, no_feedthrough=["space"])
    matrix = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]])
    values = np.array([solved(matrix, np.array([5.0, -1.0, 3.0]), n) for n in range(5)])
    for element in (1, 3):
        assert np.allclose(flight.signals[f"space.y[{element}]"], values[:, element - 1], rtol=1e-12)
    assert "space.u[3]" not in flight.signals


@pytest.mark.parametrize(("order", "inputs"), [(2, 2), (4, 2), (5, 5), (1, 1)])
def test_state_space_of_other_sizes_against_the_matrix_exponential(order, inputs):
    """Sizes that FMPy cannot set. Euler's steps are as near to the exponential as their size lets them."""
    path = str(reference_fmu(3, "StateSpace"))
    matrix = 0.1 * np.diag(np.arange(1.0, order), 1) - 0.2 * np.eye(order)
    entry = np.zeros((order, inputs))
    entry[0] = 0.25
    drive = np.arange(1.0, inputs + 1)
    output = np.arange(1.0, inputs * order + 1).reshape(inputs, order)
    settings = {
        "StateSpace.n": order,
        "StateSpace.m": inputs,
        "StateSpace.r": inputs,
        "StateSpace.A": matrix.ravel().tolist(),
        "StateSpace.B": entry.ravel().tolist(),
        "StateSpace.C": output.ravel().tolist(),
        "StateSpace.D": [0.0] * inputs**2,
        "StateSpace.x0": [0.0] * order,
        "StateSpace.u": drive.tolist(),
    }
    flight = perilune.simulate(path, set=settings, stop_time=8.0, step=1.0, record=["x", "A"])
    state = np.array([flight.signals[f"StateSpace.x[{each}]"] for each in range(1, order + 1)])
    outputs = np.array([flight.signals[f"StateSpace.y[{each}]"] for each in range(1, inputs + 1)])
    assert f"StateSpace.x[{order + 1}]" not in flight.signals
    assert np.array_equal(flight["StateSpace.A"][-1].reshape(order, order), matrix)
    for n in range(9):
        assert np.allclose(state[:, n], solved(matrix, entry @ drive, n), rtol=1e-11, atol=1e-14)
        assert np.allclose(state[:, n], expm(n * extended(matrix, entry @ drive))[:order, order], rtol=1e-3)
    assert np.allclose(outputs, output @ state, rtol=1e-13, atol=1e-15)


def test_elements_that_nothing_is_connected_to_vary_from_trial_to_trial(tmp_path):
    """u[1] is connected, u[2] drawn: y[2] = 2 u[2] after 1 s, u[1] = y[1] of the source 0.25 s late."""
    strict_fmu(tmp_path)
    root = system(
        component("source", "strict", "output y[1] Real"),
        component("sink", "strict", "input u[1] Real; output y[1] Real; output y[2] Real"),
        connections=connection("source.y[1]", "sink.u[1]"),
    )
    path = pack(tmp_path / "t.ssp", tmp_path, document(root))
    (tmp_path / "c.toml").write_text(PLAN)
    trials = perilune.batch(str(path), str(tmp_path / "c.toml"), workers=1).trials["default"]
    assert np.array_equal(trials.metrics["second"], 2.0 * trials.draws["sink.u[2]"])
    assert np.allclose(trials.metrics["first"], 0.25 * (0.0 + 0.125 + 0.25 + 0.375))


PLAN = """
system = "t.ssp"
trials = 5
seed = 1
[draw."sink.u[2]"]
distribution = "uniform"
low = 1
high = 2
[metric.first]
expression = "sink.y[1]"
reduction = "final"
[metric.second]
expression = "sink.y[2]"
reduction = "final"
[success]
expression = "first > 0"
"""
