"""Collector of instructions, which inserts injections between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from ...instances.fmu_library import FUNCTION_NAMES
from ...loop import codes

Stretch = tuple[int, int]  # first slot and number of slots


class Callee(Protocol):
    """Interface to an FMU's instance for the writers of instructions."""

    @property
    def address(self) -> int:
        """Address of the instance, the first argument of its calls."""

    def function_addresses(self) -> list[int]:
        """Return the addresses of the FMI functions, in the order of `FUNCTION_NAMES`."""

    @property
    def is_self_contained(self) -> bool:
        """True if calls of the FMU change nothing else in the process."""

    def locate(self, references: np.ndarray, kind: str, *, to_set: bool = False) -> int:
        """Return the address of variables if they are contiguous in the FMU's memory, else 0."""


class Unloaded:
    """Placeholder for an instance in instructions that are inspected but not executed."""

    address = 0
    is_self_contained = True

    def function_addresses(self) -> list[int]:
        """Return 0 for every function."""
        return [0] * len(FUNCTION_NAMES)

    def locate(self, references: np.ndarray, kind: str, *, to_set: bool = False) -> int:
        """Return 0: the memory is not accessible."""
        return 0


class InstructionRows:
    """Collector of instructions. ``fault_slots`` are numbered as in the program's arrays."""

    def __init__(self, instances: Sequence[Callee], fault_slots: Sequence[int]) -> None:
        self.addresses = [(instance.address, instance.function_addresses()) for instance in instances]
        self._self_contained = [instance.is_self_contained for instance in instances]
        self.between_steps = False  # True if all FMUs are between steps, so that their memory may be accessed directly
        self.fault_slots = fault_slots
        self.rows: list[list[int]] = []
        self._ended = 0  # number of instructions of earlier sections

    def array(self) -> np.ndarray:
        """Return the collected instructions, uint64 [instruction, column]."""
        return np.array(self.rows, dtype=np.uint64).reshape(-1, codes.COLUMNS)

    def call(self, code: int, component: int, function: int, stretch: Stretch = (0, 0)) -> None:
        """Add a call of an FMI function on a range of slots or parameters, or on rows of the transfer table."""
        instance, addresses = self.addresses[component]
        self.rows.append([code, addresses[function], instance, int(stretch[0]), int(stretch[1]), component, function])
        self._restore_floats(component)

    def begin(self) -> None:
        """Start a new list of instructions."""
        self.rows, self._ended = [], 0

    def end_part(self) -> int:
        """End a section, which is executed separately from the next one; return the number of instructions so far."""
        self._ended = len(self.rows)
        return self._ended

    def _restore_floats(self, component: int) -> None:
        """Restore the floating-point environment, once for several consecutive calls of a component."""
        if not self._self_contained[component]:
            restore = [codes.RESTORE_FLOATS, 0, 0, 0, 0, component, 0]
            if len(self.rows) - 2 >= self._ended and self.rows[-2] == restore:
                del self.rows[-2]
            self.rows.append(restore)

    def inject(self, stretch: Stretch) -> None:
        """Add the faults and excitations on a range of slots."""
        for number, slot in enumerate(self.fault_slots):
            if stretch[0] <= slot < stretch[0] + stretch[1]:
                self.rows.append([codes.INJECT, 0, 0, number, 1, 0, 0])
