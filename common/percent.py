"""Fractions in per cent, on pages and in a terminal: plain digits, 0 and 100 only for nothing and all."""

from __future__ import annotations


def percent(fraction: float, decimals: int = 2) -> str:
    """A fraction from 0 to 1 in %, without the sign, to so many decimals: ``99.50``.

    What is neither 0 nor 1 never reads as 0 or 100: it is ``< 0.01`` or ``> 99.99``.
    """
    text, minimum = f"{100.0 * fraction:.{decimals}f}", 10.0**-decimals
    if fraction > 0.0 and float(text) == 0.0:
        return f"< {minimum:.{decimals}f}"
    if fraction < 1.0 and float(text) == 100.0:
        return f"> {100.0 - minimum:.{decimals}f}"
    return text


def short_percent(fraction: float, decimals: int = 2) -> str:
    """The same without zeros at the end, as a text has it: ``99.5``."""
    text = percent(fraction, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text
