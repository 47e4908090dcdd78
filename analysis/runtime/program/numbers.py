"""Conversion of values to the types of variables."""

from __future__ import annotations

import math

import numpy as np

from ..fmi.representations import TEXTS
from ..fmi.variable import ScalarVariable
from .component import FailedError, NonFiniteError, Sample

LONGEST = {"String": 4095, "Binary": 65536}  # largest size of an exchanged text in bytes


def as_stored(variable: ScalarVariable, sample: Sample) -> Sample:
    """Return a value converted to its variable's type. Raises NonFiniteError for a number out of range.

    Values of a Float64 are not checked here, since the FMU checks them; a Boolean is true unless it is 0.
    """
    stored = variable.representation
    if variable.type in TEXTS:
        return sample
    if variable.type == "Boolean":
        return sample != 0.0
    number = sample if isinstance(sample, int) else float(sample)
    if stored.name == "Float32":
        number = float(np.float32(number))
    low, high = stored.limits
    if stored.name != "Float64" and not (math.isfinite(number) and low <= number <= high):
        raise NonFiniteError(f"{variable.name} is {number}, beyond the limits of {stored.name}")
    return float(number) if variable.type == "Real" else int(number)


def check_output(variable: ScalarVariable, sample: Sample) -> None:
    """Raise NonFiniteError for a Real that is not finite, FailedError for a text that is too long."""
    if variable.type == "Real" and not math.isfinite(float(sample)):
        raise NonFiniteError(f"{variable.name} is {sample!r}")
    content = sample.encode() if isinstance(sample, str) else sample
    if isinstance(content, bytes) and len(content) > LONGEST[variable.type]:
        raise FailedError(f"{variable.name} has more than {LONGEST[variable.type]} bytes")
