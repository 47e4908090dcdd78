"""Trajectories of a variant's simulations: distance along the ground, height, plan view."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .....campaigns.compare.campaign_comparison import Contender
from ....common.round_body import downrange, radius_of
from ....common.signals import displayed_name
from ...campaign.recorded_names import (
    LETTERS,
    AxisNames,
    axes_of,
    axis_of,
    find_vector,
    names_of_record,
    owner_of,
    variable_of,
)
from .ends import target_of
from .recorded import ComparedFlight

DRAWN = 40  # paths drawn in a figure


@dataclass(frozen=True)
class FlightPath:
    """A path in space: ``along``, ``height`` (m) and ``plan`` (x and y, [2, rows], m).

    ``along`` (m, negative before the target) is the distance along the ground or, if the ground is not known to be
    round, along the horizontal line from the start to the target.
    """

    success: bool
    along: np.ndarray
    height: np.ndarray
    plan: np.ndarray


@dataclass(frozen=True)
class VariantPaths:
    """Paths of one variant, the horizontal position of its target, and the name of its height.

    ``radius`` (m) is the radius of the body along whose ground downrange is measured; None if no altitude reveals it.
    ``axes`` are the names of the axes of positions.
    """

    paths: list[FlightPath]
    target: np.ndarray
    height: str
    radius: float | None
    axes: AxisNames = LETTERS

    @property
    def over_ground(self) -> bool:
        """True if the height is an altitude above the ground."""
        return self.height.rpartition(".")[2] == "altitude"


def collect_paths(contender: Contender, flights: Sequence[ComparedFlight]) -> VariantPaths | None:
    """Return the paths of a variant's simulations, extended to recorded final values; None if there are no paths."""
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
        if not flight.is_whole and set(names) <= set(finals):  # sampled rows seldom include the end
            signals = [np.append(values, finals[name][index]) for name, values in zip(names, signals, strict=True)]
        *places, heights = signals
        if heights.size > 1:
            plotted.append((flight.success, np.stack(places), heights, target.values[index]))
    fits = (radius_of(path, heights) for _, path, heights, _ in plotted if height != position[2])
    radius = next((fit for fit in fits if fit is not None), None)  # common to all flights in a figure
    paths = []
    for success, path, heights, aim in plotted:
        along = _along(path[:2], aim[:2]) if radius is None else downrange(path, radius, aim)
        paths.append(FlightPath(success, along, heights, path[:2]))
    if not paths:
        return None
    title = displayed_name(height, {name: axis for name in position if (axis := axis_of(document, name))})
    return VariantPaths(paths, target.values[0, :2], title, radius, axes_of(document, position))


def _along(plan: np.ndarray, target: np.ndarray) -> np.ndarray:
    line = target - plan[:, 0]
    length = float(np.hypot(*line))
    direction = line / length if length > 0.0 else np.array([1.0, 0.0])
    return direction @ (plan - target[:, np.newaxis])
