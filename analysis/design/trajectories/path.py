"""Path of a plan, independent of the method that found it: data for pages and tables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....common.errors import EndedError, ExitStatus

OFF = 0.02  # share of the range from least to full throttle, above which an interval belongs to a burn
ALL = 1.0 - 1e-6  # share above which an interval counts as full thrust


class PlanError(EndedError):
    """Failure to find a requested plan; the message names the plan and the reason."""

    def __init__(self, message: str, status: int = ExitStatus.NOT_MET) -> None:
        super().__init__(message, status)


@dataclass(frozen=True)
class PlannedPath:
    """Path of a plan at N + 1 times (s) and over the N intervals between them.

    ``position`` (m) and ``velocity`` (m/s) contain a row for each time, with the components along and up;
    ``propellant`` is relative to the initial mass. For each interval ``throttle`` is the fraction of the engine's
    largest thrust, and ``pitch`` (rad) is the angle of thrust from the first axis in the middle of the interval, nan
    without thrust.
    """

    time: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    propellant: np.ndarray
    throttle: np.ndarray
    pitch: np.ndarray

    @property
    def duration(self) -> float:
        """Duration, s."""
        return float(self.time[-1])

    @property
    def propellant_fraction(self) -> float:
        return float(self.propellant[-1])

    @property
    def middle(self) -> np.ndarray:
        """Middles of the intervals, s."""
        return (self.time[1:] + self.time[:-1]) / 2.0

    def burns(self) -> list[tuple[float, float]]:
        """Begin and end (s) of every burn above least throttle; intervals at partial throttle count in proportion."""
        low, high = float(self.throttle.min()), float(self.throttle.max())
        if not high > low:
            return [(float(self.time[0]), self.duration)]
        fraction = (self.throttle - low) / (high - low)
        fraction[fraction > ALL] = 1.0
        burning = np.concatenate([[False], fraction > OFF, [False]])
        edges = np.flatnonzero(burning[1:] != burning[:-1]).reshape(-1, 2)
        step = np.diff(self.time)
        burns = []
        for first, after in edges:
            idle = (1.0 - fraction[[first, after - 1]]) * step[[first, after - 1]]
            if after - first == 1:  # the position of such a burn in its interval is unknown
                idle /= 2.0
            burns.append((float(self.time[first] + idle[0]), float(self.time[after] - idle[1])))
        return burns
