"""FMUs of FMI 3.0 in the FMU Manipulation Toolbox 2.0: a container of FMI 3.0, and the toolbox's checks and compiler.

Truth: the blocks in Python, stepped in the order of the container (Jacobi: all with the values of the last exchange,
then all are read). Two blocks are connected terminal to terminal. Containers describe start values of arrays by an
element that is not in the standard's schema, so FMPy reads them without validation.
"""

from __future__ import annotations

import json
import logging
import shutil
import zipfile
from pathlib import Path
from typing import Any

import fmpy
import pytest
from fmpy.fmi3 import FMU3Slave

from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.runtime import BlockInstance
from tests.support.lengths import either, generator
from tests.support.native.building import COMPILED, fmi3_fmu
from tests.support.native.toolbox import find_semantic_errors

assembly = pytest.importorskip("fmu_manipulation_toolbox.assembly")
compiler = pytest.importorskip("fmu_manipulation_toolbox.compiler")
operations = pytest.importorskip("fmu_manipulation_toolbox.operations")

pytestmark = pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
STEP = 0.125  # s
GUIDANCE, SWITCH = catalogue()["analytic_guidance"], catalogue()["command_switch"]


@pytest.fixture(autouse=True)
def quiet() -> None:
    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.ERROR)


def make_container(folder: Path) -> Path:
    """Write a container with the guidance's command on the switch's braking terminal; all else is the container's."""
    for block in (GUIDANCE, SWITCH):
        shutil.copy(fmi3_fmu(block), folder / f"{block.fmu_name}.fmu")
    guidance, switch = (f"{block.fmu_name}.fmu" for block in (GUIDANCE, SWITCH))
    described = {
        "fmu": [guidance, switch],
        "step_size": STEP,
        "auto_link": False,
        "auto_local": True,
        "link": [[guidance, "command", switch, "braking"]],
    }
    (folder / "container.json").write_text(json.dumps(described))
    created = assembly.Assembly("container.json", fmu_directory=folder, default_step_size=STEP)
    created.make_fmu(fmi_version=3)
    return folder / "container.fmu"


class Jacobi:
    """The two blocks in Python; inputs and outputs by the names that the container gives them."""

    def __init__(self) -> None:
        self.guidance, self.switch = BlockInstance(GUIDANCE), BlockInstance(SWITCH)

    def set(self, name: str, values: Any) -> None:
        for component in (self.guidance, self.switch):
            if name in component.block.variables:
                setattr(component.block, name, values)
                return
        raise KeyError(name)

    def exchange(self) -> None:
        for member, name in SWITCH.bundles["braking"].names.items():
            setattr(self.switch.block, name, getattr(self.guidance.block, member))

    def start(self) -> None:
        self.guidance.start()
        self.exchange()
        self.switch.start()

    def step(self, t: float) -> None:
        self.guidance.do_step(t, STEP)
        self.switch.do_step(t, STEP)
        self.exchange()


def elements(values: Any) -> list:
    return list(values) if hasattr(values, "__len__") else [values]


def test_a_container_has_the_bits_of_its_blocks(tmp_path: Path) -> None:
    container = make_container(tmp_path)
    description = fmpy.read_model_description(str(container), validate=False)
    variables = {variable.name: variable for variable in description.modelVariables}
    assert not [name for name in variables if name.startswith("braking_")]  # which the terminal connects
    slave = FMU3Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(container), str(tmp_path / "unpacked")),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="container",
    )
    ours, random = Jacobi(), generator("container of FMI 3.0")

    def set_both(name: str, given: Any) -> None:
        variable = variables[name]
        getattr(slave, f"set{variable.type}")([variable.valueReference], elements(given))
        ours.set(name, given)

    def theirs(name: str, size: int) -> list:
        variable = variables[name]
        return getattr(slave, f"get{variable.type}")([variable.valueReference], nValues=size)

    def set_inputs(n: int) -> None:
        set_both("position", [random.uniform(-1e4, 1e4) for _ in range(3)])
        set_both("velocity", [random.uniform(-100.0, 100.0) for _ in range(3)])
        set_both("mass", random.uniform(100.0, 1000.0))
        set_both("own_thrust_direction", [random.uniform(-1.0, 1.0) for _ in range(3)])
        set_both("source", (2, 1, 2, 2)[n % 4])
        set_both("engine_on", n % 5 != 4)

    slave.instantiate()
    slave.enterInitializationMode(startTime=0.0)
    set_inputs(0)
    slave.exitInitializationMode()
    ours.start()
    nonzero = set()
    for n in range(40):
        set_inputs(n)
        slave.doStep(n * STEP, STEP)
        ours.step(n * STEP)
        for component in (ours.guidance, ours.switch):
            block = component.block
            for name in (name for name, each in block.variables.items() if each.causality == "output"):
                # what is connected inside is a local variable of the container
                inside = f"{block.fmu_name}.{name}"
                expected = elements(getattr(block, name))
                actual = theirs(inside if inside in variables else name, len(expected))
                assert list(map(repr, map(float, actual))) == list(map(repr, map(float, expected))), (n, inside)
                nonzero |= {inside} if any(expected) else set()
    assert {"command_switch.thrust_acceleration", "analytic_guidance.time_to_go"} <= nonzero
    slave.terminate()
    slave.freeInstance()


@pytest.mark.parametrize("name", COMPILED[:: either(1, 4)])
def test_its_semantic_checks_find_nothing(name: str) -> None:
    assert find_semantic_errors(fmi3_fmu(catalogue()[name])) == []


def test_it_compiles_the_sources_by_the_build_description(tmp_path: Path) -> None:
    """Without its binaries, an FMU is compiled for this machine, and flies as before."""
    path = tmp_path / "forming_filter.fmu"
    built = fmi3_fmu(catalogue()["forming_filter"])
    with zipfile.ZipFile(built) as archive, zipfile.ZipFile(path, "w") as target:
        for name in archive.namelist():
            if not name.startswith("binaries/"):
                target.writestr(name, archive.read(name))
    fmu = operations.FMU(str(path))
    fmu.apply_operation(compiler.OperationCompileSources())
    fmu.repack(str(tmp_path / "compiled.fmu"))
    arguments = {"stop_time": 2.0, "output": ["disturbance", "generator"]}
    expected = fmpy.simulate_fmu(str(built), **arguments)
    actual = fmpy.simulate_fmu(str(tmp_path / "compiled.fmu"), **arguments)
    assert actual.tobytes() == expected.tobytes()
