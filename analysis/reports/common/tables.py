"""Tables of a page: headings, rows of cells, and which columns hold numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from markupsafe import Markup

from .page import exact
from .quantities import MINUS

PLACES = 3  # decimals of a fraction


class Table(NamedTuple):
    """Headings and rows of cells; the columns ``numbers`` are aligned right."""

    heads: Sequence[str]
    rows: Sequence[Sequence[Markup | str]]
    numbers: Sequence[int]


def cell(value: Any, digits: int = 4, unit: str | None = None) -> Markup:
    """A number with so many significant digits and the exact value in the markup, or a word as it is."""
    return exact(value, unit, digits)


def fraction(value: float | None) -> Markup:
    """A number of the order of 1 with `PLACES` decimals and the exact value in the markup."""
    if value is None or not math.isfinite(value):
        return exact(value)
    displayed = f"{round(value, PLACES) + 0.0:.{PLACES}f}".replace("-", MINUS)
    return Markup('<data value="{}">{}</data>').format(repr(value), displayed)


def fractions(low: float | None, high: float | None) -> Markup:
    """The two ends of an interval."""
    return Markup("{} to {}").format(fraction(low), fraction(high))
