"""Kinds of connectors, and the connections that are allowed between them: the table of SSP 2.0.

The table includes the table of SSP 1.0. System connectors belong to the system that contains the connection, element
connectors to the elements inside it.
"""

from __future__ import annotations

PARAMETERS = ("parameter", "structuralParameter")  # kinds with values that are known before a simulation
LED_OUT = ("output", "local", "calculatedParameter", "constant")  # kinds that lead out of a system
OUT = ("output", "local")
VALUES = ("calculatedParameter", *OUT)
IN = ("input", "inout")
ALLOWED: dict[tuple[bool, str], dict[bool, tuple[str, ...]]] = {
    # (True for a source of the system, kind of the source): {True for targets of the system: kinds of targets}
    (True, "structuralParameter"): {True: VALUES, False: (*PARAMETERS, *IN)},
    (True, "parameter"): {True: VALUES, False: ("parameter", *IN)},
    (True, "input"): {True: OUT, False: IN},
    (False, "constant"): {True: ("constant", *VALUES), False: (*PARAMETERS, *IN)},
    (False, "calculatedParameter"): {True: VALUES, False: ("parameter", *IN)},
    (False, "output"): {True: OUT, False: IN},
    (False, "local"): {True: OUT, False: IN},
    (False, "inout"): {True: OUT, False: IN},  # an extension: SSP does not permit connecting two dictionaries
}


def can_connect(kind: str, is_system: bool, target: str, is_target_system: bool) -> bool:
    """Return True if values can flow between connectors of these kinds, each in the system or in an element of it."""
    return target in ALLOWED.get((is_system, kind), {}).get(is_target_system, ())
