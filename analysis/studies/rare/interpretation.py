"""Interpretation of a rare failure's simulations: levels, influence of parameters, equivalent Monte Carlo."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...campaigns.summary import success_interval
from ...campaigns.verdicts.order_statistics import quantiles
from .outcome import RareOutcome


class LevelSpan(NamedTuple):
    """Simulations ``first`` to ``last`` of a level, its ``threshold``, and the threshold of the next level.

    ``reached`` is the probability of the level itself, None if its chains are not trusted, in which case no level
    follows.
    """

    number: int
    first: int
    last: int
    threshold: float | None
    following: float | None
    reached: float | None


def level_spans(result: RareOutcome) -> list[LevelSpan]:
    """Return the levels as ranges of simulations, counted from 1; the seed of a chain belongs to the level before."""
    spans: list[LevelSpan] = []
    levels = result.simulation.levels
    first, seeds, reached = 1, 0, 1.0
    for index, level in enumerate(levels):
        is_last = index + 1 == len(levels)
        last = result.simulation.evaluations if is_last else first + level.samples - seeds - 1
        following: float | None = 0.0 if is_last else levels[index + 1].threshold
        trusted = level.probability is not None
        spans.append(
            LevelSpan(
                index + 1, first, last, level.threshold, following if trusted else None, reached if trusted else None
            )
        )
        fraction = level.probability or 0.0
        first, seeds = last + 1, round(fraction * level.samples)
        reached *= fraction
    return spans


def influence(result: RareOutcome) -> dict[str, float]:
    """Return the distance of failures from the first level's samples in each dispersed parameter, largest first.

    The distance is in standard deviations of the first level. It is the larger of two shifts: of the mean, and of the
    mean distance from the median, which detects failures at both ends.
    """
    count = level_spans(result)[0].last
    failed = result.flown.values >= 0.0
    influences: dict[str, float] = {}
    if not failed.any():
        return influences
    for name in result.space.names:
        column = result.flown.draws[name]
        start = column[:count]
        middle, spread = float(quantiles(start, (0.5,))[0]), float(np.std(start))
        if spread == 0.0:
            continue
        shift = abs(float(np.mean(column[failed]) - np.mean(start)))
        apart = float(np.mean(np.abs(column[failed] - middle)) - np.mean(np.abs(start - middle)))
        influences[name] = max(shift, apart) / spread
    return dict(sorted(influences.items(), key=lambda item: -item[1]))


class Equivalent(NamedTuple):
    """Method of estimating the probability, with its number of simulations and the resulting interval."""

    label: str
    simulations: float
    low: float
    high: float


def equivalents(result: RareOutcome) -> list[Equivalent]:
    """Return this study, Monte Carlo with as many simulations, and Monte Carlo with the same accuracy.

    The same accuracy means the same coefficient of variation. For Monte Carlo the interval is Clopper and Pearson's for
    the expected number of failures, rounded to an integer.
    """
    low, high = result.interval
    estimates = [Equivalent("this study", result.flights, low, high)]
    if result.probability is None:
        return estimates
    for label, trials in (
        ("Monte Carlo, same number", float(result.flights)),
        ("Monte Carlo, same c.o.v.", result.brute_force or 0.0),
    ):
        if trials >= 1.0:
            low, high = success_interval(round(result.probability * trials), round(trials))
            estimates.append(Equivalent(label, round(trials), low, high))
    return estimates
