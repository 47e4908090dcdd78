"""The compiled functions that fly a simulation, each got ready when it is called for the first time."""

from __future__ import annotations

import threading
from collections.abc import Callable

from .compiled import arrays, group, loop
from .compiled.floats import float_restorer

Arguments = tuple[object, ...]  # of the loop, but for what fused steps have


class Loops:
    """Calls them one at a time; ``locked`` where FMUs need the interpreter lock, ``fused`` where steps are compiled.

    ``under_way`` is locked while a flight goes on, also one that has been given up. Where FMUs are not
    ``self_contained`` the floating-point environment is the default after each call, whatever ended it.
    """

    def __init__(self, *, locked: bool, with_fmi3: bool, fused: arrays.Fused | None, self_contained: bool) -> None:
        self._locked = locked
        self._self_contained = self_contained
        self._with_fmi3 = with_fmi3
        self.fused = fused
        self._ready: dict[str, Callable[..., int]] = {}
        self.under_way = threading.Lock()

    def unlock(self, arguments: Arguments) -> None:
        """Have the loop fly without the interpreter lock, and compiled for arguments like these."""
        self._locked = False
        self._ready = {}
        self._loop((*arguments, self.fused or ()))

    def fly(self, arguments: Arguments) -> int:
        """One flight; returns the number of rows in the record."""
        with self.under_way:
            complete = (*arguments, self.fused or ())
            return self._call(complete)

    def interpret(self, arguments: Arguments) -> int:
        """Likewise, by the program's instructions, whatever is fused."""
        with self.under_way:
            return self._call((*arguments, ()))

    def fly_group(self, arguments: Arguments, flights: arrays.Group) -> int:
        """A group of flights; returns how many have flown."""
        with self.under_way:
            complete = (*arguments, self.fused or (), flights)
            if "group" not in self._ready:
                with_fused = self.fused is not None
                self._ready["group"] = group.compile_for(complete, locked=self._locked, with_fused=with_fused)
            return self._ready["group"](*complete)

    def _call(self, arguments: Arguments) -> int:
        rows = self._loop(arguments)(*arguments)
        if not self._self_contained:
            float_restorer()()
        return rows

    def _loop(self, arguments: Arguments) -> Callable[..., int]:
        with_fused = bool(arguments[-1])
        name = "fused" if with_fused else "interpreted"
        if name not in self._ready:
            self._ready[name] = loop.compile_for(
                arguments, locked=self._locked, with_fmi3=self._with_fmi3, with_fused=with_fused
            )
        return self._ready[name]
