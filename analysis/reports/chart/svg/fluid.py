"""Charts as wide as the page: px are px at any width of it, so that text and lines keep their sizes.

The area of the axes is that of the <svg> element, whose padding texts overflow. Abscissas of marks and texts are
percentages; paths are stretched, their strokes are not.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ...interactive.charts import Axis, Backing, Chart, Curve, Note
from .frame import Frame

POINT = 1.375  # px of a pt: the least text has 11 px


class FluidFrame(Frame):
    """A rectangle with 0 at its left upper corner, as wide as may be."""

    @property
    def is_fluid(self) -> bool:
        return True

    def along(self, x: float) -> str:
        return f"{100.0 * x / self.width:.3f}%"

    def put(self, x: float, y: float, element: Callable[[float, float], str]) -> str:
        return f'<svg x="{self.along(x)}" y="{y:.2f}" overflow="visible">{element(0.0, 0.0)}</svg>'

    def stretch(self, elements: str) -> str:
        view = f'viewBox="0 0 {self.width:g} {self.height:.2f}" preserveAspectRatio="none"'
        return f'<svg width="100%" height="100%" overflow="visible" {view}>{elements}</svg>' if elements else ""

    def clip(self, name: str, elements: str) -> str:
        return f'<svg width="100%" height="100%" fill="none">{elements}</svg>'


def in_pixels(chart: Chart) -> Chart:
    """Return a chart whose sizes are in px instead of pt."""
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


def _note(note: Note) -> Note:
    backing = note.backing and Backing(note.backing.colour, note.backing.opacity, POINT * note.backing.margin)
    offset = (POINT * note.offset[0], POINT * note.offset[1])
    return replace(note, offset=offset, size=POINT * note.size, backing=backing)
