"""Numbers and units as pages show them: SI internally, degrees and superscripts on screen."""

from __future__ import annotations

import math
import re
from typing import Any

RADIANS = re.compile(r"rad(/s[23]?)?")
POWER = re.compile(r"(?<=[A-Za-z])(-?\d)")
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MINUS = "\N{MINUS SIGN}"
NONE = "\N{EN DASH}"
PLAIN_DIGITS = 6  # digits before the point; larger numbers have an exponent


def display_unit(unit: str | None) -> str:
    """Return a unit as displayed: ``m/s2`` is m/s², radians (per second) become degrees, ``1`` and None are empty."""
    if unit is None or unit == "1":
        return ""
    return declared_unit(unit.replace("rad", "deg") if RADIANS.fullmatch(unit) else unit)


def declared_unit(unit: str | None) -> str:
    """Return a connector's unit as text, radians included: ``rad/s2`` is rad/s², ``1`` and None are empty."""
    if unit is None or unit == "1":
        return ""
    return POWER.sub(lambda power: power.group(1).translate(SUPERSCRIPTS), unit).replace(".", "·")


def display_factor(unit: str | None) -> float:
    """Return the factor that converts a value in ``unit`` to its `display_unit`."""
    return math.degrees(1.0) if unit is not None and RADIANS.fullmatch(unit) else 1.0


def label_with_unit(name: str, unit: str | None) -> str:
    """Return an axis label: ``name, unit``, or the name alone without a unit."""
    displayed = display_unit(unit)
    return f"{name}, {displayed}" if displayed else name


def number(value: Any, digits: int = 4, decimals: int | None = None) -> str:
    """Return a number with ``digits`` significant digits, and an exponent if it is large; None is a dash.

    ``decimals`` sets the number of decimals instead, for numbers of the order of 1.
    """
    if value is None:
        return NONE
    if isinstance(value, bool | str):
        return str(value).lower() if isinstance(value, bool) else value
    if isinstance(value, int):
        return str(value).replace("-", MINUS)
    if not math.isfinite(value):
        return {math.inf: "∞", -math.inf: f"{MINUS}∞"}.get(value, "not a number")
    if decimals is not None:
        return f"{round(value, decimals) + 0.0:.{decimals}f}".replace("-", MINUS)
    text = f"{value + 0.0:.{digits}g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        if 0 < int(exponent) < PLAIN_DIGITS:
            return f"{float(text):.0f}".replace("-", MINUS)
        return f"{mantissa.replace('-', MINUS)}e{int(exponent)}"
    return text.replace("-", MINUS)


def in_display_unit(value: Any, unit: str | None) -> Any:
    """Convert a value in ``unit`` to its displayed unit; Integers, Booleans and None remain unchanged."""
    factor = display_factor(unit)
    return value if factor == 1.0 or value is None or isinstance(value, bool | str) else value * factor


def tick(value: float, _: int = 0) -> str:
    """Return a tick label: plain digits, a proper minus sign, no offset."""
    text = f"{value:.10g}"
    if text.endswith("00000") and abs(value) >= 1e6:
        text = f"{value:.6g}"
    return number(value, 6) if "e" in text else text.replace("-", MINUS)


def log_tick(value: float, _: int = 0) -> str:
    """Return a tick label of a logarithmic axis: plain digits near 1, powers of ten elsewhere."""
    if 1e-2 <= value < 1e4:
        return tick(value)
    mantissa, exponent = f"{value:.0e}".split("e")
    power = f"10{str(int(exponent)).translate(SUPERSCRIPTS)}"
    return power if mantissa == "1" else f"{mantissa}·{power}"
