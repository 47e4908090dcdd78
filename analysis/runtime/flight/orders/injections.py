"""Faults and excitations as the loop applies them to slots."""

from __future__ import annotations

import math
from typing import NamedTuple

from ....options.fault import Fault
from ...loop import codes

KIND_NUMBERS = {"override": codes.OVERRIDE, "bias": codes.BIAS, "freeze": codes.FREEZE}
NEVER = (math.inf, math.inf)  # window of a fault that never acts


class Injection(NamedTuple):
    """Fault or excitation of a connector, active in the window [from, until) in s.

    ``value`` is in the connector's unit; for an excitation it is the number of the column to add.
    """

    connector: str
    kind: int
    value: float
    window: tuple[float, float]


def of_fault(fault: Fault, margin: float) -> Injection:
    """Return the injection of a fault; ``margin`` (s) allows for rounding of the times of communication points."""
    window = (fault.start - margin, fault.stop - margin)
    return Injection(fault.name, KIND_NUMBERS[fault.kind], float(fault.value), window)


def of_excitation(connector: str, column: int) -> Injection:
    """Return the injection that adds a column of `Simulation.advance`'s excitation, in the connector's unit."""
    return Injection(connector, codes.EXCITE, float(column), (-math.inf, math.inf))
