"""Columns of words in a terminal; the last column is wrapped."""

from __future__ import annotations

import itertools
import textwrap
from collections.abc import Sequence

from ..cell import Code, CommandLine
from ..model import Listing
from .words import cell_text

WIDEST = 100  # columns of a line
LONGEST = 48  # characters of a column; longer entries shift the rest of their line
INDENT = "  "  # indentation of rows below a heading


def wrap_line(line: str, indent: int) -> list[str]:
    """Return a line broken into lines of at most WIDEST columns between words, all but the first indented."""
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


def listing_lines(listing: Listing) -> list[str]:
    """Return the lines of a listing; columns have the stated widths, or the widths of their cells up to LONGEST."""
    heading, before = ([listing.heading], INDENT) if listing.heading else ([], "")
    rows = [[before + cell_text(row[0]), *map(cell_text, row[1:])] for row in listing.rows]
    if listing.columns:
        gap, widths = "", [len(before) + listing.columns[0], *listing.columns[1:]]
        indent = sum(widths)
    else:
        gap, widths = "  ", [_width(column) for column in zip(*rows, strict=True)][:-1]
        indent = min(sum(widths) + len(gap) * len(widths), LONGEST)
    lines = [
        gap.join(entry.ljust(width) for entry, width in zip(row, [*widths, 0], strict=True)).rstrip() for row in rows
    ]
    wrapped = (
        [line] if isinstance(row[-1], Code | CommandLine) else wrap_line(line, indent)
        for row, line in zip(listing.rows, lines, strict=True)
    )
    return [*heading, *itertools.chain.from_iterable(wrapped)]


def _width(column: Sequence[str]) -> int:
    return max((len(entry) for entry in column if len(entry) <= LONGEST), default=0)
