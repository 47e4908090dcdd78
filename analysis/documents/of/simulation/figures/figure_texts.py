"""Texts of figures: ranges, conditions, times, sentences."""

from __future__ import annotations

from ....cell import Inline, Interval, Quantity, Rich
from ....figures.declared import SampleRange


def condition_text(rows: SampleRange) -> list[Inline]:
    """Return the condition that selects samples, as text."""
    unit = rows.signal.unit_name
    condition = (
        Quantity(rows.low, unit, is_bare=True) if rows.low == rows.high else value_range(rows.low, rows.high, unit)
    )
    return [f"{rows.signal.label} is ", condition]


def value_range(low: float | None, high: float | None, unit: str | None) -> Interval:
    """Return the text of a range, without the unit; at most one limit is None."""
    ends = (None if limit is None else Quantity(limit, unit, is_bare=True) for limit in (low, high))
    return Interval(*ends)


def seconds(time: float) -> Quantity:
    """Return a time with its unit."""
    return Quantity(float(time), "s", 6)


def sentence(words: Rich) -> list[Inline]:
    """Return a text as a sentence, with an initial capital and a full stop."""
    first, *others = [words] if isinstance(words, str) else words
    return [capital(first) if isinstance(first, str) else first, *others, "."]


def capital(words: str) -> str:
    """Return a text with an initial capital."""
    return words[:1].upper() + words[1:]


def join(texts: list[list[Inline]], separator: str) -> list[Inline]:
    """Return the texts joined by a separator."""
    return [part for index, text in enumerate(texts) for part in ([separator, *text] if index else text)]
