"""Types of connectors and parameters in SSP 1.0 and 2.0, the runtime's type of each, and which may be connected."""

from __future__ import annotations

RUNTIME_TYPES = {
    **dict.fromkeys(("Real", "Float64", "Float32"), "Real"),
    **dict.fromkeys(
        ("Integer", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64"),
        "Integer",
    ),
    "Boolean": "Boolean",
    "String": "String",
    "Enumeration": "Enumeration",
    "Binary": "Binary",
}
SAME = {"Real": "Float64", "Integer": "Int32"}  # names that FMI 2.0 and SSP 1.0 have for types of FMI 3.0
WIDENED = (("Integer", "Real"), ("Integer", "Enumeration"))  # runtime types of source and target that fit


def runtime_type(name: str) -> str:
    """The type that the runtime computes with, by the name that a document or an FMU has for it."""
    return RUNTIME_TYPES.get(name, name)


def is_same_type(first: str, second: str) -> bool:
    """Whether two names mean one type: Real is Float64, Integer is Int32."""
    return SAME.get(first, first) == SAME.get(second, second)


def fits(source: str, target: str) -> bool:
    """Whether values of one type can be given to another: integers only without loss, Float64 rounded to Float32."""
    kinds = runtime_type(source), runtime_type(target)
    if kinds[0] != kinds[1]:
        return kinds in WIDENED
    if kinds[0] != "Integer":
        return True
    (low, high), (lowest, highest) = integer_range(source), integer_range(target)
    return lowest <= low and high <= highest


def integer_range(name: str) -> tuple[int, int]:
    """The smallest and the largest value of an integer type."""
    exact = SAME.get(name, name)
    bits = int(exact.removeprefix("U").removeprefix("Int"))
    return (0, 2**bits - 1) if exact.startswith("U") else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
