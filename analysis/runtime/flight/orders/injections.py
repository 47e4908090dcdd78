"""Faults and excitations as the loop applies them to slots."""

from __future__ import annotations

import math
from typing import NamedTuple

from ....options.fault import Fault
from ...loop import codes

KIND_NUMBERS = {"override": codes.OVERRIDE, "bias": codes.BIAS, "freeze": codes.FREEZE}
NEVER = (math.inf, math.inf)  # the window of a fault that does not fly


class Injection(NamedTuple):
    """One of the loop's faults: a connector, what is done to it, and in which window [from, until) s.

    ``value`` is in the connector's unit; of an excitation it is the column that is added.
    """

    connector: str
    kind: int
    value: float
    window: tuple[float, float]


def of_fault(fault: Fault, margin: float) -> Injection:
    """Return the injection of a fault; ``margin`` (s) is the rounding that the times of communication points may
    lack."""
    window = (fault.start - margin, fault.stop - margin)
    return Injection(fault.name, KIND_NUMBERS[fault.kind], float(fault.value), window)


def of_excitation(connector: str, column: int) -> Injection:
    """Return the injection for a connector to which `Simulation.advance` adds a column of its excitation, in its
    unit."""
    return Injection(connector, codes.EXCITE, float(column), (-math.inf, math.inf))
