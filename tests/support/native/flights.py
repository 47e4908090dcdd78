"""Simulation of a block's check by FMPy's calls, in FMI 2.0 element by element and in FMI 3.0 with arrays.

FMPy's `simulate_fmu` stacks the inputs of a type, which requires equal sizes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

Values = dict[str, list[float | int | bool]]  # all elements of a variable in order, under its name without index
Row = Mapping[str, float]  # elements by their names in FMI 2.0


class Flown:
    """Record of a simulation: the values of all variables at each point, and the complete state at the end."""

    def __init__(self) -> None:
        self.points: list[Values] = []
        self.state = b""


def fly_fmi2(fmu: Path, parameters: Row, inputs: Sequence[Row], step: float, folder: Path) -> Flown:
    """Simulate in FMI 2.0, each step from the values of its row of ``inputs``."""
    description = fmpy.read_model_description(str(fmu), validate=False)
    variables = {variable.name: variable for variable in description.modelVariables}
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(fmu), str(folder)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="fmi2",
    )

    def set_elements(values: Row) -> None:
        for name, number in values.items():
            kind, python = FMI2_FUNCTIONS[variables[name].type]
            getattr(slave, f"set{kind}")([variables[name].valueReference], [python(number)])

    def get_all() -> Values:
        values: Values = {}
        for variable in description.modelVariables:
            (number,) = getattr(slave, f"get{FMI2_FUNCTIONS[variable.type][0]}")([variable.valueReference])
            values.setdefault(variable.name.partition("[")[0], []).append(number)
        return values

    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    set_elements(parameters)
    slave.enterInitializationMode()
    set_elements(inputs[0])
    slave.exitInitializationMode()
    flown = Flown()
    flown.points.append(get_all())
    for n, row in enumerate(inputs[:-1]):
        set_elements(row)
        slave.doStep(n * step, step)
        flown.points.append(get_all())
    flown.state = slave.serializeFMUState(slave.getFMUState())
    slave.terminate()
    slave.freeInstance()
    return flown


def fly_fmi3(fmu: Path, parameters: Row, inputs: Sequence[Row], step: float, folder: Path) -> Flown:
    """Simulate the same in FMI 3.0."""
    description = fmpy.read_model_description(str(fmu), validate=False)
    variables = {each.name: each for each in description.modelVariables if each.causality != "independent"}
    slave = FMU3Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(fmu), str(folder)),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="fmi3",
    )
    arrays: dict[str, list[Any]] = {}

    def set_arrays(values: Row) -> None:
        changed = set()
        for element, number in values.items():
            name, _, index = element.partition("[")
            variable = variables[name]
            array = arrays.setdefault(name, _starts(variable))
            array[_position(index, variable.shape)] = number
            changed.add(name)
        for name in sorted(changed):
            variable = variables[name]
            kind, python = FUNCTIONS[variable.type]
            getattr(slave, f"set{kind}")([variable.valueReference], [python(number) for number in arrays[name]])

    def get_all() -> Values:
        values: Values = {}
        for name, variable in variables.items():
            kind, _ = FUNCTIONS[variable.type]
            size = len(_elements(variable.shape))
            values[name] = getattr(slave, f"get{kind}")([variable.valueReference], nValues=size)
        return values

    slave.instantiate()
    set_arrays(parameters)
    slave.enterInitializationMode(startTime=0.0)
    set_arrays(inputs[0])
    slave.exitInitializationMode()
    flown = Flown()
    flown.points.append(get_all())
    for n, row in enumerate(inputs[:-1]):
        set_arrays(row)
        assert slave.doStep(n * step, step) == (False, False, False, n * step + step)
        flown.points.append(get_all())
    state = slave.getFMUState()
    flown.state = slave.serializeFMUState(state)
    slave.freeFMUState(state)
    slave.terminate()
    slave.freeInstance()
    return flown


FMI2_FUNCTIONS = {
    "Real": ("Real", float),
    "Integer": ("Integer", int),
    "Enumeration": ("Integer", int),
    "Boolean": ("Boolean", bool),
}
FUNCTIONS = {
    "Float64": ("Float64", float),
    "Int32": ("Int32", int),
    "Boolean": ("Boolean", bool),
    "Enumeration": ("Int64", int),
}


def _elements(shape: tuple[int, ...] | None) -> range:
    count = 1
    for length in shape or ():
        count *= length
    return range(count)


def _starts(variable: Any) -> list[Any]:
    """Return the declared starts, as numbers; an array's are one text."""
    texts = str(variable.start).split()
    return [text == "true" if variable.type == "Boolean" else float(text) for text in texts]


def _position(index: str, shape: tuple[int, ...] | None) -> int:
    """Return the number in row order of the element ``2,3]`` of FMI 2.0; some matrices number theirs through."""
    numbers = [int(number) - 1 for number in index.rstrip("]").split(",")] if index else [0]
    if len(numbers) == 2:
        assert shape is not None
        return numbers[0] * shape[1] + numbers[1]
    return numbers[0]
