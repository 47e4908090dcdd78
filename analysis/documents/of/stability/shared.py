"""Figures common to several loops, such as identical axes, which are shown once, with the first loop.

Two figures are equal if they have the same texts, lines and marks, and no point differs by more than `TOLERANCE`, less
than half the width of a line.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ....stability.results.report import LoopReport
from ...chart.panel import POINTS
from ...common.panels import HALF_WIDTH, PANEL_WIDTH
from ...interactive.charts import Axis, Chart
from ...pictures import Figure

TOLERANCE = 0.5  # pt; lines of responses are 1.3 pt wide
COORDINATES = (
    "at",
    "ends",
    "ticks",
)  # fields that are not compared; of x and y only the shape is
FiguresBySection = dict[str, list[Figure]]  # figures by section of a loop's article


@dataclass(frozen=True)
class FigureContent:
    """Content of a figure for comparison: its points (pt), and all other content."""

    strokes: Sequence[object]
    points: np.ndarray


@dataclass(frozen=True)
class SharedFigures:
    """The figures shown with a loop, and labels of figures shown with another loop, by the index of that loop."""

    figures: FiguresBySection
    labels_by_loop: dict[int, list[str]]


@dataclass
class _DistinctFigure:
    figure: Figure
    picture: FigureContent
    loops: list[int]


def picture_of(figure: Figure) -> FigureContent:
    """Return the content of a figure; points outside the axes are moved to their edges."""
    charts = [chart for chart in (figure.chart, figure.below) if chart is not None]
    width, height = POINTS * (PANEL_WIDTH if figure.is_narrow else HALF_WIDTH), POINTS * figure.height
    points = [each for chart in charts for each in _points(chart, width, height)]
    return FigureContent([_strokes(chart) for chart in charts], np.concatenate(points))


def _strokes(chart: Chart) -> Sequence[object]:
    texts = [[text for _, text in axis.ticks] for axis in (chart.x, chart.y)]
    marks = [chart.x, chart.y, *chart.curves, *chart.areas, *chart.rules, *chart.notes]
    return chart.title, texts, [_look(each) for each in marks]


def _look(mark: Any) -> list[object]:
    fields = {name: value for name, value in vars(mark).items() if name not in COORDINATES}
    return [np.shape(value) if name in ("x", "y") else value for name, value in fields.items()]


def _points(chart: Chart, width: float, height: float) -> Iterator[np.ndarray]:
    """Yield the coordinates (pt) of everything in a chart whose axes would fill the figure."""

    def across(x: object, *, of_axes: bool = False) -> np.ndarray:
        return width * _fractions(chart.x, x, of_axes)

    def up(y: object, *, of_axes: bool = False) -> np.ndarray:
        return height * _fractions(chart.y, y, of_axes)

    yield across([at for at, _ in chart.x.ticks])
    yield up([at for at, _ in chart.y.ticks])
    for curve in chart.curves:
        yield across(curve.x)
        yield up(curve.displayed)
    for area in chart.areas:
        yield across(area.x, of_axes=area.of_axes[0])
        yield up(area.y, of_axes=area.of_axes[1])
    for rule in chart.rules:
        yield across(rule.at) if rule.upright else up(rule.at)
    for note in chart.notes:
        yield across(note.at[0], of_axes=note.of_axes[0])
        yield up(note.at[1], of_axes=note.of_axes[1])


def _fractions(axis: Axis, values: object, of_axes: bool) -> np.ndarray:
    numbers = np.atleast_1d(np.asarray(values, dtype=float))
    ends = np.array(axis.ends)
    if of_axes:
        return numbers
    if axis.logarithmic:
        numbers, ends = np.log(np.maximum(numbers, 1e-300)), np.log(ends)
    return np.clip((numbers - ends[0]) / (ends[1] - ends[0]), 0.0, 1.0)


def are_indistinguishable(one: FigureContent, other: FigureContent) -> bool:
    """Return True if two figures have equal content and no point differs by more than `TOLERANCE`."""
    if one.strokes != other.strokes or one.points.size != other.points.size:
        return False
    return np.allclose(one.points, other.points, rtol=0.0, atol=TOLERANCE, equal_nan=True)


def share_figures(loops: Sequence[LoopReport], figures: Sequence[FiguresBySection]) -> list[SharedFigures]:
    """Return the figures to show with each loop: each figure of the loops with the first loop that has it."""
    distinct: dict[str, list[_DistinctFigure]] = {}
    retained: list[dict[str, list[_DistinctFigure]]] = []
    elsewhere: list[dict[int, list[str]]] = [{} for _ in loops]
    for index, parts in enumerate(figures):
        retained.append({key: [] for key in parts})
        for key, members in parts.items():
            for figure in members:
                picture = picture_of(figure)
                same = next(
                    (one for one in distinct.get(figure.label, []) if are_indistinguishable(one.picture, picture)), None
                )
                if same is None:
                    one = _DistinctFigure(figure, picture, [index])
                    distinct.setdefault(figure.label, []).append(one)
                    retained[-1][key].append(one)
                elif same.loops[0] != index:
                    same.loops.append(index)
                    elsewhere[index].setdefault(same.loops[0], []).append(figure.label)
    return [
        SharedFigures({key: [_titled(one, loops) for one in members] for key, members in parts.items()}, away)
        for parts, away in zip(retained, elsewhere, strict=True)
    ]


def _titled(one: _DistinctFigure, loops: Sequence[LoopReport]) -> Figure:
    """Return a figure whose label names its loops if there are several."""
    if len(one.loops) == 1:
        return one.figure
    names = combine_loop_names([loops[index] for index in one.loops])
    return replace(one.figure, label=f"{one.figure.label}: {names}")


def combine_loop_names(loops: Sequence[LoopReport]) -> str:
    """Return the names of loops, with elements of a vector combined, and with operating points if these differ."""
    points = len({loop.point for loop in loops}) > 1
    stems: dict[tuple[str, str], list[str]] = {}
    for loop in loops:
        stem, bracket, index = loop.name.partition("[")
        stems.setdefault((stem, f" at {loop.point}" if points else ""), []).append(bracket + index)
    return ", ".join(f"{stem}{', '.join(indices)}{point}" for (stem, point), indices in stems.items())
