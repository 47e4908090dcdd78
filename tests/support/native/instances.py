"""Instances of a block with one interface: Python object, pythonfmu FMU, native FMUs of FMI 2.0 and 3.0.

Elements are numbered as FMI 2.0's value references. Numbers in a saved state can be replaced directly, without
functions that set variables.
"""

from __future__ import annotations

import copy
import json
import struct
from pathlib import Path
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from perilune.fmus_src.block import Block
from perilune.fmus_src.export.description.variables import list_variables
from perilune.fmus_src.export.judge.tunable import tunable_parameters
from perilune.fmus_src.runtime import BlockInstance

HEADER = 6  # words before those of elements
Settings = dict[int, float | int | bool]
FMI3_FUNCTIONS = {"Float64": "Float64", "Int32": "Int32", "Boolean": "Boolean", "Enumeration": "Int64"}


class PlainBlock:
    """The Python object."""

    def __init__(self, block: type[Block]) -> None:
        self.component = BlockInstance(block, tunable_parameters(block))

    def set(self, settings: Settings) -> None:
        self.component.set(list(settings), list(settings.values()))

    def enter(self) -> None:
        """Do nothing: a new object is being initialised."""

    def start(self) -> None:
        self.component.start()

    def step(self, t: float, h: float) -> None:
        self.component.do_step(t, h)

    def values(self) -> list[Any]:
        return self.component.values()

    def save(self) -> Any:
        return copy.deepcopy(self.component.get_state())

    def replace(self, state: Any, settings: Settings) -> Any:
        """Return a saved state with other numbers."""
        state = copy.deepcopy(state)
        for reference, number in settings.items():
            state["values"][reference] = number
        return state

    def restore(self, state: Any) -> None:
        self.component.set_state(copy.deepcopy(state))

    def free(self) -> None:
        """Do nothing."""


class Fmi2Fmu:
    """An FMU of FMI 2.0; a Python FMU has its state as JSON."""

    def __init__(self, block: type[Block], fmu: Path, folder: Path) -> None:
        self.types = [each.type_name for each in block.variables.values() for _ in range(each.size)]
        description = fmpy.read_model_description(str(fmu), validate=False)
        self.is_native = not description.coSimulation.needsExecutionTool
        self.slave: Any = FMU2Slave(
            guid=description.guid,
            unzipDirectory=fmpy.extract(str(fmu), str(folder)),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=block.fmu_name,
        )
        self.slave.instantiate()
        self.slave.setupExperiment(startTime=0.0)

    def set(self, settings: Settings) -> None:
        for kind in ("Real", "Integer", "Boolean"):
            chosen = {r: number for r, number in settings.items() if self.types[r] == kind}
            if chosen:
                getattr(self.slave, f"set{kind}")(list(chosen), list(chosen.values()))

    def enter(self) -> None:
        self.slave.enterInitializationMode()

    def start(self) -> None:
        self.slave.exitInitializationMode()

    def step(self, t: float, h: float) -> None:
        self.slave.doStep(t, h)

    def values(self) -> list[Any]:
        values: dict[int, Any] = {}
        for kind, python in (("Real", float), ("Integer", int), ("Boolean", bool)):
            references = [r for r, each in enumerate(self.types) if each == kind]
            if references:
                values |= dict(zip(references, map(python, getattr(self.slave, f"get{kind}")(references)), strict=True))
        return [values[r] for r in sorted(values)]

    def save(self) -> bytes:
        state = self.slave.getFMUstate()
        text: bytes = self.slave.serializeFMUstate(state)
        self.slave.freeFMUstate(state)
        return text

    def replace(self, state: bytes, settings: Settings) -> bytes:
        """Return a serialised state with other words."""
        if self.is_native:
            return replace_words(state, settings)
        document = json.loads(state)
        for reference, number in settings.items():
            document["values"][reference] = number
        return json.dumps(document).encode()

    def restore(self, state: bytes) -> None:
        restored = self.slave.deSerializeFMUstate(state)
        self.slave.setFMUstate(restored)
        self.slave.freeFMUstate(restored)

    def free(self) -> None:
        self.slave.terminate()
        self.slave.freeInstance()


class Fmi3Fmu:
    """A native FMU of FMI 3.0, whose arrays are set as wholes; its messages go to ``log``."""

    def __init__(self, block: type[Block], fmu: Path, folder: Path, log: list[str] | None = None) -> None:
        self.variables = list_variables(block)
        self.log = [] if log is None else log
        description = fmpy.read_model_description(str(fmu), validate=False)
        self.slave: Any = FMU3Slave(
            guid=description.guid,
            unzipDirectory=fmpy.extract(str(fmu), str(folder)),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=block.fmu_name,
        )
        self.slave.instantiate(logMessage=self.note, loggingOn=True)

    def note(self, *arguments: Any) -> None:
        """Keep a message of the FMU."""
        self.log.append(arguments[3].decode())

    def set(self, settings: Settings) -> None:
        for variable in self.variables:
            numbers = [settings.get(variable.first + k) for k in range(variable.size)]
            if all(number is None for number in numbers):
                continue
            function = FMI3_FUNCTIONS[variable.type_name]
            now = getattr(self.slave, f"get{function}")([variable.reference], nValues=variable.size)
            numbers = [old if new is None else new for old, new in zip(now, numbers, strict=True)]
            getattr(self.slave, f"set{function}")([variable.reference], numbers)

    def enter(self) -> None:
        self.slave.enterInitializationMode(startTime=0.0)

    def start(self) -> None:
        self.slave.exitInitializationMode()

    def step(self, t: float, h: float) -> None:
        self.slave.doStep(t, h)

    def values(self) -> list[Any]:
        values: list[Any] = []
        for variable in self.variables:
            function = FMI3_FUNCTIONS[variable.type_name]
            values += getattr(self.slave, f"get{function}")([variable.reference], nValues=variable.size)
        return values

    def save(self) -> bytes:
        state = self.slave.getFMUState()
        text: bytes = self.slave.serializeFMUState(state)
        self.slave.freeFMUState(state)
        return text

    def replace(self, state: bytes, settings: Settings) -> bytes:
        """Return a serialised state with other words."""
        return replace_words(state, settings)

    def restore(self, state: bytes) -> None:
        restored = self.slave.deserializeFMUState(state)
        self.slave.setFMUState(restored)
        self.slave.freeFMUState(restored)

    def free(self) -> None:
        self.slave.terminate()
        self.slave.freeInstance()


def replace_words(state: bytes, settings: Settings) -> bytes:
    """Return the words of a state with those of elements replaced: doubles, int64, 0 and 1."""
    words = bytearray(state)
    for reference, number in settings.items():
        code = "<d" if isinstance(number, float) else "<q"
        struct.pack_into(code, words, 8 * (HEADER + reference), number)
    return bytes(words)
