"""Renderer of a document as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

from ..cell import Cell, Head, Rich, Row, RowHeading, RowNote
from ..chart.panel import chart_panel, stack_panel, wide_figure
from ..chart.write_svg import no_trials
from ..common.page import write_page
from ..common.panels import HALF_WIDTH, PANEL_WIDTH, FigurePanel, swatch
from ..interactive.script_bundles import MISSING
from ..model import Document, Medium, Table, select
from ..pictures import Figure
from .cell_markup import cell_class, cell_markup, entry_markup, is_number, legend_swatch, rich_markup
from .diagram import diagram_svg

TEMPLATE = Path(__file__).with_name("document.html")
COLUMNS = {"": "", "numbers": "n", "names": "who", "sentences": "long"}  # CSS classes by the setting of a column


def write_document(document: Document, path: Path) -> None:
    """Write the page of a document, reproducible to the byte."""
    write_page(
        path,
        TEMPLATE,
        title=document.title,
        document=document,
        sections=[*document.sections, *document.page_sections()],
        cell=cell_markup,
        rich=rich_markup,
        layout=lay_out,
        rows=_rows,
        swatch=swatch,
        entry_of=entry_markup,
        diagram=diagram_svg,
        on_page=lambda node: select(node, Medium.PAGE),
        scripts_missing=MISSING,
    )


class HeadCell(NamedTuple):
    """A cell of a table head that spans ``columns`` and ``rows``; ``kind`` is its CSS class."""

    text: str
    note: Rich
    kind: str
    columns: int = 1
    rows: int = 1


class BodyRow(NamedTuple):
    """A row of a table body: cells with their CSS classes, or one text across all columns."""

    content: Sequence[tuple[str, Cell]] = ()
    anchor: str = ""
    is_first: bool = False
    heading: RowHeading | None = None
    note: RowNote | None = None


class TableLayout(NamedTuple):
    """Layout of a table on a page: one or two rows of heads, the rows of its body, the number of columns."""

    heads: Sequence[Sequence[HeadCell]]
    rows: Sequence[BodyRow]
    columns: int


def lay_out(table: Table) -> TableLayout:
    """Return the layout of a table with the classes and spans of its cells."""
    heads = [head if isinstance(head, Head) else Head(head) for head in table.heads]
    plain = [row for row in table.rows if not isinstance(row, RowHeading | RowNote)]
    contents = [row.content if isinstance(row, Row) else row for row in plain]
    declared = [COLUMNS[head.column] for head in heads for _ in range(max(1, len(head.below)))]
    kinds = [kind or _kind_of([row[column] for row in contents]) for column, kind in enumerate(declared)]
    starts = [sum(max(1, len(each.below)) for each in heads[:index]) for index in range(len(heads))]
    has_two = any(head.below for head in heads)
    upper = [
        HeadCell(
            head.text,
            head.note,
            _head_kind(kinds[start]),
            max(1, len(head.below)),
            2 if has_two and not head.below else 1,
        )
        for head, start in zip(heads, starts, strict=True)
    ]
    lower = [
        HeadCell(text, "", _head_kind(kinds[start + index]))
        for head, start in zip(heads, starts, strict=True)
        for index, text in enumerate(head.below)
    ]
    return TableLayout([upper, lower] if has_two else [upper], _body(table, kinds), len(kinds))


def _kind_of(column: Sequence[Cell]) -> str:
    """Return the CSS class of a column whose head does not state one."""
    return "n" if column and all(map(is_number, column)) else ""


def _head_kind(kind: str) -> str:
    return kind if kind == "n" else ""


def _body(table: Table, kinds: Sequence[str]) -> list[BodyRow]:
    body: list[BodyRow] = []
    above: Cell = None
    for row in table.rows:
        match row:
            case RowHeading():
                body.append(BodyRow(heading=row, is_first=True))
                above = None
                continue
            case RowNote():
                body.append(BodyRow(note=row))
                continue
        content, anchor, is_first = row if isinstance(row, Row) else Row(row)
        first = content[0]
        is_new = not table.is_grouped or first != above
        above = first
        classes = [cell_class(cell, kind) for cell, kind in zip(content, kinds, strict=True)]
        displayed = [first if is_new else "", *content[1:]]
        starts_group = is_first or (table.is_grouped and is_new)
        body.append(BodyRow(list(zip(classes, displayed, strict=True)), anchor, starts_group))
    return body


def _rows(figures: Sequence[Figure]) -> list[tuple[str, list[tuple[Figure, FigurePanel]]]]:
    """Group consecutive figures of equal width; the key is "wide", "halves" or "" (narrow)."""
    return [(kind, [(figure, panel_of(figure)) for figure in run]) for kind, run in groupby(figures, _kind)]


def _kind(figure: Figure) -> str:
    return "wide" if figure.is_wide else "" if figure.is_narrow else "halves"


def panel_of(figure: Figure) -> FigurePanel:
    """Return a figure with its drawings and its legend."""
    legend = [(legend_swatch(entry), ", ".join(entry.lines)) for entry in figure.legend]
    width = PANEL_WIDTH if figure.is_narrow else HALF_WIDTH
    named = (figure.name, figure.words)
    if figure.is_wide:
        wide = wide_figure(*named, figure.chart, figure.height, title=figure.chart.title)
        return FigurePanel(figure.label, wide, legend)
    if figure.below is not None:
        stack = stack_panel(figure.label, *named, (figure.chart, figure.below), figure.height, width)
        return stack._replace(legend=legend)
    panel = chart_panel(
        figure.label,
        *named,
        figure.chart,
        figure.height,
        width,
        title=figure.chart.title,
        trials=figure.trials or no_trials,
        reduced=figure.is_reduced,
    )
    return panel._replace(legend=legend)
