"""Path of a plan, of any origin: data for pages and tables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....common.errors import EndedError, ExitStatus

OFF = 0.02  # share of the range from least to full throttle, above which an interval belongs to a burn
ALL = 1.0 - 1e-6  # share above which it counts as full


class PlanError(EndedError):
    """Failure to find a requested plan; the message names it and the reason."""

    def __init__(self, message: str, status: int = ExitStatus.NOT_MET) -> None:
        super().__init__(message, status)


@dataclass(frozen=True)
class PlannedPath:
    """Plan at N + 1 times (s) and over the N intervals between them.

    ``position`` (m) and ``velocity`` (m/s) have a row each, along and up; ``propellant`` is relative to the initial
    mass. Over each interval ``throttle`` is the fraction of the engine's largest thrust, and ``pitch`` (rad) the angle
    of thrust from the first axis in its middle, nan if there is no thrust.
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
        """Begin and end (s) of every stretch above least throttle; intermediate intervals are divided in proportion."""
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
