"""Tunable parameters set between steps, in all forms of a block.

Truth: the saved state of the same moment with the parameter's number replaced in its bytes, restored and simulated
further: equal bit for bit. `make long` tests every tunable parameter of every block, `make test` the tunable parameters
of some blocks.
"""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path
from typing import Any

import pytest
from fmpy.fmi1 import FMICallException

from perilune.analysis.runtime.instances.instance import instantiate
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.common.paths import CACHE, shipped_fmu
from perilune.fmus_src.block import Block, Input
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.evidence.check import read_check
from perilune.fmus_src.evidence.recorded import of_type
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.judge.tunable import tunable_parameters
from perilune.fmus_src.export.native_fmu import build_native_fmu
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.runtime import BlockInstance
from perilune.fmus_src.start_values import TuningError
from tests.support.kernels.comparison import another, bits
from tests.support.kernels.native_instance import ERROR, OK, NativeInstance, library
from tests.support.kernels.users_blocks import Gains
from tests.support.lengths import either
from tests.support.native.building import NATIVE, fmi3_fmu
from tests.support.native.instances import Fmi2Fmu, Fmi3Fmu, PlainBlock, Settings

AHEAD = 6  # steps after the parameter is set
SAMPLE = ("thrust_allocation", "quaternion_feedback", "slew_quintic")  # Reals, vectors, matrices, Integers, Booleans


NAMES = [name for variable in Gains.variables.values() for name in variable.element_names()]
GAINS = {name: number for number, name in enumerate(NAMES)}
WRONG = {
    ("gain", -1.0): "gain = -1.0 is below its minimum 0.0",
    ("gain", float("nan")): "gain = nan is not finite",
    ("axes[2]", -6.5): "axes[2] = -6.5 is below its minimum -5.0",
    ("count", 6): "count = 6 is above its maximum 5",
    ("offset", 1.0): "offset is a parameter, fixed after initialisation",
    ("total", 1.0): "total is computed and cannot be set",
}


def instances_of(block: type[Block], folder: Path) -> list[Any]:
    """Return instances of a block of the catalogue, those of FMUs from the built ones."""
    instances: list[Any] = [PlainBlock(block)]
    if block.fmu_name in NATIVE:
        instances.append(Fmi2Fmu(block, shipped_fmu(block.fmu_name, "native"), folder / "native"))
        if local_platform(3) is not None:
            instances.append(Fmi3Fmu(block, fmi3_fmu(block), folder / "fmi3"))
    instances.append(Fmi2Fmu(block, shipped_fmu(block.fmu_name, "python"), folder / "python"))
    return instances


