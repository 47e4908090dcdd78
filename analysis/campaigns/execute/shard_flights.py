"""Simulation of shards: the trials of each shard are divided among workers and reassembled."""

from __future__ import annotations

import itertools
from collections.abc import Generator, Iterator, Sequence

from ..folder.numbering import Numbering
from ..trials import TrialTable, join_trials
from .flyer import Flyer
from .workers import FlyerPool

MOST_IN_THREAD, MOST_IN_PROCESS = (
    500,
    10,
)  # trials in a task: enough to justify sending it, few enough to distribute or lose
TASKS = 16  # least number of tasks for each worker, so that all workers end at about the same time


def fly_shards(
    numbering: Numbering, shards: Sequence[int], pool: FlyerPool, size: int
) -> Generator[tuple[int, dict[str, TrialTable]]]:
    """Simulate shards of the pool's plan, in tasks of ``size`` trials.

    Yields the number of each shard, and its trials by variant, on completion, in any order of shards.
    """
    variants = [variant.name for variant in pool.plan.campaign.variants()]
    owners: dict[int, tuple[int, str]] = {}  # shard and variant of submitted tasks

    def tasks() -> Iterator[tuple[str, range]]:
        places = itertools.count()
        for shard in shards:
            trials = numbering.of(shard)
            pieces = [trials[first : first + size] for first in range(0, len(trials), size)]
            for piece in pieces:
                for variant in variants:
                    owners[next(places)] = shard, variant
                    yield variant, piece

    parts = ShardAssembler(numbering, variants)
    for place, flown_trials in pool.work(Flyer.fly, tasks()):
        shard, variant = owners.pop(place)
        whole = parts.add(shard, variant, flown_trials)
        if whole is not None:
            yield shard, whole


def task_size(trials: int, workers: int, threads: bool) -> int:
    """Return the number of trials that a worker simulates in one task."""
    return max(1, min(MOST_IN_THREAD if threads else MOST_IN_PROCESS, trials // (TASKS * workers)))


class ShardAssembler:
    """Assembles shards from portions that arrive in any order, and returns a shard once all its trials are present."""

    def __init__(self, numbering: Numbering, variants: Sequence[str]) -> None:
        self._numbering = numbering
        self._variants = variants
        self._pieces: dict[int, dict[str, list[TrialTable]]] = {}

    def add(self, shard: int, variant: str, trials: TrialTable) -> dict[str, TrialTable] | None:
        """Add trials of a shard; return all of its trials by variant if the shard is complete, else None."""
        pieces = self._pieces.setdefault(shard, {name: [] for name in self._variants})
        pieces[variant].append(trials)
        flown = sum(len(piece) for parts in pieces.values() for piece in parts)
        if flown < len(self._numbering.of(shard)) * len(self._variants):
            return None
        return {name: join_trials(parts) for name, parts in self._pieces.pop(shard).items()}
