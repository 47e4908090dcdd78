"""The nodes of a document: what a result says, without markup and without a medium.

A renderer decides how a node is shown; which nodes a medium has follows from their type alone:

| node | terminal | notebook | page |
|---|---|---|---|
| `Text` | yes | yes | yes |
| `Table` | its first rows | its first rows | yes |
| `Figures` | no | the first ones | yes |
| `Fold` | its summary | no | closed, opens |
| `Note` | no | no | yes |
| heading of a `Section` | no | no | yes |
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from ..reports.common.colours import Look
from ..reports.interactive.charts import Chart


class Quantity(NamedTuple):
    """A number in SI, displayed with ``digits`` significant digits in the unit that people read.

    ``is_bare``: without the unit, which its row or column states.
    """

    value: float | None
    unit: str | None = None
    digits: int = 4
    is_bare: bool = False


Cell = str | float | bool | Quantity | None


@dataclass(frozen=True)
class Text:
    """A statement of a result, without a full stop."""

    kind: ClassVar[str] = "text"
    text: str


@dataclass(frozen=True)
class Note:
    """An aid to read a figure or a table, which only a page needs."""

    kind: ClassVar[str] = "note"
    text: str


@dataclass(frozen=True)
class Table:
    """Rows of cells below ``heads``; a terminal and a notebook list the first ``listed`` rows."""

    kind: ClassVar[str] = "table"
    heads: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    listed: int = 20


@dataclass(frozen=True)
class Figure:
    """A chart of ``height`` (in); ``name`` is unique in its document, ``words`` describe it to those who do not see."""

    label: str
    name: str
    words: str
    chart: Chart
    height: float


class LegendEntry(NamedTuple):
    """A look of lines, and what has it: the names of ``lines``, or words in them."""

    look: Look
    lines: Sequence[str]


@dataclass(frozen=True)
class Figures:
    """Figures next to each other, two in a row of a wide page, with one legend; ``draw`` them only where they show."""

    kind: ClassVar[str] = "figures"
    draw: Callable[[], Sequence[Figure]]
    legend: Sequence[LegendEntry] = ()


@dataclass(frozen=True)
class Fold:
    """Nodes that few readers need, behind their ``summary``."""

    kind: ClassVar[str] = "fold"
    summary: str
    nodes: Sequence[Node]


Node = Text | Note | Table | Figures | Fold


@dataclass(frozen=True)
class Section:
    """Nodes below a ``heading``, which may be empty."""

    heading: str
    nodes: Sequence[Node]


@dataclass(frozen=True)
class Document:
    """A result for its readers: ``statements`` first, then sections.

    ``data`` is what programs read, whose keys are part of the interface.
    """

    title: str
    statements: Sequence[Text]
    sections: Sequence[Section]
    data: object


def nodes_of(document: Document) -> list[Node]:
    """Return the statements and the nodes of all sections, in order."""
    return [*document.statements, *(node for section in document.sections for node in section.nodes)]
