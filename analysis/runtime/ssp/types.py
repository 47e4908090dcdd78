"""Types of connectors and parameters in SSP 1.0 and 2.0, and the corresponding types of the runtime."""

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
WHOLE = ("Integer", "Enumeration")  # the runtime's integer types
GENERAL = ("Real", "Integer")  # the only numeric types of SSP 1.0, also for variables of FMI 3.0


def runtime_type(name: str) -> str:
    """Return the runtime's type for the name of a type in a document or an FMU."""
    return RUNTIME_TYPES.get(name, name)


def is_of_type(stored: str, declared: str) -> bool:
    """Return True if a variable's type fits the declared type: Real and Integer include all types of their kind.

    An Enumeration may be declared as an Integer, as in older FMUs, since its items are numbers.
    """
    kinds = WHOLE if declared == "Integer" else (declared,)
    return stored == declared or (declared in GENERAL and runtime_type(stored) in kinds)


def integer_range(name: str) -> tuple[int, int]:
    """Return the smallest and largest value of an integer type."""
    exact = "Int32" if name == "Integer" else name
    bits = int(exact.removeprefix("U").removeprefix("Int"))
    return (0, 2**bits - 1) if exact.startswith("U") else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
