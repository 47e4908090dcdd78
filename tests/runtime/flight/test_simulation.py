"""Complete simulations of FMUs, compared with an independently written lander and the published test state.

Truth: support/flights/independent_lander.py, which shares no code with the components; the numbers printed in the
published method's worked state; an initial state that ends a run before its first step; new instances, which reset
instances must reproduce to the last bit; FMPy's calls for the FMU state.
"""

import shutil

import fmpy
import numpy as np
import pytest
from fmpy import fmi2

import perilune
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.paths import FLAVOURS
from tests.support.builders import component, connection, document, external, fly, pack, parameter_set, system
from tests.support.flights import independent_lander
from tests.support.lengths import either

SYSTEM = "lunar_terminal_guidance"
MIDDLE = ([1e5, 0.0, 10500.0], [-950 * np.cos(0.05), 0.0, -950 * np.sin(0.05)])
ASIDE = ([7.4e4, 6.6e4, 9900.0], [-640.0, -690.0, -31.0])
RIGHT = ([8.9e4, -5.1e4, 11400.0], [-870.0, 391.0, 0.0])
VARIANTS = {
    "stop": {"use": {"guidance": "analytic_guidance"}},
    "exact": {"use": {"guidance": "analytic_exact_guidance"}, "parameters": ["exact.ssv"]},
}


@pytest.fixture(params=FLAVOURS)
def tiny(request, tiny_folder):
    return tiny_folder / request.param


def start(position, velocity):
    actual = {f"plant.initial_position[{i + 1}]": position[i] for i in range(3)}
    return actual | {f"plant.initial_velocity[{i + 1}]": velocity[i] for i in range(3)}


def vector(result, name):
    return np.column_stack([result[f"{name}[{i}]"] for i in (1, 2, 3)])


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", either([None, "python"], [None]))  # the other flies the same bits, see below
@pytest.mark.parametrize("state", either([MIDDLE, ASIDE, RIGHT], [ASIDE]))
@pytest.mark.parametrize("step", [0.1, 1.0])
@pytest.mark.parametrize("variant", ["stop", "exact"])
def test_flies_as_the_independent_lander(variant, step, state, flavour):
    expected = independent_lander.fly(*state, step, variant)
    result = perilune.simulate(SYSTEM, set=start(*state), step=step, flavour=flavour, **VARIANTS[variant])
    assert result.status == "finished"
    np.testing.assert_allclose(result.time, expected["times"], rtol=0, atol=1e-9)
    for name, truth in (("plant.position", expected["positions"]), ("plant.velocity", expected["velocities"])):
        scale = np.abs(truth).max()
        assert np.abs(vector(result, name) - truth).max() <= 1e-9 * scale
        np.testing.assert_array_equal(vector(result, name.replace("plant", "navigation")), vector(result, name))
    if variant == "exact":
        burns = result["guidance.burn_duration"][result["guidance.burn_duration"] > 0]
        assert burns[-1] == pytest.approx(expected["last_burn"], rel=1e-7)


# As printed: time-to-go by quadratic, cubic, A* quartic, modified A*; acceleration, pitch and its rate.
PRINTED = {
    "analytic_guidance": ("217.578132", "4.7323943", "0.2885476", "8.14639e-4"),
    "analytic_exact_guidance": ("213.645917", "4.8079921", "0.2926228", "9.36934e-4"),
    "astar_guidance": ("212.982772", None, None, None),
    "astar_modified_guidance": ("209.126308", None, None, None),
}


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("guidance", PRINTED)
def test_first_command_of_the_printed_state(guidance):
    result = perilune.simulate(SYSTEM, use={"guidance": guidance}, set=start(*MIDDLE), stop_time=0.1)
    direction, rate = (
        vector(result, "guidance.thrust_direction")[0],
        vector(result, "guidance.thrust_direction_rate")[0],
    )
    pitch = np.arcsin(direction[2])
    actual = (
        result["guidance.time_to_go"][0],
        result["guidance.thrust_acceleration"][0],
        pitch,
        rate[2] / np.cos(pitch),
    )
    for value, text in zip(actual, PRINTED[guidance], strict=True):
        if text is not None:
            mantissa, _, exponent = text.partition("e")
            half_digit = 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
            assert abs(value - float(text)) <= half_digit * (1 + 1e-9), (value, text)


