"""Trajectories in bundles: side and plan view of many flights, a panel per contender, one scale in all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...campaigns.compare.comparison import Contender
from ..campaign.recorded_names import (
    LETTERS,
    AxisNames,
    axes_of,
    axis_of,
    find_vector,
    names_of_record,
    owner_of,
    variable_of,
)
from ..chart.axes import linear_axis
from ..chart.equal import Ends, to_scale
from ..chart.lines import line
from ..chart.marks import across, instant, level, note_above
from ..chart.panel import POINTS, chart_panel
from ..chart.symbols import mark
from ..common.colours import GRID, INK, Look
from ..common.panels import PANEL_HEIGHT, PANEL_WIDTH, Panel, far
from ..common.round_body import downrange, radius_of
from ..common.signals import displayed_name
from ..interactive.charts import NO_BOX, Axis, Chart, Curve
from ..interactive.measures import FAILED_DASHES
from .dispersions import TARGET, target_of
from .recorded import Flight

DRAWN = 40  # flights of a panel
STRETCH = 4.0  # a plan whose sides differ by less is drawn to one scale both ways
Polyline = tuple[np.ndarray, np.ndarray, bool]  # abscissas and ordinates of a path as displayed, True if it succeeded
ROOM = 0.12  # of the successful flights' extent, around them; failed flights may leave it


@dataclass(frozen=True)
class Path:
    """A flight in space: ``along`` (m from the target along the ground or, where that is not known to be round, along
    the horizontal line from the start to it, negative before it), ``height`` (m), and ``plan`` (x and y by rows, m)."""

    success: bool
    along: np.ndarray
    height: np.ndarray
    plan: np.ndarray


@dataclass(frozen=True)
class Bundle:
    """The paths of one contender, the horizontal place of its target, and what its height is called.

    ``radius`` (m) is that of the body over whose ground downrange goes; None where no altitude shows that it is round.
    ``axes`` are those of the frame of positions.
    """

    paths: list[Path]
    target: np.ndarray
    height: str
    radius: float | None
    axes: AxisNames = LETTERS

    @property
    def over_ground(self) -> bool:
        """Whether the height is one over the ground."""
        return self.height.rpartition(".")[2] == "altitude"


def bundle_of(contender: Contender, flights: Sequence[Flight]) -> Bundle | None:
    """The paths of a contender's flights, to their ends where the batch keeps the final values; None without any."""
    document = contender.stored.document
    names = names_of_record(document)
    position = find_vector(document, names, "position", "m")
    if position is None:
        return None
    owner = owner_of(document, position[0])
    altitudes = [name for name in names if variable_of(document, name) == "altitude"]
    height = next((name for name in altitudes if owner_of(document, name) == owner), position[2])
    target = target_of(contender, "position")
    row = {int(trial): index for index, trial in enumerate(contender.trials.trial)}
    plotted: list[tuple[bool, np.ndarray, np.ndarray, np.ndarray]] = []  # success, path, heights, target
    names, finals = [*position, height], contender.trials.final
    traced = [flight for flight in flights if set(names) <= set(flight.signals)]
    for chosen in np.unique(np.linspace(0, len(traced) - 1, min(DRAWN, len(traced))).round().astype(int)):
        flight = traced[chosen]
        index = row[flight.trial]
        signals = [flight.signals[name] for name in names]
        if not flight.is_whole and set(names) <= set(finals):  # the sampled rows seldom reach the end
            signals = [np.append(values, finals[name][index]) for name, values in zip(names, signals, strict=True)]
        *places, heights = signals
        if heights.size > 1:
            plotted.append((flight.success, np.stack(places), heights, target.values[index]))
    fits = (radius_of(path, heights) for _, path, heights, _ in plotted if height != position[2])
    radius = next((fit for fit in fits if fit is not None), None)  # of all flights: they are drawn in one figure
    paths = []
    for success, path, heights, aim in plotted:
        along = _along(path[:2], aim[:2]) if radius is None else downrange(path, radius, aim)
        paths.append(Path(success, along, heights, path[:2]))
    if not paths:
        return None
    title = displayed_name(height, {name: axis for name in position if (axis := axis_of(document, name))})
    return Bundle(paths, target.values[0, :2], title, radius, axes_of(document, position))


def _along(plan: np.ndarray, target: np.ndarray) -> np.ndarray:
    line = target - plan[:, 0]
    length = float(np.hypot(*line))
    direction = line / length if length > 0.0 else np.array([1.0, 0.0])
    return direction @ (plan - target[:, np.newaxis])


