"""Text for a terminal: aligned columns, lines no longer than 100 columns."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

WIDEST = 100  # columns of a line
LONGEST = 48  # characters of a column, beyond which an entry pushes the rest of its line on


def wrap(line: str, indent: int) -> list[str]:
    """A line as lines of at most WIDEST columns, all but the first indented; words are not broken."""
    if len(line) <= WIDEST:
        return [line.rstrip()]
    return textwrap.wrap(
        line,
        WIDEST,
        subsequent_indent=" " * indent,
        break_long_words=False,
        break_on_hyphens=False,
        replace_whitespace=False,
        drop_whitespace=True,
        expand_tabs=False,
    )


def text_table(rows: Sequence[Sequence[str]]) -> list[str]:
    """Lines for each row, each column but the last as wide as its entries up to LONGEST; the last one is wrapped."""
    if not rows:
        return []
    widths = [
        max((len(entry) for entry in column if len(entry) <= LONGEST), default=0) for column in zip(*rows, strict=True)
    ][:-1]
    indent = min(sum(widths) + 2 * len(widths), LONGEST)
    return [
        line
        for row in rows
        for line in wrap(
            "  ".join(entry.ljust(width) for entry, width in zip(row, [*widths, 0], strict=True)).rstrip(), indent
        )
    ]
