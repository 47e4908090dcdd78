"""The probability of a rare failure by subset simulation (Au and Beck 2001), and how sure it is.

The failure is the last of nested events, each of which a tenth of the points of the one before are in: its probability
is the product of theirs. Points of an event are had by chains (`conditional_sampling`) from those of the one before.
Where chains cannot renew the noise of one source, levels end, and what is left is bounded (`_bound`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypedDict

import numpy as np

from ...campaigns.draws.generators import standard_normals
from .conditional_sampling import FIRST_SPREAD, Chains, FreshStreams, MarginOf, Points, grow_chains
from .uncertainty import (
    CONFIDENCE,
    ConfidenceInterval,
    binomial_interval,
    chain_correlation,
    equivalent_trials,
    family_interval,
    fractional_interval,
)

SHARE = 0.1  # of a level's points that are in the next event (Au and Beck 2001, section 5)
MOST_TIED = 0.5  # of a level's points, above which they share one margin rather than approach the failure
LEAST_ACCEPTED = 0.05  # of the noise moves of any one source, below which a level's points are not trusted
FEW = 20  # moves of one noise source, below which its own acceptance rate says nothing


@dataclass(frozen=True)
class Level:
    """One of the nested events: margins not below ``threshold`` (None for the first, which is everything).

    ``probability`` of the next event in it, None where its chains are not ``trusted``. ``draw_acceptance`` and
    ``noise_acceptance`` are the acceptance rates of the two moves, None where there were none, ``least_acceptance`` is
    the lowest of a noise source and ``source`` its place; ``spread`` is that of the draw moves. ``correlation`` is
    gamma of Au and Beck (2001, equation 29), ``deviation`` the coefficient of variation of the probability (equation
    28), which takes chains for independent of each other.
    """

    threshold: float | None
    samples: int
    probability: float | None
    draw_acceptance: float | None = None
    noise_acceptance: float | None = None
    least_acceptance: float | None = None
    source: int | None = None
    spread: float | None = None
    correlation: float = 0.0
    deviation: float | None = None

    @property
    def renewal_rate(self) -> float | None:
        """The acceptance rate of the source that is renewed least; of all where no single one is known; None without
        noise moves."""
        return self.noise_acceptance if self.least_acceptance is None else self.least_acceptance

    @property
    def trusted(self) -> bool:
        """True if its chains renewed the noise of every source often enough."""
        return self.renewal_rate is None or self.renewal_rate >= LEAST_ACCEPTED


@dataclass(frozen=True, eq=False)
class SubsetSimulation:
    """Result of a subset simulation: ``probability``, or None where no failure was reached and only the interval's end
    is known.

    ``failures`` are the points that failed at the last trusted level, with their ``margins``. ``families`` is of how
    many of the first points the last event's are descendants. ``equivalent_trials`` are the plain Monte Carlo trials
    that would say as much, which bound the probability where ``noise_ends`` says that levels ended because the noise
    was not renewed; None where nothing says.
    """

    probability: float | None
    interval: ConfidenceInterval
    levels: tuple[Level, ...]
    evaluations: int
    failures: Points
    margins: np.ndarray
    families: int
    equivalent_trials: float | None
    noise_ends: bool = False


class StalledLevelError(Exception):
    """Error of a level too many of whose points share one margin for a next event; ``args`` are margin and share."""


@dataclass(eq=False)
class _Population:
    """A level's points: ``chains`` (chains, length) are their places by time, ``family`` the first point of each."""

    points: Points
    margins: np.ndarray
    chains: np.ndarray
    family: np.ndarray
    threshold: float | None = None
    grown: Chains | None = None


