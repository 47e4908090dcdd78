"""Figures of trajectories: side and plan view of many simulations, one figure per variant, on one scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ....chart.axes import linear_axis
from ....chart.equal import Ends, to_scale
from ....chart.lines import line
from ....chart.marks import horizontal_band, horizontal_line, note_above, vertical_line
from ....chart.panel import POINTS
from ....chart.symbols import mark
from ....common.colours import GRID, INK, Look
from ....common.panels import PANEL_HEIGHT, PANEL_WIDTH, choose_length_unit
from ....interactive.charts import NO_BOX, Axis, Chart, Curve
from ....interactive.measures import FAILED_DASHES
from ....pictures import Figure
from .end_figures import TARGET
from .trajectories import FlightPath, VariantPaths

STRETCH = 4.0  # ratio of a plan's sides below which it has equal scales
Polyline = tuple[np.ndarray, np.ndarray, bool]  # abscissas and ordinates of a path as displayed, True if it succeeded
ROOM = 0.12  # margin over the extent of successful paths; failed ones may exceed it


def side_figures(bundles: Mapping[str, VariantPaths], styles: Mapping[str, Look]) -> list[Figure]:
    """Return figures of height over downrange distance on common scales, with the surface if heights are altitudes."""
    framed = _frame(bundles)
    has_ground = all(bundle.over_ground for bundle in bundles.values())
    along = np.concatenate([path.along for path in framed] + [np.zeros(1)])
    height = np.concatenate([path.height for path in framed] + ([np.zeros(1)] if has_ground else []))
    x_scale, x_unit = choose_length_unit(along)
    y_scale, y_unit = choose_length_unit(height)
    x_axis = linear_axis(_limits(x_scale * along), 5, label=f"downrange from the target, {x_unit}")
    y_axis = linear_axis(_limits(y_scale * height), 5)
    figures = []
    for index, (label, bundle) in enumerate(bundles.items()):
        paths = [(x_scale * path.along, y_scale * path.height, path.success) for path in bundle.paths]
        chart = side_chart(paths, styles[label].colour, x_axis, y_axis, has_ground=has_ground)
        words = f"Side view of {len(bundle.paths)} flights of {label}"
        figures.append(_figure(label, f"side-{index}", words, chart, f"{bundle.height}, {y_unit}", styles))
    return figures


def _figure(label: str, name: str, words: str, chart: Chart, title: str, styles: Mapping[str, Look]) -> Figure:
    titled = replace(chart, title=title)
    return Figure(label, name, words, titled, PANEL_HEIGHT, is_narrow=True, look=styles[label])


def side_chart(paths: Sequence[Polyline], colour: str, x: Axis, y: Axis, *, has_ground: bool) -> Chart:
    """Return the chart of paths in side view, with the target and the surface at height 0."""
    return Chart(
        NO_BOX,
        x,
        y,
        curves=[_line(path, colour) for path in paths],
        areas=[horizontal_band(min(y.ends[0], 0.0), 0.0, GRID, 1.0)] if has_ground else [],
        rules=[vertical_line(0.0, INK, 0.8, (1.0, 2.0)), *([horizontal_line(0.0, INK, 0.8)] if has_ground else [])],
    )


def plan_figures(bundles: Mapping[str, VariantPaths], styles: Mapping[str, Look]) -> list[Figure]:
    """Return figures of paths in plan view with the target, on a common scale."""
    plans = [path.plan for path in _frame(bundles)]
    x, y = np.concatenate(plans + [bundle.target[:, np.newaxis] for bundle in bundles.values()], axis=1)
    is_to_scale = 1.0 / STRETCH <= (np.ptp(x) or 1e-9) / (np.ptp(y) or 1e-9) <= STRETCH
    x_scale, x_unit = choose_length_unit(np.concatenate([x, y]) if is_to_scale else x)
    y_scale, y_unit = (x_scale, x_unit) if is_to_scale else choose_length_unit(y)
    x_ends, y_ends = _limits(x_scale * x), _limits(y_scale * y)
    axes = next(iter(bundles.values())).axes
    title = f"{axes[1]}, {y_unit}"
    figures = []
    for index, (label, bundle) in enumerate(bundles.items()):
        paths = [(x_scale * path.plan[0], y_scale * path.plan[1], path.success) for path in bundle.paths]
        target = mark(x_scale * bundle.target[0], y_scale * bundle.target[1], TARGET)
        curves = [*(_line(path, styles[label].colour) for path in paths), target]
        chart_of = partial(_plan_chart, curves, f"{axes[0]}, {x_unit}")
        if is_to_scale:
            chart = to_scale(chart_of, x_ends, y_ends, POINTS * PANEL_WIDTH, POINTS * PANEL_HEIGHT, title=title)
        else:
            chart = replace(chart_of(x_ends, y_ends), notes=[note_above("not to scale")])
        words = f"Plan view of {len(bundle.paths)} flights of {label}"
        figures.append(_figure(label, f"plan-{index}", words, chart, title, styles))
    return figures


def _plan_chart(curves: Sequence[Curve], label: str, x_ends: Ends, y_ends: Ends) -> Chart:
    return Chart(NO_BOX, linear_axis(x_ends, 5, label=label), linear_axis(y_ends, 5), curves=curves)


def _line(path: Polyline, colour: str) -> Curve:
    """Return the line of a path, dark and dashed for a failed trial."""
    x, y, success = path
    if success:
        return line(x, y, colour, width=0.7, opacity=0.6)
    return line(x, y, INK, width=0.8, dashes=FAILED_DASHES, opacity=0.8)


def _frame(bundles: Mapping[str, VariantPaths]) -> list[FlightPath]:
    """Return the paths that determine the scale: all paths of successful trials, or all paths if none succeeded."""
    paths = [path for bundle in bundles.values() for path in bundle.paths]
    return [path for path in paths if path.success] or paths


def _limits(values: np.ndarray) -> tuple[float, float]:
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    margin = ROOM * (high - low) or 1.0
    return low - margin, high + margin
