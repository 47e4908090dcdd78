"""Units by name, as FMI 2.0 defines them: exponents of base units, a factor and an offset.

A name consists of symbols with integer exponents, joined by "." and "/"; a "/" applies to the next symbol only: m/s2,
N.m/rad, kg.m2, 1/s. Blocks of this repository use SI units and radians, so all their factors are one.

Source of factors: the International System of Units (BIPM 2019); the international foot, pound and knot.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache

BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
POUND = 0.45359237  # kg
FOOT = 0.3048  # m
GRAVITY = 9.80665  # m/s2, standard


@dataclass(frozen=True)
class UnitDefinition:
    """Unit in terms of base units: value in base units = factor * value + offset."""

    exponents: dict[str, int]
    factor: float = 1.0
    offset: float = 0.0


SYMBOLS = {
    "1": UnitDefinition({}),
    **{name: UnitDefinition({name: 1}) for name in BASE_UNITS},
    "N": UnitDefinition({"kg": 1, "m": 1, "s": -2}),
    "Pa": UnitDefinition({"kg": 1, "m": -1, "s": -2}),
    "J": UnitDefinition({"kg": 1, "m": 2, "s": -2}),
    "W": UnitDefinition({"kg": 1, "m": 2, "s": -3}),
    "Hz": UnitDefinition({"s": -1}),
    "C": UnitDefinition({"A": 1, "s": 1}),
    "V": UnitDefinition({"kg": 1, "m": 2, "s": -3, "A": -1}),
    "Ohm": UnitDefinition({"kg": 1, "m": 2, "s": -3, "A": -2}),
    "F": UnitDefinition({"kg": -1, "m": -2, "s": 4, "A": 2}),
    "Wb": UnitDefinition({"kg": 1, "m": 2, "s": -2, "A": -1}),
    "T": UnitDefinition({"kg": 1, "s": -2, "A": -1}),
    "H": UnitDefinition({"kg": 1, "m": 2, "s": -2, "A": -2}),
    "g": UnitDefinition({"kg": 1}, 1e-3),
    "t": UnitDefinition({"kg": 1}, 1e3),
    "lb": UnitDefinition({"kg": 1}, POUND),
    "km": UnitDefinition({"m": 1}, 1e3),
    "cm": UnitDefinition({"m": 1}, 1e-2),
    "mm": UnitDefinition({"m": 1}, 1e-3),
    "um": UnitDefinition({"m": 1}, 1e-6),
    "ft": UnitDefinition({"m": 1}, FOOT),
    "in": UnitDefinition({"m": 1}, FOOT / 12.0),
    "nmi": UnitDefinition({"m": 1}, 1852.0),
    "kn": UnitDefinition({"m": 1, "s": -1}, 1852.0 / 3600.0),
    "ms": UnitDefinition({"s": 1}, 1e-3),
    "us": UnitDefinition({"s": 1}, 1e-6),
    "min": UnitDefinition({"s": 1}, 60.0),
    "h": UnitDefinition({"s": 1}, 3600.0),
    "d": UnitDefinition({"s": 1}, 86400.0),
    "deg": UnitDefinition({"rad": 1}, math.pi / 180.0),
    "arcmin": UnitDefinition({"rad": 1}, math.pi / 10800.0),
    "arcsec": UnitDefinition({"rad": 1}, math.pi / 648000.0),
    "rev": UnitDefinition({"rad": 1}, 2.0 * math.pi),
    "mrad": UnitDefinition({"rad": 1}, 1e-3),
    "kN": UnitDefinition({"kg": 1, "m": 1, "s": -2}, 1e3),
    "mN": UnitDefinition({"kg": 1, "m": 1, "s": -2}, 1e-3),
    "lbf": UnitDefinition({"kg": 1, "m": 1, "s": -2}, POUND * GRAVITY),
    "kPa": UnitDefinition({"kg": 1, "m": -1, "s": -2}, 1e3),
    "MPa": UnitDefinition({"kg": 1, "m": -1, "s": -2}, 1e6),
    "bar": UnitDefinition({"kg": 1, "m": -1, "s": -2}, 1e5),
    "kJ": UnitDefinition({"kg": 1, "m": 2, "s": -2}, 1e3),
    "kW": UnitDefinition({"kg": 1, "m": 2, "s": -3}, 1e3),
    "mW": UnitDefinition({"kg": 1, "m": 2, "s": -3}, 1e-3),
    "mV": UnitDefinition({"kg": 1, "m": 2, "s": -3, "A": -1}, 1e-3),
    "mA": UnitDefinition({"A": 1}, 1e-3),
    "nT": UnitDefinition({"kg": 1, "s": -2, "A": -1}, 1e-9),
    "degC": UnitDefinition({"K": 1}, 1.0, 273.15),
    "degF": UnitDefinition({"K": 1}, 5.0 / 9.0, 273.15 - 32.0 * 5.0 / 9.0),
    "percent": UnitDefinition({}, 0.01),
}
PART = re.compile(r"([./]?)([A-Za-z]+|1)(-?\d+)?")


@cache
def unit_definition(name: str) -> UnitDefinition | None:
    """Return the definition of a unit by name, or None if it is not a product of SYMBOLS.

    A unit with an offset cannot occur in a product.
    """
    if name in SYMBOLS:
        return SYMBOLS[name]
    exponents: dict[str, int] = {}
    factor, place = 1.0, 0
    while place < len(name):
        part = PART.match(name, place)
        if part is None or (part.group(1) == "") != (place == 0):
            return None
        symbol = SYMBOLS.get(part.group(2))
        if symbol is None or symbol.offset:
            return None
        power = int(part.group(3) or "1") * (-1 if part.group(1) == "/" else 1)
        factor *= symbol.factor**power
        for base, exponent in symbol.exponents.items():
            exponents[base] = exponents.get(base, 0) + power * exponent
        place = part.end()
    if not name:
        return None
    return UnitDefinition({base: exponents[base] for base in BASE_UNITS if exponents.get(base)}, factor)


def deg(angle: float) -> float:
    """Return an angle in degrees as radians, for parameters written in degrees."""
    return angle * math.pi / 180.0
