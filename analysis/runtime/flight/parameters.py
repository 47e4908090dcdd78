"""The parameters that a flight is given, and the Strings that FMUs exchange: where they lie in the loop's arrays.

Strings are no signals of a result, which is made of numbers.
"""

from __future__ import annotations

import ctypes
import warnings
from collections.abc import Mapping

import numpy as np
from fmpy.model_description import ScalarVariable

from ...common.errors import InputError
from ..ssp.given_values import ParameterValue
from ..system.fmu import Fmu
from ..system.network import Network
from ..system.passing.settings import Settings
from ..system.schedule import origin
from .compiled import arrays

TYPE_KIND = {"Real": 0, "Integer": 1, "Enumeration": 1, "Boolean": 2, "String": 3}
Key = tuple[str, str]  # (component, variable)

# By the digests of FMUs, found out in flight: variables that they do not give back; who is asked for one at a time; who
# refuses to be set in initialisation mode.
_unreadable: dict[str, set[str]] = {}
_one_by_one: set[str] = set()
_set_once: set[str] = set()


class Parameters:
    """Values by (component, variable); those of a component and type are contiguous.

    ``ranges`` [component, type of TYPE_KIND, 4] are the first one, how many there are, and how many of them, the first
    ones, are set again in initialisation mode and read back after it.
    """

    def __init__(self, network: Network, settings: Settings) -> None:
        self._network = network
        self.keys: list[Key] = []
        self.types: dict[Key, str] = {}
        self.references: list[int] = []
        self.ranges = np.zeros((len(network.fmus), 4, 4), dtype=np.int64)
        given: dict[str, list[str]] = {name: [] for name in network.fmus}
        for component, name in settings.variables:
            given[component].append(name)
        for index, (component, fmu) in enumerate(network.fmus.items()):
            grades = {
                name: _grade(fmu, fmu.variables[name], driven=f"{component}.{name}" in network.driver)
                for name in given[component]
            }
            for kind in range(4):
                mine = [name for name in grades if TYPE_KIND[fmu.variables[name].type] == kind]
                mine.sort(key=grades.__getitem__)
                counts = [sum(grades[name] <= grade for name in mine) for grade in (2, 1, 0)]
                if fmu.digest in _set_once:
                    counts[1] = 0
                self.ranges[index, kind] = len(self.keys), *counts
                for name in mine:
                    self.keys.append((component, name))
                    self.types[component, name] = fmu.variables[name].type
                    self.references.append(fmu.variables[name].valueReference)
        self.positions = {key: position for position, key in enumerate(self.keys)}
        count = len(self.keys)
        self._texts: dict[int, ctypes.Array[ctypes.c_char]] = {}  # kept alive while the loop has their addresses
        self.values = arrays.Settings(
            np.zeros(count), np.zeros(count, dtype=np.int32), np.zeros(count, dtype=np.uint64)
        )
        self.update({key: settings.variables[key] for key in self.keys})

    def __contains__(self, key: Key) -> bool:
        return key in self.positions

    def __getitem__(self, key: Key) -> ParameterValue:
        """A parameter's value, of its own type."""
        return self.value_in(self.values, self.positions[key])

    def __setitem__(self, key: Key, value: ParameterValue) -> None:
        position, kind = self.positions[key], self.types[key]
        if kind == "String":
            self._texts[position] = ctypes.create_string_buffer(str(value).encode())
            self.values.text[position] = ctypes.addressof(self._texts[position])
        elif kind == "Real":
            self.values.real[position] = value
        else:
            self.values.whole[position] = value

    def update(self, values: Mapping[Key, ParameterValue]) -> None:
        for key, value in values.items():
            self[key] = value

    def value_in(self, values: arrays.Settings, position: int) -> ParameterValue:
        """What arrays of the same layout, those read back, hold in a place."""
        kind = self.types[self.keys[position]]
        if kind == "String":
            address = int(values.text[position])
            return ctypes.string_at(address).decode(errors="replace") if address else ""
        if kind == "Real":
            return float(values.real[position])
        return bool(values.whole[position]) if kind == "Boolean" else int(values.whole[position])

    def is_one_by_one(self, component: str) -> bool:
        """Whether a component's parameters are read back one by one, since it does not give all of them."""
        return self._network.fmus[component].digest in _one_by_one

    def learn_unreadable(self, first: int, count: int) -> None:
        """Not to read back what an FMU does not give: a parameter, or one of ``count`` that is to be found yet."""
        component, name = self.keys[first]
        fmu = self._network.fmus[component]
        if count > 1:
            _one_by_one.add(fmu.digest)
        elif name not in _unreadable.setdefault(fmu.digest, set()):
            _unreadable[fmu.digest].add(name)
            text = f"{fmu.label}: {name} cannot be read back: whether {component} takes its value is not known"
            warnings.warn(text, stacklevel=2)

    def learn_set_once(self, component: str) -> None:
        """Not to set an FMU's parameters in initialisation mode, which it has refused; they are read back."""
        _set_once.add(self._network.fmus[component].digest)

    def blank(self) -> arrays.Settings:
        """Arrays of the same layout, to read into."""
        return arrays.Settings(*(np.zeros_like(array) for array in self.values))


