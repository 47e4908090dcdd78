"""Rows and progress of a simulation, readable while it runs and after its process has crashed."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np

from ....common.machine.room import check_room
from ..loop import codes

OUTCOME_WORDS = codes.INSTRUCTION + 1


class Phase(IntEnum):
    """Activity of a simulation's FMUs."""

    IDLE = 0
    INSTANTIATION = 1
    FLIGHT = 2
    RENEWAL = 3  # terminated, then reset or instantiated again
    END = 4  # terminated, then freed


@dataclass(eq=False)
class FlightRecorder:
    """``record`` [signals, rows] and ``times`` [rows] (s) of a flight; ``outcome`` is the loop's, see `arrays.Buffers`.

    ``halt`` [1] ends the flight at its next communication point, if someone sets it. ``phase`` [2] is what the
    simulation does, one of `Phase`, and the component that it does it with.
    """

    record: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))
    times: np.ndarray = field(default_factory=lambda: np.empty(0))
    outcome: np.ndarray = field(default_factory=lambda: np.zeros(OUTCOME_WORDS, dtype=np.int64))
    halt: np.ndarray = field(default_factory=lambda: np.zeros(1, dtype=np.int64))
    phase: np.ndarray = field(default_factory=lambda: np.zeros(2, dtype=np.int64))

    def reserve(self, signals: int, rows: int, step: float) -> None:
        """Reserve room for the rows of a simulation.

        Raises ExcessError, which names the ``step`` (s), where memory does not do.
        """
        if self.times.size < rows:
            check_room(signals, rows, step)
            self._allocate(signals, rows)

    def _allocate(self, signals: int, rows: int) -> None:
        self.record = np.empty((signals, rows))
        self.times = np.empty(rows)

    def enter(self, phase: Phase, component: int = 0) -> None:
        """Note what is done next."""
        self.phase[:] = phase, component

    @property
    def point(self) -> int:
        """The communication point that is being computed, or the last one."""
        return int(self.outcome[codes.POINT_REACHED])

    @property
    def subject(self) -> int:
        """The number of the component that was the last to step."""
        return int(self.outcome[codes.SUBJECT])


def rows_between(first: int, last: int, every: int = 1) -> int:
    """Return the number of rows of a flight between two communication points, -1 for its start,
    with every n-th row kept."""
    return (last - max(first, 0)) // every + 2
