"""Result of a worst-case search: worst value, JSON, tables, and trials to replay."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..flown import FlightDocument, StudyResult
from ..study_units import unit_of_expression
from .objective import Objective
from .realisations import ONE, FreshNoise, Realisations
from .search import SearchPhase


class WorstFlight(FlightDocument):
    """Simulation in a row of worst.parquet; ``value`` is None if the simulation failed."""

    trial: int
    value: float | str | None


class RandomFlight(WorstFlight):
    """Worst of the random trials, and whether it is ``inside`` the box."""

    inside: bool


@dataclass(frozen=True, eq=False, kw_only=True)
class WorstOutcome(StudyResult):
    """Worst point in a box of draws: its ``value`` of ``badness``, inf if it failed, and ``place`` in the unit cube.

    ``row`` and ``random`` are the indices in ``flown`` of the worst simulation and of the worst random trial;
    ``reason`` explains why the worst failed, if known. ``phases`` are the phases of the search with their numbers of
    points, the random trials first.

    With random noise, the value of a point is a quantile ``over`` realisations of the noise, and ``fresh`` contains
    simulations of the worst point with other realisations. ``noise_matters`` is True if noise changed any value of the
    random trials, None if this was not examined.
    """

    DRAWS = "worst.parquet"

    badness: Objective
    sigmas: float
    value: float
    place: np.ndarray
    row: int
    random: int
    random_trials: int
    over: Realisations | None = None
    fresh: FreshNoise | None = None
    noise_matters: bool | None = None
    reason: str = ""
    phases: tuple[SearchPhase, ...] = ()

    @property
    def worst(self) -> WorstFlight:
        """Worst simulation: ``value`` (None if it failed), ``trial`` in worst.parquet, ``draws``, ``metrics``."""
        return {
            "trial": 0,
            "value": self.as_json(self.value),
            **self.flown.simulation_json(self.places[0], self.badness.fact),
        }

    @property
    def worst_random(self) -> RandomFlight:
        """Worst of the random trials, and whether it is ``inside`` the box."""
        place = self.flown.points[self.random]
        inside = bool(np.all((place >= 0.0) & (place <= 1.0)))
        value = self.as_json(float(self.flown.values[self.random]))
        return {
            "trial": 1,
            "value": value,
            "inside": inside,
            **self.flown.simulation_json(self.random, self.badness.fact),
        }

    @property
    def flown_text(self) -> str:
        """Text on the statistic over the noise at the worst point, "" if the noise is not random."""
        if self.over is None:
            return ""
        return ONE if self.noise_matters is False else self.over.text

    @property
    def worst_realisation(self) -> float | None:
        """Worst value of the worst point under the noise of the search; None if it equals the point's value."""
        if self.over is None or self.over.count == 1 or self.over.quantile == 1.0 or self.noise_matters is False:
            return None
        fresh = 0 if self.fresh is None else self.fresh.values.size
        searched = slice(0, self.flown.values.size - fresh)
        same = np.all(self.flown.points[searched] == self.flown.points[self.row], axis=1)
        return float(self.flown.values[searched][same].max())

    def as_json(self, value: float) -> float | str | None:
        """Return a value as JSON: null if the simulation failed, "unstable" or "unlimited" for such margins."""
        return self.badness.fact(self.badness.size(value))

    @property
    def places(self) -> list[int]:
        """Indices of the worst simulation and of the worst random one."""
        return [self.row, self.random]

    @property
    def unit(self) -> str:
        """Unit of the objective, "" if it has none or its text contains it."""
        return "" if self.badness.expression is None else unit_of_expression(self.badness.expression, self.units)

    def values(self) -> dict[str, float]:
        """Return the numbers that requirements may refer to; numbers of fresh noise are nan without fresh noise."""
        values = {"worst": self.value, "random": float(self.flown.values[self.random])}
        values |= {
            "fresh_worst": math.nan if self.fresh is None else self.fresh.worst,
            "fresh_quantile": math.nan if self.fresh is None else self.fresh.at_quantile,
        }
        return {name: self.badness.size(value) for name, value in values.items()} | {"flights": float(self.flights)}

    def json_document(self, folder: Path | None = None) -> dict[str, object]:
        """Return the result as JSON; ``folder`` is the folder to which it has been written, or None."""
        replay = self.replay(folder, 0)
        return {
            **self.facts,
            "metric": self.badness.text,
            "sigmas": self.sigmas,
            **self._condition_document(),
            "unit": self.unit,
            "units": dict(self.units),
            **self._noise_document(),
            **({} if self.fresh is None else {"fresh": self.fresh.document(self.as_json)}),
            **({} if self.noise_matters is None else {"noise_matters": self.noise_matters}),
            "flights": self.flights,
            "random_trials": self.random_trials,
            "worst": self.worst,
            "worst_random": self.worst_random,
            **({"reason": self.reason} if self.reason else {}),
            **({"replay": replay} if replay else {}),
        }

    def _noise_document(self) -> dict[str, object]:
        """Return the value of a point under random noise; empty if the noise is not random."""
        if self.over is None:
            return {}
        entries = {"objective": self.flown_text, "quantile": self.over.quantile, "realisations": self.over.count}
        largest = self.worst_realisation
        return entries if largest is None else entries | {"worst_realisation": self.as_json(largest)}

    def write(self, folder: Path) -> None:
        """Write worst.json, flights.parquet, and worst.parquet for `--draws`: the worst trial, and the random one."""
        self._write(folder, "worst", "value", np.array(self.places))
