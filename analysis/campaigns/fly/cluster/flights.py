"""Flies shards on a cluster: tasks of some seconds, flown again wherever workers are lost."""

from __future__ import annotations

import threading
import time
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import suppress
from typing import Any

from .....common.errors import InputError
from ....runtime.flight.interruptible import PATIENCE
from ...trials import Trials
from ..campaign import Campaign
from ..shards.flights import Parts
from . import work
from .sent import make_sent
from .tasks import Again, Portions, Task, WorkersDiedError

WAITING = 2  # tasks for each thread: one flies, one is there when it is done
LOOK_UP = 1.0  # s, between looks at which workers are there
WITHOUT_WORKERS = 60.0  # s that a campaign waits for workers to come back


class Cluster:
    """The workers of a scheduler that a client of distributed is connected to; called, it flies shards.

    A task whose worker dies goes to another one, as often as the scheduler lets it, and is then given to it anew, in
    two parts: a campaign ends only where all that is left are single trials that end one worker after the other.
    """

    def __init__(self, client: Any, address: str) -> None:
        self._client = client
        self._address = address

    def __call__(self, campaign: Campaign, shards: Sequence[int]) -> Generator[tuple[int, dict[str, Trials]]]:
        """Fly shards of a campaign: each one's trials by variant, as soon as all are there, in any order of shards.

        Raises WorkersDiedError, and what ends a flight's preparation in a worker.
        """
        from distributed import KilledWorker
        from distributed.comm import CommClosedError

        if not shards:
            return
        client = self._client
        variants = [variant.name for variant in campaign.plan.campaign.variants()]
        parts = Parts(campaign.numbering, variants)
        portions = Portions(campaign.numbering, shards, variants)
        repeated = Again()
        sent = make_sent(campaign)
        here = client.submit(_itself, sent, pure=False)  # the workers pass it on, and make it again where all lose it
        under_way: dict[Any, Task] = {}
        try:
            while True:
                threads = self._threads()
                for _ in range(WAITING * max(threads, 1) - len(under_way)):
                    task = tuple(portions.next(max(threads, 1))) or repeated.next()
                    if task:
                        under_way[client.submit(work.fly, here, task, pure=False)] = task
                if not under_way:
                    return
                for future in self._finish(under_way):
                    task = under_way.pop(future)
                    try:
                        shard_trials = future.result()
                    except KilledWorker as error:
                        if error.task == here.key:
                            here = client.submit(_itself, sent, pure=False)
                        repeated.add(task)
                        left = [] if portions.trials else repeated.hopeless(under_way.values())
                        if left:
                            raise WorkersDiedError(_what_ends_them(left)) from error
                        continue
                    for piece, (trials, seconds) in zip(task, shard_trials, strict=True):
                        portions.record_duration(piece, seconds)
                        whole = parts.add(piece.shard, piece.variant, trials)
                        if whole is not None:
                            yield piece.shard, whole
        except ImportError as error:
            problem = f"a worker cannot load perilune: {error}"
            raise InputError("`scheduler`", "", problem, "install the same in its environment") from error
        except (CancelledError, OSError) as error:
            if client.status == "running" and not isinstance(error, (CancelledError, CommClosedError)):
                raise  # a worker's disk is full, say
            raise WorkersDiedError(f"the scheduler {self._address} is gone") from error
        finally:
            if under_way:
                self._end(list(under_way), sent.key)

    def _threads(self) -> int:
        """How many flights the workers that are there can fly at once."""
        return sum(self._client.nthreads().values())

    def _finish(self, under_way: dict[Any, Any]) -> Iterator[Any]:
        """Those of some futures that are done, one at least. Raises WorkersDiedError where no worker is left."""
        from distributed import wait

        seen = time.monotonic()
        while True:
            with suppress(TimeoutError), self._client.as_current():
                done = wait(list(under_way), timeout=LOOK_UP, return_when="FIRST_COMPLETED").done
                return iter(done)
            if self._threads():
                seen = time.monotonic()
            elif time.monotonic() - seen > WITHOUT_WORKERS:
                raise WorkersDiedError(f"the scheduler {self._address} had no worker for {WITHOUT_WORKERS:g} s")

    def _end(self, futures: list[Any], key: str) -> None:
        """Take tasks back, and end those that fly at their next communication points."""
        with suppress(Exception):  # the cluster may be what has ended
            self._client.cancel(futures, force=True)
        halting = threading.Thread(target=self._halt, args=(key,), daemon=True)  # a worker that hangs does not answer
        halting.start()
        halting.join(PATIENCE)

    def _halt(self, key: str) -> None:
        with suppress(Exception):
            self._client.run(work.halt, key, on_error="ignore")


def _itself(sent: Any) -> Any:
    return sent


def _what_ends_them(tasks: Sequence[Task]) -> str:
    """In words, of tasks of one trial each."""
    names = [f"trial {task[0].trials[0]} of {task[0].variant}" for task in tasks]
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return f"workers end again and again with {names[0]}{more}"
