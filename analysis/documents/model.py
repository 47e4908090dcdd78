"""The nodes of a document: what a result says, without a medium.

A renderer decides how a node is shown; which nodes a medium has follows from their type alone:

| node | terminal | notebook | page |
|---|---|---|---|
| `Text`, `Verdict`, `KeyNumbers` | yes | yes | yes |
| `Table` | its first rows | its first rows | yes |
| `Commands` | yes | no | yes |
| `Figures` | no | the first ones | yes |
| `Diagram` | no | where there are no figures | yes |
| `Fold` | its summary; its nodes if ``is_listed`` | no | opens |
| `Note`, `OnPage`, `SystemFigures`, `History` | no | no | yes |
| heading of a `Section` | where it has lines | no | yes |
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from markupsafe import Markup

from ..reports.common.colours import Look
from ..reports.figures.section import Section as SystemFigure
from ..reports.interactive.charts import Chart, Curve, Marker
from ..reports.time_histories import ComponentHistory


class Quantity(NamedTuple):
    """A number in SI, displayed with ``digits`` significant digits in the unit that people read.

    ``is_bare``: without the unit, which its row or column states. ``decimals``: with this many instead of ``digits``,
    for fractions, of which a column has the same decimals.
    """

    value: float | None
    unit: str | None = None
    digits: int = 4
    is_bare: bool = False
    decimals: int | None = None


class Interval(NamedTuple):
    """The two ends of an interval in one cell."""

    low: Quantity
    high: Quantity


class Code(NamedTuple):
    """Text of a program: an expression, a file, a digest; a column of ``is_long`` ones is not narrowed."""

    text: str
    is_long: bool = False


Inline = str | Quantity | Code
Rich = str | Sequence[Inline]  # a sentence; its numbers keep their exact values in a page


class Phrase(NamedTuple):
    """Several numbers and words in a cell."""

    content: Sequence[Inline]


class LegendEntry(NamedTuple):
    """A look of lines or of marks, and what has it: the names of ``lines``, or words in them."""

    look: Look | Marker | Curve
    lines: Sequence[str]


Cell = Inline | Interval | float | bool | Phrase | LegendEntry | None


@dataclass(frozen=True)
class Text:
    """A statement of a result, without a full stop."""

    kind: ClassVar[str] = "text"
    content: Rich


@dataclass(frozen=True)
class Note:
    """An aid to read a figure or a table, which only a page needs."""

    kind: ClassVar[str] = "note"
    content: Rich


@dataclass(frozen=True)
class Verdict:
    """The answer of a document in one statement, and what stands with it."""

    kind: ClassVar[str] = "verdict"
    lead: Rich
    nodes: Sequence[Node] = ()
    is_bad: bool = False


@dataclass(frozen=True)
class KeyNumbers:
    """Short numbers with their names."""

    kind: ClassVar[str] = "numbers"
    entries: Sequence[tuple[str, Cell]]


@dataclass(frozen=True)
class Commands:
    """Command lines with their purposes; ``missing`` says why there is none."""

    kind: ClassVar[str] = "commands"
    entries: Sequence[tuple[str, str]]
    missing: Rich = ""


@dataclass(frozen=True)
class Table:
    """Rows of cells below ``heads``; a terminal and a notebook list the first ``listed`` rows."""

    kind: ClassVar[str] = "table"
    heads: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    listed: int = 20


@dataclass(frozen=True)
class Figure:
    """A chart of ``height`` (in); ``name`` is unique in its document, ``words`` describe it to those who do not see.

    ``is_wide``: as wide as the page; ``is_narrow``: three in a row of a wide page, not two.
    ``legend`` is that of this figure alone.
    """

    label: str
    name: str
    words: str
    chart: Chart
    height: float
    is_wide: bool = False
    is_narrow: bool = False
    legend: Sequence[LegendEntry] = ()


@dataclass(frozen=True)
class Figures:
    """Figures next to each other with one legend; ``draw`` them only where they show."""

    kind: ClassVar[str] = "figures"
    draw: Callable[[], Sequence[Figure]]
    legend: Sequence[LegendEntry] = ()


@dataclass(frozen=True)
class Diagram:
    """A drawing without axes; ``draw`` returns it with its width and height (pt), which it has at any width of a page.

    ``name`` is unique in its document, ``words`` describe it to those who do not see.
    """

    kind: ClassVar[str] = "diagram"
    name: str
    words: str
    draw: Callable[[], tuple[Chart, float, float]]


@dataclass(frozen=True)
class Fold:
    """Nodes that few readers need, behind their ``summary``.

    ``is_open``: a page has it open at first. ``is_listed``: a terminal lists the nodes, too.
    """

    kind: ClassVar[str] = "fold"
    summary: str
    nodes: Sequence[Node]
    is_open: bool = False
    is_listed: bool = False


@dataclass(frozen=True)
class OnPage:
    """Nodes that only a page has; ``compose`` them while it is written, since they may take a simulation."""

    kind: ClassVar[str] = "on_page"
    compose: Callable[[], Sequence[Node]]


@dataclass(frozen=True)
class SystemFigures:
    """Figures of a simulation, each with its heading, and ``findings`` on several of them."""

    kind: ClassVar[str] = "system_figures"
    figures: Sequence[SystemFigure]
    findings: Sequence[Markup] = ()


@dataclass(frozen=True)
class History:
    """Signals of one component of a simulation over time."""

    kind: ClassVar[str] = "history"
    history: ComponentHistory


Node = (
    Text | Note | Verdict | KeyNumbers | Commands | Table | Figures | Diagram | Fold | OnPage | SystemFigures | History
)


@dataclass(frozen=True)
class Section:
    """Nodes below a ``heading``, which may be empty; ``given`` is what all its numbers are conditional on."""

    heading: str
    nodes: Sequence[Node]
    given: str = ""


@dataclass(frozen=True)
class Document:
    """A result for its readers: ``summary`` first, then sections.

    ``json`` is what programs read; its keys are part of the interface.
    """

    title: str
    summary: Sequence[Node]
    sections: Sequence[Section]
    json: object


def nodes_of(document: Document) -> list[Node]:
    """Return the nodes of the summary and of all sections, in order."""
    return [*document.summary, *(node for section in document.sections for node in section.nodes)]
