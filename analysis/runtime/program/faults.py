"""Faults that the reference loop applies to values, by connector name."""

from __future__ import annotations

from collections.abc import Sequence

from ...options.fault import Fault
from .component import Sample

MARGIN = 1e-6  # fraction of a step, because times of communication points, start + n step, are rounded


class Faults:
    """Faults of a simulation, in order of application; each begins and ends ``margin`` (s) earlier than declared."""

    def __init__(self, faults: Sequence[Fault], step: float) -> None:
        self._faults = faults
        self._margin = MARGIN * step
        self._frozen: dict[int, Sample] = {}  # values at the beginning of freezes, by number of the fault

    def apply(self, name: str, sample: Sample, time: float) -> Sample:
        """Return the value of a connector at a time (s) after all of its faults have been applied in turn."""
        for number, fault in enumerate(self._faults):
            if fault.name == name and fault.start - self._margin <= time < fault.stop - self._margin:
                if fault.kind == "override":
                    sample = float(fault.value)
                elif fault.kind == "bias":
                    sample = add(sample, fault.value)
                else:
                    sample = self._frozen.setdefault(number, sample)
        return sample


def add(sample: Sample, bias: float) -> Sample:
    """Return a number plus a bias; the sum is exact for integers, whose bias is an integer."""
    return sample + int(bias) if isinstance(sample, int) else float(sample) + float(bias)
