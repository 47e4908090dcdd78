"""The compiled functions that fly a simulation, each got ready when it is called for the first time."""

from __future__ import annotations

import threading
from collections.abc import Callable

from .compiled import arrays, group, loop

Arguments = tuple[object, ...]  # of the loop; the last one is what fused steps have, or an empty tuple


class Loops:
    """Calls them one at a time; ``locked`` where FMUs need the interpreter lock.

    ``under_way`` is locked while a flight goes on, also one that has been given up.
    """

    def __init__(self, *, locked: bool, with_fmi3: bool) -> None:
        self._locked = locked
        self._with_fmi3 = with_fmi3
        self._ready: dict[tuple[str, bool], Callable[..., int]] = {}
        self.under_way = threading.Lock()

    def unlock(self, arguments: Arguments) -> None:
        """Have the loop fly without the interpreter lock, and compiled for arguments like these."""
        self._locked = False
        self._ready = {}
        self._loop(arguments)

    def fly(self, arguments: Arguments) -> int:
        """One flight; returns the number of rows in the record."""
        with self.under_way:
            return self._loop(arguments)(*arguments)

    def fly_group(self, arguments: Arguments, flights: arrays.Group) -> int:
        """A group of flights; returns how many have flown."""
        with self.under_way:
            with_fused = bool(arguments[-1])
            if ("group", with_fused) not in self._ready:
                self._ready["group", with_fused] = group.compile_for(
                    (*arguments, flights), locked=self._locked, with_fused=with_fused
                )
            return self._ready["group", with_fused](*arguments, flights)

    def _loop(self, arguments: Arguments) -> Callable[..., int]:
        with_fused = bool(arguments[-1])
        if ("loop", with_fused) not in self._ready:
            self._ready["loop", with_fused] = loop.compile_for(
                arguments, locked=self._locked, with_fmi3=self._with_fmi3, with_fused=with_fused
            )
        return self._ready["loop", with_fused]
