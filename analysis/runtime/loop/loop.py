"""Caller of the loop that simulates a system, one run at a time."""

from __future__ import annotations

import ctypes
import threading

from . import arrays
from .library import load_library
from .structures import FilledStructure


class Loop:
    """Loop of a simulation; ``under_way`` is locked during a run, even if its caller no longer waits.

    Unless FMUs are ``self_contained``, the default floating-point environment is restored after each run, however it
    ends.
    """

    def __init__(self, *, self_contained: bool) -> None:
        self._library = load_library()
        self._self_contained = self_contained
        self._run = FilledStructure("Run")
        self.under_way = threading.Lock()

    def fly(self, run: arrays.Run) -> int:
        """Execute a run; return the number of recorded rows."""
        with self.under_way:
            self._run.fill(run)
            rows: int = self._library.perilune_fly(ctypes.byref(self._run.memory))
            if not self._self_contained:
                self._library.perilune_restore_floats()
            return rows

    def fly_group(self, run: arrays.Run, flights: arrays.RunGroup) -> int:
        """Execute a group of runs, each from the start; return the number of executed runs."""
        with self.under_way:
            self._run.fill(run)
            group = FilledStructure("RunGroup")
            group.fill(flights)
            count: int = self._library.perilune_fly_group(ctypes.byref(self._run.memory), ctypes.byref(group.memory))
            return count
