"""The units that blocks may declare, with their SI base-unit exponents (FMI 2.0 BaseUnit).

Blocks work in SI and radians throughout, so every factor is one.
"""

from __future__ import annotations

UNITS: dict[str, dict[str, int]] = {
    "1": {},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "rad/s2": {"rad": 1, "s": -2},
    "1/s": {"s": -1},
    "s": {"s": 1},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "m/s2": {"m": 1, "s": -2},
    "m2": {"m": 2},
    "m2/s2": {"m": 2, "s": -2},
    "m2/s3": {"m": 2, "s": -3},
    "m3/s2": {"m": 3, "s": -2},
    "kg": {"kg": 1},
    "kg/s": {"kg": 1, "s": -1},
    "kg.m2": {"kg": 1, "m": 2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N.m.s": {"kg": 1, "m": 2, "s": -1},
    "N.s": {"kg": 1, "m": 1, "s": -1},
}
