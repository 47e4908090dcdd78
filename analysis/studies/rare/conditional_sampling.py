"""Samples of draws and noise on condition that a margin is above a threshold: chains from those that are known.

Two moves alternate (`_NoiseMoves.choose`). The draws move by adaptive conditional sampling (Papaioannou, Betz,
Zwirglmaier and Straub 2015, section 4.3): a candidate is rho u + sqrt(1 - rho^2) xi with xi standard normal, which
leaves the normal distribution as it is; its spread sqrt(1 - rho^2) follows the acceptance rate. The noise moves by a
fresh stream for one source, chosen at random: a Gibbs sampler over the sources by rejection. Either is accepted where
the candidate's margin is above the threshold, and is reversible with respect to the distribution before the condition.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...campaigns.draws.generators import standard_normals
from ...runtime.loop.elementary import elementary


@dataclass(frozen=True, eq=False)
class Points:
    """``draws`` (points, dimensions), standard normal, and ``streams`` (points, sources), a number each.

    Points with the same number in a column have the same noise of that source; other numbers are independent of it.
    """

    draws: np.ndarray
    streams: np.ndarray

    def rows(self, rows: np.ndarray) -> Points:
        """Return some of the points, by number or by mask."""
        return Points(self.draws[rows], self.streams[rows])

    def __len__(self) -> int:
        return len(self.draws)


MarginOf = Callable[[Points], np.ndarray]


class FreshStreams:
    """Unused numbers of streams, each returned once, from 0 on: the noise of trials not simulated before."""

    def __init__(self) -> None:
        self._next = 0

    def take(self, count: int) -> np.ndarray:
        """Return the next ``count`` numbers."""
        self._next += count
        return np.arange(self._next - count, self._next)


ACCEPTED = 0.44  # the acceptance rate of draws that is aimed at (ibid., section 4.3)
GROUPS = 10  # of chains, between which moves are adapted (ibid.: a tenth of the chains)
FIRST_SPREAD = 0.6
INERT_AFTER = 10  # fresh streams of a source, none of which changes a margin


@dataclass(frozen=True, eq=False)
class Chains:
    """Chains by time: points as ``draws`` (chains, length, dimensions) and ``streams`` (chains, length, sources).

    The first point of each is its seed; ``margins`` are (chains, length). ``draw_acceptance`` is the share of draw
    moves that were accepted, None where there were none. ``noise_moves`` and ``noise_accepted`` (sources,) count the
    moves of each source, ``spread`` is the last one.
    """

    draws: np.ndarray
    streams: np.ndarray
    margins: np.ndarray
    draw_acceptance: float | None
    noise_moves: np.ndarray
    noise_accepted: np.ndarray
    spread: float


class _NoiseMoves:
    """Choice of the streams to renew: one source at a time, those that change no margin along with every move.

    A source is chosen with a probability inverse to its acceptance rate so far, so that all are renewed about as often:
    the acceptance rate of all noise moves together is then near the harmonic mean of the sources'. A source is inert
    where `INERT_AFTER` fresh streams have not changed a bit of any margin since the level began: renewing it along with
    other moves costs none, and leaves chains as right as they are.
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
        """Leave out the sources that are inert so far; between groups of chains."""
        inert = ~self._changed & (self.moves >= INERT_AFTER)
        self._active, self._inert = np.flatnonzero(~inert), np.flatnonzero(inert)
        self._weights = (self.moves[~inert] + 2.0) / (self.accepted[~inert] + 1.0)

    def choose(self, chains: np.ndarray, step: int, draws: float | None) -> np.ndarray:
        """Return the ``chains`` (by number) that renew noise in a step, and do not move draws.

        They alternate, unless draws are renewed as a whole, with the acceptance rate ``draws``: then they are chosen as
        often as a source of that rate, if that is less often.
        """
        if draws is None:
            return (step + chains) % 2 == 1
        noise = float(self._weights.sum())
        return self._random.random(chains.size) < max(0.5, noise / (noise + 1.0 / max(draws, 0.01)))

    def candidates(self, streams: np.ndarray, noise: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return streams of the next candidates, where ``noise`` moves with one source renewed,
        and the moved ones (moves,)."""
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
        """Record moves of the sources ``chosen``: which were accepted, which changed the margin."""
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

    ``margin`` maps points to margins (points,); chains are independent of each other but for the moves, which change
    from one group of them to the next (ibid., equations 25 to 27). ``random`` are the generators of draw moves and of
    noise moves. Where there are no sources, all moves are draw moves, and the other way round.
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
