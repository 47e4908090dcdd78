"""Simulation of shards on a cluster, in tasks of some seconds that are repeated if workers are lost."""

from __future__ import annotations

import threading
import time
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import suppress
from typing import Any

from .....common.errors import InputError
from ....runtime.flight.interruptible import PATIENCE
from ...trials import TrialTable
from ..loaded_campaign import LoadedCampaign
from ..shard_flights import ShardAssembler
from . import work
from .sent import make_sent
from .tasks import RetryQueue, Task, TaskSplitter, WorkersDiedError

WAITING = 2  # tasks for each thread: one running, one waiting
LOOK_UP = 1.0  # s, between checks of the workers
WITHOUT_WORKERS = 60.0  # s, time without workers before a campaign is aborted


class Cluster:
    """Workers of a scheduler to which a client of distributed is connected; a call simulates shards.

    A task whose worker died is reassigned as often as the scheduler permits, then submitted again in two halves. A
    campaign is aborted only if all remaining tasks are single trials whose workers die repeatedly.
    """

    def __init__(self, client: Any, address: str) -> None:
        self._client = client
        self._address = address

    def __call__(self, campaign: LoadedCampaign, shards: Sequence[int]) -> Generator[tuple[int, dict[str, TrialTable]]]:
        """Simulate shards of a campaign; yield each shard's number and trials by variant on completion, in any order.

        Raises WorkersDiedError, and exceptions from the preparation of a simulation in a worker.
        """
        from distributed.comm import CommClosedError

        if not shards:
            return
        client = self._client
        tasks = ShardTasks(client, campaign, shards)
        try:
            while tasks.submit(self._threads()):
                for future in self._finish(tasks.under_way):
                    yield from tasks.collect(future)
        except ImportError as error:
            problem = f"a worker cannot load perilune: {error}"
            raise InputError("`scheduler`", "", problem, "install this version in the worker's environment") from error
        except (CancelledError, OSError) as error:
            if client.status == "running" and not isinstance(error, (CancelledError, CommClosedError)):
                raise  # for instance because a worker's disk is full
            raise WorkersDiedError(f"the scheduler {self._address} no longer answers") from error
        finally:
            if tasks.under_way:
                self._end(list(tasks.under_way), tasks.key)

    def _threads(self) -> int:
        """Return the number of simulations that the current workers can run in parallel."""
        return sum(self._client.nthreads().values())

    def _finish(self, under_way: dict[Any, Any]) -> Iterator[Any]:
        """Return an iterator over finished futures, at least one. Raises WorkersDiedError if no worker is left."""
        from distributed import wait

        last_time = time.monotonic()
        while True:
            with suppress(TimeoutError), self._client.as_current():
                done = wait(list(under_way), timeout=LOOK_UP, return_when="FIRST_COMPLETED").done
                return iter(done)
            if self._threads():
                last_time = time.monotonic()
            elif time.monotonic() - last_time > WITHOUT_WORKERS:
                raise WorkersDiedError(f"the scheduler {self._address} had no worker for {WITHOUT_WORKERS:g} s")

    def _end(self, futures: list[Any], key: str) -> None:
        """Cancel tasks, and end running simulations at their next communication points."""
        with suppress(Exception):  # the cluster may have ended
            self._client.cancel(futures, force=True)
        halting = threading.Thread(target=self._halt, args=(key,), daemon=True)  # a worker that hangs does not answer
        halting.start()
        halting.join(PATIENCE)

    def _halt(self, key: str) -> None:
        with suppress(Exception):
            self._client.run(work.halt, key, on_error="ignore")


class ShardTasks:
    """Tasks for some shards of a campaign: submitted tasks ``under_way`` by future, pending tasks, completed trials."""

    def __init__(self, client: Any, campaign: LoadedCampaign, shards: Sequence[int]) -> None:
        variants = [variant.name for variant in campaign.plan.campaign.variants()]
        self.under_way: dict[Any, Task] = {}
        self._client = client
        self._parts = ShardAssembler(campaign.numbering, variants)
        self._portions = TaskSplitter(campaign.numbering, shards, variants)
        self._repeated = RetryQueue()
        self._sent = make_sent(campaign)
        self.key = self._sent.key
        self._send()

    def _send(self) -> None:
        """Send the campaign to the cluster, which loses it when the last worker with the campaign is lost."""
        self._campaign = self._client.submit(_itself, self._sent, pure=False)

    def submit(self, threads: int) -> bool:
        """Submit enough tasks for this number of threads; return True if any task is running or queued."""
        for _ in range(WAITING * max(threads, 1) - len(self.under_way)):
            task = tuple(self._portions.next(max(threads, 1))) or self._repeated.next()
            if task:
                self.under_way[self._client.submit(work.fly, self._campaign, task, pure=False)] = task
        return bool(self.under_way)

    def collect(self, future: Any) -> Iterator[tuple[int, dict[str, TrialTable]]]:
        """Yield the shards completed by a finished task. Raises WorkersDiedError."""
        from distributed import KilledWorker

        task = self.under_way.pop(future)
        try:
            shard_trials = future.result()
        except KilledWorker as error:
            self._repeat(task, error)
            return
        for piece, (trials, seconds) in zip(task, shard_trials, strict=True):
            self._portions.record_duration(piece, seconds)
            whole = self._parts.add(piece.shard, piece.variant, trials)
            if whole is not None:
                yield piece.shard, whole

    def _repeat(self, task: Task, error: Any) -> None:
        """Repeat a task whose workers died. Raises WorkersDiedError if only trials that kill workers are left."""
        if error.task == self._campaign.key:
            self._send()
        self._repeated.add(task)
        left = [] if self._portions.trials else self._repeated.single_trials_left(self.under_way.values())
        if left:
            raise WorkersDiedError(_describe_worker_deaths(left)) from error


def _itself(sent: Any) -> Any:
    return sent


def _describe_worker_deaths(tasks: Sequence[Task]) -> str:
    """Return a description of tasks, each of a single trial, whose workers die repeatedly."""
    names = [f"trial {task[0].trials[0]} of {task[0].variant}" for task in tasks]
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return f"workers ended repeatedly during {names[0]}{more}"
