"""Data of a worst-case search for its document: objective of its points, lanes of the search box."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....campaigns.verdicts.order_statistics import quantiles
from ....studies.worst.objective import MOST
from ....studies.worst.outcome import WorstOutcome
from ...common.quantities import display_factor, label_with_unit

CUT = 0.02  # fraction of simulations that may be outside the axis, opposite to the worst


class ObjectiveValues(NamedTuple):
    """The objective of all points of a search in order, as displayed.

    ``values`` (points,) are NaN if there is none; ``failed`` marks points that did not complete or are unstable.
    ``rising`` is True if larger values are worse, False for a margin. ``worst`` and ``random`` are the indices of the
    worst point and of the worst random trial.
    """

    label: str
    values: np.ndarray
    failed: np.ndarray
    rising: bool
    worst: int
    random: int

    def limits(self) -> tuple[float, float]:
        """Return the ends of an axis that shows the worst value, and all but a few of the others."""
        finite = self.values[np.isfinite(self.values)]
        if not finite.size:
            return -1.0, 1.0
        (level,) = quantiles(finite, [CUT if self.rising else 1.0 - CUT])
        worst = finite.max() if self.rising else finite.min()
        low, high = float(min(level, worst)), float(max(level, worst))
        margin = 0.08 * (high - low) or 0.05 * abs(high) or 1.0
        return low - margin, high + margin

    def worst_so_far(self) -> np.ndarray:
        """Return the worst value up to each point; NaN before the first value."""
        return np.fmax.accumulate(self.values) if self.rising else np.fmin.accumulate(self.values)


def point_values(study: WorstOutcome) -> np.ndarray:
    """Return the objective of every point of the search, (points,), without new noise; larger is worse.

    Each point is simulated with all realisations of the noise in a row; after the random trials only once if noise does
    not matter.
    """
    count = 1 if study.over is None else study.over.count
    later = 1 if study.noise_matters is False else count
    fresh = 0 if study.fresh is None else study.fresh.values.size
    flown = study.flown.values[: study.flown.values.size - fresh]
    split = study.random_trials * count
    columns = []
    for values, size in ((flown[:split], count), (flown[split:], later)):
        rows = values.reshape(-1, size)
        columns.append(rows[:, 0] if study.over is None or size == 1 else study.over.objective(rows))
    return np.concatenate(columns)


def objective_of(study: WorstOutcome) -> ObjectiveValues:
    """Return the objective of all points in the order of simulation, angles in degrees."""
    values = point_values(study)
    displayed = select_values(study, values)
    label = label_with_unit(study.badness.text, study.unit)
    random = int(np.argmax(values[: study.random_trials]))
    failed = ~np.isfinite([study.badness.size(float(value)) for value in values])
    rising = study.badness.size(-1.0) < 0.0  # smaller values of a margin are worse
    return ObjectiveValues(label, displayed, failed, rising, int(np.argmax(values)), random)


def select_values(study: WorstOutcome, values: np.ndarray) -> np.ndarray:
    """Return the displayed numbers for values of the objective, in the displayed unit; NaN where there is none."""
    sizes = np.array([study.badness.size(float(value)) for value in values])
    known = np.isfinite(sizes) & (np.abs(sizes) < MOST)
    return np.where(known, sizes * display_factor(study.unit), np.nan)


class Lane(NamedTuple):
    """A dispersed parameter in the box: its ends, and its values in the worst case and in the worst random trial."""

    name: str
    unit: str
    low: float
    high: float
    worst: float
    random: float

    @property
    def label(self) -> str:
        return label_with_unit(self.name, self.unit)

    def at(self, value: float) -> float:
        """Return a value as a fraction of the box."""
        return (value - self.low) / (self.high - self.low)


def box_lanes(study: WorstOutcome) -> list[Lane]:
    """Return a lane for every dispersed parameter."""
    plotted, (worst, random) = study.flown.draws, study.places
    return [
        Lane(name, study.units.get(name, ""), low, high, float(plotted[name][worst]), float(plotted[name][random]))
        for name, (low, high) in study.space.ranges(study.sigmas).items()
    ]
