"""Calls of the loop that simulates a system, one at a time."""

from __future__ import annotations

import ctypes
import threading

from . import arrays
from .library import load_library
from .structures import Filled


class Loop:
    """The loop of a simulation; ``under_way`` is locked during a run, also one that has been given up.

    Where FMUs are not ``self_contained`` the floating-point environment is the default after each call, whatever ended
    it.
    """

    def __init__(self, *, self_contained: bool) -> None:
        self._library = load_library()
        self._self_contained = self_contained
        self._run = Filled("Run")
        self.under_way = threading.Lock()

    def fly(self, run: arrays.Run) -> int:
        """Run once; return the number of rows in the record."""
        with self.under_way:
            self._run.fill(run)
            rows: int = self._library.perilune_fly(ctypes.byref(self._run.memory))
            if not self._self_contained:
                self._library.perilune_restore_floats()
            return rows

    def fly_group(self, run: arrays.Run, flights: arrays.Group) -> int:
        """Simulate a group of runs from their start; return the number of simulated ones."""
        with self.under_way:
            self._run.fill(run)
            group = Filled("Group")
            group.fill(flights)
            count: int = self._library.perilune_fly_group(ctypes.byref(self._run.memory), ctypes.byref(group.memory))
            return count
