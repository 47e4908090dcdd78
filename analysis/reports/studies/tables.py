"""Tables of a study's page: headings, rows of cells, and which columns hold numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from markupsafe import Markup

from ..kit.page import exact


class Table(NamedTuple):
    """Headings and rows of cells; the columns ``numbers`` are set to the right."""

    heads: Sequence[str]
    rows: Sequence[Sequence[Markup | str]]
    numbers: Sequence[int]


def cell(value: Any, digits: int = 4, unit: str | None = None) -> Markup:
    """A number for reading with the exact value in the markup, or a word as it is."""
    return exact(value, unit, digits)


def interval(low: float | None, high: float | None, digits: int = 3) -> Markup:
    """The two ends of an interval."""
    return Markup("{} to {}").format(exact(low, None, digits), exact(high, None, digits))
