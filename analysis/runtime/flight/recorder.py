"""Rows and progress of a simulation, readable while it runs and after its process has crashed."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np

from ....common.machine.room import check_room
from ..loop import codes

OUTCOME_WORDS = codes.INSTRUCTION + 1


class FmuActivity(IntEnum):
    """Activity of a simulation: the group of FMI calls being executed."""

    IDLE = 0
    INSTANTIATION = 1
    FLIGHT = 2
    RENEWAL = 3  # terminated, then reset or instantiated again
    END = 4  # terminated, then freed


@dataclass(eq=False)
class FlightRecorder:
    """``record`` [signals, rows] and ``times`` [rows] (s) of a flight; for ``outcome`` see `arrays.Buffers`.

    Setting ``halt`` [1] ends the flight at its next communication point. ``phase`` [2] is the current `FmuActivity` and
    the component concerned.
    """

    record: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))
    times: np.ndarray = field(default_factory=lambda: np.empty(0))
    outcome: np.ndarray = field(default_factory=lambda: np.zeros(OUTCOME_WORDS, dtype=np.int64))
    halt: np.ndarray = field(default_factory=lambda: np.zeros(1, dtype=np.int64))
    phase: np.ndarray = field(default_factory=lambda: np.zeros(2, dtype=np.int64))

    def reserve(self, signals: int, rows: int, step: float) -> None:
        """Allocate memory for the rows of a simulation, unless enough is allocated already.

        Raises ExcessError if memory does not suffice; its message names ``step`` (s).
        """
        if self.times.size < rows:
            check_room(signals, rows, step)
            self._allocate(signals, rows)

    def _allocate(self, signals: int, rows: int) -> None:
        self.record = np.empty((signals, rows))
        self.times = np.empty(rows)

    def enter(self, phase: FmuActivity, component: int = 0) -> None:
        """Record the phase that begins, and the component concerned."""
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
