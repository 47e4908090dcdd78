"""FMI 3.0 functions of a native FMU, called by FMPy: life cycle, complete state, and responses to invalid calls.

Truth: the messages and values of FMI 2.0's functions (`test_native_interface.py`) and of the block in Python. Invalid
calls of all kinds are tested under sanitizers in `test_sanitizers.py`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi3 import FMU3Slave

from perilune.common.paths import CACHE
from perilune.fmus_src.block import Block, Input, Output, Parameter, State
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu
from perilune.fmus_src.kernel.enumerations import Enumeration, member
from perilune.fmus_src.kernel.vector_types import vector
from perilune.fmus_src.runtime import BlockInstance

pytestmark = pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")


class Way(Enumeration):
    """Direction of the walk."""

    STAY = member("stay")
    FORWARDS = member("forwards")


class VectorWalk(Block):
    """Adds its input to its sum at every sample."""

    gain = Parameter(1.0, description="factor")
    sample_period = Parameter(0.0, unit="s", description="sampling")
    x = Input([0.0, 0.0, 0.0], unit="m", description="what to add")
    k = Input(1, description="an int to multiply the product with")
    on = Input(True, description="whether to add")
    way = Input(Way, start=Way.FORWARDS, description="which way")
    total = Output([0.0, 0.0, 0.0], direct=True, unit="m", description="the sum")
    starts = Output([0.0, 0.0, 0.0], direct=True, unit="m", description="the input at the start")
    product = Output(1, direct=True, description="grows beyond 32 bits")
    last_way = Output(Way, direct=True, description="the way at the last sample")
    samples = State(0, description="samples last_way")
    start_time = State(0.0, unit="s", description="start of the flight")

    def initialize(self) -> None:
        self.starts = self.gain * self.x

    def step(self, t: float, h: float) -> None:
        if self.on and self.way == Way.FORWARDS:
            self.total = self.total + self.gain * self.x
        self.product = self.product * self.k
        self.last_way = self.way
        self.samples = self.samples + 1


class Walk:
    """An instance, with its variables by name and the messages of its log."""

    def __init__(self, path: Path, folder: str) -> None:
        description = fmpy.read_model_description(str(path))
        self.variables = {variable.name: variable for variable in description.modelVariables}
        self.log: list[str] = []
        self.slave = FMU3Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="walk",
        )
        self.slave.instantiate(logMessage=self.add_message, loggingOn=True)

    def add_message(self, environment: object, status: int, category: bytes, message: bytes) -> None:
        assert (status, category) == (3, b"logStatusError")
        self.log.append(message.decode())

    def get(self, name: str) -> Any:
        variable = self.variables[name]
        kind = {"Enumeration": "Int64"}.get(variable.type, variable.type)
        values = getattr(self.slave, f"get{kind}")([variable.valueReference], nValues=math.prod(variable.shape or ()))
        return values if variable.shape else values[0]

    def set(self, **values: Any) -> None:
        for name, settings in values.items():
            variable = self.variables[name]
            kind = {"Enumeration": "Int64"}.get(variable.type, variable.type)
            elements = list(settings) if variable.shape else [settings]
            getattr(self.slave, f"set{kind}")([variable.valueReference], elements)

    def start(self, time: float = 0.0) -> None:
        self.slave.enterInitializationMode(startTime=time)
        self.slave.exitInitializationMode()


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Return the FMU, and its unpacked folder."""
    folder = tmp_path_factory.mktemp("walk")
    platform = local_platform(3)
    assert platform is not None
    path = build_native_fmu(VectorWalk, folder / "vector_walk.fmu", platforms=[platform], cache=CACHE, fmi=3)
    return path, str(fmpy.extract(str(path), str(folder / "unpacked")))


@pytest.fixture
def walk(built: tuple[Path, str]) -> Iterator[Walk]:
    instance = Walk(*built)
    yield instance
    instance.slave.freeInstance()


def refuse(walk: Walk, message: str, call: Any, *arguments: Any, **named: Any) -> None:
    """Assert that the call ends with an error whose message contains this one."""
    with pytest.raises(FMICallException):
        call(*arguments, **named)
    assert message in walk.log[-1]


def test_reads_during_initialisation_settle_each_time(walk: Walk) -> None:
    walk.set(x=[2.0, 0.0, 1.0], gain=3.0)
    walk.slave.enterInitializationMode(startTime=5.0)
    assert walk.get("starts") == [6.0, 0.0, 3.0]
    assert (walk.get("start_time"), walk.get("time")) == (5.0, 5.0)
    walk.set(x=[4.0, 1.0, 0.0])
    assert walk.get("starts") == [12.0, 3.0, 0.0]
    walk.slave.exitInitializationMode()
    walk.set(x=[5.0, 5.0, 5.0])
    assert walk.get("starts") == [12.0, 3.0, 0.0]


