"""Representation of values: the types of FMI 3.0 with their ranges, and the corresponding type of the runtime."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

UNBOUNDED = (-np.inf, np.inf)
SINGLE = float(np.finfo(np.float32).max)
EXACT = 2**53  # float64 represents all integers up to this one exactly


class Representation(NamedTuple):
    """Type of FMI 3.0; ``type`` is the corresponding type of the runtime: Real, Integer, Boolean, String or Binary."""

    name: str
    type: str
    dtype: str  # numpy dtype, empty for bytes of any length
    limits: tuple[float, float] = UNBOUNDED  # exact, as Python integers

    @property
    def is_wide(self) -> bool:
        """True if the type contains integers that a float64 cannot represent."""
        return self.dtype in ("int64", "uint64")

    def describe_problem(self) -> str:
        """Return the predicate of the error message for a number that is out of range."""
        return "has more than 32 bits" if self.name == "Int32" else f"is not of type {self.name}"

    def describe_range(self) -> str:
        """Return the permitted integers as text, for use as the object of a sentence."""
        low, high = self.limits
        return "a whole number of 32 bits" if self.name == "Int32" else f"a whole number from {low} to {high}"


def _make_integer(name: str) -> Representation:
    dtype = name.lower()
    limits = np.iinfo(dtype)
    return Representation(name, "Integer", dtype, (int(limits.min), int(limits.max)))


# In the order of the loop's kinds of transfers, `loop.codes`.
REPRESENTATIONS = {
    each.name: each
    for each in (
        Representation("Float64", "Real", "float64"),
        Representation("Float32", "Real", "float32", (-SINGLE, SINGLE)),
        *map(_make_integer, ("Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64")),
        Representation("Boolean", "Boolean", "bool", (0, 1)),
        Representation("String", "String", ""),
        Representation("Binary", "Binary", ""),
    )
}
OF_FMI2 = {"Real": "Float64", "Integer": "Int32", "Enumeration": "Int32", "Boolean": "Boolean", "String": "String"}
TEXTS = ("String", "Binary")  # types that are exchanged and not recorded
