"""SVG of charts of variable width, in which text and line widths keep their sizes in px.

The <svg> element covers the plotting area, and texts overflow into its padding. Positions of marks and texts are
percentages of the area; paths are stretched, but not their line widths.
"""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ...interactive.charts import Axis, Backing, Chart, ChartNote, Curve
from .frame import Frame

POINT = 1.375  # px per pt, so the smallest text has 11 px
VISIBLE = 'overflow="visible"'


@dataclass(frozen=True)
class FluidFrame(Frame):
    """A plotting area of variable size with the origin at its upper left corner.

    ``name`` is unique among the figures of a page; ``margins`` (px) are left, above, right and below.
    """

    name: str
    margins: tuple[float, float, float, float]

    def format_x(self, x: float) -> str:
        return _percentage(x / self.width)

    def format_y(self, y: float) -> str:
        return _percentage(y / self.height)

    def place_element(self, x: float, y: float, element: str) -> str:
        """Return an element, drawn about the origin, at a position."""
        return f'<svg x="{self.format_x(x)}" y="{self.format_y(y)}" {VISIBLE}>{element}</svg>'

    def stretch(self, elements: str) -> str:
        """Return paths stretched with the area, clipped at its edges."""
        return _stretch(elements, self.width, self.height, 'fill="none"')

    def stretch_edges(self, elements: str) -> str:
        """Return paths stretched with the area, not clipped, for lines on its edges."""
        return _stretch(elements, self.width, self.height, VISIBLE)

    def stretch_up(self, elements: str, width: float) -> str:
        """Return paths to the left of the area, stretched to its height, with a fixed ``width``."""
        return _stretch(elements, width, self.height, f'x="{-width:g}" width="{width:g}" {VISIBLE}')

    def stretch_across(self, elements: str, height: float) -> str:
        """Return paths below the area, stretched to its width, with a fixed ``height``."""
        return _stretch(elements, self.width, height, f'y="100%" height="{height:g}" {VISIBLE}')

    def clip(self, elements: str) -> str:
        """Return elements clipped at the edges of the area."""
        return f"<svg>{elements}</svg>" if elements else ""

    def repeat(self, element: str, positions: Sequence[tuple[float, float]]) -> str:
        if len(positions) == 1:
            return self.place_element(*positions[0], element)
        key = f"{self.name}-{zlib.crc32(f'{element}{positions}'.encode()):x}"
        copies = (f'<use href="#{key}" x="{self.format_x(x)}" y="{self.format_y(y)}"/>' for x, y in positions)
        return f'<defs><g id="{key}">{element}</g></defs>{"".join(copies)}'


def _stretch(elements: str, width: float, height: float, frame: str) -> str:
    view = f'viewBox="0 0 {width:g} {height:g}" preserveAspectRatio="none"'
    return f"<svg {frame} {view}>{elements}</svg>" if elements else ""


def _percentage(fraction: float) -> str:
    return f"{round(100.0 * fraction, 3):g}%"


def in_pixels(chart: Chart) -> Chart:
    """Return a chart with its sizes in px instead of pt."""
    return replace(
        chart,
        x=_axis(chart.x),
        y=_axis(chart.y),
        curves=[_curve(each) for each in chart.curves],
        dots=[replace(each, size=POINT * each.size) for each in chart.dots],
        areas=[replace(each, stroke=POINT * each.stroke) for each in chart.areas],
        rules=[replace(each, width=POINT * each.width) for each in chart.rules],
        notes=[_note(each) for each in chart.notes],
    )


def _axis(axis: Axis) -> Axis:
    return replace(axis, size=POINT * axis.size)


def _curve(curve: Curve) -> Curve:
    marker = curve.marker and replace(curve.marker, size=POINT * curve.marker.size, width=POINT * curve.marker.width)
    return replace(curve, width=POINT * curve.width, marker=marker)


def _note(note: ChartNote) -> ChartNote:
    backing = note.backing and Backing(note.backing.colour, note.backing.opacity, POINT * note.backing.margin)
    offset = (POINT * note.offset[0], POINT * note.offset[1])
    return replace(note, offset=offset, size=POINT * note.size, backing=backing)