def _grade(fmu: Fmu, variable: ScalarVariable, *, driven: bool) -> int:
    """0: set in initialisation mode too, and read back; 1: not read back; 2: set before initialisation mode only.

    FMI 2.0 lets inputs and what has initial="exact" be set in that mode; other values the FMU calculates itself from
    then on, and an input that is connected is given anew.
    """
    settable = variable.causality in ("input", "parameter") or variable.initial == "exact"
    if not settable or (driven and variable.causality == "input"):
        return 2
    return 1 if variable.name in _unreadable.get(fmu.digest, ()) else 0


LONGEST = 4096  # bytes of a string, with its end


class Texts:
    """Places of the Strings that are connected, by name; those of a component and direction are contiguous.

    ``ranges`` [component, 0 inputs, 1 outputs] are the first and how many there are. ``connections`` [component] lists
    the component that each of its inputs comes from (-1: a value that the system is given), and both places.
    """

    def __init__(self, network: Network, settings: Settings) -> None:
        self.slots: dict[str, int] = {}
        self._references: list[int] = []
        self._initial: list[bytes] = []
        self._file = network.file
        links = {
            name: origin(network, link)
            for name, link in network.driver.items()
            if link.target.type_name == "String" and link.target.component is not None and not link.is_parameter
        }
        read = {start.name for start in links.values()}
        self.ranges = np.zeros((len(network.fmus), 2, 2), dtype=np.int64)
        for index, (component, fmu) in enumerate(network.fmus.items()):
            for column, (causality, wanted) in enumerate((("input", links), ("output", read))):
                first = len(self._references)
                for variable in fmu.variables.values():
                    name = f"{component}.{variable.name}"
                    if variable.type == "String" and variable.causality == causality and name in wanted:
                        given = settings.variables.get((component, variable.name), variable.start or "")
                        self._place(name, variable.valueReference, str(given))
                self.ranges[index, column] = first, len(self._references) - first
        for name in sorted(read - set(self.slots)):
            self._place(name, 0, str(settings.nodes.get(name, "")))
        numbers = {name: number for number, name in enumerate(network.fmus)}
        self.connections: list[list[tuple[int, int, int]]] = [[] for _ in network.fmus]
        for name, start in links.items():
            owner = network.driver[name].target.component or ""
            number = -1 if start.component is None else numbers[start.component]
            self.connections[numbers[owner]].append((number, self.slots[start.name], self.slots[name]))

    def _place(self, name: str, reference: int, initial: str) -> None:
        content = initial.encode()
        if len(content) >= LONGEST:
            raise InputError(self._file, name, f"a string of {LONGEST} bytes or more", "shorten it")
        self.slots[name] = len(self._references)
        self._references.append(reference)
        self._initial.append(content)

    def memory(self) -> arrays.Texts:
        """Arrays for the loop."""
        count = len(self._references)
        initial = np.zeros((count, LONGEST), dtype=np.uint8)
        for row, content in zip(initial, self._initial, strict=True):
            row[: len(content)] = np.frombuffer(content, dtype=np.uint8)
        rows = initial.copy()
        return arrays.Texts(
            reference=np.array(self._references, dtype=np.uint32),
            initial=initial,
            rows=rows,
            address=rows.ctypes.data + LONGEST * np.arange(count, dtype=np.uint64),
            given=np.zeros(count, dtype=np.uint64),
        )
