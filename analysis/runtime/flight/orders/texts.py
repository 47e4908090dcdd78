"""Strings and Binaries that FMUs exchange, in the loop's arrays.

They are not recorded, because signals of a result are numbers.
"""

from __future__ import annotations

import numpy as np

from .....common.errors import InputError
from ...fmi.variable import ScalarVariable
from ...loop import arrays
from ...system.network import Network
from ...system.passing.settings import SystemSettings
from ...system.schedule import origin
from .transfers import select_arrays

LONGEST = {"String": 4096, "Binary": 65536}  # bytes of one text, including a String's terminating zero


class TextSlots:
    """Positions of the connected texts of one type, by name; texts of one component and direction are contiguous.

    ``ranges`` [component, 0 input or 1 output] contain the first position and the number of positions, and
    ``variables`` [component] [direction] the variables. ``connections`` [component] lists, for each input of the
    component, the source component (-1: an input of the system) and the positions of both ends.
    """

    def __init__(self, network: Network, settings: SystemSettings, type_name: str = "String") -> None:
        self.slots: dict[str, int] = {}
        self.longest = LONGEST[type_name]
        self.variables: list[list[list[ScalarVariable]]] = []
        self._references: list[int] = []
        self._initial: list[bytes] = []
        self._file = network.file
        self._is_binary = type_name == "Binary"
        links = {
            name: origin(network, link)
            for name, link in network.driver.items()
            if link.target.type_name == type_name and link.target.component is not None and not link.is_parameter
        }
        read = {start.name for start in links.values()}
        self.ranges = np.zeros((len(network.fmus), 2, 2), dtype=np.int64)
        for index, (component, fmu) in enumerate(network.fmus.items()):
            self.variables.append([])
            for column, (causality, exchanged) in enumerate((("input", links), ("output", read))):
                first = len(self._references)
                variables = fmu.variables.values() if links else ()
                every = [each for each in variables if each.type == type_name and each.causality == causality]
                selected = select_arrays(
                    every, {each.name for each in every if f"{component}.{each.name}" in exchanged}
                )
                for variable in selected:
                    initial = settings.variables.get((component, variable.name), variable.start or "")
                    self._add(f"{component}.{variable.name}", variable.reference, str(initial))
                self.ranges[index, column] = first, len(self._references) - first
                self.variables[-1].append(selected)
        for name in sorted(read - set(self.slots)):
            self._add(name, 0, str(settings.nodes.get(name, "")))
        numbers = {name: number for number, name in enumerate(network.fmus)}
        self.connections: list[list[tuple[int, int, int]]] = [[] for _ in network.fmus]
        for name, start in links.items():
            owner = network.driver[name].target.component or ""
            number = -1 if start.component is None else numbers[start.component]
            self.connections[numbers[owner]].append((number, self.slots[start.name], self.slots[name]))

    def _add(self, name: str, reference: int, initial: str) -> None:
        try:
            content = bytes.fromhex(initial) if self._is_binary else initial.encode()
        except ValueError:
            raise InputError(
                self._file, name, f"{initial[:20]!r} is not hexadecimal", "write two digits per byte"
            ) from None
        if len(content) >= self.longest:
            kind = "a binary value" if self._is_binary else "a string"
            raise InputError(self._file, name, f"{kind} of {self.longest} bytes or more", "give a shorter value")
        self.slots[name] = len(self._references)
        self._references.append(reference)
        self._initial.append(content)

    def sizes(self) -> np.ndarray:
        """Return the initial size of each text in bytes, uint64."""
        return np.array([len(content) for content in self._initial], dtype=np.uint64)

    def memory(self) -> arrays.Texts:
        """Return the arrays of texts for the loop."""
        count = len(self._references)
        initial = np.zeros((count, self.longest), dtype=np.uint8)
        for row, content in zip(initial, self._initial, strict=True):
            row[: len(content)] = np.frombuffer(content, dtype=np.uint8)
        rows = initial.copy()
        return arrays.Texts(
            reference=np.array(self._references, dtype=np.uint32),
            initial=initial,
            rows=rows,
            address=rows.ctypes.data + self.longest * np.arange(count, dtype=np.uint64),
            given=np.zeros(count, dtype=np.uint64),
        )
