"""Display of a result in a notebook: a heading, a few tables, one figure, without side effects on other cells."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from markupsafe import Markup
from matplotlib.figure import Figure as Plot

from .page import render_page
from .quantities import display_unit, in_display_unit, number
from .svg import svg_bytes

TEMPLATE = Path(__file__).with_name("notebook.html")
MOST_ROWS = 12


class CellGrid(NamedTuple):
    """A small table: head cells and rows of cells, as text or markup."""

    head: Sequence[str]
    rows: Sequence[Sequence[Markup | str]]


def notebook_view(title: str, words: Iterable[str], grids: Iterable[CellGrid], plot: Plot | None) -> str:
    """Return the HTML of a result; a long table is cut to its first rows, followed by the number of all rows."""
    displayed = [(grid.head, grid.rows[:MOST_ROWS], len(grid.rows)) for grid in grids if grid.rows]
    picture = None
    if plot is not None:  # text as paths, with identifiers unique among the notebook's figures
        svg = svg_bytes(plot, "notebook", text_as_paths=True)
        picture = f"data:image/svg+xml;base64,{b64encode(svg).decode()}"
    return render_page(TEMPLATE, title=title, words=list(filter(None, words)), grids=displayed, picture=picture)


def value_text(values: Iterable[Any], unit: str | None) -> str:
    """Return numbers with their unit, angles in deg."""
    text = ", ".join(number(in_display_unit(value, unit)) for value in values)
    return f"{text} {display_unit(unit)}".strip()
