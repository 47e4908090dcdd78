"""Rows and progress of a simulation, readable during the simulation and after a crash of its process."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np

from ....common.machine.table_memory import check_table_memory
from ..loop import codes

OUTCOME_WORDS = codes.INSTRUCTION + 1


class FmuActivity(IntEnum):
    """Activity of a simulation: the kind of FMI calls that it is executing."""

    IDLE = 0
    INSTANTIATION = 1
    FLIGHT = 2
    RENEWAL = 3  # terminating, then resetting or instantiating again
    END = 4  # terminating, then freeing


@dataclass(eq=False)
class FlightRecorder:
    """``record`` [signals, rows] and ``times`` [rows] (s) of a flight; for ``outcome`` see `arrays.Buffers`.

    A nonzero ``halt`` [1] ends the flight at its next communication point. ``phase`` [2] contains the current
    `FmuActivity` and the number of the component that it concerns.
    """

    record: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))
    times: np.ndarray = field(default_factory=lambda: np.empty(0))
    outcome: np.ndarray = field(default_factory=lambda: np.zeros(OUTCOME_WORDS, dtype=np.int64))
    halt: np.ndarray = field(default_factory=lambda: np.zeros(1, dtype=np.int64))
    phase: np.ndarray = field(default_factory=lambda: np.zeros(2, dtype=np.int64))

    def reserve(self, signals: int, rows: int, step: float) -> None:
        """Allocate memory for the rows of a simulation, unless enough memory is already allocated.

        Raises ExcessError if memory does not suffice; its message states ``step`` (s).
        """
        if self.times.size < rows:
            check_table_memory(signals, rows, step)
            self._allocate(signals, rows)

    def _allocate(self, signals: int, rows: int) -> None:
        self.record = np.empty((signals, rows))
        self.times = np.empty(rows)

    def enter(self, phase: FmuActivity, component: int = 0) -> None:
        """Record a phase that begins, and the component that it concerns."""
        self.phase[:] = phase, component

    @property
    def point(self) -> int:
        """Number of the communication point being computed, or of the last one."""
        return int(self.outcome[codes.POINT_REACHED])

    @property
    def subject(self) -> int:
        """Number of the component that stepped last."""
        return int(self.outcome[codes.SUBJECT])


def rows_between(first: int, last: int, every: int = 1) -> int:
    """Return the number of rows to allocate for a flight from point ``first`` (-1: its start) to point ``last``.

    Every ``every``-th row is recorded.
    """
    return (last - max(first, 0)) // every + 2
