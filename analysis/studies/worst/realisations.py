"""Noise in a worst-case search: the same realisations at every point, fresh realisations for the worst point."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypedDict

import numpy as np

from ....common.errors import InputError
from ...campaigns.verdicts.order_statistics import quantiles
from .search import LEAST

REALISATIONS = 5
QUANTILE = 0.5
ONE = "one noise realisation"
FRESH = 10  # factor on the realisations for the worst point


@dataclass(frozen=True)
class Realisations:
    """Objective of a point under noise: a ``quantile`` of its values over ``count`` realisations; 1 is the worst."""

    count: int
    quantile: float

    @property
    def fresh(self) -> int:
        """Number of fresh realisations with which the worst point is simulated."""
        return FRESH * self.count

    @property
    def name(self) -> str:
        """Quantile as text, both for metrics (larger is worse) and for margins (smaller is worse)."""
        return {0.5: "median", 1.0: "worst"}.get(self.quantile, f"{self.quantile:g} quantile from best to worst")

    @property
    def text(self) -> str:
        if self.count == 1:
            return ONE
        quantile = f", quantile {self.quantile:g}," if self.quantile == QUANTILE else ""
        return f"{self.name}{quantile} of {self.count} noise realisations"

    def objective(self, values: np.ndarray) -> np.ndarray:
        """Return the quantile of values (points, realisations) over the realisations."""
        return quantiles(values.T, (self.quantile,))[0]


def read_realisations(
    count: int | None, quantile: float | None, flights: int, noise_trial: int | None, *, default: int = REALISATIONS
) -> Realisations:
    """Return the noise options of a search with ``flights`` simulations. Raises InputError."""
    for option, value in (("`realisations`", count), ("`quantile`", quantile)):
        if value is not None and noise_trial is not None:
            problem = f"all simulations have the noise of trial {noise_trial}"
            raise InputError(option, f"{value:g}", problem, f"leave out {option} or `noise_trial`")
    if count is not None and count < 1:
        raise InputError("`realisations`", str(count), "not a positive number", "give 1 or more")
    fraction = QUANTILE if quantile is None else quantile
    if not 0.0 < fraction <= 1.0:
        raise InputError("`quantile`", f"{fraction:g}", "not a quantile", "give a number above 0 and at most 1")
    realisations = Realisations(max(1, min(default, flights // LEAST)) if count is None else count, fraction)
    if count is not None and LEAST <= flights < count * LEAST:
        problem = f"{flights} simulations are too few: a search needs {LEAST} points or more"
        raise InputError("`realisations`", str(count), problem, f"give `flights` {count * LEAST} or more")
    minimum = 1 if fraction == 1.0 else math.ceil(1.0 / (1.0 - fraction) - 1e-9)
    if quantile is not None and realisations.count < minimum:
        problem = f"{realisations.count} realisations are too few for this quantile"
        raise InputError(
            "`quantile`", f"{fraction:g}", problem, f"give `realisations` {minimum} or more, or `quantile` 1"
        )
    return realisations


class FreshDocument(TypedDict):
    """Fresh simulations of the worst point as JSON."""

    realisations: int
    worst: float | str | None
    quantile: float
    at_quantile: float | str | None


@dataclass(frozen=True, eq=False)
class FreshNoise:
    """Worst point under fresh noise: ``values`` (realisations,) of the objective; larger is worse."""

    values: np.ndarray
    quantile: float

    @property
    def worst(self) -> float:
        return float(self.values.max())

    @property
    def at_quantile(self) -> float:
        return float(quantiles(self.values, (self.quantile,))[0])

    def document(self, fact: Callable[[float], float | str | None]) -> FreshDocument:
        """Return the result as JSON; ``fact`` converts a value to JSON."""
        return {
            "realisations": int(self.values.size),
            "worst": fact(self.worst),
            "quantile": self.quantile,
            "at_quantile": fact(self.at_quantile),
        }
