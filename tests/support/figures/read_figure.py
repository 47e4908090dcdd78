"""Charts read from a drawn figure of matplotlib: complete charts, or none.

Titles, labels and legends remain in the picture, which the page's script shows below its lines.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import StepPatch

from perilune.analysis.documents.chart.plot_lines import TrialDots
from perilune.analysis.documents.interactive.charts import Axis, Chart
from perilune.analysis.documents.interactive.columns import has_enough_digits
from tests.support.figures.read_marks import read_areas, read_collection, read_curve, read_dots, read_rule, read_steps
from tests.support.figures.read_notes import read_note
from tests.support.figures.read_ticks import read_axis
from tests.support.figures.unstated import UnstatedError


def read_charts(figure: Figure, *, reduced: bool = False) -> list[Chart]:
    """Read the charts of a drawn figure; ``reduced``: envelopes of their lines.

    If one pair of axes is not stated in full, or has bars and bands alone, all are `picture`.
    """
    try:
        if figure.images or figure.lines or figure.patches or figure.artists or figure.subfigs:
            raise UnstatedError("something beside the axes")
        return [_read_axes(axes, reduced) for axes in figure.axes]
    except UnstatedError:
        return [_picture(axes) for axes in figure.axes]


def _read_axes(axes: Axes, reduced: bool) -> Chart:
    if axes.images or axes.artists or axes.tables or axes.child_axes or not axes.axison:
        raise UnstatedError("an image, a table or axes within axes")
    if [name for name, spine in axes.spines.items() if spine.get_visible()] != ["left", "bottom"]:
        raise UnstatedError("other edges than the left and the bottom one")
    lines = _by_order(axes.lines)
    dots = [line for line in lines if isinstance(line, TrialDots)]
    plain = [line for line in lines if line.get_transform() is axes.transData and line not in dots]
    patches = _by_order(axes.patches)
    steps = [patch for patch in patches if isinstance(patch, StepPatch)]
    if not (plain or dots or any(not patch.get_fill() for patch in patches)):
        raise UnstatedError("bars and bands alone")
    curves = [*(read_curve(line, reduced) for line in plain), *map(read_steps, steps)]
    for curve in curves:
        _check_digits(axes.get_xlim(), axes.get_xscale(), curve.x)
        _check_digits(axes.get_ylim(), axes.get_yscale(), curve.displayed)
    return Chart(
        box=_box(axes),
        x=read_axis(axes.xaxis, axes.get_xlim(), _label(axes)),
        y=read_axis(axes.yaxis, axes.get_ylim(), ""),
        curves=curves,
        dots=[read_dots(line) for line in dots],
        areas=[
            *(area for each in _by_order(axes.collections) for area in read_collection(axes, each)),
            *(area for each in patches if each not in steps for area in read_areas(axes, each)),
        ],
        rules=[read_rule(axes, line) for line in lines if line not in (*plain, *dots)],
        notes=[read_note(axes, text) for text in axes.texts if text.get_text() or _has_arrow(text)],
    )


def _check_digits(ends: tuple[float, float], scale: str, numbers: np.ndarray) -> None:
    """Refuse numbers whose places in the figure differ once they are float32, as poles very near to z = 1."""
    if scale == "linear" and not has_enough_digits(ends, numbers):
        raise UnstatedError("numbers of more digits than a page has")


def _picture(axes: Axes) -> Chart:
    """Return axes that remain a picture, with the abscissa along which the cursor is marked."""
    x, y = (
        Axis(label=label, ends=(float(low), float(high)), logarithmic=axis.get_scale() == "log", size=0.0)
        for label, (low, high), axis in (
            (_label(axes), axes.get_xlim(), axes.xaxis),
            ("", axes.get_ylim(), axes.yaxis),
        )
    )
    return Chart(_box(axes), x, y, picture=True)


def _box(axes: Axes) -> tuple[float, float, float, float]:
    bounds = axes.get_position()
    left, top, width, height = (
        round(float(each), 5) for each in (bounds.x0, 1.0 - bounds.y1, bounds.width, bounds.height)
    )
    return left, top, width, height


def _label(axes: Axes) -> str:
    """Return the label of an abscissa; of axes that share theirs one alone, or the figure, has it."""
    figure = axes.get_figure(root=True)
    assert figure is not None  # the axes were drawn
    labels = [each.get_xlabel() for each in (axes, *axes.get_shared_x_axes().get_siblings(axes))]
    return next(filter(None, labels), figure.get_supxlabel())


def _by_order(artists: Iterable[Any]) -> list[Any]:
    """Return artists from the back to the front."""
    return sorted((each for each in artists if each.get_visible()), key=lambda each: float(each.get_zorder()))


def _has_arrow(text: Any) -> bool:
    return getattr(text, "arrow_patch", None) is not None