def test_it_steps_as_the_block_in_python(walk: Walk) -> None:
    plain = BlockInstance(VectorWalk)
    plain.block.sample_period = 0.3
    walk.set(sample_period=0.3)
    plain.start()
    walk.start()
    for n in range(100):
        values = {"x": [0.1 * n, 1.0, -1.0], "on": n % 7 != 0, "way": int(n % 11 != 0), "k": -1}
        walk.set(**values)
        for name, settings in values.items():
            setattr(plain.block, name, vector(*settings) if name == "x" else settings)
        assert walk.slave.doStep(n * 0.1, 0.1) == (False, False, False, n * 0.1 + 0.1)
        plain.do_step(n * 0.1, 0.1)
        for name in ("total", "product", "last_way", "samples"):
            expected = getattr(plain.block, name)
            assert walk.get(name) == (list(expected) if name == "total" else expected)
        assert walk.get("time") == n * 0.1 + 0.1


def test_parameters_are_fixed_and_outputs_are_computed(walk: Walk) -> None:
    walk.slave.enterInitializationMode()
    refuse(walk, "fmi3SetFloat64: total is computed and cannot be set", walk.set, total=[0.0, 0.0, 0.0])
    walk.slave.exitInitializationMode()
    refuse(walk, "fmi3SetFloat64: gain is a parameter, fixed after initialisation", walk.set, gain=2.0)
    reference = walk.variables["time"].valueReference
    refuse(walk, "fmi3SetFloat64: time is the independent variable", walk.slave.setFloat64, [reference], [1.0])


def test_wrong_references_types_and_sizes_are_refused(walk: Walk) -> None:
    walk.start()
    x, k, way = (walk.variables[name].valueReference for name in ("x", "k", "way"))
    get, put = walk.slave.getFloat64, walk.slave.setFloat64
    refuse(walk, "fmi3GetFloat64: there is no variable with value reference 99", get, [99])
    refuse(walk, "fmi3GetFloat64: k is of type Int32", get, [k])
    refuse(
        walk, "fmi3GetInt32: way is of type Enumeration, which has the functions of Int64", walk.slave.getInt32, [way]
    )
    refuse(walk, "fmi3GetFloat64: the variables have 3 elements, nValues is 2", get, [x], nValues=2)
    refuse(walk, "fmi3SetFloat64: the variables have 3 elements, nValues is 4", put, [x], [0.0] * 4)
    refuse(walk, "fmi3GetString: there are no String variables", walk.slave.getString, [x])
    before = walk.get("x")
    refuse(walk, "fmi3SetFloat64: k is of type Int32", put, [x, k], [1.0, 2.0, 3.0, 4.0])
    assert walk.get("x") == before


def test_before_initialisation_starts_are_read(walk: Walk) -> None:
    """As FMI 3.0 allows; what was set, and the declared start of what is computed."""
    walk.set(x=[1.0, 2.0, 3.0])
    assert (walk.get("x"), walk.get("gain"), walk.get("product")) == ([1.0, 2.0, 3.0], 1.0, 1)


def test_nothing_is_logged_unless_the_importer_wants_it(built: tuple[Path, str]) -> None:
    walk = Walk(*built)
    walk.slave.fmi3SetDebugLogging(walk.slave.component, False, 0, None)
    with pytest.raises(FMICallException):
        walk.slave.doStep(0.0, 0.1)
    assert walk.log == []
    walk.slave.freeInstance()
    silent = FMU3Slave(
        guid=walk.slave.guid,
        unzipDirectory=walk.slave.unzipDirectory,
        modelIdentifier=walk.slave.modelIdentifier,
        instanceName="silent",
    )
    silent.instantiate(logMessage=walk.add_message)
    with pytest.raises(FMICallException):
        silent.doStep(0.0, 0.1)
    assert walk.log == []
    silent.freeInstance()


def test_several_variables_come_in_one_call(walk: Walk) -> None:
    walk.set(x=[1.0, 2.0, 3.0])
    walk.start(time=7.0)
    references = [walk.variables[name].valueReference for name in ("gain", "x", "time", "starts")]
    assert walk.slave.getFloat64(references, nValues=8) == [1.0, 1.0, 2.0, 3.0, 7.0, 1.0, 2.0, 3.0]


