"""Tasks for a cluster, each with trials for some seconds; tasks abandoned by a scheduler are split."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ...folder.numbering import Numbering

MOST_DEATHS = 3  # deaths of workers with a single trial before the trial counts as the cause
FIRST = 4  # trials in a task while their duration is unknown
LONGEST, SHORTEST = 3.0, 0.5  # s of a task: little is lost with a worker, and sending a task costs only 10 ms
QUICKEST = 1e-6  # s, least measurable duration of a trial
ROUNDS = 2  # least number of remaining tasks for each thread, so that all threads end at about the same time


class WorkersDiedError(RuntimeError):
    """Repeated loss of workers before they complete any work, or loss of all workers."""


@dataclass(frozen=True)
class TrialSpan:
    """Trials of one variant within one shard."""

    shard: int
    variant: str
    trials: range


class TaskSplitter:
    """Splitter of shards into tasks sized by measured duration; ``trials`` is the number of remaining trials."""

    def __init__(self, numbering: Numbering, shards: Sequence[int], variants: Sequence[str]) -> None:
        self._left = deque(TrialSpan(shard, variant, numbering.of(shard)) for shard in shards for variant in variants)
        self.trials = sum(len(piece.trials) for piece in self._left)
        self._seconds: dict[str, float] = {}  # duration of a trial, by variant

    def record_duration(self, piece: TrialSpan, seconds: float) -> None:
        self._seconds[piece.variant] = seconds / len(piece.trials)

    def next(self, threads: int) -> list[TrialSpan]:
        """Return the next task for ``threads`` threads; an empty task if no trials are left."""
        slowest = max(self._seconds.values(), default=0.0)
        budget = min(LONGEST, max(SHORTEST, self.trials * slowest / (ROUNDS * threads)))
        pieces: list[TrialSpan] = []
        while self._left:
            first = self._left[0]
            seconds = self._seconds.get(first.variant)
            count = FIRST if seconds is None else int(budget / max(seconds, QUICKEST))
            if pieces and (seconds is None or not count):
                break
            piece = TrialSpan(first.shard, first.variant, first.trials[: max(count, 1)])
            pieces.append(piece)
            self._left.popleft()
            if len(piece.trials) < len(first.trials):
                self._left.appendleft(TrialSpan(first.shard, first.variant, first.trials[len(piece.trials) :]))
            if seconds is None:
                break
            budget -= seconds * len(piece.trials)
        self.trials -= sum(len(piece.trials) for piece in pieces)
        return pieces


def halve(pieces: Sequence[TrialSpan]) -> list[tuple[TrialSpan, ...]]:
    """Return a task's trials as two tasks, or as one task if there is only one trial."""
    first = sum(len(piece.trials) for piece in pieces) // 2
    parts: tuple[list[TrialSpan], list[TrialSpan]] = ([], [])
    for piece in pieces:
        for half, trials in zip(parts, (piece.trials[:first], piece.trials[first:]), strict=True):
            if trials:
                half.append(TrialSpan(piece.shard, piece.variant, trials))
        first = max(0, first - len(piece.trials))
    return [tuple(half) for half in parts if half]


OWN = MOST_DEATHS - 1  # largest count of failures before a trial has been a separate task
Task = tuple[TrialSpan, ...]


class RetryQueue:
    """Queue of abandoned tasks, split in half each time to isolate trials that kill workers."""

    def __init__(self) -> None:
        self._waiting: deque[Task] = deque()
        self._times: dict[Task, int] = {}

    def add(self, task: Task) -> None:
        """Add an abandoned task in two halves."""
        times = self._times.pop(task, 0) + 1
        parts = halve(task)
        self._waiting += parts
        self._times |= dict.fromkeys(parts, times if len(parts) == 1 else min(times, OWN))

    def next(self) -> Task:
        """Remove and return the task that has waited longest; an empty task if there is none."""
        return self._waiting.popleft() if self._waiting else ()

    def single_trials_left(self, under_way: Iterable[Task]) -> list[Task]:
        """Return all remaining tasks if each is a single trial that was abandoned often enough; else an empty list."""
        left = [*self._waiting, *under_way]
        worn = all(len(halve(task)) == 1 and self._times.get(task, 0) >= MOST_DEATHS for task in left)
        return left if worn else []
