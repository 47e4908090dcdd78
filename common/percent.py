"""Fractions as percentages for pages and terminals, where 0 and 100 mean exactly none and all."""

from __future__ import annotations


def percent(fraction: float, decimals: int = 2) -> str:
    """Return a fraction from 0 to 1 in %, as text without the sign, with ``decimals`` decimals: ``99.50``.

    A fraction other than 0 and 1 never appears as 0 or 100, but as ``< 0.01`` or ``> 99.99``.
    """
    text, minimum = f"{100.0 * fraction:.{decimals}f}", 10.0**-decimals
    if fraction > 0.0 and float(text) == 0.0:
        return f"< {minimum:.{decimals}f}"
    if fraction < 1.0 and float(text) == 100.0:
        return f"> {100.0 - minimum:.{decimals}f}"
    return text


def short_percent(fraction: float, decimals: int = 2) -> str:
    """Return a fraction as `percent` does, without trailing zeros, for running text: ``99.5``."""
    text = percent(fraction, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text
