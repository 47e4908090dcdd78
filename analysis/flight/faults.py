"""What is injected on connectors while a system flies: faults, and signals that excite it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import InputError
from . import loop

KINDS = {"override": loop.OVERRIDE, "bias": loop.BIAS, "freeze": loop.FREEZE}


@dataclass(frozen=True)
class Fault:
    """A connector's value replaced (override), shifted (bias) or held (freeze) in [start, stop) s.

    ``name`` is ``component.connector``: on an output every reader sees the fault, on an input
    only that component. ``value`` is in the connector's unit and unused by freeze. Raises
    InputError for an unknown kind or a window that is empty.
    """

    name: str
    kind: str
    value: float = 0.0
    start: float = 0.0
    stop: float = math.inf

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise InputError("fault", self.name, f"unknown kind {self.kind}", f"use one of {', '.join(KINDS)}")
        if not self.start < self.stop or not math.isfinite(self.value):
            raise InputError("fault", self.name, "empty window or value not finite", "give start < stop and a number")

    @property
    def kind_number(self) -> int:
        return KINDS[self.kind]

    @property
    def window(self) -> tuple[float, float]:
        return self.start, self.stop


@dataclass(frozen=True)
class Excitation:
    """A connector to which `Simulation.advance` adds the given column of its excitation, in the connector's unit."""

    name: str
    column: int

    kind_number = loop.EXCITE
    window = (-math.inf, math.inf)

    @property
    def value(self) -> float:
        return float(self.column)


Injection = Fault | Excitation
