"""Interface to the complete memory of a system at a communication point, in this process or in a child."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

Snapshot = TypeVar("Snapshot")


@dataclass(frozen=True)
class MemoryCell:
    """One real number in a system's memory: a variable of an FMU, or the value last exchanged at a connector."""

    name: str
    unit: str | None
    component: str | None  # None: an exchanged value
    place: int  # value reference, or slot


class BaseMemory(ABC, Generic[Snapshot]):
    """Complete memory of a simulation's FMUs and connectors; ``cells`` are its real numbers.

    Integers, and variables that FMUs declare frozen (random number generators, covariances), are saved and restored,
    but they are no cells.
    """

    cells: list[MemoryCell]

    @abstractmethod
    def read(self) -> np.ndarray:
        """Return the current values of all cells, in the order of ``cells``."""

    @abstractmethod
    def save(self, point: int) -> Snapshot:
        """Save the complete memory at communication point ``point``. Free it with `release`."""

    @abstractmethod
    def restore(self, snapshot: Snapshot, cell: MemoryCell | None = None, number: float = 0.0) -> None:
        """Restore a snapshot; if ``cell`` is passed, set this cell to ``number`` afterwards."""

    @abstractmethod
    def release(self, snapshot: Snapshot) -> None:
        """Free the memory of a snapshot."""
