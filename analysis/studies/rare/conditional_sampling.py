"""Samples of draws and noise conditional on a margin above a threshold: Markov chains from known samples.

Two moves alternate (`_NoiseMoves.choose`). Draws move by adaptive conditional sampling (Papaioannou, Betz, Zwirglmaier
and Straub 2015, section 4.3): a candidate is rho u + sqrt(1 - rho^2) xi with xi standard normal, which preserves the
normal distribution; its spread sqrt(1 - rho^2) is adapted to the acceptance rate. A noise move gives one source, chosen
at random, a fresh stream: a Gibbs sampler over the sources by rejection. A candidate is accepted if its margin is above
the threshold; both moves are reversible with respect to the unconditional distribution.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...campaigns.draws.generators import standard_normals
from ...runtime.loop.elementary import elementary


@dataclass(frozen=True, eq=False)
class Points:
    """Samples: ``draws`` (points, dimensions), standard normal, and stream numbers ``streams`` (points, sources).

    Points with the same number in a column have the same noise of that source; noise with different numbers is
    independent.
    """

    draws: np.ndarray
    streams: np.ndarray

    def rows(self, rows: np.ndarray) -> Points:
        """Return some of the points, by index or mask."""
        return Points(self.draws[rows], self.streams[rows])

    def __len__(self) -> int:
        return len(self.draws)


MarginOf = Callable[[Points], np.ndarray]


class FreshStreams:
    """Generator of unused stream numbers, from 0 on: each is the noise of a trial not simulated before."""

    def __init__(self) -> None:
        self._next = 0

    def take(self, count: int) -> np.ndarray:
        """Return the next ``count`` numbers."""
        self._next += count
        return np.arange(self._next - count, self._next)


ACCEPTED = 0.44  # target acceptance rate of draws (ibid., section 4.3)
GROUPS = 10  # groups of chains, between which moves are adapted (ibid.: a tenth of the chains)
FIRST_SPREAD = 0.6
INERT_AFTER = 10  # number of fresh streams of a source that change no margin


@dataclass(frozen=True, eq=False)
class Chains:
    """Markov chains: points as ``draws`` (chains, length, dimensions) and ``streams`` (chains, length, sources).

    The first point of each chain is its seed; ``margins`` has the shape (chains, length). ``draw_acceptance`` is the
    share of accepted draw moves, None without such moves. ``noise_moves`` and ``noise_accepted`` (sources,) count the
    moves of each source and the accepted ones; ``spread`` is the final spread of draw moves.
    """

    draws: np.ndarray
    streams: np.ndarray
    margins: np.ndarray
    draw_acceptance: float | None
    noise_moves: np.ndarray
    noise_accepted: np.ndarray
    spread: float


class _NoiseMoves:
    """Choice of the streams to renew: one source at a time, and inert sources along with every move.

    A source is chosen with a probability inversely proportional to its acceptance rate so far, so that all sources are
    renewed about equally often: the acceptance rate of all noise moves is then near the harmonic mean of the rates of
    the sources. A source is inert if `INERT_AFTER` fresh streams have not changed any bit of a margin since the level
    began: renewing it along with other moves is free, and keeps the chains valid.
    """

    def __init__(self, sources: int, fresh: FreshStreams, random: np.random.Generator) -> None:
        self.moves, self.accepted = np.zeros(sources, dtype=int), np.zeros(sources, dtype=int)
        self._changed = np.zeros(sources, dtype=bool)
        self._fresh, self._random = fresh, random
        self._active = np.arange(sources)
        self._weights = np.ones(sources)
        self._inert = np.arange(0)

    @property
    def any(self) -> bool:
        return bool(self._active.size)

    def adapt(self) -> None:
        """Mark the sources that have been inert so far; called between groups of chains."""
        inert = ~self._changed & (self.moves >= INERT_AFTER)
        self._active, self._inert = np.flatnonzero(~inert), np.flatnonzero(inert)
        self._weights = (self.moves[~inert] + 2.0) / (self.accepted[~inert] + 1.0)

    def choose(self, chains: np.ndarray, step: int, draws: float | None) -> np.ndarray:
        """Return the ``chains`` (by number) that renew noise in a step, instead of moving draws.

        Both moves alternate, unless all draws are renewed together, with the acceptance rate ``draws``: then draws are
        chosen as often as a source with this rate, but at most half of the time.
        """
        if draws is None:
            return (step + chains) % 2 == 1
        noise = float(self._weights.sum())
        return self._random.random(chains.size) < max(0.5, noise / (noise + 1.0 / max(draws, 0.01)))

    def candidates(self, streams: np.ndarray, noise: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the streams of the next candidates, one source renewed where ``noise``, and its index (moves,)."""
        rows = np.flatnonzero(noise)
        chosen = (
            self._random.choice(self._active, rows.size, p=self._weights / self._weights.sum()) if rows.size else rows
        )
        renewed = streams.copy()
        renewed[rows, chosen] = self._fresh.take(rows.size)
        for source in self._inert:
            renewed[:, source] = self._fresh.take(len(renewed))
        return renewed, chosen

    def count(self, chosen: np.ndarray, accepted: np.ndarray, changed: np.ndarray) -> None:
        """Record which moves of the sources ``chosen`` were accepted, and which changed the margin."""
        np.add.at(self.moves, chosen, 1)
        np.add.at(self.accepted, chosen[accepted], 1)
        self._changed[chosen[changed]] = True


