"""Markup of cells and sentences, with the exact SI value of each number."""

from __future__ import annotations

from markupsafe import Markup, escape

from ....common.percent import percent
from ..cell import (
    Bar,
    Cell,
    Code,
    CommandLine,
    Digest,
    DisplayedNumber,
    Faint,
    Inline,
    Interval,
    LegendEntry,
    Lines,
    Link,
    Percentage,
    Phrase,
    Quantity,
    QuantityVector,
    Rich,
    Strong,
    Track,
    VerdictCell,
)
from ..chart.legend import swatch_of
from ..common.colours import Look
from ..common.page import breakable, exact, with_exact
from ..common.panels import mark_swatch, swatch
from ..common.quantities import display_unit
from ..interactive.charts import Curve, Marker

BAR = 220.0  # px, length of a bar of 100 %


def cell_markup(cell: Cell) -> Markup:
    """Return the markup of a cell with its exact SI value; names may break across lines."""
    match cell:
        case str():
            return breakable(cell)
        case Code(text):
            return Markup("<code>{}</code>").format(text)
        case CommandLine(text):
            return Markup('<code class="command">{}</code>').format(text)
        case Digest(text):
            return escape(text)
        case Link(text, anchor):
            return Markup('<a href="#{}">{}</a>').format(anchor, text)
        case VerdictCell(verdict):
            return escape(verdict)
        case Strong(inner):
            return Markup("<b>{}</b>").format(cell_markup(inner))
        case Faint(inner):
            return Markup('<span class="muted">{}</span>').format(cell_markup(inner))
        case Lines(content, is_line_on_paper):
            end = Markup('<br class="screen"> ') if is_line_on_paper else Markup("<br>")
            return end.join(map(cell_markup, content))
        case Phrase(content):
            return rich_markup(content)
        case LegendEntry():
            return Markup('<span class="who">{}</span>').format(entry_markup(cell))
        case Interval(low, None):
            return Markup("at least {}").format(cell_markup(low))
        case Interval(None, high):
            return Markup("at most {}").format(cell_markup(high))
        case Interval(low, high):
            return Markup("{} to {}").format(cell_markup(low), cell_markup(high))
        case DisplayedNumber(text, exactly):
            return with_exact(repr(exactly).strip("()"), text)
        case QuantityVector(values, unit, digits, is_bare):
            numbers = Markup(", ").join(exact(value, unit, digits) for value in values)
            return numbers if is_bare else Markup("{} {}").format(numbers, display_unit(unit))
        case Percentage(fraction, decimals):
            return with_exact(repr(fraction), percent(fraction, decimals))
        case Track():
            return _track(cell)
        case Bar(fraction):
            return Markup('<span class="bar" style="width: {:.1f}px"></span>').format(BAR * fraction)
        case Quantity(value, unit, digits, is_bare, decimals):
            number = exact(value, unit, digits, decimals)
            return number if is_bare or not display_unit(unit) else Markup("{} {}").format(number, display_unit(unit))
    return exact(cell)


def rich_markup(content: Rich, *, is_sentence: bool = False) -> Markup:
    """Return the markup of a sentence.

    ``is_sentence`` adds an initial capital and, unless a verdict ends it, a full stop.
    """
    inline = [content] if isinstance(content, str) else list(content)
    if is_sentence and isinstance(inline[0], str):
        inline[0] = inline[0][:1].upper() + inline[0][1:]
    stop = "." if is_sentence and not isinstance(inline[-1], VerdictCell) else ""
    return Markup("").join(map(_inline_markup, inline)) + escape(stop)


def _inline_markup(part: Inline) -> Markup:
    """Return the markup of an inline element; it colours a verdict, whereas in a table the cell is coloured."""
    if isinstance(part, VerdictCell):
        return Markup('<span class="verdict {}">{}</span>').format(part.grade, part.verdict)
    return cell_markup(part)


def is_number(cell: Cell) -> bool:
    """Return True if a cell is a number; columns of numbers are aligned to the right."""
    match cell:
        case Strong(inner) | Faint(inner):
            return is_number(inner)
        case Link(text):
            return text.isdecimal()
    return not isinstance(
        cell, str | Code | CommandLine | Digest | VerdictCell | Lines | Phrase | LegendEntry | Track | Bar
    )


def cell_class(cell: Cell, column: str) -> str:
    """Return the CSS class of a cell in a ``column`` of this class."""
    match cell:
        case Code(_, is_long=True):
            return "long"
        case Phrase(_, True):
            return column or "who"
        case Lines(_, is_line_on_paper=True):
            return column or "unbroken"
        case Digest():
            return "hash"
        case VerdictCell(_, grade):
            return f"verdict {grade}"
        case Track():
            return "interval"
    return column


def entry_markup(entry: LegendEntry) -> Markup:
    """Return the markup of a legend entry: its look and its words."""
    return legend_swatch(entry) + Markup(", ").join(map(breakable, entry.lines))


def legend_swatch(entry: LegendEntry) -> Markup:
    """Return the look of a legend entry as a short line or a mark."""
    match entry.look:
        case Look():
            return swatch(entry.look)
        case Marker():
            return mark_swatch(entry.look)
        case Curve():
            return swatch_of(entry.look)


def _track(track: Track) -> Markup:
    """Return a rate as a mark on a scale, with its interval as a bar."""

    def position(value: float) -> float:
        return 100.0 * (value - track.start) / (1.0 - track.start)

    scale = Markup(
        '<span class="track"><i style="left: {:.2f}%; right: {:.2f}%"></i><b style="left: {:.2f}%"></b></span>'
    )
    marks = scale.format(position(track.low), 100.0 * (1.0 - track.high) / (1.0 - track.start), position(track.rate))
    ends = Markup('<span class="ends"><span>{:.0f} %</span><span>100 %</span></span>').format(100.0 * track.start)
    return marks + ends if track.has_ends else marks