def fly_check(block: type[Block], instance: Any) -> tuple[int, list[Settings], float]:
    """Fly the first half of a block's check: the row that is reached, inputs of all rows, step (s)."""
    check = read_check(block)
    assert check is not None
    elements = [(name, each) for each in block.variables.values() for name in each.element_names()]
    references = {name: number for number, (name, _) in enumerate(elements)}
    variables = dict(elements)
    rows: list[Settings] = [
        {references[name]: of_type(variables[name], float(text)) for name, text in row.items()
         if isinstance(variables.get(name), Input)}
        for row in csv.DictReader(io.StringIO(check.table.decode()))
    ]  # fmt: skip
    instance.set({references[name]: of_type(variables[name], each) for name, each in check.parameters.items()})
    instance.enter()
    instance.set(rows[0])
    instance.start()
    middle = min(len(rows) // 2, 200)
    for n in range(middle):
        instance.set(rows[n])
        instance.step(n * check.step, check.step)
    return middle, rows, check.step


def fly_on(instance: Any, begin: int, rows: list[Settings], step: float) -> list[bytes]:
    """Return the values after each further step, up to the first that fails, which stands as the end."""
    points = []
    for n in range(begin, min(begin + AHEAD, len(rows) - 1)):
        instance.set(rows[n])
        try:
            instance.step(n * step, step)
        except (FMICallException, ArithmeticError, ValueError):
            return [*points, b"failed"]
        points.append(bits(instance.values()))
    return points


@pytest.mark.parametrize("name", either(list(catalogue()), SAMPLE))
@pytest.mark.usefixtures("fmus")
def test_a_parameter_set_between_steps_is_one_replaced_in_the_state(name: str, tmp_path: Path) -> None:
    block = catalogue()[name]
    tunable = tunable_parameters(block)
    if not tunable:
        pytest.skip("no parameter of this block is tunable")
    flights: list[dict[str, list[bytes]]] = []
    for instance in instances_of(block, tmp_path):
        middle, rows, step = fly_check(block, instance)
        saved = instance.save()
        flown = {"": fly_on(instance, middle, rows, step)}
        first = 0
        for parameter, variable in block.variables.items():
            if parameter in tunable:
                instance.restore(saved)
                now = instance.values()[first : first + variable.size]
                settings = {first + k: another(each, variable.minimum, variable.maximum) for k, each in enumerate(now)}
                before = instance.values()
                instance.set(settings)
                changed = [number for k, number in enumerate(instance.values()) if k not in settings]
                assert bits(changed) == bits([number for k, number in enumerate(before) if k not in settings])
                flown[parameter] = fly_on(instance, middle, rows, step)
                instance.restore(instance.replace(saved, settings))
                assert fly_on(instance, middle, rows, step) == flown[parameter], parameter
            first += variable.size
        instance.restore(saved)
        assert fly_on(instance, middle, rows, step) == flown[""]
        instance.restore(saved)
        instance.free()
        flights.append(flown)
    assert all(each == flights[0] for each in flights[1:])


def test_the_next_step_reads_what_was_set_and_outputs_stand_till_then() -> None:
    """1 + 3 after a step; then twice (2 * 4 * 1 + 5) more, at once nothing."""
    plain, native = BlockInstance(Gains, tunable_parameters(Gains)), NativeInstance(Gains, dll=library(Gains))
    settings = {GAINS["gain"]: 2.0, GAINS["axes[1]"]: 4.0, GAINS["axes[2]"]: 5.0, GAINS["count"]: 2}
    plain.start()
    native.enter()
    assert native.start() == OK
    totals = []
    for n in range(3):
        if n == 1:
            plain.set(list(settings), list(settings.values()))
            assert native.set(list(settings), list(settings.values())) == OK
        if n == 2:
            plain.set([GAINS["on"]], [False])
            assert native.set([GAINS["on"]], [False]) == OK
        totals.append(plain.get([GAINS["total"]])[0])
        assert native.get([GAINS["total"]]) == totals[-1:]
        plain.do_step(0.1 * n, 0.1)
        assert native.do_step(0.1 * n, 0.1) == OK
    totals.append(plain.get([GAINS["total"]])[0])
    assert totals == [3.0, 6.0, 32.0, 32.0]
    assert native.get([GAINS["total"]]) == [32.0]
    native.free()


@pytest.mark.parametrize(("name", "number"), WRONG)
def test_what_cannot_be_set_is_refused_by_name_and_nothing_is_set(name: str, number: float) -> None:
    """Also where it stands behind one that could be."""
    plain, native = BlockInstance(Gains, tunable_parameters(Gains)), NativeInstance(Gains, dll=library(Gains))
    plain.start()
    native.enter()
    native.start()
    before = plain.values()
    with pytest.raises(TuningError, match=f"^{re.escape(WRONG[name, number])}$"):
        plain.set([GAINS["x"], GAINS[name]], [5.0, number])
    assert plain.values() == before
    assert native.set([GAINS[name]], [number]) == ERROR
    kind = "Integer" if name == "count" else "Real"
    assert native.log == [f"fmi2Set{kind}: {WRONG[name, number]}"]
    assert native.get(list(range(len(NAMES)))) == before
    assert native.do_step(0.0, 0.1) == OK  # the instance continues
    native.free()


@pytest.mark.parametrize(("name", "number"), list(WRONG)[::2])
def test_the_python_fmu_says_the_same(name: str, number: float, tmp_path: Path) -> None:
    path = build_python_fmu(Gains, tmp_path / "gains.fmu")
    instance = instantiate(load_fmu(path.read_bytes(), str(path)), "gains")
    slave: Any = instance.slave
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    slave.setReal([GAINS["gain"], GAINS["axes[2]"]], [2.0, 0.5])
    slave.doStep(0.0, 0.1)
    assert slave.getReal([GAINS["total"]]) == [5.5]
    with pytest.raises(FMICallException):
        slave.setReal([GAINS[name]], [number])
    assert f"TuningError: {WRONG[name, number]}" in "\n".join(instance.messages)
    instance.abandon()  # pythonfmu's error is fmi2Fatal, after which no call is allowed


@pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
def test_the_fmu_of_fmi_3_says_the_same(tmp_path: Path) -> None:
    platform = local_platform(3)
    assert platform is not None
    path = build_native_fmu(Gains, tmp_path / "gains.fmu", platforms=[platform], cache=CACHE, fmi=3)
    log: list[str] = []
    instance = Fmi3Fmu(Gains, path, tmp_path / "unpacked", log)
    instance.enter()
    instance.start()
    before = instance.values()
    for (name, number), message in WRONG.items():
        with pytest.raises(FMICallException):
            instance.set({GAINS[name]: number})
        kind = "Int32" if name == "count" else "Float64"
        assert log.pop() == f"fmi3Set{kind}: {message}"
        assert bits(instance.values()) == bits(before)
    instance.set({GAINS["gain"]: 2.0, GAINS["axes[2]"]: 0.5, GAINS["count"]: 2, GAINS["on"]: True})
    instance.step(0.0, 0.1)
    assert instance.values()[GAINS["total"]] == 8.0
    instance.free()