def subset_simulation(
    margin: MarginOf, dimensions: int, sources: int = 0, *, seed: int = 0, samples: int = 4500, least: float = 1e-9
) -> SubsetSimulation:
    """Compute the probability that ``margin`` is 0 or more over standard normal draws and the noise of independent
    sources.

    ``margin`` maps points of ``dimensions`` draws and ``sources`` streams to margins (points,), the larger the nearer
    to failure; inf is a failure and none is nan. Each level has ``samples`` points. A failure less likely than about
    ``least`` is abandoned. The interval counts that points of a chain, and chains of one family, are alike. The same
    seed gives the same bits. Raises StalledLevelError where margins do not vary, ValueError for fewer than 100 samples,
    a ``least`` not in (0, 1), or nothing random.
    """
    if samples < 100 or not 0.0 < least < 1.0 or dimensions + sources < 1:
        raise ValueError(f"{samples} samples, least {least}, {dimensions} dimensions, {sources} sources")
    sequence = np.random.SeedSequence(seed)
    random = np.random.Generator(np.random.Philox(sequence))
    of_noise = np.random.Generator(np.random.Philox(sequence.spawn(1)[0]))
    fresh = FreshStreams()
    evaluations = 0

    def count_calls(points: Points) -> np.ndarray:
        nonlocal evaluations
        evaluations += len(points)
        return margin(points)

    normals = standard_normals(random, (samples, dimensions))
    points = Points(normals, np.repeat(fresh.take(samples)[:, np.newaxis], sources, axis=1))
    population = _Population(points, count_calls(points), np.arange(samples)[:, np.newaxis], np.arange(samples))
    spread, reached = FIRST_SPREAD, 1.0
    levels: list[Level] = []
    while True:
        threshold = _next_threshold(population.margins)
        inside = population.margins >= threshold
        level = _level(population, inside)
        levels.append(level)
        before, reached = reached, reached * float(inside.mean())
        if threshold == 0.0 or reached < least:
            break
        seeds = random.permutation(np.flatnonzero(inside))
        length = samples // len(seeds)
        chains = grow_chains(
            count_calls, population.points.rows(seeds), population.margins[seeds], threshold, length, spread, fresh,
            (random, of_noise),
        )  # fmt: skip
        spread = chains.spread
        size = chains.margins.size
        grown = _Population(
            Points(chains.draws.reshape(size, dimensions), chains.streams.reshape(size, sources)),
            chains.margins.reshape(-1),
            np.arange(size).reshape(chains.margins.shape),
            np.repeat(population.family[seeds], length),
            threshold,
            chains,
        )
        level = _level(grown, None)
        if not level.trusted:
            levels.append(level)
            return _bound(population, before, samples, levels, evaluations)
        population = grown
    failed = population.margins >= 0.0
    families = population.family[inside]
    if len(levels) == 1:
        interval = binomial_interval(int(inside.sum()), samples, CONFIDENCE)
    else:
        interval = family_interval(reached, families, samples, CONFIDENCE)
    missed = threshold != 0.0
    if missed:
        interval = ConfidenceInterval(0.0, interval.high, interval.variation)
    return SubsetSimulation(
        None if missed else reached,
        interval,
        tuple(levels),
        evaluations,
        population.points.rows(failed),
        population.margins[failed],
        len(np.unique(families)),
        None if missed else equivalent_trials(reached, interval.variation),
    )


def _bound(
    population: _Population, reached: float, samples: int, levels: list[Level], evaluations: int
) -> SubsetSimulation:
    """Return the result of the last trusted level, whose chains are in an event of the probability ``reached``.

    Its points are as many plain Monte Carlo trials as would give that probability with the variance that the families
    of all its points have. The failures among them are counted as theirs, with the interval of Clopper and Pearson.
    """
    failed = population.margins >= 0.0
    fraction = float(failed.mean())
    trials = float(samples)
    if len(levels) > 2:
        variation = family_interval(reached, population.family, samples, CONFIDENCE).variation
        trials = equivalent_trials(reached, variation) or trials
    interval = fractional_interval(reached * fraction * trials, trials, CONFIDENCE)
    levels[-2] = _level(population, failed)
    return SubsetSimulation(
        reached * fraction if failed.any() else None,
        interval,
        tuple(levels),
        evaluations,
        population.points.rows(failed),
        population.margins[failed],
        len(np.unique(population.family[failed])),
        trials,
        noise_ends=True,
    )


def _next_threshold(margins: np.ndarray) -> float:
    """Return the margin of the next event: that of the last of the worst tenth, 0 where they have all failed.

    Where many share that margin, the event is that of larger ones only. Raises StalledLevelError where there are none.
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
        raise StalledLevelError(float(threshold), tied)
    return min(float(above[-1]), 0.0)


def _level(population: _Population, inside: np.ndarray | None) -> Level:
    """Return the facts of a level, whose points ``inside`` are in the next event; None where it has none."""
    of_moves: _Moves = {} if population.grown is None else _moves(population.grown)
    if inside is None:
        return Level(population.threshold, population.margins.size, None, **of_moves)
    probability = float(inside.mean())
    correlation = chain_correlation(inside[population.chains])
    deviation = None
    if probability > 0.0:
        deviation = float(np.sqrt((1.0 - probability) / (probability * inside.size) * (1.0 + correlation)))
    return Level(
        population.threshold, inside.size, probability, **of_moves, correlation=correlation, deviation=deviation
    )


class _Moves(TypedDict, total=False):
    draw_acceptance: float | None
    spread: float
    noise_acceptance: float
    least_acceptance: float
    source: int


def _moves(chains: Chains) -> _Moves:
    acceptance: _Moves = {"draw_acceptance": chains.draw_acceptance, "spread": chains.spread}
    moves, accepted = chains.noise_moves, chains.noise_accepted
    if moves.sum():
        acceptance["noise_acceptance"] = float(accepted.sum() / moves.sum())
        rates = np.where(moves >= FEW, accepted / np.maximum(moves, 1), np.inf)
        if rates.min() < np.inf:
            acceptance |= {"least_acceptance": float(rates.min()), "source": int(np.argmin(rates))}
    return acceptance
