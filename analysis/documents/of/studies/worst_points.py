"""A search for the worst case as its document has it: the objective of its points, lanes of the search box."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....campaigns.verdicts.order_statistics import quantiles
from ....studies.worst.objective import MOST
from ....studies.worst.outcome import WorstOutcome
from ...common.quantities import display_factor, label_with_unit

CUT = 0.02  # of the simulations, those farthest from the worst may lie outside of an axis


class ObjectiveValues(NamedTuple):
    """The objective of all points of a search in their order, as a page shows it.

    ``values`` (points,) are nan where there is none, and ``failed`` says which did not come to their end, or are
    unstable. ``rising`` says that a larger value is worse; a margin is worse where it is smaller. ``worst`` and
    ``random`` are the places of the worst point and of the worst random trial.
    """

    label: str
    values: np.ndarray
    failed: np.ndarray
    rising: bool
    worst: int
    random: int

    def limits(self) -> tuple[float, float]:
        """Return ends of an axis with the worst value on it, and all but a few of the others."""
        finite = self.values[np.isfinite(self.values)]
        if not finite.size:
            return -1.0, 1.0
        (level,) = quantiles(finite, [CUT if self.rising else 1.0 - CUT])
        worst = finite.max() if self.rising else finite.min()
        low, high = float(min(level, worst)), float(max(level, worst))
        margin = 0.08 * (high - low) or 0.05 * abs(high) or 1.0
        return low - margin, high + margin

    def worst_so_far(self) -> np.ndarray:
        """Return the worst value up to each point; nan before the first."""
        return np.fmax.accumulate(self.values) if self.rising else np.fmin.accumulate(self.values)


def point_values(study: WorstOutcome) -> np.ndarray:
    """Return the objective (points,) of every point of the search, the larger the worse; fresh noise is left out.

    Each point flies the realisations of the noise in a row; where noise does not matter, one after the random trials.
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
    """Return the objective of all points in the order in which they were flown, angles in degrees."""
    values = point_values(study)
    displayed = select_values(study, values)
    label = label_with_unit(study.badness.text, study.unit)
    random = int(np.argmax(values[: study.random_trials]))
    failed = ~np.isfinite([study.badness.size(float(value)) for value in values])
    rising = study.badness.size(-1.0) < 0.0  # of a margin the smaller number is worse
    return ObjectiveValues(label, displayed, failed, rising, int(np.argmax(values)), random)


def select_values(study: WorstOutcome, values: np.ndarray) -> np.ndarray:
    """Return the numbers that values of the objective stand for, in the unit that is shown; nan where there is none."""
    sizes = np.array([study.badness.size(float(value)) for value in values])
    known = np.isfinite(sizes) & (np.abs(sizes) < MOST)
    return np.where(known, sizes * display_factor(study.unit), np.nan)


class Lane(NamedTuple):
    """A dispersed parameter in the box: its ends, and its values at the worst case and the worst random trial."""

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
