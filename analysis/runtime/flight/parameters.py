"""Parameters of a simulation in the loop's arrays."""

from __future__ import annotations

import ctypes
import warnings
from collections.abc import Collection, Mapping

import numpy as np

from ....common.errors import InputError
from ..fmi.variable import ScalarVariable
from ..loop import arrays
from ..ssp.parameter_values import ParameterValue, parse_value
from ..system.fmu import STRUCTURAL, Fmu
from ..system.network import Network
from ..system.passing.settings import SystemSettings
from .orders.transfers import ComponentTransfers, TransferTable, select_arrays

TYPE_KIND = {"Real": 0, "Integer": 1, "Enumeration": 1, "Boolean": 2, "String": 3}
Key = tuple[str, str]  # (component, variable)

# Detected during simulations, by digest: variables that an FMU does not return, FMUs to be read one variable at a
# time, and FMUs that refuse parameters in initialisation mode.
_unreadable: dict[str, set[str]] = {}
_one_by_one: set[str] = set()
_set_once: set[str] = set()


class Parameters:
    """Parameter values by (component, variable); parameters of one component and type are contiguous.

    ``ranges`` [component, type of TYPE_KIND, 4] contain the first parameter, and the numbers of parameters to set, to
    set again in initialisation mode, and to read back. ``transfers`` contains the parameters of components of FMI 3.0
    as rows of ``table``, one for each variable with all of its elements. Parameters in ``tuned`` change during
    simulation and are not read back.
    """

    def __init__(
        self,
        network: Network,
        settings: SystemSettings,
        table: TransferTable | None = None,
        tuned: Collection[str] = (),
    ) -> None:
        self._network = network
        self._tuned = tuned
        self._table = TransferTable() if table is None else table
        self.transfers: dict[int, ComponentTransfers] = {}
        self._layout: dict[int, tuple[str, int]] = {}  # of FMI 3.0: type, and offset of the first byte
        self.keys: list[Key] = []
        self.types: dict[Key, str] = {}
        self.references: list[int] = []
        self.ranges = np.zeros((len(network.fmus), 4, 4), dtype=np.int64)
        assigned: dict[str, list[str]] = {name: [] for name in network.fmus}
        for component, name in settings.variables:
            assigned[component].append(name)
        for index, (component, fmu) in enumerate(network.fmus.items()):
            if fmu.version == 3:
                self.transfers[index] = self._place_transfers(component, fmu, assigned[component])
                continue
            grades = {
                name: self._classify(component, fmu.variables[name], driven=f"{component}.{name}" in network.driver)
                for name in assigned[component]
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
                    self.references.append(fmu.variables[name].reference)
        self.positions = {key: position for position, key in enumerate(self.keys)}
        count = len(self.keys)
        self._texts: dict[int, ctypes.Array[ctypes.c_char]] = {}  # kept alive while the loop has their addresses
        self.values = arrays.Settings(
            np.zeros(count), np.zeros(count, dtype=np.int32), np.zeros(count, dtype=np.uint64)
        )
        self.words = np.zeros(count, dtype=np.uint64)  # values of FMI 3.0, as in `arrays.Fmi3`
        self.update({key: settings.variables[key] for key in self.keys if key in settings.variables})
        for key in self.keys:
            if key not in settings.variables:
                self[key] = self._start(*key)

    def _place_transfers(self, component: str, fmu: Fmu, assigned: list[str]) -> ComponentTransfers:
        """Return the transfers of a component of FMI 3.0, each for a complete array."""
        transfers = ComponentTransfers()
        arrays_of: dict[str, list[ScalarVariable]] = {}
        for variable in select_arrays(fmu.variables.values(), set(assigned)):
            arrays_of.setdefault(variable.array or variable.name, []).append(variable)
        for elements in arrays_of.values():
            first, dtype = len(self.keys), elements[0].representation.dtype
            driven = any(f"{component}.{each.name}" in self._network.driver for each in elements)
            for position, each in enumerate(elements, first):
                self.keys.append((component, each.name))
                self.types[component, each.name] = each.type
                self.references.append(each.reference)
                if dtype:
                    self._layout[position] = dtype, 8 * first + np.dtype(dtype).itemsize * each.index
            transfer = self._table.add(elements, first)
            if elements[0].causality == STRUCTURAL:
                transfers.structural.append(transfer)
                transfers.back.append(transfer)
                continue
            grade = max(self._classify(component, each, driven=driven) for each in elements)
            transfers.before.append(transfer)
            if grade <= 1 and fmu.digest not in _set_once:
                transfers.repeated.append(transfer)
            if grade == 0:
                transfers.back.append(transfer)
        return transfers

    def _classify(self, component: str, variable: ScalarVariable, *, driven: bool) -> int:
        """Return the treatment of a parameter: 0, 1 or 2.

        - 0: set again in initialisation mode, and read back
        - 1: set again in initialisation mode, but not read back
        - 2: set only before initialisation mode

        In initialisation mode FMI 2.0 permits setting only inputs and variables with initial="exact"; the FMU computes
        all others itself, and a connected input is set by its connection.
        """
        settable = variable.causality in ("input", "parameter") or variable.initial == "exact"
        if not settable or (driven and variable.causality == "input"):
            return 2
        unreadable = _unreadable.get(self._network.fmus[component].digest, ())
        return int(f"{component}.{variable.name}" in self._tuned or (variable.array or variable.name) in unreadable)

    def _start(self, component: str, name: str) -> ParameterValue:
        """Return the start value of an element that was not set, in an array that is set as a whole."""
        variable = self._network.fmus[component].variables[name]
        if variable.start is None:
            problem = f"{name} has neither a value nor a start, but FMI 3.0 sets only complete arrays"
            remedy = f"give a value for every element of {component}.{variable.array}"
            raise InputError(self._network.file, f"{component}.{name}", problem, remedy)
        return parse_value(variable.start, variable.type, self._network.fmus[component].label, name)

    def __contains__(self, key: Key) -> bool:
        return key in self.positions

    def __getitem__(self, key: Key) -> ParameterValue:
        """Return a parameter's value in the parameter's type."""
        return self.value_in(self.values, self.words, self.positions[key])

    def __setitem__(self, key: Key, value: ParameterValue) -> None:
        position, kind = self.positions[key], self.types[key]
        if kind == "String":
            self._texts[position] = ctypes.create_string_buffer(str(value).encode())
            self.values.text[position] = ctypes.addressof(self._texts[position])
        elif position in self._layout:
            self._view(self.words, position)[0] = value
        elif kind == "Real":
            self.values.real[position] = value
        else:
            self.values.whole[position] = value

    def update(self, values: Mapping[Key, ParameterValue]) -> None:
        for key, value in values.items():
            self[key] = value

    def value_in(self, values: arrays.Settings, words: np.ndarray, position: int) -> ParameterValue:
        """Return the value at a position of arrays with this layout; ``words`` contain the values of FMI 3.0."""
        kind = self.types[self.keys[position]]
        if kind == "String":
            address = int(values.text[position])
            return ctypes.string_at(address).decode(errors="replace") if address else ""
        if position in self._layout:
            return self._view(words, position)[0].item()  # type: ignore[no-any-return]
        if kind == "Real":
            return float(values.real[position])
        return bool(values.whole[position]) if kind == "Boolean" else int(values.whole[position])

    def _view(self, words: np.ndarray, position: int) -> np.ndarray:
        """Return a one-element view, in its own dtype, of the FMI 3.0 value at a position."""
        dtype, first = self._layout[position]
        return words.view(np.uint8)[first : first + np.dtype(dtype).itemsize].view(dtype)

    def is_one_by_one(self, component: str) -> bool:
        """Return True if a component's parameters are to be read back one by one, because some cannot be read."""
        return self._network.fmus[component].digest in _one_by_one

    def learn_unreadable(self, first: int, count: int) -> None:
        """Note that an FMU does not return a parameter, which is not read back any more.

        If ``count`` > 1, several parameters were read and any of them may be the cause: note to read them one by one.
        """
        component, name = self.keys[first]
        fmu = self._network.fmus[component]
        name = fmu.variables[name].array or name
        if count > 1:
            _one_by_one.add(fmu.digest)
        elif name not in _unreadable.setdefault(fmu.digest, set()):
            _unreadable[fmu.digest].add(name)
            text = f"{fmu.label}: {name} cannot be read back, so it is not known whether {component} accepts its value"
            warnings.warn(text, stacklevel=2)

    def is_set_once(self, component: str) -> bool:
        """Return True if the FMU of a component refuses parameters in initialisation mode."""
        return self._network.fmus[component].digest in _set_once

    def learn_set_once(self, component: str) -> None:
        """Note that an FMU refuses parameters in initialisation mode: they are set before it only, but read back."""
        _set_once.add(self._network.fmus[component].digest)

    def blank(self) -> arrays.Settings:
        """Return zeroed arrays of the same layout, into which parameters can be read."""
        return arrays.Settings(*(np.zeros_like(array) for array in self.values))
