"""Fractions in per cent, on pages and in a terminal: plain digits, 0 and 100 only for nothing and all."""

from __future__ import annotations


def percent(fraction: float, decimals: int = 2) -> str:
    """Format a fraction from 0 to 1 in %, without the sign, to ``decimals`` decimals: ``99.50``.

    Fractions other than 0 and 1 never read as 0 or 100: they are ``< 0.01`` or ``> 99.99``.
    """
    text, minimum = f"{100.0 * fraction:.{decimals}f}", 10.0**-decimals
    if fraction > 0.0 and float(text) == 0.0:
        return f"< {minimum:.{decimals}f}"
    if fraction < 1.0 and float(text) == 100.0:
        return f"> {100.0 - minimum:.{decimals}f}"
    return text


def short_percent(fraction: float, decimals: int = 2) -> str:
    """Format the same without zeros at the end, as in running text: ``99.5``."""
    text = percent(fraction, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text