def side_panels(bundles: Mapping[str, Bundle], styles: Mapping[str, Look]) -> list[Panel]:
    """Height over downrange distance, one scale in all panels, with the surface below altitudes; not to scale."""
    framed = _frame(bundles)
    has_ground = all(bundle.over_ground for bundle in bundles.values())
    along = np.concatenate([path.along for path in framed] + [np.zeros(1)])
    height = np.concatenate([path.height for path in framed] + ([np.zeros(1)] if has_ground else []))
    x_scale, x_unit = far(along)
    y_scale, y_unit = far(height)
    x_axis = linear_axis(_limits(x_scale * along), 5, label=f"downrange from the target, {x_unit}")
    y_axis = linear_axis(_limits(y_scale * height), 5)
    panels = []
    for index, (label, bundle) in enumerate(bundles.items()):
        paths = [(x_scale * path.along, y_scale * path.height, path.success) for path in bundle.paths]
        chart = side_chart(paths, styles[label].colour, x_axis, y_axis, has_ground=has_ground)
        description = f"Side view of {len(bundle.paths)} flights of {label}"
        panels.append(chart_panel(label, f"side-{index}", description, chart, title=f"{bundle.height}, {y_unit}"))
    return panels


def side_chart(paths: Sequence[Polyline], colour: str, x: Axis, y: Axis, *, has_ground: bool) -> Chart:
    """Return paths from the side, with the place of the target and the surface at height 0."""
    return Chart(
        NO_BOX,
        x,
        y,
        curves=[_line(path, colour) for path in paths],
        areas=[across(min(y.ends[0], 0.0), 0.0, GRID, 1.0)] if has_ground else [],
        rules=[instant(0.0, INK, 0.8, (1.0, 2.0)), *([level(0.0, INK, 0.8)] if has_ground else [])],
    )


def plan_panels(bundles: Mapping[str, Bundle], styles: Mapping[str, Look]) -> list[Panel]:
    """Paths from above with the target, one scale in all panels."""
    plans = [path.plan for path in _frame(bundles)]
    x, y = np.concatenate(plans + [bundle.target[:, np.newaxis] for bundle in bundles.values()], axis=1)
    is_to_scale = 1.0 / STRETCH <= (np.ptp(x) or 1e-9) / (np.ptp(y) or 1e-9) <= STRETCH
    x_scale, x_unit = far(np.concatenate([x, y]) if is_to_scale else x)
    y_scale, y_unit = (x_scale, x_unit) if is_to_scale else far(y)
    x_ends, y_ends = _limits(x_scale * x), _limits(y_scale * y)
    axes = next(iter(bundles.values())).axes
    title = f"{axes[1]}, {y_unit}"
    panels = []
    for index, (label, bundle) in enumerate(bundles.items()):
        paths = [(x_scale * path.plan[0], y_scale * path.plan[1], path.success) for path in bundle.paths]
        target = mark(x_scale * bundle.target[0], y_scale * bundle.target[1], TARGET)
        curves = [*(_line(path, styles[label].colour) for path in paths), target]
        chart_of = partial(_plan_chart, curves, f"{axes[0]}, {x_unit}")
        if is_to_scale:
            chart = to_scale(chart_of, x_ends, y_ends, POINTS * PANEL_WIDTH, POINTS * PANEL_HEIGHT, title=title)
        else:
            chart = replace(chart_of(x_ends, y_ends), notes=[note_above("not to scale")])
        description = f"Plan view of {len(bundle.paths)} flights of {label}"
        panels.append(chart_panel(label, f"plan-{index}", description, chart, title=title))
    return panels


def _plan_chart(curves: Sequence[Curve], label: str, x_ends: Ends, y_ends: Ends) -> Chart:
    return Chart(NO_BOX, linear_axis(x_ends, 5, label=label), linear_axis(y_ends, 5), curves=curves)


def _line(path: Polyline, colour: str) -> Curve:
    """A flight; one that failed is dark and dashed."""
    x, y, success = path
    if success:
        return line(x, y, colour, width=0.7, opacity=0.6)
    return line(x, y, INK, width=0.8, dashes=FAILED_DASHES, opacity=0.8)


def _frame(bundles: Mapping[str, Bundle]) -> list[Path]:
    """The paths that decide the scale: of successful flights, or all where none succeeded."""
    paths = [path for bundle in bundles.values() for path in bundle.paths]
    return [path for path in paths if path.success] or paths


def _limits(values: np.ndarray) -> tuple[float, float]:
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    margin = ROOM * (high - low) or 1.0
    return low - margin, high + margin
