"""Simulation of a single instance, call by call, to test its reset; the same steps for FMI 2.0 and FMI 3.0."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from fmpy import fmi2
from fmpy.fmi1 import FMICallException

from ..fmi.variable import ScalarVariable
from .instance import Instance
from .slaves import Fmi3Slave

Number = float | int | bool
KINDS: dict[str, Callable[[float], Number]] = {"Real": float, "Integer": int, "Enumeration": int, "Boolean": bool}
FMI2_CALLS = {"Real": "Real", "Integer": "Integer", "Enumeration": "Integer", "Boolean": "Boolean"}


def begin(instance: Instance, changes: Mapping[str, Number], start: float, tolerance: float | None) -> None:
    """Initialise with values that replace the declared ones. Raises FMICallException if a call fails."""
    slave = instance.slave
    if isinstance(slave, Fmi3Slave):
        if instance.fmu.sizes:
            slave.enterConfigurationMode()
            _set(instance, instance.fmu.sizes)
            slave.exitConfigurationMode()
        _set(instance, changes)
        slave.enterInitializationMode(tolerance, start)
    else:
        _set(instance, changes)
        slave.setupExperiment(tolerance=tolerance, startTime=start)
        slave.enterInitializationMode()
    _set(instance, changes)
    slave.exitInitializationMode()


def step(instance: Instance, time: float, size: float) -> bool:
    """Perform a step; return True if another step may follow. Raises FMICallException if the step fails."""
    try:
        ended = instance.slave.doStep(time, size)
    except FMICallException as error:
        if error.status != fmi2.fmi2Discard:
            raise
        return False
    return not (isinstance(instance.slave, Fmi3Slave) and ended[1])


def read(instance: Instance, causality: str) -> bytes:
    """Return the values of variables, type by type; for unreadable variables return the failure instead."""
    groups: dict[str, list[ScalarVariable]] = {}
    for variable in instance.fmu.variables.values():
        if variable.causality == causality and variable.type in KINDS:
            groups.setdefault(_call(instance, variable), []).append(variable)
    return b"".join(_read(instance, call, group) for call, group in groups.items())


def _read(instance: Instance, call: str, group: list[ScalarVariable]) -> bytes:
    """Return the values of variables read in one call, or one by one if one of them cannot be read."""
    references = list(dict.fromkeys(each.reference for each in group))
    wholes = [[each for each in group if each.reference == reference] for reference in references]
    get = getattr(instance.slave, f"get{call}")
    try:
        if isinstance(instance.slave, Fmi3Slave):
            return np.array(get(references, sum(len(_names(each)) for each in wholes)), dtype=np.float64).tobytes()
        return np.array(get([each.reference for each in group]), dtype=np.float64).tobytes()
    except FMICallException:
        if len(references) == 1:
            return b"?"
    return b"".join(_read(instance, call, each) for each in wholes)


def _names(group: list[ScalarVariable]) -> set[int]:
    """Return the elements of a variable, each once, although aliases may repeat them."""
    return {each.index for each in group}


def _set(instance: Instance, changes: Mapping[str, Number]) -> None:
    """Set variables to values; an array is set as a whole if one of its elements changes."""
    variables = instance.fmu.variables
    if not isinstance(instance.slave, Fmi3Slave):
        for name, number in changes.items():
            getattr(instance.slave, f"set{_call(instance, variables[name])}")([variables[name].reference], [number])
        return
    wholes = {variables[name].array or name: variables[name] for name in changes}
    for whole, first in wholes.items():
        elements = [each for each in variables.values() if (each.array or each.name) == whole]
        values = [changes.get(each.name, declared(each)) for each in elements]
        if None not in values:
            getattr(instance.slave, f"set{_call(instance, first)}")([first.reference], values)


def declared(variable: ScalarVariable) -> Number | None:
    """Return a variable's declared start value, or None."""
    if variable.start is None:
        return None
    if variable.type == "Boolean":
        return str(variable.start).lower() in ("true", "1")
    return KINDS[variable.type](float(variable.start))


def _call(instance: Instance, variable: ScalarVariable) -> str:
    if isinstance(instance.slave, Fmi3Slave):
        return variable.representation.name
    return FMI2_CALLS[variable.type]