@pytest.mark.usefixtures("fmus")
def test_row_n_holds_values_of_its_time_and_the_command_applied_next():
    result = perilune.simulate(SYSTEM, stop_time=5.0)
    np.testing.assert_array_equal(result["plant.thrust"], result["allocation.thrust"])
    np.testing.assert_array_equal(result["plant.command_time"], result["guidance.command_time"])
    np.testing.assert_array_equal(result["guidance.position[1]"], result["plant.position[1]"])
    # the acceleration over a step is that of the command in the row before it
    change = np.diff(vector(result, "plant.velocity"), axis=0) / 0.1
    change[:, 2] += 1.62
    demanded = result["plant.thrust"] / result["plant.mass"]
    np.testing.assert_allclose(np.linalg.norm(change, axis=1), demanded[:-1], rtol=1e-6)


def test_finished_in_row_zero_ends_the_run_before_a_step(tiny, tmp_path):
    body = system(
        component("ramp", "ramp", "output flag Boolean; output y Real m"),
        declared="output finished Boolean",
        connections=connection("ramp.flag", "finished"),
    )
    path = pack(tmp_path / "s.ssp", tiny, document(body))
    result = fly(path, set={"ramp.flag_at": 0})
    assert (result.status, result.time.tolist(), result["ramp.count"].tolist()) == ("finished", [0.0], [0.0])
    result = fly(path, set={"ramp.flag_at": 3})
    assert (result.status, result.time.tolist()) == ("finished", [0.0, 0.25, 0.5, 0.75])
    assert result["finished"].tolist() == [0, 0, 0, 1]
    result = fly(path, set={"ramp.flag_at": 4})  # at the stop time both hold
    assert (result.status, result.time[-1]) == ("finished", 1.0)
    assert fly(path).status == "stop_time"


def test_no_step_at_all_is_a_run_of_one_row(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(component("ramp", "ramp"))))
    result = fly(path, stop_time=0.0)
    assert (result.status, result.time.tolist(), result["ramp.y"].tolist()) == ("stop_time", [0.0], [1.0])


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", ["python", "native"])
def test_reset_flies_the_bits_of_a_fresh_instance(flavour):
    options = SystemOptions(parameters=("noisy.ssv",), flavour=flavour, stop_time=40.0)
    varied = ["navigation.stream", "plant.initial_position[1]"]
    cases = [{varied[0]: 3, varied[1]: 1e5}, {varied[0]: 4, varied[1]: 9.9e4}, {varied[0]: 3, varied[1]: 1e5}]
    fresh = []
    for case in cases:
        with Simulation(prepare_system(SYSTEM, options), varied=varied) as simulation:
            fresh.append({name: column.copy() for name, column in simulation.fly(case).signals.items()})
    with Simulation(prepare_system(SYSTEM, options), varied=varied) as simulation:
        for case, expected in zip(cases, fresh, strict=True):
            actual = simulation.fly(case)
            assert all(np.array_equal(actual[name], column) for name, column in expected.items())
    assert not np.array_equal(fresh[0]["guidance.position[1]"], fresh[1]["guidance.position[1]"])


@pytest.mark.usefixtures("fmus")
def test_flavours_fly_the_same_bits():
    actual = [perilune.simulate(SYSTEM, parameters=["noisy.ssv"], flavour=name) for name in ("python", "native")]
    assert actual[0].signals.keys() == actual[1].signals.keys()
    for name, column in actual[0].signals.items():
        assert np.array_equal(column, actual[1][name]), name


@pytest.mark.parametrize("kind", [1, 4])
def test_a_failed_flight_does_not_touch_the_next(tiny, tmp_path, kind):
    path = pack(tmp_path / "s.ssp", tiny, document(system(component("trouble", "trouble", "output y Real m"))))
    with Simulation(prepare_system(path), varied=["trouble.kind"]) as simulation:
        for _ in range(3):
            failed = simulation.fly({"trouble.kind": kind})
            assert failed.status == "failed"
            assert failed.time.size == (3 if kind == 1 else 0)
            assert "division" in failed.message
            assert simulation.fly({"trouble.kind": 0})["trouble.y"].tolist() == [1, 2, 3, 4, 5]


