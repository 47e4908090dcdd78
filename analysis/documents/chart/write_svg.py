"""A chart as an SVG element, shown on paper and by pages without scripts, and below the script's lines."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from markupsafe import Markup, escape

from ..interactive.charts import Chart, Dots
from ..interactive.measures import LABEL_SIZE
from .svg.axes import draw_axes, draw_labels
from .svg.fluid import FluidFrame, in_pixels
from .svg.lines import draw_area, draw_curve, draw_rule
from .svg.marks import draw_dots, draw_marks
from .svg.texts import draw_note

TrialPositions = Callable[[Dots], tuple[np.ndarray, np.ndarray]]  # abscissas and ordinates as displayed, [trials]


def no_trials(dots: Dots) -> tuple[np.ndarray, np.ndarray]:
    """Raise the error for a chart with marks of trials but without their positions."""
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
    """Return the <svg> element of a chart laid out by `lay_out_fluid` in a figure of this size (pt).

    ``name`` must be unique among the figures of a page; ``description`` is the text for screen readers; ``title`` is
    above the axes; ``kind`` is an additional CSS class; ``trials`` returns the positions of its `Dots`.
    """
    assert chart.fluid
    scaled, point, (left, top, right, bottom) = in_pixels(chart), chart.fluid.point, chart.fluid.margins
    across, up = round(point * width - left - right, 2), round(point * height - top - bottom, 2)
    frame = FluidFrame(scaled.x, scaled.y, 0.0, 0.0, across, up, name, chart.fluid.margins)
    size = f"aspect-ratio:{across:g}/{up:g}" if chart.fluid.to_scale else f"height:{up:g}px"
    style = f"width:calc(100% - {left + right:g}px);{size};padding:{top:g}px {right:g}px {bottom:g}px {left:g}px"
    elements = _elements(frame, scaled, title, trials, point * LABEL_SIZE)
    classes = f"figure {kind}".rstrip()
    return Markup(
        f'<svg xmlns="http://www.w3.org/2000/svg" style="{style}" role="img" aria-label="{escape(description)}" '
        f'class="{classes}" font-family="DejaVu Sans, sans-serif">{elements}</svg>'
    )


def _elements(frame: FluidFrame, chart: Chart, title: str, trials: TrialPositions, label_size: float) -> str:
    """Return the elements of the picture from back to front."""
    return "".join(
        (
            *draw_axes(frame),
            *_inside(frame, chart, trials),
            *(draw_marks(frame, curve) for curve in chart.curves if curve.beyond),
            *(draw_note(frame, note) for note in chart.notes),
            *draw_labels(frame, title, label_size),
        )
    )


def _inside(frame: FluidFrame, chart: Chart, trials: TrialPositions) -> Iterator[str]:
    """Yield the elements within the axes; consecutive paths share one element."""
    paths = [draw_area(frame, each) for each in chart.areas]
    paths += [draw_rule(frame, each) for each in chart.rules]
    paths += [draw_dots(frame, each, *trials(each)) for each in chart.dots]
    for each in chart.curves:
        paths.append(draw_curve(frame, each))
        if each.marker and not each.beyond:
            yield frame.stretch("".join(paths))
            yield frame.clip(draw_marks(frame, each))
            paths.clear()
    yield frame.stretch("".join(paths))
