"""Trajectories in bundles: side and plan view of many flights, a panel per contender, one scale in all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from ...campaigns.compare.comparison import Contender
from ..campaign.recorded_names import find_vector, names_of_record, owner_of, variable_of
from ..common.panels import Panel, far, panel
from ..common.round_body import radius_of, track_angles
from ..common.style import FAILED, FAINT, GRID, INK, Look, plain_ticks
from .dispersions import TARGET, target_of
from .recorded import Flight

DRAWN = 40  # flights of a panel
SHAPE = 1.45  # width over height of a panel's axes
STRETCH = 4.0  # a plan whose sides differ by less is drawn to one scale both ways
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
    """

    paths: list[Path]
    target: np.ndarray
    height: str
    radius: float | None

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
        along = _along(path[:2], aim[:2]) if radius is None else radius * track_angles(path, radius, aim)[0]
        paths.append(Path(success, along, heights, path[:2]))
    return Bundle(paths, target.values[0, :2], height, radius) if paths else None


def _along(plan: np.ndarray, target: np.ndarray) -> np.ndarray:
    line = target - plan[:, 0]
    length = float(np.hypot(*line))
    direction = line / length if length > 0.0 else np.array([1.0, 0.0])
    return direction @ (plan - target[:, np.newaxis])


def side_panels(bundles: Mapping[str, Bundle], looks: Mapping[str, Look]) -> list[Panel]:
    """Height over downrange distance, one scale in all panels, with the surface below altitudes; not to scale."""
    framed = _frame(bundles)
    ground = all(bundle.over_ground for bundle in bundles.values())
    along = np.concatenate([path.along for path in framed] + [np.zeros(1)])
    height = np.concatenate([path.height for path in framed] + ([np.zeros(1)] if ground else []))
    x_scale, x_unit = far(along)
    y_scale, y_unit = far(height)
    panels = []
    for index, (label, bundle) in enumerate(bundles.items()):

        def draw(axes: Axes, bundle: Bundle = bundle, colour: str = looks[label].colour) -> None:
            for path in bundle.paths:
                _line(axes, x_scale * path.along, y_scale * path.height, colour, path.success)
            axes.axvline(0.0, color=INK, linewidth=0.8, linestyle=(0, (1, 2)))
            if ground:
                axes.axhspan(
                    -ROOM * y_scale * float(np.nanmax(height)), 0.0, facecolor=GRID, edgecolor="none", zorder=0.8
                )
                axes.axhline(0.0, color=INK, linewidth=0.8, zorder=0.9)
            axes.set_xlim(*_limits(x_scale * along))
            axes.set_ylim(*_limits(y_scale * height))
            axes.set_xlabel(f"downrange from the target, {x_unit}")
            axes.set_title(f"{bundle.height}, {y_unit}", loc="left", fontsize=8.5)
            plain_ticks(axes, x=5, y=5)

        panels.append(panel(label, f"side-{index}", f"Side view of {len(bundle.paths)} flights of {label}", draw))
    return panels


def plan_panels(bundles: Mapping[str, Bundle], looks: Mapping[str, Look]) -> list[Panel]:
    """Paths from above with the target, one scale in all panels."""
    plans = [path.plan for path in _frame(bundles)]
    x, y = np.concatenate(plans + [bundle.target[:, np.newaxis] for bundle in bundles.values()], axis=1)
    equal = 1.0 / STRETCH <= (np.ptp(x) or 1e-9) / (np.ptp(y) or 1e-9) <= STRETCH
    x_scale, x_unit = far(np.concatenate([x, y]) if equal else x)
    y_scale, y_unit = (x_scale, x_unit) if equal else far(y)
    x_limits, y_limits = _limits(x_scale * x), _limits(y_scale * y)
    if equal:
        x_limits, y_limits = _to_shape(x_limits, y_limits)
    panels = []
    for index, (label, bundle) in enumerate(bundles.items()):

        def draw(axes: Axes, bundle: Bundle = bundle, colour: str = looks[label].colour) -> None:
            for path in bundle.paths:
                _line(axes, x_scale * path.plan[0], y_scale * path.plan[1], colour, path.success)
            axes.plot(x_scale * bundle.target[0], y_scale * bundle.target[1], **TARGET)
            axes.set_xlim(*x_limits)
            axes.set_ylim(*y_limits)
            if equal:
                axes.set_aspect("equal")
            else:
                axes.set_title("not to scale", loc="right", fontsize=8.0, color=FAINT)
            axes.set_xlabel(f"x, {x_unit}")
            axes.set_title(f"y, {y_unit}", loc="left", fontsize=8.5)
            plain_ticks(axes, x=5, y=5)

        panels.append(panel(label, f"plan-{index}", f"Plan view of {len(bundle.paths)} flights of {label}", draw))
    return panels


def _line(axes: Axes, x: np.ndarray, y: np.ndarray, colour: str, success: bool) -> None:
    """A flight; one that failed is dark and dashed."""
    if success:
        axes.plot(x, y, color=colour, linewidth=0.7, alpha=0.6)
    else:
        axes.plot(x, y, linewidth=0.8, alpha=0.8, **FAILED)


def _frame(bundles: Mapping[str, Bundle]) -> list[Path]:
    """The paths that decide the scale: of successful flights, or all where none succeeded."""
    paths = [path for bundle in bundles.values() for path in bundle.paths]
    return [path for path in paths if path.success] or paths


def _limits(values: np.ndarray) -> tuple[float, float]:
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    margin = ROOM * (high - low) or 1.0
    return low - margin, high + margin


def _to_shape(x: tuple[float, float], y: tuple[float, float]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Limits widened one way, so that axes with one scale fill their panel."""
    width, height = x[1] - x[0], y[1] - y[0]
    more_x, more_y = max(0.0, SHAPE * height - width) / 2, max(0.0, width / SHAPE - height) / 2
    return (x[0] - more_x, x[1] + more_x), (y[0] - more_y, y[1] + more_y)
