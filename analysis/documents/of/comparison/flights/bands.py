"""Percentiles of quantities over time, over the simulations of a variant."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2, norm

from .....campaigns.verdicts.order_statistics import quantiles
from ...campaign.recorded_names import RATIO
from .recorded import ComparedFlight, FlightQuantity, doubling

LEVELS = (5.0, 25.0, 50.0, 75.0, 95.0)  # %
MOST_TIMES = 300  # largest number of times of a band
FEWEST = 0.25  # fraction of the simulations; bands end when fewer are still running
SINGLES, FAILURES = 4, 2  # successful and failed flights drawn one by one
STATES = 6  # number of states in the filter's normalised squared error: position and velocity
History = tuple[np.ndarray, np.ndarray]  # times (s) and values


@dataclass(frozen=True)
class Bands:
    """Percentiles (levels LEVELS, rows) of a quantity at ``time`` (s) over ``flights`` simulations, in SI.

    The simulations are the successful ones, or the failed ones if none succeeded. ``singles`` are a few of these
    simulations, ``failed`` are some of the others that failed.
    """

    time: np.ndarray
    percentiles: np.ndarray
    flights: int
    singles: list[History]
    failed: list[History]

    def finite_values(self) -> np.ndarray:
        """Return all finite values of the bands and of ``singles``."""
        values = np.concatenate([self.percentiles.ravel(), *(row for _, row in self.singles)])
        return values[np.isfinite(values)]


def bands_of(quantity: FlightQuantity, flights: Sequence[ComparedFlight]) -> Bands | None:
    """Return percentiles, at each time over the simulations that last until then; None if none has the quantity.

    Times are taken from the longest simulation, and usually the others have the same times; elsewhere a value is
    interpolated linearly, or held if it is an Integer or Boolean. A command in the last row of a simulation never acts
    and is omitted. Errors over sigma include failed simulations.
    """
    good, bad = (
        [_history(quantity, flight) for flight in flights if flight.success == success and _has(flight, quantity)]
        for success in (True, False)
    )
    histories = good + bad if quantity.kind == "consistency" else good or bad
    if not histories:
        return None
    longest = max((time for time, _ in histories), key=lambda time: float(time[-1]))
    grid = longest[:: doubling(longest.size / MOST_TIMES)]
    values = np.stack([_resample(grid, time, row, quantity.held) for time, row in histories])
    flying = np.sum(np.isfinite(values), axis=0)
    enough = flying >= max(1.0, FEWEST * len(histories))
    percentiles = quantiles(values[:, enough], [level / 100.0 for level in LEVELS])
    failed = bad[:FAILURES] if good and quantity.kind != "consistency" else []
    return Bands(grid[enough], percentiles, len(histories), histories[:SINGLES], failed)


def _has(flight: ComparedFlight, quantity: FlightQuantity) -> bool:
    return flight.time.size > 1 and set(quantity.names) <= set(flight.signals)


def _history(quantity: FlightQuantity, flight: ComparedFlight) -> History:
    rows = slice(0, -1 if quantity.kind == "commands" and flight.is_whole else None)
    return flight.time[rows], quantity.values(flight.signals)[rows]


def _resample(grid: np.ndarray, time: np.ndarray, values: np.ndarray, held: bool) -> np.ndarray:
    """Return values at the times of a grid; NaN beyond the ends of the simulation."""
    margin = 1e-9 * max(1.0, abs(time[-1]))
    inside = (grid >= time[0] - margin) & (grid <= time[-1] + margin)
    if held:
        samples = values[np.clip(np.searchsorted(time, grid + margin, side="right") - 1, 0, time.size - 1)]
    else:
        samples = np.interp(grid, time, values)
    return np.where(inside, samples, np.nan)


def expectation(quantity: FlightQuantity) -> tuple[float, ...]:
    """Return the 5, 50 and 95 % values expected of a consistent filter's errors; empty for other quantities."""
    variable = quantity.variable
    if variable == "normalised_error_square":
        return tuple(float(chi2.ppf(level / 100.0, STATES)) for level in LEVELS[::2])
    if variable.endswith(RATIO):
        return tuple(float(norm.ppf(level / 100.0)) for level in LEVELS[::2])
    return ()
