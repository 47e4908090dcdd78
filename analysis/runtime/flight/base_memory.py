"""The complete memory of a system between two communication points, wherever its FMUs are."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

Snapshot = TypeVar("Snapshot")


@dataclass(frozen=True)
class Cell:
    """One real number that the system remembers: an FMU's variable, or the last value of a connector."""

    name: str
    unit: str | None
    component: str | None  # None: an exchanged value
    place: int  # value reference, or slot


class BaseMemory(ABC, Generic[Snapshot]):
    """The memory of a simulation's FMUs and connectors as real numbers, ``cells``; nothing else is remembered.

    Whole numbers, and what FMUs name as frozen (random number generators, covariances), are saved and put back, but
    are no cells.
    """

    cells: list[Cell]

    @abstractmethod
    def read(self) -> np.ndarray:
        """Read the values of all cells now."""

    @abstractmethod
    def take(self, point: int) -> Snapshot:
        """Save everything at communication point ``point``; `release` it in the end."""

    @abstractmethod
    def put_back(self, snapshot: Snapshot, cell: Cell | None = None, number: float = 0.0) -> None:
        """Restore everything as it was, but for one cell's value."""

    @abstractmethod
    def release(self, snapshot: Snapshot) -> None:
        """Free what `take` saved."""
