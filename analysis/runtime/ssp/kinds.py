"""Kinds of connectors, and which may be connected: the table of allowed connections of SSP 2.0.

It includes that of SSP 1.0. The system is the one that contains the connection; elements are inside it.
"""

from __future__ import annotations

PARAMETERS = ("parameter", "structuralParameter")  # have their value before a flight
LED_OUT = ("output", "local", "calculatedParameter", "constant")  # kinds that lead out of a system
OUT = ("output", "local")
VALUES = ("calculatedParameter", *OUT)
IN = ("input", "inout")
ALLOWED: dict[tuple[bool, str], dict[bool, tuple[str, ...]]] = {
    # (whether the source is the system, its kind): kinds of targets by whether they are the system's
    (True, "structuralParameter"): {True: VALUES, False: (*PARAMETERS, *IN)},
    (True, "parameter"): {True: VALUES, False: ("parameter", *IN)},
    (True, "input"): {True: OUT, False: IN},
    (False, "constant"): {True: ("constant", *VALUES), False: (*PARAMETERS, *IN)},
    (False, "calculatedParameter"): {True: VALUES, False: ("parameter", *IN)},
    (False, "output"): {True: OUT, False: IN},
    (False, "local"): {True: OUT, False: IN},
    (False, "inout"): {True: OUT, False: IN},  # the standard has no way from one dictionary to another; we have
}


def can_connect(kind: str, is_system: bool, target: str, is_target_system: bool) -> bool:
    """Return True if values can flow between connectors of these kinds, each of the system or of an element."""
    return target in ALLOWED.get((is_system, kind), {}).get(is_target_system, ())
