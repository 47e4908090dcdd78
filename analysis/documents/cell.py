"""Cells of tables and inline elements of sentences: numbers with units, words with a role."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:  # figures double the start-up time of verbs without figures
    from .common.colours import Look
    from .interactive.charts import Curve, Marker


class Quantity(NamedTuple):
    """A number in SI, displayed in a readable unit with ``digits`` significant digits.

    ``is_bare`` omits the unit, which the row or column states. ``decimals`` replaces ``digits`` for fractions, so that
    all numbers in a column have as many decimals.
    """

    value: float | int | bool | None
    unit: str | None = None
    digits: int = 4
    is_bare: bool = False
    decimals: int | None = None


class DisplayedNumber(NamedTuple):
    """A number and its displayed text, if this is not a multiple of the SI value: a factor in dB, a complex number."""

    text: str
    exact: float | complex


class QuantityVector(NamedTuple):
    """Elements of a vector in SI, each displayed like a `Quantity`; ``is_bare`` omits the unit."""

    values: Sequence[float]
    unit: str | None = None
    digits: int = 6
    is_bare: bool = True


class Percentage(NamedTuple):
    """A fraction, displayed in per cent without the unit, which its column states."""

    fraction: float
    decimals: int = 2


class Interval(NamedTuple):
    """An interval in one cell; at most one of its ends is None, which means that it has no limit there."""

    low: Quantity | Percentage | DisplayedNumber | None
    high: Quantity | Percentage | DisplayedNumber | None


class Track(NamedTuple):
    """A rate with its interval, drawn on a scale from ``start`` to 1; ``has_ends`` labels the ends of the scale."""

    rate: float
    low: float
    high: float
    start: float
    has_ends: bool = False


class Bar(NamedTuple):
    """A fraction, drawn as a bar."""

    fraction: float


class Code(NamedTuple):
    """Program text: an expression, a file, a digest; a column of ``is_long`` entries is not narrowed."""

    text: str
    is_long: bool = False


class CommandLine(NamedTuple):
    """A command line, which a page copies on a click."""

    text: str


class Digest(NamedTuple):
    """The digest of a file."""

    text: str


class Link(NamedTuple):
    """Text linked to the row or section with this ``anchor``."""

    text: str
    anchor: str


Grade = Literal["pass", "fail", "withheld", "not-applicable"]


class VerdictCell(NamedTuple):
    """A verdict as a word, coloured by its grade."""

    verdict: str
    grade: Grade


class Strong(NamedTuple):
    """A highlighted cell: the best of its column, or a significant value."""

    cell: Cell


class Faint(NamedTuple):
    """A subdued cell that explains its neighbour."""

    cell: Cell


class Lines(NamedTuple):
    """Several cells in one, below each other; ``is_line_on_paper`` puts them side by side on paper."""

    content: Sequence[Cell]
    is_line_on_paper: bool = False


class LegendEntry(NamedTuple):
    """The look of lines or marks, and their meaning: the names of ``lines``, or words that contain them."""

    look: Look | Marker | Curve
    lines: Sequence[str]


Inline = (
    str
    | Quantity
    | DisplayedNumber
    | Percentage
    | Interval
    | Code
    | CommandLine
    | Link
    | VerdictCell
    | Strong
    | Faint
    | LegendEntry
)
Rich = str | Sequence[Inline]  # a sentence; a page keeps the exact values of its numbers


class Phrase(NamedTuple):
    """Several numbers and words in a cell; ``is_unbroken`` keeps them on one line."""

    content: Sequence[Inline]
    is_unbroken: bool = True


Cell = Inline | QuantityVector | Track | Bar | Digest | Lines | float | bool | Phrase | None


class Head(NamedTuple):
    """The heading of a column, or of the columns ``below`` it, with a ``note`` on a separate line.

    Columns of numbers are aligned to the right. ``column`` sets the layout: "numbers" aligns cells to the right even if
    some contain words, "names" keeps them on one line, "sentences" is not narrowed.
    """

    text: str
    note: Rich = ""
    below: Sequence[str] = ()
    column: Literal["", "numbers", "names", "sentences"] = ""


class Row(NamedTuple):
    """Cells of a row; links refer to it by ``anchor``, and it may begin a group of rows."""

    content: Sequence[Cell]
    anchor: str = ""
    is_first: bool = False


class RowHeading(NamedTuple):
    """A heading of the following rows across all columns; the emphasised words of ``title`` are `Strong`."""

    title: Rich
    note: Rich = ""


class RowNote(NamedTuple):
    """A note on the row above, across all columns but the first."""

    content: Rich
