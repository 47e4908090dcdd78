"""The memory of a system that flies in a child; see `flight.memory.Memory`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..flight.base_memory import BaseMemory, Cell
from .protocol import messages


@dataclass(frozen=True)
class ApartSnapshot:
    """What a child has saved at a communication point."""

    point: int
    number: int


class Answering(Protocol):
    """What answers requests: a simulation in a child."""

    def ask(self, request: object, expected: type[messages.Kind]) -> messages.Kind: ...

    def ask_numbers(self, request: object, count: int) -> np.ndarray: ...


class ApartMemory(BaseMemory[ApartSnapshot]):
    """The memory of a simulation in a child. Raises InputError."""

    def __init__(self, simulation: Answering) -> None:
        self._simulation = simulation
        self.cells = [Cell(*cell) for cell in simulation.ask(messages.ListMemory(), messages.CellList).entries]

    def read(self) -> np.ndarray:
        """The values of all cells now."""
        return self._simulation.ask_numbers(messages.ReadMemory(), len(self.cells))

    def take(self, point: int) -> ApartSnapshot:
        """Save everything at communication point ``point``; `release` it in the end."""
        return ApartSnapshot(point, self._simulation.ask(messages.TakeSnapshot(point), messages.Done).number)

    def put_back(self, snapshot: ApartSnapshot, cell: Cell | None = None, number: float = 0.0) -> None:
        """Everything as it was, but for one cell's value."""
        index = None if cell is None else self.cells.index(cell)
        self._simulation.ask(messages.PutBack(snapshot.number, index, number), messages.Done)

    def release(self, snapshot: ApartSnapshot) -> None:
        """Free what `take` saved."""
        self._simulation.ask(messages.ReleaseSnapshot(snapshot.number), messages.Done)
