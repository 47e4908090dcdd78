"""Tasks that a scheduler has given up, as one worker after the other died with them: flown again, in smaller parts."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from ..workers.workers import MOST_DEATHS
from .task_size import Piece, halves

OWN = MOST_DEATHS - 1  # how often a part counts as given up at most before it has been by itself
Task = tuple[Piece, ...]


class Again:
    """Parts of tasks that were given up; halved each time, so that what ends workers takes no others with it."""

    def __init__(self) -> None:
        self._waiting: deque[Task] = deque()
        self._times: dict[Task, int] = {}

    def add(self, task: Task) -> None:
        """A task that was given up."""
        times = self._times.pop(task, 0) + 1
        parts = halves(task)
        self._waiting += parts
        self._times |= dict.fromkeys(parts, times if len(parts) == 1 else min(times, OWN))

    def next(self) -> Task:
        """What has waited longest; empty where nothing does."""
        return self._waiting.popleft() if self._waiting else ()

    def hopeless(self, under_way: Iterable[Task]) -> list[Task]:
        """All that is left, if these are single trials that were given up often enough; else nothing."""
        left = [*self._waiting, *under_way]
        worn = all(len(halves(task)) == 1 and self._times.get(task, 0) >= MOST_DEATHS for task in left)
        return left if worn else []
