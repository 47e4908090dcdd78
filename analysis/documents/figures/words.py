"""Words of figures: ranges, conditions, times, sentences."""

from __future__ import annotations

from markupsafe import Markup

from ..common.page import exact
from .declared import Rows


def condition_text(rows: Rows) -> Markup:
    """Return the condition of a selection of samples."""
    unit = rows.signal.unit_name
    condition = exact(rows.low, unit) if rows.low == rows.high else range_text(rows.low, rows.high, unit)
    return Markup("{} is {}").format(rows.signal.label, condition)


def range_text(low: float | None, high: float | None, unit: str | None) -> Markup:
    """Return the range between two limits of which at most one is None, without the unit."""
    if low is None or high is None:
        token, limit = ("at least", low) if high is None else ("at most", high)
        return Markup("{} {}").format(token, exact(limit, unit))
    return Markup("{} to {}").format(exact(low, unit), exact(high, unit))


def seconds(time: float) -> Markup:
    """Return a time with its unit."""
    return Markup("{} s").format(exact(float(time), digits=6))


def sentence(words: Markup) -> Markup:
    """Return a text as a sentence: with a capital first and a full stop last."""
    return Markup("{}.").format(Markup(capital(words)))


def capital(words: str) -> str:
    """Return a text with a capital first."""
    return words[:1].upper() + words[1:]
