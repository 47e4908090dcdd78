"""Renderer of a document as lines of a terminal."""

from __future__ import annotations

from collections.abc import Iterable

from ....common.visible import on_one_line
from ...campaigns.plain_text import align_columns
from ..model import (
    Commands,
    Document,
    Fold,
    KeyNumbers,
    Listing,
    Medium,
    Node,
    Only,
    Printed,
    Section,
    Table,
    Text,
    Verdict,
    select,
)
from .word_columns import listing_lines, wrap_line
from .words import cell_text, heads_of, number_line, rich_text, rows_of

CONTINUED = 4  # columns by which further lines of a statement are indented


def document_lines(document: Document) -> list[str]:
    """Return the lines of a document for a terminal; line breaks in foreign names are escaped."""
    sections = [line for section in document.sections for line in _section_lines(section)]
    return [on_one_line(line) for line in (*_lines(document.summary), *sections)]


def _section_lines(section: Section) -> list[str]:
    lines = _lines(section.nodes)
    if not lines or not section.heading:
        return lines
    return ["", f"{section.heading}, {section.condition}" if section.condition else section.heading, *lines]


def _lines(nodes: Iterable[Node]) -> list[str]:
    return [line for node in nodes for line in _node_lines(node)]


def _node_lines(node: Node) -> list[str]:
    match node:
        case Text(content, _, is_wrapped):
            return wrap_line(rich_text(content), CONTINUED) if is_wrapped else [rich_text(content)]
        case Printed(lines):
            return list(lines)
        case Only():
            return _lines(select(node, Medium.TERMINAL))
        case Verdict(lead, nodes):
            return [rich_text(lead), *_lines(nodes)]
        case KeyNumbers():
            return [number_line(node)]
        case Commands(entries, missing):
            return [f"{purpose}: {command}" for purpose, command in entries] or [rich_text(missing)]
        case Fold(summary, nodes, is_listed=True):
            return ["", summary, *_lines(nodes)]
        case Fold(summary):
            return [summary]
        case Listing():
            return listing_lines(node)
        case Table() if node.rows:
            rows = [[cell_text(cell) for cell in row] for row in rows_of(node)[: node.listed]]
            more = len(rows_of(node)) - len(rows)
            lines = [line.rstrip() for line in align_columns([heads_of(node), *rows])]
            return [*lines, *([f"and {more} more"] if more else [])]
    return []