def grow_chains(
    margin: MarginOf,
    seeds: Points,
    margins: np.ndarray,
    threshold: float,
    length: int,
    spread: float,
    fresh: FreshStreams,
    random: tuple[np.random.Generator, np.random.Generator],
) -> Chains:
    """Grow chains of ``length`` points from ``seeds``, whose ``margins`` (chains,) reach ``threshold``.

    ``margin`` maps points to margins (points,). Chains depend on each other only through the moves, which are adapted
    from one group of chains to the next (ibid., equations 25 to 27). ``random`` contains the generators for draw moves
    and for noise moves. Without sources all moves are draw moves; without dimensions all are noise moves.
    """
    chains, dimensions = seeds.draws.shape
    draws = np.empty((chains, length, dimensions))
    streams = np.empty((chains, length, seeds.streams.shape[1]), dtype=np.int64)
    values = np.empty((chains, length))
    noise_moves = _NoiseMoves(streams.shape[2], fresh, random[1])
    rates: list[float] = []
    for number, group in enumerate(np.array_split(np.arange(chains), min(GROUPS, chains))):
        here, level = seeds.rows(group), margins[group]
        draws[group, 0], streams[group, 0], values[group, 0] = here.draws, here.streams, level
        steps = []
        for step in range(1, length):
            noise = np.zeros(len(group), dtype=bool)
            if noise_moves.any:
                whole = rates[-1] if rates and spread == 1.0 else None
                noise = noise_moves.choose(group, step, whole) if dimensions else ~noise
            moved = np.sqrt(1.0 - spread**2) * here.draws + spread * standard_normals(random[0], here.draws.shape)
            renewed, chosen = noise_moves.candidates(here.streams, noise)
            candidates = Points(np.where(noise[:, np.newaxis], here.draws, moved), renewed)
            proposed = margin(candidates)
            good = proposed >= threshold
            noise_moves.count(chosen, good[noise], proposed[noise] != level[noise])
            if not noise.all():
                steps.append(float(good[~noise].mean()))
            retained = good[:, np.newaxis]
            here = Points(np.where(retained, candidates.draws, here.draws), np.where(retained, renewed, here.streams))
            level = np.where(good, proposed, level)
            draws[group, step], streams[group, step], values[group, step] = here.draws, here.streams, level
        noise_moves.adapt()
        if steps:
            rates.append(float(np.mean(steps)))
            spread = min(1.0, float(spread * elementary("exp")((rates[-1] - ACCEPTED) / np.sqrt(number + 1.0))))
    acceptance = float(np.mean(rates)) if rates else None
    return Chains(draws, streams, values, acceptance, noise_moves.moves, noise_moves.accepted, spread)
