"""The cells of tables and the inline parts of sentences: numbers with their units, words with a meaning."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:  # figures take as long to import as a verb without any takes to answer
    from .common.colours import Look
    from .interactive.charts import Curve, Marker


class Quantity(NamedTuple):
    """A number in SI, displayed with ``digits`` significant digits in the unit that people read.

    ``is_bare``: without the unit, which its row or column states. ``decimals``: with this many instead of ``digits``,
    for fractions, of which a column has the same decimals.
    """

    value: float | int | bool | None
    unit: str | None = None
    digits: int = 4
    is_bare: bool = False
    decimals: int | None = None


class Displayed(NamedTuple):
    """A number with the text of it that is no multiple of the exact SI value: a factor in dB, a complex number."""

    text: str
    exact: float | complex


class Vector(NamedTuple):
    """Numbers of a vector in SI, displayed like a `Quantity` each; ``is_bare``: without the unit."""

    values: Sequence[float]
    unit: str | None = None
    digits: int = 6
    is_bare: bool = True


class Percentage(NamedTuple):
    """A fraction, displayed in per cent without the unit, which its column states."""

    fraction: float
    decimals: int = 2


class Interval(NamedTuple):
    """The two ends of an interval in one cell; at most one is None."""

    low: Quantity | Percentage | Displayed | None
    high: Quantity | Percentage | Displayed | None


class Track(NamedTuple):
    """A rate with its interval, drawn on a scale from ``start`` to 1, whose ends are written if ``has_ends``."""

    rate: float
    low: float
    high: float
    start: float
    has_ends: bool = False


class Bar(NamedTuple):
    """A fraction, drawn as a bar."""

    fraction: float


class Code(NamedTuple):
    """Text of a program: an expression, a file, a digest; a column of ``is_long`` ones is not narrowed."""

    text: str
    is_long: bool = False


class CommandLine(NamedTuple):
    """A command line, which a page copies at a click."""

    text: str


class Digest(NamedTuple):
    """A digest of a file."""

    text: str


class Link(NamedTuple):
    """Text that leads to the row or section with this ``anchor``."""

    text: str
    anchor: str


Grade = Literal["pass", "fail", "withheld", "not-applicable"]


class Judged(NamedTuple):
    """A verdict as a word, coloured by its grade."""

    verdict: str
    grade: Grade


class Strong(NamedTuple):
    """A cell that stands out: the best of its column, a significant one."""

    cell: Cell


class Faint(NamedTuple):
    """A cell that explains its neighbour."""

    cell: Cell


class Lines(NamedTuple):
    """Cells below each other in one; ``is_line_on_paper``: there next to each other."""

    content: Sequence[Cell]
    is_line_on_paper: bool = False


class LegendEntry(NamedTuple):
    """A look of lines or of marks, and what has it: the names of ``lines``, or words in them."""

    look: Look | Marker | Curve
    lines: Sequence[str]


Inline = (
    str
    | Quantity
    | Displayed
    | Percentage
    | Interval
    | Code
    | CommandLine
    | Link
    | Judged
    | Strong
    | Faint
    | LegendEntry
)
Rich = str | Sequence[Inline]  # a sentence; its numbers keep their exact values in a page


class Phrase(NamedTuple):
    """Several numbers and words in a cell, which stays in one line if ``is_unbroken``."""

    content: Sequence[Inline]
    is_unbroken: bool = True


Cell = Inline | Vector | Track | Bar | Digest | Lines | float | bool | Phrase | None


class Head(NamedTuple):
    """The heading of a column, or of the columns ``below`` it, with a ``note`` in a separate line.

    A column of ``numbers`` is aligned to the right though some cells are words, as without this one of numbers alone;
    ``names`` remain in one line, a column of ``sentences`` is not narrowed.
    """

    text: str
    note: Rich = ""
    below: Sequence[str] = ()
    column: Literal["", "numbers", "names", "sentences"] = ""


class Row(NamedTuple):
    """Cells that links lead to by ``anchor``, or that begin a group of rows."""

    content: Sequence[Cell]
    anchor: str = ""
    is_first: bool = False


class RowHeading(NamedTuple):
    """The heading of the rows below it, over all columns; what stands out of ``title`` is `Strong`."""

    title: Rich
    note: Rich = ""


class RowNote(NamedTuple):
    """A note on the row above it, below all columns but the first."""

    content: Rich
