"""A chart as an SVG element: what a page shows without scripts and on paper, and below the script's own lines."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from markupsafe import Markup, escape

from ..common.colours import FAINT, GRID, INK
from ..interactive.charts import Area, Axis, Chart, Curve, Note, Rule
from ..interactive.measures import AXES_WIDTH, GRID_WIDTH, LABEL_SIZE
from .polyline import path_of
from .quantity import ordinates
from .text import text_width

MARGIN = 3.0  # pt, around everything
STROKE, GAP = 3.5, 3.5  # pt: of a tick, from there to its text
LABEL_GAP = 4.0  # pt, from the texts of ticks to the label of the axis
TITLE_GAP = 4.0  # pt, from the title to the axes
ASCENT, DESCENT = 0.928, 0.236  # of DejaVu Sans, of its size
MIDDLE = 0.365  # of its size, from the base line to the middle of digits
MOST_SPANS = 1e6  # of the outline of an area, which is no line over the abscissa
STILL = "still"  # the class of what remains where a script draws lines
ANCHORS = {"left": "start", "center": "middle", "right": "end"}
RISES = {"top": ASCENT, "center": MIDDLE, "bottom": -DESCENT, "baseline": 0.0}


def lay_out(chart: Chart, width: float, height: float, *, title: str = "") -> Chart:
    """Return the chart with the ``box`` of its axes in a figure of this size (pt), which leaves room for all texts."""
    x, y = chart.x, chart.y
    left = MARGIN + max((text_width(text, y.size) for _, text in y.ticks), default=0.0) + GAP + STROKE
    bottom = MARGIN + STROKE + GAP + (ASCENT + DESCENT) * x.size
    bottom += LABEL_GAP + (ASCENT + DESCENT) * LABEL_SIZE if x.label else 0.0
    top = MARGIN + (TITLE_GAP + (ASCENT + DESCENT) * LABEL_SIZE if title else MIDDLE * y.size)
    right = MARGIN
    if x.ticks:
        at, text = x.ticks[-1]
        inner = width - left - right
        beyond = text_width(text, x.size) / 2.0 - (1.0 - _fraction(x, at)) * inner
        right += max(0.0, beyond)
    inner_width, inner_height = width - left - right, height - top - bottom
    box = (
        round(left / width, 5),
        round(top / height, 5),
        round(inner_width / width, 5),
        round(inner_height / height, 5),
    )
    return replace(chart, box=box)


def write_svg(
    chart: Chart, name: str, description: str, width: float, height: float, *, title: str = "", kind: str = ""
) -> Markup:
    """Return the <svg> element of a chart that has its box, in a figure of this size (pt).

    ``name`` must differ between the figures of a page; ``description`` is what a screen reader says; ``title``
    stands above the axes; ``kind`` is a class more.
    """
    left, top, wide, high = (
        fraction * size for fraction, size in zip(chart.box, (width, height, width, height), strict=True)
    )
    frame = _Frame(chart, left, top, wide, high)
    elements = [
        f'<rect width="{width:g}" height="{height:g}" fill="#fff"/>',
        f'<clipPath id="{name}-clip">',
        f'<rect x="{left:.2f}" y="{top:.2f}" width="{wide:.2f}" height="{high:.2f}"/></clipPath>',
        *frame.axes(),
        f'<g clip-path="url(#{name}-clip)" fill="none">',
        *(frame.area(area) for area in chart.areas),
        *(frame.rule(rule) for rule in chart.rules),
        *(frame.curve(curve) for curve in chart.curves),
        "</g>",
        *(frame.note(note) for note in chart.notes),
        *frame.labels(height, title),
    ]
    classes = f"figure {kind}".rstrip()
    element = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" role="img" '
        f'aria-label="{escape(description)}" class="{classes}" font-family="DejaVu Sans, sans-serif">'
    )
    return Markup("".join([element, *elements, "</svg>"]))


def _fraction(axis: Axis, at: float) -> float:
    """Return where a number lies between the ends of an axis: 0 at the first, 1 at the second."""
    low, high = axis.ends
    return (at - low) / (high - low)


class _Frame:
    """The axes of a chart at their place (pt) in the figure."""

    def __init__(self, chart: Chart, left: float, top: float, wide: float, high: float) -> None:
        self._chart, self._left, self._top, self._wide, self._high = chart, left, top, wide, high

    def _x(self, at: float) -> float:
        return self._left + _fraction(self._chart.x, at) * self._wide

    def _y(self, at: float) -> float:
        return self._top + (1.0 - _fraction(self._chart.y, at)) * self._high

    def axes(self) -> Iterator[str]:
        """Grid, edges, strokes of ticks and their texts."""
        left, bottom, right, top = self._left, self._top + self._high, self._left + self._wide, self._top
        x = [(self._x(at), text) for at, text in self._chart.x.ticks]
        y = [(self._y(at), text) for at, text in self._chart.y.ticks]
        upright = "".join(f"M{at:.2f} {bottom:.2f}V{top:.2f}" for at, _ in x)
        level = "".join(f"M{left:.2f} {at:.2f}H{right:.2f}" for at, _ in y)
        yield f'<path d="{upright}{level}" stroke="{GRID}" stroke-width="{GRID_WIDTH:g}"/>'
        strokes = "".join(f"M{at:.2f} {bottom:.2f}v{STROKE:g}" for at, _ in x)
        strokes += "".join(f"M{left:.2f} {at:.2f}h-{STROKE:g}" for at, _ in y)
        edges = f"M{left:.2f} {top:.2f}V{bottom:.2f}H{right:.2f}"
        yield f'<path d="{edges}{strokes}" fill="none" stroke="{FAINT}" stroke-width="{AXES_WIDTH:g}"/>'
        base = bottom + STROKE + GAP + ASCENT * self._chart.x.size
        for size, anchor, texts in (
            (self._chart.x.size, "middle", [(at, base, text) for at, text in x]),
            (
                self._chart.y.size,
                "end",
                [(left - STROKE - GAP, at + MIDDLE * self._chart.y.size, text) for at, text in y],
            ),
        ):
            written = "".join(f'<text x="{at:.2f}" y="{line:.2f}">{escape(text)}</text>' for at, line, text in texts)
            yield f'<g font-size="{size:g}" text-anchor="{anchor}" fill="{INK}">{written}</g>'

    def curve(self, curve: Curve) -> str:
        """A line, or the dot of a lone sample."""
        x, y = self._x_of(curve.x), self._y_of(ordinates(curve))
        path = path_of(x, y, steps=curve.steps, width=self._wide)
        line = (
            f'<path d="{path}" stroke="{curve.colour}" stroke-width="{curve.width:g}" stroke-linejoin="round"'
            f"{_dashed(curve.width, curve.dashes)}/>"
        )
        if curve.marker is None:
            return line
        radius = curve.marker.size / 2.0
        dots = (
            f'<circle cx="{x[row]:.2f}" cy="{y[row]:.2f}" r="{radius:g}" fill="{curve.marker.fill}"/>'
            for row in np.flatnonzero(np.isfinite(y))
        )
        return line + "".join(dots)

    def _x_of(self, numbers: np.ndarray) -> np.ndarray:
        low, high = self._chart.x.ends
        position: np.ndarray = self._left + (numbers - low) / (high - low) * self._wide
        return position

    def _y_of(self, numbers: np.ndarray) -> np.ndarray:
        low, high = self._chart.y.ends
        position: np.ndarray = self._top + (high - numbers) / (high - low) * self._high
        return position

    def note(self, note: Note) -> str:
        """A text at a point of the data or of the axes."""
        across, up = note.of_axes
        x = (self._left + note.at[0] * self._wide if across else self._x(note.at[0])) + note.offset[0]
        y = (self._top + (1.0 - note.at[1]) * self._high if up else self._y(note.at[1])) - note.offset[1]
        y += RISES[note.align[1]] * note.size
        bold = ' font-weight="700"' if note.bold else ""
        return (
            f'<text x="{x:.2f}" y="{y:.2f}" font-size="{note.size:g}" text-anchor="{ANCHORS[note.align[0]]}" '
            f'fill="{note.colour}"{bold}>{escape(note.text)}</text>'
        )

    def area(self, area: Area) -> str:
        """A filled polygon."""
        x = self._left + area.x * self._wide if area.of_axes[0] else self._x_of(area.x)
        y = self._top + (1.0 - area.y) * self._high if area.of_axes[1] else self._y_of(area.y)
        path = path_of(x, y, steps=False, width=MOST_SPANS)
        return f'<path d="{path}z" fill="{area.colour}" fill-opacity="{area.opacity:g}"/>'

    def rule(self, rule: Rule) -> str:
        """A straight line across the axes."""
        low, high = (self._chart.x if rule.upright else self._chart.y).ends
        if not min(low, high) <= rule.at <= max(low, high):
            return ""
        path = (
            f"M{self._x(rule.at):.2f} {self._top:.2f}v{self._high:.2f}"
            if rule.upright
            else f"M{self._left:.2f} {self._y(rule.at):.2f}h{self._wide:.2f}"
        )
        return (
            f'<path d="{path}" stroke="{rule.colour}" stroke-width="{rule.width:g}"{_dashed(rule.width, rule.dashes)}/>'
        )

    def labels(self, height: float, title: str) -> Iterator[str]:
        """The label of the abscissa and the title, which remain where a script draws the chart."""
        middle = self._left + self._wide / 2.0
        for text, x, y, anchor in (
            (self._chart.x.label, middle, height - MARGIN - DESCENT * LABEL_SIZE, "middle"),
            (title, self._left, self._top - TITLE_GAP - DESCENT * LABEL_SIZE, "start"),
        ):
            if text:
                yield (
                    f'<g class="{STILL}"><text x="{x:.2f}" y="{y:.2f}" font-size="{LABEL_SIZE:g}" '
                    f'text-anchor="{anchor}" fill="{INK}">{escape(text)}</text></g>'
                )


def _dashed(width: float, dashes: Sequence[float]) -> str:
    return f' stroke-dasharray="{" ".join(f"{width * each:g}" for each in dashes)}"' if dashes else ""
