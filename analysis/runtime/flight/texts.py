"""Strings that FMUs exchange: a place in memory for each, since an FMU may forget at its next call what it gave.

They are no signals of a result, which is made of numbers.
"""

from __future__ import annotations

import numpy as np

from ...common.errors import InputError
from ..system.assignments import Settings
from ..system.network import Network
from ..system.schedule import origin
from .compiled import arrays

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
