"""A chart as an SVG element: what a page shows without scripts and on paper, and below the script's own lines."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from markupsafe import Markup, escape

from ..interactive.charts import Chart, Dots
from ..interactive.measures import LABEL_SIZE
from .svg.axes import draw_axes, draw_labels
from .svg.fluid import FluidFrame, in_pixels
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
    """Return the <svg> element of a chart that was laid out in a figure of this size (pt).

    ``name`` must differ between the figures of a page; ``description`` is what a screen reader says; ``title``
    stands above the axes; ``kind`` is a class more; ``trials`` returns the positions of its `Dots`.
    """
    if chart.fluid:
        scaled, point, (left, top, right, bottom) = in_pixels(chart), chart.fluid.point, chart.fluid.margins
        high = point * height
        edges = (-left, high - top)
        frame: Frame = FluidFrame(scaled.x, scaled.y, 0.0, 0.0, width, high - top - bottom, edges)
        size, kind = f'style="height:{high:g}px;padding:{top:g}px {right:g}px {bottom:g}px {left:g}px"', f"fluid {kind}"
        elements = _elements(frame, scaled, name, title, trials, point * LABEL_SIZE)
    else:
        left, top, wide, high = chart.box
        frame = Frame(chart.x, chart.y, left * width, top * height, wide * width, high * height, (0.0, height))
        size = f'viewBox="0 0 {width:g} {height:g}"'
        paper = f'<rect width="{width:g}" height="{height:g}" fill="#fff"/>'
        elements = paper + _elements(frame, chart, name, title, trials, LABEL_SIZE)
    classes = f"figure {kind}".rstrip()
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img" aria-label="{escape(description)}" '
        f'class="{classes}" font-family="DejaVu Sans, sans-serif">{elements}</svg>'
    )


def _elements(frame: Frame, chart: Chart, name: str, title: str, trials: TrialPositions, label_size: float) -> str:
    """Return the elements of the picture, from the back to the front."""
    below = "".join(draw_area(frame, each) for each in chart.areas)
    below += "".join(draw_rule(frame, each) for each in chart.rules)
    dots = "".join(draw_dots(frame, each, *trials(each)) for each in chart.dots)
    curves = "".join(
        frame.stretch(draw_curve(frame, each)) + ("" if each.beyond else draw_marks(frame, each))
        for each in chart.curves
    )
    return "".join(
        (
            *draw_axes(frame),
            frame.clip(name, frame.stretch(below) + dots + curves),
            *(draw_marks(frame, curve) for curve in chart.curves if curve.beyond),
            *(draw_note(frame, note) for note in chart.notes),
            *draw_labels(frame, title, label_size),
        )
    )
