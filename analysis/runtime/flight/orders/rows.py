"""Instructions as they are collected, and the injections that are put between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...instances.instance import Instance
from ..compiled import codes

Piece = tuple[int, int]  # first, and how many


class Rows:
    """Collects ``rows`` of instructions. ``fault_slots`` are numbered as in the program's arrays."""

    def __init__(self, instances: Sequence[Instance], fault_slots: Sequence[int]) -> None:
        self.addresses = [(instance.address, instance.function_addresses()) for instance in instances]
        self.between_steps = False  # all FMUs: what they give and take then may be in their memory
        self.fault_slots = fault_slots
        self.rows: list[list[int]] = []

    def array(self) -> np.ndarray:
        """What has been collected."""
        return np.array(self.rows, dtype=np.uint64).reshape(-1, codes.COLUMNS)

    def call(self, code: int, component: int, function: int, piece: Piece = (0, 0)) -> None:
        """A call of an FMI function on a piece of slots or parameters, or on a piece of the table."""
        instance, addresses = self.addresses[component]
        self.rows.append([code, addresses[function], instance, int(piece[0]), int(piece[1]), component, function])

    def inject(self, piece: Piece) -> None:
        """The faults on a piece of slots."""
        for number, slot in enumerate(self.fault_slots):
            if piece[0] <= slot < piece[0] + piece[1]:
                self.rows.append([codes.INJECT, 0, 0, number, 1, 0, 0])
