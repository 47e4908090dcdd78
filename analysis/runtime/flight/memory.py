"""Complete memory of a system in this process, to be saved, restored, read and changed at a communication point."""

from __future__ import annotations

import ctypes
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from lxml import etree

from ....common.errors import InputError
from ..fmi.variable import ScalarVariable
from ..instances.instance import Instance
from ..instances.slaves import Fmi3Slave
from ..loop import arrays
from ..ssp.fmu_description import find_annotation
from ..system.fmu import Fmu
from ..system.prepared import PreparedSystem
from .base_memory import BaseMemory, MemoryCell
from .program import Layout

HEADER_WORDS = 6
REMEMBERED = ("local", "output", "input")


@dataclass
class Snapshot:
    """State saved by `Memory.save`."""

    point: int  # communication point
    states: dict[str, object]  # fmi2FMUstate by component
    serialized: dict[str, bytes]
    values: np.ndarray
    whole: np.ndarray
    frozen: np.ndarray
    stored: tuple[np.ndarray, ...]


class FmuReals:
    """Cells of one FMU, read in one call."""

    def __init__(self, instance: Instance, references: np.ndarray, size: int) -> None:
        self._instance = instance
        self._references = references
        self._values = np.zeros(size)
        self._pointers = (
            references.ctypes.data_as(ctypes.POINTER(ctypes.c_uint)),
            self._values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)),
        )

    def read(self) -> np.ndarray:
        """Return the current values. The array is reused by the next call."""
        if self._references.size:
            references, values = self._pointers
            slave = self._instance.slave
            if isinstance(slave, Fmi3Slave):
                slave.fmi3GetFloat64(slave.component, references, self._references.size, values, self._values.size)
            else:
                slave.fmi2GetReal(slave.component, references, self._references.size, values)
        return self._values


class Memory(BaseMemory[Snapshot]):
    """Memory of a simulation in this process.

    Raises InputError if an FMU does not describe its serialised state, or has state outside it.
    """

    def __init__(
        self,
        prepared: PreparedSystem,
        layout: Layout,
        instances: Mapping[str, Instance],
        buffers: arrays.Buffers,
        fmi3: arrays.Fmi3 | None = None,
    ) -> None:
        self._instances = instances
        self._buffers = buffers
        self._stored = () if fmi3 is None else (fmi3.stored.sent, fmi3.stored.exact)
        self.cells: list[MemoryCell] = []
        self._write: dict[str, Callable[[bytes, int, float], bytes]] = {}
        self._pieces: list[FmuReals] = []
        for component, instance in instances.items():
            encoding, frozen = _layout(instance.fmu, component)
            self._write[component] = ENCODINGS[encoding]
            mine = _find_cells(instance.fmu, frozen)
            self.cells += [
                MemoryCell(f"{component}.{item.name}", item.unit, component, index) for index, item in mine.items()
            ]
            references = list(dict.fromkeys(item.reference for item in mine.values()))
            self._pieces.append(FmuReals(instance, np.array(references, dtype=np.uint32), len(mine)))
        # Outputs of followers that are read one step late are stored only among the exchanged values.
        followers = set(prepared.schedule.followers)
        self._slots: list[int] = []
        for name, slot in layout.slots.items():
            node = prepared.network.nodes.get(name)
            real = layout.types[name] == "Real"
            if node is not None and node.kind == "output" and node.component in followers and real:
                self.cells.append(MemoryCell(f"{name} as exchanged", layout.units[name], None, slot))
                self._slots.append(slot)

    def read(self) -> np.ndarray:
        """Return the current values of all cells, in the order of ``cells``."""
        parts = [piece.read() for piece in self._pieces]
        return np.concatenate([*parts, self._buffers.values[self._slots]])

    def save(self, point: int) -> Snapshot:
        """Save the complete memory at communication point ``point``. Free it with `release`."""
        states, serialized = {}, {}
        for component, instance in self._instances.items():
            states[component] = instance.state()
            serialized[component] = instance.serialize(states[component])
        buffers = self._buffers
        stored = tuple(words.copy() for words in self._stored)
        return Snapshot(
            point, states, serialized, buffers.values.copy(), buffers.whole.copy(), buffers.frozen.copy(), stored
        )

    def restore(self, snapshot: Snapshot, cell: MemoryCell | None = None, number: float = 0.0) -> None:
        """Restore a snapshot; if ``cell`` is passed, set this cell to ``number`` afterwards."""
        for component, instance in self._instances.items():
            instance.set_state(snapshot.states[component])
        buffers = self._buffers
        buffers.values[:] = snapshot.values
        buffers.whole[:] = snapshot.whole
        buffers.frozen[:] = snapshot.frozen
        for words, saved in zip(self._stored, snapshot.stored, strict=True):
            words[:] = saved
        if cell is None:
            return
        if cell.component is None:
            buffers.values[cell.place] = number
            return
        instance = self._instances[cell.component]
        changed = self._write[cell.component](snapshot.serialized[cell.component], cell.place, number)
        state = instance.deserialize(changed)
        instance.set_state(state)
        instance.free_state(state)

    def release(self, snapshot: Snapshot) -> None:
        """Free the memory of a snapshot."""
        for component, state in snapshot.states.items():
            self._instances[component].free_state(state)


def _find_cells(fmu: Fmu, frozen: set[int]) -> dict[int, ScalarVariable]:
    """Return the variables that are cells, by their index in the serialised state.

    The index is the value reference; elements of an array have consecutive indices, starting at the array's reference.
    """
    remembered: dict[int, ScalarVariable] = {}
    for variable in fmu.variables.values():
        index = variable.reference + variable.index
        if variable.representation.name == "Float64" and variable.causality in REMEMBERED and index not in frozen:
            remembered.setdefault(index, variable)  # an alias is no second cell
    return remembered


def _layout(fmu: Fmu, component: str) -> tuple[str, set[int]]:
    """Return the encoding of an FMU's serialised state, and the value references that are declared frozen.

    Raises InputError if the FMU declares neither, or has external state.
    """
    if fmu.external_state:
        names = ", ".join(fmu.external_state)
        problem = f"{names} depends on state outside of the FMU, which cannot be saved or perturbed"
        raise InputError(fmu.label, component, problem, "measure by injection, or use another FMU")
    description = etree.parse(fmu.folder / "modelDescription.xml")
    declared = find_annotation(description.getroot(), "SerializedState")
    if declared is None or declared.get("encoding") not in ENCODINGS:
        raise InputError(fmu.label, component, "does not document how it serialises its state", "measure by injection")
    return declared.get("encoding"), {int(item) for item in declared.get("frozen", "").split()}


def _write_word(serialized: bytes, reference: int, value: float) -> bytes:
    words = np.frombuffer(serialized, dtype=np.float64).copy()
    words[HEADER_WORDS + reference] = value
    return words.tobytes()


def _write_json(serialized: bytes, reference: int, value: float) -> bytes:
    state = json.loads(serialized.rstrip(b"\0").decode())
    state["values"][reference] = value
    return json.dumps(state).encode()


ENCODINGS: dict[str, Callable[[bytes, int, float], bytes]] = {"words": _write_word, "json": _write_json}