def test_calls_at_a_wrong_moment_are_refused(walk: Walk) -> None:
    refuse(walk, "fmi3DoStep is not allowed before initialisation", walk.slave.doStep, 0.0, 0.1)
    walk.start()
    refuse(walk, "fmi3EnterInitializationMode is not allowed between steps", walk.slave.enterInitializationMode)
    message = "StepError: the step begins at 0.1 s, and the FMU is at 0.0 s"
    refuse(walk, message, walk.slave.doStep, 0.1, 0.1)
    refuse(walk, "fmi3EnterEventMode: this FMU does not provide it", walk.slave.enterEventMode)


def test_a_step_past_the_stop_time_is_refused(walk: Walk) -> None:
    """Rounded sums of steps, which end a little after it, are not; after a reset there is none."""
    walk.slave.enterInitializationMode(startTime=0.0, stopTime=0.3)
    walk.slave.exitInitializationMode()
    walk.slave.doStep(0.0, 0.1)
    refuse(walk, "StepError: the step ends at 0.4 s, after the stop time of 0.3 s", walk.slave.doStep, 0.1, 0.3)
    walk.slave.doStep(0.1, 0.1)
    assert walk.slave.doStep(0.2, 0.1)[3] == 0.2 + 0.1 > 0.3
    refuse(walk, "after the stop time of 0.3 s", walk.slave.doStep, 0.2 + 0.1, 0.1)
    walk.slave.reset()
    walk.start()
    walk.slave.doStep(0.0, 0.5)


def test_a_step_beyond_the_largest_double_is_refused(walk: Walk) -> None:
    """Its end would be infinite, from where a step could begin at any point."""
    walk.start(time=1e308)
    refuse(walk, "communication point and step size must be finite", walk.slave.doStep, 1e308, 1e308)
    assert walk.get("time") == 1e308


def test_an_error_ends_the_run_until_reset_or_state(walk: Walk) -> None:
    walk.start()
    state = walk.slave.getFMUState()
    for n in range(3):
        walk.set(k=2**31 - 1)
        if n < 2:
            walk.slave.doStep(0.1 * n, 0.1)
    refuse(walk, "exceeds an FMI Int32's 32 bits", walk.get, "product")
    refuse(walk, "fmi3DoStep is not allowed after an error", walk.slave.doStep, 0.2, 0.1)
    walk.slave.setFMUState(state)
    walk.set(k=2**31 - 1)
    walk.slave.doStep(0.0, 0.1)
    walk.slave.doStep(0.1, 0.1)
    refuse(walk, "OverflowError: int beyond 64 bits, in the step from t = 0.2 s", walk.slave.doStep, 0.2, 0.1)
    assert "test_interface.py" in walk.log[-1]
    walk.slave.freeFMUState(state)
    walk.slave.reset()
    walk.start()
    assert walk.get("product") == 1


def test_a_state_goes_to_another_instance_as_bytes(walk: Walk, built: tuple[Path, str]) -> None:
    walk.set(x=[1.0, 2.0, 3.0])
    walk.start()
    walk.slave.doStep(0.0, 0.1)
    state = walk.slave.getFMUState()
    text = walk.slave.serializeFMUState(state)
    other = Walk(*built)
    copy = other.slave.deserializeFMUState(text)
    other.slave.setFMUState(copy)
    for instance in (walk, other):
        instance.slave.doStep(0.1, 0.1)
        assert instance.get("total") == [2.0, 4.0, 6.0]
        assert instance.get("samples") == 2
    words = memoryview(text).cast("d")
    assert list(words[8:11]) == [1.0, 2.0, 3.0]  # six words, gain, sample_period
    walk.slave.freeFMUState(state)
    other.slave.freeFMUState(copy)
    refuse(other, "the bytes are not a state of this FMU", other.slave.deserializeFMUState, text[:-8])
    other.slave.freeInstance()


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"guid": "{1}"}, "the instantiation token is not that of this binary"),
        ({"instanceName": ""}, "the instance name is NULL or blank"),
        ({"instanceName": " \t"}, "the instance name is NULL or blank"),
        ({"events": True}, "this FMU has no event mode"),
    ],
)
def test_instantiation_refuses_wrong_arguments(walk: Walk, wrong: dict[str, Any], message: str) -> None:
    events = wrong.pop("events", False)
    other = FMU3Slave(
        **{
            "guid": walk.slave.guid,
            "unzipDirectory": walk.slave.unzipDirectory,
            "modelIdentifier": walk.slave.modelIdentifier,
            "instanceName": "other",
            **wrong,
        }
    )
    with pytest.raises(Exception, match="Failed to instantiate FMU"):
        other.instantiate(logMessage=walk.add_message, eventModeUsed=events)
    assert message in walk.log[-1]
