"""The probability of a rare failure by subset simulation (Au and Beck 2001), and how sure it is.

The failure is the last of nested events, each of which a tenth of the points of the one before are in: its probability
is the product of theirs. Points of an event are had by chains (`conditional_sampling`) from those of the one before.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .conditional_sampling import FIRST_SPREAD, MarginOf, grow_chains
from .uncertainty import CONFIDENCE, Interval, binomial_interval, chain_correlation, family_interval

SHARE = 0.1  # of a level's points that are in the next event (Au and Beck 2001, section 5)
MOST_TIED = 0.5  # of a level's points, above which they share one margin rather than approach the failure


@dataclass(frozen=True)
class Level:
    """One of the nested events: margins not below ``threshold`` (None for the first, which is everything).

    ``probability`` of the next event in it, ``taken`` and ``spread`` of the chains that sampled it (None for the
    first), ``correlation`` gamma of Au and Beck (2001, equation 29) in them and the coefficient of variation
    ``deviation`` of the probability (equation 28), which takes chains for independent of each other.
    """

    threshold: float | None
    samples: int
    probability: float
    taken: float | None
    spread: float | None
    correlation: float
    deviation: float


@dataclass(frozen=True, eq=False)
class SubsetSimulation:
    """What came of it: ``probability``, or None where the failure was not reached and only the interval's end is known.

    ``failures`` (failures, dimensions) are the points that failed at the last level, with their ``margins``.
    ``families`` is of how many of the first points the last event's are descendants.
    """

    probability: float | None
    interval: Interval
    levels: tuple[Level, ...]
    evaluations: int
    failures: np.ndarray
    margins: np.ndarray
    families: int


class StuckError(Exception):
    """So many of a level's points share one margin that no next event can be told; ``args`` are margin and share."""


@dataclass(eq=False)
class _Population:
    """A level's points: ``chains`` (chains, length) are their places by time, ``family`` the first point of each."""

    points: np.ndarray
    margins: np.ndarray
    chains: np.ndarray
    family: np.ndarray
    threshold: float | None = None
    taken: float | None = None
    spread: float | None = None


def subset_simulation(
    margin: MarginOf, dimensions: int, *, seed: int = 0, samples: int = 4500, least: float = 1e-9
) -> SubsetSimulation:
    """The probability that ``margin`` is 0 or more where its points are standard normal and independent.

    ``margin`` maps points (points, dimensions) to margins (points,), the larger the nearer to failure; inf is a failure
    and none is nan. Each level has ``samples`` points. A failure less likely than about ``least`` is given up. The
    interval counts that points of a chain, and chains of one family, are alike. The same seed gives the same bits.
    Raises StuckError where margins do not vary, ValueError for fewer than 100 samples or a ``least`` not in (0, 1).
    """
    if samples < 100 or not 0.0 < least < 1.0:
        raise ValueError(f"{samples} samples, least {least}")
    random = np.random.Generator(np.random.Philox(np.random.SeedSequence(seed)))
    evaluations = 0

    def counted(points: np.ndarray) -> np.ndarray:
        nonlocal evaluations
        evaluations += len(points)
        return margin(points)

    points = random.standard_normal((samples, dimensions))
    population = _Population(points, counted(points), np.arange(samples)[:, np.newaxis], np.arange(samples))
    spread, reached = FIRST_SPREAD, 1.0
    levels: list[Level] = []
    while True:
        threshold = _next_threshold(population.margins)
        inside = population.margins >= threshold
        levels.append(_level(population, inside))
        reached *= levels[-1].probability
        if threshold == 0.0 or reached < least:
            break
        seeds = random.permutation(np.flatnonzero(inside))
        length = samples // len(seeds)
        chains = grow_chains(
            counted, population.points[seeds], population.margins[seeds], threshold, length, spread, random
        )
        spread = chains.spread
        population = _Population(
            chains.points.reshape(-1, dimensions),
            chains.margins.reshape(-1),
            np.arange(chains.margins.size).reshape(chains.margins.shape),
            np.repeat(population.family[seeds], length),
            threshold,
            chains.taken,
            chains.spread,
        )
    failed = population.margins >= 0.0
    families = population.family[inside]
    if len(levels) == 1:
        interval = binomial_interval(int(inside.sum()), samples, CONFIDENCE)
    else:
        interval = family_interval(reached, families, samples, CONFIDENCE)
    if threshold != 0.0:
        interval = Interval(0.0, interval.high, interval.variation)
    return SubsetSimulation(
        reached if threshold == 0.0 else None,
        interval,
        tuple(levels),
        evaluations,
        population.points[failed],
        population.margins[failed],
        len(np.unique(families)),
    )


def _next_threshold(margins: np.ndarray) -> float:
    """The margin of the next event: that of the last of the worst tenth, 0 where they have all failed.

    Where many share that margin, the event is that of larger ones only. Raises StuckError where there are none.
    """
    worst = np.sort(margins)[::-1]
    threshold = worst[int(SHARE * len(worst)) - 1]
    if threshold >= 0.0:
        return 0.0
    tied = float(np.mean(margins >= threshold))
    if tied <= MOST_TIED:
        return float(threshold)
    above = worst[worst > threshold]
    if not above.size:
        raise StuckError(float(threshold), tied)
    return min(float(above[-1]), 0.0)


def _level(population: _Population, inside: np.ndarray) -> Level:
    probability = float(inside.mean())
    correlation = chain_correlation(inside[population.chains])
    variance = (1.0 - probability) / (probability * inside.size) * (1.0 + correlation)
    return Level(
        population.threshold,
        inside.size,
        probability,
        population.taken,
        population.spread,
        correlation,
        float(np.sqrt(variance)),
    )
