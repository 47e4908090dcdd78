"""A document as lines of a terminal."""

from __future__ import annotations

from collections.abc import Iterable

from ...campaigns.plain_text import align_columns
from ..model import Commands, Document, Fold, KeyNumbers, Node, Section, Table, Text, Verdict
from .words import cell_text, number_line, rich_text


def document_lines(document: Document) -> list[str]:
    """Return the lines that a terminal shows of a document."""
    sections = [line for section in document.sections for line in _section_lines(section)]
    return [*_lines(document.summary), *sections]


def _section_lines(section: Section) -> list[str]:
    lines = _lines(section.nodes)
    if not lines or not section.heading:
        return lines
    return ["", f"{section.heading}, {section.given}" if section.given else section.heading, *lines]


def _lines(nodes: Iterable[Node]) -> list[str]:
    return [line for node in nodes for line in _node_lines(node)]


def _node_lines(node: Node) -> list[str]:
    match node:
        case Text(content):
            return [rich_text(content)]
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
        case Table() if node.rows:
            rows = [[cell_text(cell) for cell in row] for row in node.rows[: node.listed]]
            more = len(node.rows) - len(rows)
            lines = [line.rstrip() for line in align_columns([list(node.heads), *rows])]
            return [*lines, *([f"and {more} more"] if more else [])]
    return []
