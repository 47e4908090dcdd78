"""Rows as aligned columns of text."""

from __future__ import annotations

from collections.abc import Sequence

LONGEST = 48  # characters of a column, beyond which an entry pushes the rest of its line on


def text_table(rows: Sequence[Sequence[str]]) -> list[str]:
    """A line for each row, each column but the last as wide as its entries up to LONGEST."""
    if not rows:
        return []
    widths = [
        max((len(entry) for entry in column if len(entry) <= LONGEST), default=0) for column in zip(*rows, strict=True)
    ]
    return [
        "  ".join(entry.ljust(width) for entry, width in zip(row, [*widths[:-1], 0], strict=True)).rstrip()
        for row in rows
    ]