@pytest.mark.parametrize(("kind", "text"), [(2, "inf"), (3, "nan")])
def test_values_that_are_not_finite_end_the_run_by_name_and_time(tiny, tmp_path, kind, text):
    path = pack(tmp_path / "s.ssp", tiny, document(system(component("trouble", "trouble", "output y Real m"))))
    result = fly(path, set={"trouble.kind": kind, "trouble.at": 2})
    assert result.status == "nonfinite"
    assert result.time.tolist() == [0.0, 0.25]
    assert text in result.message
    assert "trouble.y" in result.message
    assert "0.5" in result.message


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", ["python", "native"])
@pytest.mark.parametrize("name", ["noisy_navigation", "flat_moon_lander", "analytic_exact_guidance", "forming_filter"])
def test_full_state_restores_a_flight_midway(fmus, name, flavour):
    """State taken, carried as bytes to another instance and set there: both go on with the same bits."""
    file = fmus.parent / flavour / f"{name}.fmu"
    description = fmpy.read_model_description(str(file))
    variables = {variable.name: variable for variable in description.modelVariables}
    reals = [v.valueReference for v in variables.values() if v.type == "Real"]
    inputs = [v.valueReference for v in variables.values() if v.causality == "input" and v.type == "Real"]
    sigmas = [v.valueReference for key, v in variables.items() if key.endswith("_sigma") and v.causality == "parameter"]
    folder = fmpy.extract(str(file))

    def instance(number):
        slave = fmi2.FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=f"{name}{number}",
        )
        slave.instantiate()
        slave.setReal(sigmas, [1.5] * len(sigmas))
        slave.setupExperiment(startTime=0.0)
        slave.enterInitializationMode()
        slave.exitInitializationMode()
        return slave

    def advance(slave, first, last):
        rows = []
        for n in range(first, last):
            slave.setReal(inputs, [10.0 * np.sin(n + k) + 20.0 for k in range(len(inputs))])
            slave.doStep(n * 0.1, 0.1)
            rows.append(slave.getReal(reals))
        return rows

    original, other = instance(1), instance(2)
    advance(original, 0, 37)
    advance(other, 0, 5)
    state = original.getFMUState()
    carried = original.serializeFMUState(state)
    expected = advance(original, 37, 80)
    original.setFMUState(state)
    assert advance(original, 37, 80) == expected
    original.freeFMUState(state)
    landed = other.deSerializeFMUstate(carried)
    other.setFMUState(landed)
    other.freeFMUState(landed)
    assert advance(other, 37, 80) == expected
    assert len({tuple(row) for row in expected}) > 1
    for slave in (original, other):
        slave.terminate()
        slave.freeInstance()
    shutil.rmtree(folder, ignore_errors=True)


def test_every_nth_row_and_the_last(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(component("ramp", "ramp"))))
    with Simulation(prepare_system(path, SystemOptions(stop_time=1.75))) as simulation:
        assert simulation.fly(every=3).time.tolist() == [0.0, 0.75, 1.5, 1.75]
        assert simulation.fly(every=7).time.tolist() == [0.0, 1.75]
        assert simulation.fly(every=100).time.tolist() == [0.0, 1.75]


def test_string_parameters_of_a_stranger(tiny, tmp_path):
    body = system(
        component("ramp", "ramp", "output y Real m"),
        component("odd", "stranger", "input u Real; output y Real; output length Real"),
        connections=connection("ramp.y", "odd.u"),
        bindings=external("resources/words.ssv"),
    )
    words = parameter_set("odd.word=String:three")
    path = pack(tmp_path / "s.ssp", tiny, document(body), resources___words__ssv=words)
    result = fly(path)
    assert result["odd.length"].tolist() == [5.0] * 5
    assert result["odd.y"].tolist() == [2.0, 2.0, 2.5, 3.0, 3.5]  # undeclared: u of the step's start
    with Simulation(prepare_system(path)) as simulation:
        for _ in range(2):
            assert simulation.fly()["odd.length"].tolist() == [5.0] * 5
    assert fly(path, set={"odd.word": "%s 100 %"})["odd.length"].tolist() == [8.0] * 5
