"""Native instance of a block whose variables are set and read by name, including arrays."""

from __future__ import annotations

from typing import Any

import numpy as np

from perilune.fmus_src.block import Block
from tests.support.kernels.native_instance import OK, NativeInstance


class NamedInstance:
    """One instance, started with parameters and inputs at a time (s); ``plant["position"]`` has all its elements.

    Freed with the object. Steps fail the test where the FMU reports an error.
    """

    def __init__(self, block: type[Block], start_time: float = 0.0, **settings: Any) -> None:
        self.instance = NativeInstance(block)
        self.references: dict[str, list[int]] = {}
        first = 0
        for name, variable in block.variables.items():
            self.references[name] = list(range(first, first + variable.size))
            first += variable.size
        self.time = start_time
        self.instance.enter(start_time)
        self.set(**settings)
        assert self.instance.start() == OK, self.instance.log

    def __del__(self) -> None:
        self.instance.free()

    def set(self, **settings: Any) -> None:
        """Set variables, each from a number or an array of any shape."""
        for name, number in settings.items():
            references = self.references[name]
            numbers = np.asarray(number).ravel().tolist()
            assert len(numbers) == len(references), name
            assert self.instance.set(references, numbers) == OK, (name, self.instance.log)

    def __getitem__(self, name: str) -> Any:
        numbers = self.instance.get(self.references[name])
        assert numbers is not None, self.instance.log
        return np.array(numbers) if len(numbers) > 1 else numbers[0]

    def step(self, time: float, step: float) -> None:
        """Take one communication step from a time (s)."""
        assert self.instance.do_step(time, step) == OK, self.instance.log

    def read(self) -> list | None:
        """Return all numbers, in order of declaration."""
        return self.instance.get([reference for group in self.references.values() for reference in group])

    def fly(self, duration: float, steps: int = 1) -> NamedInstance:
        """Fly for a duration (s) in equal communication steps."""
        for _ in range(steps):
            h = duration / steps
            self.step(self.time, h)
            self.time += h
        return self
