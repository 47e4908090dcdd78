"""Result of a study of a rare failure: numbers, JSON, tables, trials to replay."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NotRequired

import numpy as np

from ....common.percent import short_percent
from ..failure import Failure
from ..flown import FlightDocument, StudyResult, strict
from ..units import unit_of_expression
from .subset_simulation import LEAST_ACCEPTED, Level, SubsetSimulation
from .uncertainty import CONFIDENCE, significant_digits

TOLD = 5  # failures
APART = 1.0  # standard deviations: a failure nearer to a more probable one is not listed


class FailedFlight(FlightDocument):
    """A row of failures.parquet: ``trial`` is its number.

    ``distance`` is in standard deviations from the medians of the draws, as independent normal ones. Of noise that
    is random, ``streams`` are the trials whose noise each component had.
    """

    trial: int
    distance: float
    margin: float | None
    streams: NotRequired[dict[str, int]]
    replay: NotRequired[str]


@dataclass(frozen=True, eq=False, kw_only=True)
class RareOutcome(StudyResult):
    """The probability of a ``failure``, and the flights that it was found by.

    ``simulation`` has the numbers, of ``samples`` points a level.
    """

    DRAWS = "failures.parquet"

    failure: Failure
    simulation: SubsetSimulation
    samples: int

    @property
    def probability(self) -> float | None:
        """Probability of the failure; None where it was not reached."""
        return self.simulation.probability

    @property
    def interval(self) -> tuple[float, float]:
        """The 95 % interval of the probability."""
        return self.simulation.interval.low, self.simulation.interval.high

    @property
    def brute_force(self) -> float | None:
        """Number of plain Monte Carlo flights of the campaign with the same information; None where it is unknown."""
        return self.simulation.equivalent_trials

    @property
    def margin_unit(self) -> str:
        """The unit of margins and thresholds; empty where they have none."""
        return unit_of_expression(self.failure.expression, self.units)

    @property
    def why_levels_ended(self) -> str:
        """Why no level follows the last one, where that is the noise; else empty."""
        if not self.simulation.noise_ends:
            return ""
        level, place = self.simulation.levels[-1], len(self.simulation.levels)
        assert level.renewal_rate is not None
        rate, minimum = short_percent(level.renewal_rate), short_percent(LEAST_ACCEPTED)
        source = "" if level.source is None else f" of {self.noise.sources[level.source]}"
        return f"levels end at level {place}: {rate} % of the noise moves{source} are accepted, below {minimum} %"

    @cached_property
    def failures(self) -> list[FailedFlight]:
        """The most probable failed flights."""
        return [self._failure(trial, row) for trial, row in enumerate(self._places.tolist())]

    def _failure(self, trial: int, row: int) -> FailedFlight:
        distance, margin = float(np.linalg.norm(self.flown.points[row])), strict(self.flown.values[row])
        failure = FailedFlight(trial=trial, distance=distance, margin=margin, **self.flown.fact(row))
        if self.noise.sources:
            failure["streams"] = self.flown.streams(row)
        return failure

    @cached_property
    def _places(self) -> np.ndarray:
        """Positions of the failures among the simulations: nearest to the origin first, where the draws are most
        probable.

        Where no draw varies, those nearest to the limit.
        """
        failed = np.flatnonzero(self.flown.values >= 0.0)
        points = self.flown.points
        if not self.space.size:
            return failed[np.argsort(self.flown.values[failed], kind="stable")][:TOLD]
        chosen: list[int] = []
        for place in failed[np.argsort(np.linalg.norm(points[failed], axis=1), kind="stable")]:
            if all(np.linalg.norm(points[place] - points[other]) > APART for other in chosen):
                chosen.append(int(place))
            if len(chosen) == TOLD:
                break
        return np.array(chosen, dtype=int)

    def values(self) -> dict[str, float]:
        """Return the numbers that requirements are about: probability, interval[1] and [2], flights."""
        fraction = math.nan if self.probability is None else self.probability
        low, high = self.interval
        return {"probability": fraction, "interval[1]": low, "interval[2]": high, "flights": float(self.flights)}

    def json_document(self, folder: Path | None = None) -> dict[str, object]:
        """Return the machine-readable result; ``folder`` is where it has been written, if it has."""
        simulation = self.simulation
        failures = self.failures
        if self.replay(folder, 0):
            failures = [entry | {"replay": self.replay(folder, entry["trial"])} for entry in failures]
        return {
            **self.facts,
            "failure": self.failure.text,
            "samples": self.samples,
            **self._condition_document(),
            "probability": self.probability,
            "interval": list(self.interval),
            "confidence": CONFIDENCE,
            "variation": strict(simulation.interval.variation),
            "flights": self.flights,
            "brute_force_flights": self.brute_force,
            "families": simulation.families,
            "levels_ended": self.why_levels_ended,
            "levels": [self._level(level) for level in simulation.levels],
            "units": {**self.units, "margin": self.margin_unit},
            "failures": failures,
        }

    def _level(self, level: Level) -> dict[str, object]:
        source = None if level.source is None else self.noise.sources[level.source]
        return vars(level) | {
            "threshold": None if level.threshold is None else strict(level.threshold),
            "source": source,
            "trusted": level.trusted,
        }

    @property
    def digits(self) -> int:
        """Number of digits of the probability that its interval leaves."""
        return significant_digits(*self.interval)

    @property
    def monte_carlo(self) -> str:
        """The batch whose trials give a bound ten times lower, where the noise ends levels; else empty.

        Empty also where a value is held, since a batch holds none: its trials would not be those of this result.
        """
        trials, command = self.brute_force, None if self.commands is None else self.commands.monte_carlo
        if not self.simulation.noise_ends or trials is None or command is None or self.space.held:
            return ""
        return command(round(10.0 * trials))

    def write(self, folder: Path) -> None:
        """Write rare.json, flights.parquet and, where there are failures, failures.parquet for `--draws`."""
        self._write(folder, "rare", "margin", self._places)
