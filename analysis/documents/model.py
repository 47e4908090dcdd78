"""The nodes of a document: the content of a result, independent of the medium.

A renderer decides how to show a node; its type determines which media include it:

| node | terminal | notebook | page |
|---|---|---|---|
| `Text`, `Verdict`, `KeyNumbers` | yes | yes | yes |
| `Table` | its first rows | its first rows | yes |
| `Listing` | yes | its first rows | yes |
| `Commands` | yes | no | yes |
| `Figures` | no | the first ones | yes |
| `Diagram` | no | if there are no figures | yes |
| `Fold` | its summary; its nodes if ``is_listed`` | no | folded |
| `Only` | in its medium | in its medium | in its medium |
| `Printed` | yes | no | no |
| `Plot` | no | yes | no |
| all others | no | no | yes |
| heading of a `Section` | if it has lines | no | yes |
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from .pictures import Blocks, Diagram, Figures, Plot, Scene

if TYPE_CHECKING:  # figures double the start-up time of verbs without figures
    from .cell import Cell, Head, Rich, Row, RowHeading, RowNote


class Medium(Enum):
    """A medium for which a renderer writes."""

    TERMINAL = "terminal"
    NOTEBOOK = "notebook"
    PAGE = "page"


@dataclass(frozen=True)
class Text:
    """A statement of a result, without a full stop; ``style`` applies to a page.

    ``is_wrapped`` lets a terminal break a long statement into several lines.
    """

    kind: ClassVar[str] = "text"
    content: Rich
    style: Literal["", "lead", "fail"] = ""
    is_wrapped: bool = False


@dataclass(frozen=True)
class Printed:
    """Lines for a terminal, where a page and a notebook show the content in another form."""

    kind: ClassVar[str] = "printed"
    lines: Sequence[str]


@dataclass(frozen=True)
class Note:
    """A remark on a page that helps to read a figure or a table; ``style`` restricts it to ``paper`` or ``screen``."""

    kind: ClassVar[str] = "note"
    content: Rich
    style: Literal["", "paper", "screen"] = ""


@dataclass(frozen=True)
class Missing:
    """A statement of what a result lacks and why, where readers would look for it."""

    kind: ClassVar[str] = "missing"
    content: Rich


@dataclass(frozen=True)
class Verdict:
    """The answer of a document in one statement, with accompanying nodes."""

    kind: ClassVar[str] = "verdict"
    lead: Rich
    nodes: Sequence[Node] = ()
    is_bad: bool = False


@dataclass(frozen=True)
class KeyNumbers:
    """Key figures at the head of a section or page: short values with their names."""

    kind: ClassVar[str] = "numbers"
    entries: Sequence[tuple[str, Cell]]


@dataclass(frozen=True)
class Items:
    """Short statements as a list; ``style`` applies to a page: names with values in columns, or all on one line."""

    kind: ClassVar[str] = "items"
    items: Sequence[Rich]
    style: Literal["", "note", "pairs", "inline", "differences"] = ""


@dataclass(frozen=True)
class Commands:
    """Command lines with their purposes; ``missing`` states why there is none."""

    kind: ClassVar[str] = "commands"
    entries: Sequence[tuple[str, str]]
    missing: Rich = ""


@dataclass(frozen=True)
class Repeat:
    """The command that repeats a result."""

    kind: ClassVar[str] = "repeat"
    command: str


@dataclass(frozen=True)
class Table:
    """Rows of cells below ``heads``; a terminal and a notebook list the first ``listed`` rows.

    ``is_grouped`` omits cells of the first column equal to the cell above. ``style`` applies to a page: ``tight`` for
    many columns, ``replays`` for rows that stack on a narrow page. ``is_printed`` includes the table on paper.
    """

    kind: ClassVar[str] = "table"
    heads: Sequence[str | Head]
    rows: Sequence[Sequence[Cell] | Row | RowHeading | RowNote]
    listed: int = 20
    style: Literal["board", "", "tight", "tight verdicts", "replays", "signals"] = "board"
    is_grouped: bool = False
    is_printed: bool = True


@dataclass(frozen=True)
class Listing:
    """Rows of words without column heads, below a ``heading``; a terminal wraps the last cell, unless it is code.

    ``columns`` are the widths (characters) of all columns but the last in a terminal, by default the widths of their
    cells.
    """

    kind: ClassVar[str] = "listing"
    rows: Sequence[Sequence[Cell]]
    heading: str = ""
    columns: Sequence[int] = ()


@dataclass(frozen=True)
class ForScript:
    """A document, ``name``, that the page's script ``bundle`` reads, and nodes that are useful only with it.

    Without a name there are only nodes.
    """

    kind: ClassVar[str] = "for_script"
    name: str
    bundle: str
    content: Any
    nodes: Sequence[Node] = ()
    style: str = ""
    anchor: str = ""


@dataclass(frozen=True)
class Group:
    """Nodes below a small ``heading`` within a section, or at ``level`` 4 within a group.

    With an ``anchor``, the target of links, it is a separate article. ``is_printed`` includes it on paper.
    """

    kind: ClassVar[str] = "group"
    heading: Rich
    nodes: Sequence[Node]
    level: Literal[3, 4] = 3
    anchor: str = ""
    is_printed: bool = True


@dataclass(frozen=True)
class Fold:
    """Nodes that few readers need, collapsed under their ``summary``.

    ``is_open`` opens it initially on a page, ``is_printed`` on paper; ``is_listed`` includes the nodes in a terminal.
    """

    kind: ClassVar[str] = "fold"
    summary: str
    nodes: Sequence[Node]
    is_open: bool = False
    is_listed: bool = False
    is_printed: bool = False


@dataclass(frozen=True)
class Tile:
    """Nodes in one cell of a row of tiles; with ``is_wide`` the tile fills the row."""

    nodes: Sequence[Node]
    is_wide: bool = False


@dataclass(frozen=True)
class Tiles:
    """Tiles side by side as far as a page has space, each as wide as its content."""

    kind: ClassVar[str] = "tiles"
    tiles: Sequence[Tile]


@dataclass(frozen=True)
class Only:
    """Nodes for one medium; ``compose`` is called while it is written, since it may run a simulation."""

    kind: ClassVar[str] = "only"
    medium: Medium
    compose: Callable[[], Sequence[Node]]


Node = (
    Text
    | Printed
    | Note
    | Missing
    | Verdict
    | KeyNumbers
    | Items
    | Commands
    | Repeat
    | Table
    | Listing
    | Figures
    | Diagram
    | Plot
    | Blocks
    | Scene
    | ForScript
    | Group
    | Fold
    | Tiles
    | Only
)


@dataclass(frozen=True)
class Section:
    """Nodes below a ``heading``, which may be empty; ``condition`` is the condition of all its numbers, if any.

    ``is_folded`` folds it on a page. ``style`` applies to a page: only on screens, or on paper unbroken or on a
    separate sheet.
    """

    heading: str
    nodes: Sequence[Node]
    condition: str = ""
    is_folded: bool = False
    style: Literal["", "screen", "whole", "whole sheet"] = ""


@dataclass(frozen=True)
class Document:
    """A result for its readers: the ``summary`` followed by sections.

    ``json`` is the content for programs, or a function that returns it; its keys belong to the public interface.
    ``has_contents`` adds a table of contents to a page. ``page_sections`` composes further sections for a page only.
    ``in_degrees`` are the quantities that a page displays in degrees.
    """

    title: str
    summary: Sequence[Node]
    sections: Sequence[Section]
    json: object
    has_contents: bool = False
    in_degrees: str = "Angles"
    page_sections: Callable[[], Sequence[Section]] = tuple


def nodes_of(document: Document, medium: Medium) -> list[Node]:
    """Return the nodes of the summary and of all sections for a medium, in order."""
    nodes = [*document.summary, *(node for section in document.sections for node in section.nodes)]
    return [each for node in nodes for each in select(node, medium)]


def select(node: Node, medium: Medium) -> Sequence[Node]:
    """Return the nodes that a node stands for in a medium: itself, or what `Only` composes."""
    if not isinstance(node, Only):
        return [node]
    return node.compose() if node.medium is medium else []
