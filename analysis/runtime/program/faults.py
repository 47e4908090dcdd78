"""Faults as the reference loop applies them to values, by the names of connectors."""

from __future__ import annotations

from collections.abc import Sequence

from ..system.fault import Fault
from .component import Value

MARGIN = 1e-6  # of a step: the times of communication points, start + n step, carry rounding


class Faults:
    """Faults of one flight, in order; ``margin`` (s) is how much earlier than declared each begins and ends."""

    def __init__(self, faults: Sequence[Fault], step: float) -> None:
        self._faults = faults
        self._margin = MARGIN * step
        self._held: dict[int, Value] = {}  # by the number of a freeze, from when it began

    def apply(self, name: str, value: Value, time: float) -> Value:
        """Return what a connector has at a time (s) instead of its value, each fault behind those before it."""
        for number, fault in enumerate(self._faults):
            if fault.name == name and fault.start - self._margin <= time < fault.stop - self._margin:
                if fault.kind == "override":
                    value = float(fault.value)
                elif fault.kind == "bias":
                    value = float(value) + float(fault.value)
                else:
                    value = self._held.setdefault(number, value)
        return value
