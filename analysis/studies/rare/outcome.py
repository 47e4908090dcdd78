"""Result of a study of a rare failure: probability, JSON, tables, and trials to replay."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NotRequired

import numpy as np

from ....common.percent import short_percent
from ..failure import Failure
from ..flown import FlightDocument, StudyResult, strict_number
from ..study_units import unit_of_expression
from .subset_simulation import LEAST_ACCEPTED, Level, SubsetSimulation
from .uncertainty import CONFIDENCE, significant_digits

TOLD = 5  # number of listed failures
APART = 1.0  # standard deviations: a failure nearer to a more probable one is not listed


class FailedFlight(FlightDocument):
    """Failed simulation: row number ``trial`` of failures.parquet.

    ``distance`` is in standard deviations from the medians of the draws, as independent normal variables. ``streams``
    contains, for random noise, the trial whose noise each component had.
    """

    trial: int
    distance: float
    margin: float | None
    streams: NotRequired[dict[str, int]]
    replay: NotRequired[str]


@dataclass(frozen=True, eq=False, kw_only=True)
class RareOutcome(StudyResult):
    """Probability of a ``failure``, and the simulations from which the probability was estimated.

    ``simulation`` is the result of the subset simulation with ``samples`` points per level.
    """

    DRAWS = "failures.parquet"

    failure: Failure
    simulation: SubsetSimulation
    samples: int

    @property
    def probability(self) -> float | None:
        """Probability of the failure; None if no failure was reached."""
        return self.simulation.probability

    @property
    def interval(self) -> tuple[float, float]:
        """95 % interval of the probability."""
        return self.simulation.interval.low, self.simulation.interval.high

    @property
    def brute_force(self) -> float | None:
        """Number of plain Monte Carlo trials of the campaign with the same information; None if unknown."""
        return self.simulation.equivalent_trials

    @property
    def margin_unit(self) -> str:
        """Unit of margins and thresholds, "" if they have none."""
        return unit_of_expression(self.failure.expression, self.units)

    @property
    def why_levels_ended(self) -> str:
        """Reason why no level follows the last one if the noise ended the levels, otherwise ""."""
        if not self.simulation.noise_ends:
            return ""
        level, place = self.simulation.levels[-1], len(self.simulation.levels)
        assert level.renewal_rate is not None
        rate, minimum = short_percent(level.renewal_rate), short_percent(LEAST_ACCEPTED)
        source = "" if level.source is None else f" of {self.noise.sources[level.source]}"
        return (
            f"levels end at level {place}, since {rate} % of the noise moves{source} are accepted, fewer than "
            f"{minimum} %"
        )

    @cached_property
    def failures(self) -> list[FailedFlight]:
        """Most probable failed simulations."""
        return [self._failure(trial, row) for trial, row in enumerate(self._places.tolist())]

    def _failure(self, trial: int, row: int) -> FailedFlight:
        distance, margin = float(np.linalg.norm(self.flown.points[row])), strict_number(self.flown.values[row])
        failure = FailedFlight(trial=trial, distance=distance, margin=margin, **self.flown.simulation_json(row))
        if self.noise.sources:
            failure["streams"] = self.flown.streams(row)
        return failure

    @cached_property
    def _places(self) -> np.ndarray:
        """Indices of the failures among the simulations: nearest to the origin first, where draws are most probable.

        If no draw varies, failures nearest to the limit come first.
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
        """Return the numbers that requirements may refer to: probability, interval[1] and [2], flights."""
        fraction = math.nan if self.probability is None else self.probability
        low, high = self.interval
        return {"probability": fraction, "interval[1]": low, "interval[2]": high, "flights": float(self.flights)}

    def json_document(self, folder: Path | None = None) -> dict[str, object]:
        """Return the result as JSON; ``folder`` is the folder to which it has been written, or None."""
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
            "variation": strict_number(simulation.interval.variation),
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
            "threshold": None if level.threshold is None else strict_number(level.threshold),
            "source": source,
            "trusted": level.trusted,
        }

    @property
    def digits(self) -> int:
        """Number of significant digits of the probability, from its interval."""
        return significant_digits(*self.interval)

    @property
    def monte_carlo(self) -> str:
        """Command of a batch that lowers the bound tenfold, if the noise ended the levels, otherwise "".

        It is also "" if a value is held: a batch cannot hold values, so its trials would not correspond to this result.
        """
        trials, command = self.brute_force, None if self.commands is None else self.commands.monte_carlo
        if not self.simulation.noise_ends or trials is None or command is None or self.space.held:
            return ""
        return command(round(10.0 * trials))

    def write(self, folder: Path) -> None:
        """Write rare.json, flights.parquet and, if there are failures, failures.parquet for `--draws`."""
        self._write(folder, "rare", "margin", self._places)
