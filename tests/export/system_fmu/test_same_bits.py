"""System as one FMU, simulated by FMPy: equal to the system of component FMUs, to the last bit.

Truth: the system simulated by Perilune from the FMUs of its components, instruction by instruction.
"""

import shutil

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import perilune
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import component, connection, document, pack, system
from tests.support.graphs.small_blocks import graphs
from tests.support.lengths import either
from tests.support.native.system_fmus import Slave, build_one, fly_one
from tests.support.native.toolbox import find_semantic_errors

STEP = 0.25  # s, of the small systems


@settings(max_examples=either(200, 4), deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(graph=graphs())
def test_random_graphs(tiny_folder, tmp_path_factory, graph):
    """Faults are inputs: set before the step that ends in their window, they hold for what is exchanged at its end."""
    ssd, values, faults, _, algorithm = graph
    faults = list({fault.name: fault for fault in faults}.values())
    folder = tmp_path_factory.mktemp("graph")
    path = pack(folder / "graph.ssp", tiny_folder / "native", ssd)
    prepared = prepare_system(path, SystemOptions(flavour="native", set=values, algorithm=algorithm))
    with Simulation(prepared, faults=faults) as simulation:
        native = simulation.fly()
        names = [fault.name for fault in faults]
        tuned = [name for name in names if name.rpartition(".")[2] in ("slope", "flag_at", "factor")]
        exposed = [name for name in native.signals if "." in name and name not in tuned]
        fmu = build_one(folder / "one.fmu", path, exposed=exposed, faulty=names, set=values, algorithm=algorithm)
        assert validate_fmu(str(fmu)) == []
        kinds = {"override": 1, "bias": 2, "freeze": 3}

        def at(time: float) -> dict[str, float]:
            active = {fault: fault.start - 1e-9 <= time < fault.stop - 1e-9 for fault in faults}
            assigned = {f"fault.{fault.name}.kind": kinds[fault.kind] * active[fault] for fault in faults}
            return assigned | {f"fault.{fault.name}.value": fault.value for fault in faults}

        rows, ended = [], False
        try:
            slave = Slave(fmu, folder / "unzipped", **at(0.0))
            rows.append([slave.get(name) for name in exposed])
            while len(rows) < len(native.time) or (native.status == "stop_time" and slave.time < 2.0):
                slave.set(at(slave.time + STEP))
                slave.step(STEP)
                rows.append([slave.get(name) for name in exposed])
            if native.status != "stop_time":
                slave.set(at(slave.time + STEP))
                slave.step(STEP)
        except FMICallException:
            ended = True
    assert ended == (native.status != "stop_time")
    assert len(rows) == len(native.time)
    for column, name in enumerate(exposed):
        flown = np.array([row[column] for row in rows], dtype=float)
        assert np.array_equal(flown, native[name], equal_nan=True), name
    shutil.rmtree(folder)


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("name", either(system_names(), ["orbital_attitude"]))
def test_whole_systems(tmp_path, name):
    """Every exchanged signal; behind the system's end all values stay."""
    native = perilune.simulate(name, flavour="native")
    exposed = [signal for signal in native.signals if "." in signal]
    fmu = build_one(tmp_path / "one.fmu", name, exposed=exposed)
    assert validate_fmu(str(fmu)) == []
    assert find_semantic_errors(fmu) == []
    flown = fly_one(fmu)
    end = len(native.time)
    inputs = {each.name for each in fmpy.read_model_description(str(fmu)).modelVariables if each.causality == "input"}
    for signal in native.signals.keys() - inputs:
        assert np.array_equal(flown[signal][:end], native[signal]), signal
        assert np.all(flown[signal][end:] == flown[signal][end - 1]), signal
    assert len(flown["time"]) == end or native.status == "finished"


@pytest.mark.usefixtures("fmus")
def test_every_candidate_of_a_slot(tmp_path):
    """Candidates of different connectors and orders; the first is the system's own."""
    guidances = ["analytic_guidance", "astar_guidance"]
    guidances += either(["astar_robust_guidance", "analytic_exact_guidance", "astar_modified_guidance"], [])
    navigations = ["noisy_navigation", "kalman_navigation"]
    exposed = ["plant.position", "guidance.time_to_go"]
    slots = {"guidance": guidances, "navigation": navigations}
    fmu = build_one(tmp_path / "one.fmu", "lunar_terminal_guidance", slots, exposed)
    for number, guidance in enumerate(guidances, 1):
        for other, navigation in enumerate(navigations, 1):
            use = {"guidance": guidance, "navigation": navigation}
            native = perilune.simulate("lunar_terminal_guidance", use=use, flavour="native")
            flown = fly_one(fmu, {"guidance.use": number, "navigation.use": other})
            for name in ("plant.position[1]", "plant.position[3]", "guidance.time_to_go"):
                assert np.array_equal(flown[name][: len(native.time)], native[name]), (use, name)


@pytest.mark.usefixtures("fmus")
def test_parameter_sets_and_single_values(tmp_path):
    """Applied ones are the starts; another one has what it would change."""
    fmu = build_one(tmp_path / "one.fmu", "lunar_terminal_guidance", exposed=["plant.position"], parameters=("noisy",))
    native = perilune.simulate("lunar_terminal_guidance", parameters=["noisy"], set={"navigation.seed": 7})
    flown = fly_one(fmu, {"navigation.seed": 7})
    assert np.array_equal(flown["plant.position[1]"][: len(native.time)], native["plant.position[1]"])


INPUTS = document(
    system(
        component("gain", "gain", "input u Real m; output y Real m"),
        component("delay", "delay", "input u Real m; output y Real m"),
        component("whole", "whole", "input n Integer; input b Boolean; output m Integer; output c Boolean"),
        connections=connection("u", "gain.u")
        + connection("u", "delay.u", '<ssc:LinearTransformation factor="-2" offset="1"/>')
        + connection("n", "whole.n")
        + connection("b", "whole.b")
        + connection("gain.y", "direct")
        + connection("delay.y", "late")
        + connection("whole.m", "m")
        + connection("whole.c", "c"),
        declared="input u Real m; input n Integer; input b Boolean; output direct Real m; output late Real m; "
        "output m Integer; output c Boolean",
    ),
    stop=2.0,
)


@given(
    values=st.lists(st.floats(-1e3, 1e3), min_size=8, max_size=8),
    whole=st.lists(st.integers(-9, 9), min_size=8, max_size=8),
)
@settings(max_examples=10, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_inputs_are_held_over_a_step(one_with_inputs, values, whole):
    """Closed form: gain.y = 3 u at once, delay.y what its input was, which is -2 u + 1, in the step before."""
    slave = one_with_inputs
    slave.fmu.reset()
    slave.initialise(u=values[0], n=whole[0], b=whole[0] > 0)
    assert (slave.get("direct"), slave.get("late")) == (3.0 * values[0], 5.0)
    for u, n in zip(values, whole, strict=True):
        slave.set({"u": u, "n": n, "b": n > 0})
        slave.step(STEP)
        assert (slave.get("direct"), slave.get("late")) == (3.0 * u, u * -2.0 + 1.0)
        assert (slave.get("m"), bool(slave.get("c"))) == (n, n > 0)


@pytest.fixture(scope="module")
def one_with_inputs(tiny_folder, tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    path = pack(folder / "inputs.ssp", tiny_folder / "native", INPUTS)
    return Slave(build_one(folder / "one.fmu", path), folder / "unzipped")


def test_direct_dependence_is_declared(one_with_inputs):
    outputs = {each.variable.name: each for each in one_with_inputs.description.outputs}
    named = {name: {each.name for each in unknown.dependencies} for name, unknown in outputs.items()}
    assert named == {"direct": {"u"}, "late": set(), "m": {"n", "b"}, "c": {"n", "b"}}


def test_inputs_of_nested_systems(tiny_folder, tmp_path):
    """Closed form: 3 u, through a system inside."""
    inner = system(
        component("gain", "gain", "input u Real m; output y Real m"),
        connections=connection("u", "gain.u") + connection("gain.y", "y"),
        declared="input u Real m; output y Real m",
        name="inner",
    )
    ssd = document(
        system(
            inner,
            connections=connection("u", "inner.u") + connection("inner.y", "y"),
            declared="input u Real m; output y Real m",
        )
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", ssd)
    slave = Slave(build_one(tmp_path / "one.fmu", path), tmp_path / "one", u=2.0)
    assert {name for name, each in slave.variables.items() if each.causality == "input"} == {"u"}
    assert slave.get("y") == 6.0
    slave.set({"u": -1.5})
    slave.step(STEP)
    assert slave.get("y") == -4.5


def test_names_that_the_wrapper_has(tmp_path):
    """Blocks called as files of the wrapper, components as words of C."""
    file = tmp_path / "blocks.py"
    file.write_text(BLOCKS)
    build_own_blocks(file, tmp_path / "fmus", ["native"], [local_platform()])
    ssd = document(
        system(
            component("switch", "instance", "output y Real"),
            component("signal", "sampling", "input u Real; output y Real"),
            connections=connection("switch.y", "signal.u") + connection("signal.y", "out"),
            declared="output out Real",
        )
    )
    path = pack(tmp_path / "s.ssp", tmp_path / "fmus" / "native", ssd)
    slave = Slave(build_one(tmp_path / "one.fmu", path), tmp_path / "one")
    slave.step(STEP)
    assert slave.get("out") == 6.0


BLOCKS = '''
"""Blocks with names of the wrapper."""

from perilune import Block, Input, Output


class Instance(Block):
    """y = 3."""

    y = Output(3.0, description="three")

    def initialize(self) -> None:
        self.y = 3.0

    def step(self, t: float, h: float) -> None:
        self.y = 3.0


class Sampling(Block):
    """y = 2 u."""

    u = Input(0.0, description="input")
    y = Output(0.0, direct=True, description="output")

    def initialize(self) -> None:
        self.y = 2.0 * self.u

    def step(self, t: float, h: float) -> None:
        self.y = 2.0 * self.u
'''
