"""Many trials on this machine: processes for Python FMUs, threads for native ones."""

from __future__ import annotations

import atexit
import gc
import itertools
import os
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor
from concurrent.futures import wait as wait_for
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

from loky import ProcessPoolExecutor, cpu_count
from loky.process_executor import TerminatedWorkerError

from ...common.errors import InputError, suggestion, warn_in_one_line
from ...common.process import leave
from ...runtime.flight.interruptible import PATIENCE, wait
from ...runtime.system.prepared import PreparedSystem
from ..spec.plan import BatchPlan
from .crash_report import LastWords, hung_trials
from .flyer import Flyer

Result = TypeVar("Result")
ENGINES = ("threads", "processes")
WAITING = 4  # tasks that are handed out ahead, for each worker
LOOK_UP = 1.0  # s, between looks at whether the process that is worked for is there
MOST_DEATHS = 3  # of workers in a row, without a task done
_local = threading.local()
_flyers: list[Flyer] = []  # of this process's threads


class WorkersDiedError(RuntimeError):
    """Workers end one after the other, before they have done anything, or none is left."""


def in_threads(systems: Iterable[PreparedSystem], engine: str | None) -> bool:
    """Whether trials fly in threads: as asked, or wherever they can. Raises InputError where they cannot."""
    can = all(prepared.flies_in_threads for prepared in systems)
    if engine is None:
        return can
    if engine not in ENGINES:
        raise InputError("`engine`", engine, "unknown", suggestion(engine, ENGINES))
    if engine == "threads" and not can:
        problem = "Python FMUs, and those of which a process can hold one instance, do not fly in threads"
        raise InputError("`engine`", engine, problem, "use processes, or native FMUs")
    return engine == "threads"


def worker_count(workers: int | None) -> int:
    """The number of parallel flights: as asked for, or one per processor. Raises InputError."""
    count = workers if workers is not None else cpu_count()
    if count < 1:
        raise InputError("`workers`", str(count), "not a positive number", "give 1 or more")
    return count


class FlyerPool:
    """Workers that each hold a `Flyer` of one plan, for as long as the pool is open.

    Python FMUs hold the interpreter lock, so they get a process per worker; native ones (``threads``)
    release it and get threads. With one worker everything happens in the caller's thread, unless it is to be a process.
    """

    def __init__(self, plan: BatchPlan, workers: int, threads: bool, *, apart: bool = False) -> None:
        self.plan = plan
        self._workers = workers
        here = workers == 1 and not apart
        self._flyer = Flyer(plan) if here else None
        self._executor: Executor | None = None
        self._make: Callable[[], Executor] | None = None
        self._words: TemporaryDirectory | None = None  # of processes that end themselves
        if not here:
            if threads:
                self._make = partial(ThreadPoolExecutor, workers, initializer=_start, initargs=(plan,))
            else:
                self._words = TemporaryDirectory(prefix="perilune_") if plan.watch.timeout is not None else None
                words = None if self._words is None else Path(self._words.name)
                self._make = partial(ProcessPoolExecutor, workers, initializer=_start_process, initargs=(plan, words))
            self._executor = self._make()

    def work(self, function: Callable[..., Result], tasks: Iterable[tuple]) -> Iterator[tuple[int, Result]]:
        """Call ``function(flyer, *task)`` for every task: (place of the task, result), in any order.

        The function is defined at the top of a module; tasks and results can be pickled. What has not
        begun when the iterator is closed is not done any more. The tasks of a worker process that is killed, or that
        ends itself for a trial that hangs, are done again, without that trial. Raises `WorkersDiedError`.
        """
        if self._executor is None:
            assert self._flyer is not None
            for index, task in enumerate(tasks):
                outcome = wait(partial(function, self._flyer, *task), self._flyer.interrupt)
                if self._flyer.halted:
                    raise KeyboardInterrupt
                yield index, outcome
            return
        fresh = enumerate(tasks)
        held: dict[int, tuple] = {}  # handed out, and not done
        deaths = known = 0
        while True:
            try:
                for done in self._hand_out(function, held, fresh):
                    deaths = 0
                    yield done
                return
            except TerminatedWorkerError as error:
                hung = 0 if self._words is None else len(hung_trials(Path(self._words.name)))
                deaths = deaths + 1 if hung == known else 0
                known = hung
                if deaths == MOST_DEATHS:
                    how = " ".join(str(error).split())  # which loky says in several lines
                    raise WorkersDiedError(f"worker processes end again and again: {how}") from error
                assert self._make is not None
                self._executor = self._make()

    def _hand_out(
        self, function: Callable[..., Result], held: dict[int, tuple], fresh: Iterator[tuple[int, tuple]]
    ) -> Iterator[tuple[int, Result]]:
        """The results of tasks, those that are held and then fresh ones; so few at a time that all cost no memory."""
        assert self._executor is not None
        waiting = itertools.chain(list(held.items()), fresh)
        futures: dict[Future, int] = {}
        try:
            while True:
                for place, task in itertools.islice(waiting, WAITING * self._workers - len(futures)):
                    held[place] = task
                    futures[self._executor.submit(_call, function, task)] = place
                if not futures:
                    return
                done = wait_for(futures, return_when=FIRST_COMPLETED).done
                for future in sorted(done, key=_is_broken):  # what was done before a worker died is not done again
                    place, outcome = futures.pop(future), future.result()
                    del held[place]
                    yield place, outcome
        except KeyboardInterrupt:
            self._halt(list(futures))
            raise
        finally:
            for future in futures:
                future.cancel()

    def _halt(self, futures: list[Future]) -> None:
        """End what flies: threads at their next communication point, processes at once."""
        for future in futures:
            future.cancel()
        for flyer in _flyers:
            if flyer.plan is self.plan:
                flyer.interrupt()
        if isinstance(self._executor, ProcessPoolExecutor):
            self._executor.shutdown(wait=False, kill_workers=True)
        else:
            wait_for(futures, timeout=PATIENCE)

    def __enter__(self) -> FlyerPool:
        return self

    def __exit__(self, *_: object) -> None:
        if self._executor is not None:
            self._executor.shutdown()
        if self._flyer is not None:
            self._flyer.close()
        for flyer in [each for each in _flyers if each.plan is self.plan]:  # processes free their own instances
            flyer.close()
            _flyers.remove(flyer)
        if self._words is not None:
            self._words.cleanup()


def _is_broken(future: Future) -> bool:
    return isinstance(future.exception(), TerminatedWorkerError)


def _start(plan: BatchPlan, words: LastWords | None = None) -> None:
    _local.flyer = Flyer(plan, words)
    _flyers.append(_local.flyer)


def _start_process(plan: BatchPlan, words: Path | None) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal sends it to all; the parent decides
    atexit.register(_leave)
    warn_in_one_line()
    threading.Thread(target=_leave_with, args=(os.getppid(),), daemon=True).start()
    timeout = plan.watch.timeout
    _start(plan, None if words is None or timeout is None else LastWords(words, timeout))


def _leave_with(parent: int) -> None:
    """End this process where the one that it works for is killed, since no one else would."""
    while os.getppid() == parent:
        time.sleep(LOOK_UP)
    leave(1)


def _leave() -> None:
    """Remove the unpacked FMUs, then leave."""
    try:
        _local.flyer.close()
        del _local.flyer
        gc.collect()
    finally:
        leave(0)


def _call(function: Callable[..., Result], task: tuple) -> Result:
    return function(_local.flyer, *task)
