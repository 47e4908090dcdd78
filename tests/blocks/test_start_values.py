"""FMUs reject parameters outside their declared bounds, values that are not finite, and steps of excessive duration.

Truth: the declarations, the numbers that are set, and equal messages of all forms: Python object, pythonfmu FMU, native
FMUs of FMI 2.0 and 3.0. Systems as one FMU are tested in export/system_fmu/test_start_values.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave

from perilune.analysis.runtime.instances.instance import instantiate
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.common.paths import CACHE
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.runtime import BlockInstance, StepError
from perilune.fmus_src.start_values import StartError
from tests.support.kernels.native_instance import ERROR, OK, NativeInstance, library
from tests.support.kernels.users_blocks import Bounded

NAMES = [name for variable in Bounded.variables.values() for name in variable.element_names()]
WRONG = {
    ("internal_step", 1e-6): "internal_step = 1e-06 is below its minimum 0.0001",
    ("internal_step", 0.0): "internal_step = 0.0 is below its minimum 0.0001",
    ("fraction", 1.5): "fraction = 1.5 is above its maximum 1.0",
    ("axes[2]", -2.0): "axes[2] = -2.0 is below its minimum -1.0",
    ("table[2,1]", 10.0): "table[2,1] = 10.0 is above its maximum 9.0",
    ("table[1,2]", -math.inf): "table[1,2] = -inf is not finite",
    ("free", math.nan): "free = nan is not finite",
    ("count", 6): "count = 6 is above its maximum 5",
    ("count", -1): "count = -1 is below its minimum 0",
    ("u", math.inf): "u = inf is not finite",
    ("w[2]", math.nan): "w[2] = nan is not finite",
}
RIGHT = {"u": 7.0, "fraction": 1.0, "axes[1]": -1.0, "free": 1e300, "count": 0, "internal_step": 1e-4}


@pytest.fixture(scope="module")
def fmi3(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, str]:
    """Return the description of the FMU of FMI 3.0, and its unpacked folder."""
    platform = local_platform(3)
    if platform is None:
        pytest.skip("FMI 3.0 libraries are not compiled for this system")
    folder = tmp_path_factory.mktemp("fmi3")
    path = build_native_fmu(Bounded, folder / "bounded.fmu", platforms=[platform], cache=CACHE, fmi=3)
    return fmpy.read_model_description(str(path)), str(fmpy.extract(str(path), str(folder / "unpacked")))


@pytest.fixture
def native() -> Iterator[NativeInstance]:
    instance = NativeInstance(Bounded, dll=library(Bounded))
    yield instance
    instance.free()


def plain_with(**values: float) -> BlockInstance:
    component = BlockInstance(Bounded)
    component.set([NAMES.index(name) for name in values], list(values.values()))
    return component


@pytest.mark.parametrize(("name", "number"), WRONG)
def test_a_block_does_not_start_with_a_wrong_value_and_says_which(
    name: str, number: float, native: NativeInstance
) -> None:
    message = WRONG[name, number]
    with pytest.raises(StartError) as error:
        plain_with(**{name: number}).start()
    assert str(error.value) == message
    assert native.set([NAMES.index(name)], [number]) == OK
    native.enter()
    assert native.start() == ERROR
    assert native.log == [f"StartError: {message}"]
    assert native.start() == ERROR
    assert "after an error" in native.log[-1]


def test_a_value_that_is_set_during_initialisation_is_compared_too(native: NativeInstance) -> None:
    """The next read settles the instance, and is refused in place of an initialisation that would not end."""
    native.enter()
    assert native.set([NAMES.index("internal_step")], [1e-9]) == OK
    assert native.get([NAMES.index("y")]) is None
    assert native.log == ["StartError: internal_step = 1e-09 is below its minimum 0.0001"]
    component = plain_with(internal_step=1e-9)
    with pytest.raises(StartError):
        component.get([NAMES.index("y")])


def test_bounds_themselves_and_inputs_beyond_theirs_are_taken(native: NativeInstance) -> None:
    component = plain_with(**RIGHT)
    component.start()
    native.set([NAMES.index(name) for name in RIGHT], list(RIGHT.values()))
    native.enter()
    assert native.start() == OK
    assert native.get(list(range(len(NAMES)))) == component.values()
    for number in (math.inf, math.nan):  # between steps inputs cost no comparison
        assert native.set([NAMES.index("u")], [number]) == OK


def test_the_python_fmu_says_the_same(tmp_path: Path) -> None:
    path = build_python_fmu(Bounded, tmp_path / "bounded.fmu")
    instance = instantiate(load_fmu(path.read_bytes(), str(path)), "bounded")
    instance.slave.setupExperiment(startTime=0.0)
    instance.slave.enterInitializationMode()
    instance.slave.setReal([NAMES.index("axes[2]")], [-2.0])
    with pytest.raises(FMICallException):
        instance.slave.exitInitializationMode()
    assert f"StartError: {WRONG['axes[2]', -2.0]}" in "\n".join(instance.messages)
    instance.abandon()  # pythonfmu's error is fmi2Fatal, after which no call is allowed


@pytest.mark.parametrize(("name", "number"), WRONG)
def test_the_fmu_of_fmi_3_says_the_same(name: str, number: float, fmi3: tuple[Any, str]) -> None:
    description, folder = fmi3
    log: list[str] = []
    slave = FMU3Slave(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="bounded",
    )
    slave.instantiate(logMessage=lambda *arguments: log.append(arguments[3].decode()), loggingOn=True)
    variable = next(each for each in description.modelVariables if each.name == name.partition("[")[0])
    declared = Bounded.variables[variable.name]
    values = list(declared.elements)
    values[declared.element_names().index(name)] = number
    getattr(slave, f"set{variable.type}")([variable.valueReference], values)
    slave.enterInitializationMode(startTime=0.0)
    with pytest.raises(FMICallException):
        slave.exitInitializationMode()
    assert log == [f"StartError: {WRONG[name, number]}"]
    slave.freeInstance()


PLANTS = [name for name, block in catalogue().items() if "internal_step" in block.variables and not block.python_only]


@pytest.mark.parametrize("name", PLANTS)
def test_a_step_of_a_million_seconds_is_refused_by_every_plant_in_place_of_taking_all_night(name: str) -> None:
    block = catalogue()[name]
    component = BlockInstance(block)
    component.start()
    with pytest.raises(StepError) as error:
        component.do_step(0.0, 1e6)
    assert "communication step 1000000.0 s holds more than 1000000 integration steps of 0." in str(error.value)
    native = NativeInstance(block)
    native.enter()
    assert native.start() == OK
    assert native.do_step(0.0, 1e6) == ERROR
    assert native.log == [f"StepError: {error.value}"]
    native.free()


def test_the_step_that_a_lander_takes_for_a_short_lag_counts() -> None:
    """A hundredth of internal_step: 2000 s hold two million of them."""
    component = BlockInstance(catalogue()["spherical_moon_lander"])
    names = list(component.block.variables)
    first = sum(component.block.variables[name].size for name in names[: names.index("thrust_lag")])
    component.set([first], [1e-3])
    component.start()
    with pytest.raises(StepError, match=r"step 2000\.0 s holds more than 1000000 integration steps of 0\.001 s"):
        component.do_step(0.0, 2000.0)


@pytest.mark.parametrize("step", [1e5, math.nextafter(1e5, math.inf)])
def test_a_million_integration_steps_are_taken_and_one_more_is_not(step: float, native: NativeInstance) -> None:
    component = plain_with()
    component.start()
    native.enter()
    native.start()
    calls: list[Callable[[], object]] = [lambda: component.do_step(0.0, step), lambda: native.do_step(0.0, step)]
    if step == 1e5:
        assert [call() for call in calls] == [None, OK]
        assert component.block.y == 1_000_000.0
    else:
        with pytest.raises(
            StepError, match=r"step 100000\.0000000\d+ s holds more than 1000000 integration steps of 0\.1 s"
        ):
            calls[0]()
        assert calls[1]() == ERROR
