"""A chart as an SVG element: what a page shows without scripts and on paper, and below the script's own lines."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from markupsafe import Markup, escape

from ..interactive.charts import Chart, Dots
from .svg.axes import draw_axes, draw_labels
from .svg.frame import Frame
from .svg.lines import draw_area, draw_curve, draw_rule
from .svg.marks import draw_dots, draw_marks
from .svg.texts import draw_note

TrialPositions = Callable[[Dots], tuple[np.ndarray, np.ndarray]]  # abscissas and ordinates as displayed, [trials]


def no_trials(dots: Dots) -> tuple[np.ndarray, np.ndarray]:
    """Raise the error of a chart whose trials nobody has."""
    raise ValueError(f"a chart has marks of the trials of {dots.variant}, whose positions are not known")


def write_svg(
    chart: Chart,
    name: str,
    description: str,
    width: float,
    height: float,
    *,
    title: str = "",
    kind: str = "",
    trials: TrialPositions = no_trials,
) -> Markup:
    """Return the <svg> element of a chart that has its box, in a figure of this size (pt).

    ``name`` must differ between the figures of a page; ``description`` is what a screen reader says; ``title``
    stands above the axes; ``kind`` is a class more; ``trials`` returns the positions of its `Dots`.
    """
    left, top, wide, high = (
        fraction * size for fraction, size in zip(chart.box, (width, height, width, height), strict=True)
    )
    frame = Frame(chart.x, chart.y, left, top, wide, high)
    elements = [
        f'<rect width="{width:g}" height="{height:g}" fill="#fff"/>',
        f'<clipPath id="{name}-clip">',
        f'<rect x="{left:.2f}" y="{top:.2f}" width="{wide:.2f}" height="{high:.2f}"/></clipPath>',
        *draw_axes(frame),
        f'<g clip-path="url(#{name}-clip)" fill="none">',
        *(draw_area(frame, area) for area in chart.areas),
        *(draw_rule(frame, rule) for rule in chart.rules),
        *(draw_dots(frame, dots, *trials(dots)) for dots in chart.dots),
        *(draw_curve(frame, each) + ("" if each.beyond else draw_marks(frame, each)) for each in chart.curves),
        "</g>",
        *(draw_marks(frame, curve) for curve in chart.curves if curve.beyond),
        *(draw_note(frame, note) for note in chart.notes),
        *draw_labels(frame, chart, height, title),
    ]
    classes = f"figure {kind}".rstrip()
    element = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" role="img" '
        f'aria-label="{escape(description)}" class="{classes}" font-family="DejaVu Sans, sans-serif">'
    )
    return Markup("".join([element, *elements, "</svg>"]))
