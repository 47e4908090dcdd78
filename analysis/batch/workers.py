"""Many trials on this machine: processes for Python FMUs, threads for native ones."""

from __future__ import annotations

import atexit
import gc
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor, as_completed
from concurrent.futures import wait as wait_for
from functools import partial
from typing import Any, TypeVar

from loky import ProcessPoolExecutor, cpu_count

from ..campaign.plan import BatchPlan
from ..errors import InputError, warn_in_one_line
from ..flight.interruptible import PATIENCE, wait
from ..process_end import leave
from .flyer import Flyer
from .trials import Trials

Task = tuple[str, range]
Result = TypeVar("Result")
_local = threading.local()
_flyers: list[Flyer] = []  # of this process's threads


def worker_count(workers: int | None) -> int:
    """The number of parallel flights: as asked for, or one per processor. Raises InputError."""
    count = workers if workers is not None else cpu_count()
    if count < 1:
        raise InputError("--workers", str(count), "not a positive number", "give 1 or more")
    return count


def tasks_of(plan: BatchPlan, workers: int, native: bool) -> list[Task]:
    """Trials in pieces large enough to send and small enough to share out, or to lose where a process is stopped."""
    trials = plan.campaign.trials
    size = max(1, min(50 if native else 10, trials // (4 * workers)))
    pieces = [range(first, min(first + size, trials)) for first in range(0, trials, size)]
    return [(variant.name, piece) for piece in pieces for variant in plan.campaign.variants()]


class FlyerPool:
    """Workers that each hold a `Flyer` of one plan, for as long as the pool is open.

    Python FMUs hold the interpreter lock, so they get a process per worker; native ones
    release it and get threads. With one worker everything happens in the caller's thread.
    """

    def __init__(self, plan: BatchPlan, workers: int, native: bool) -> None:
        self.plan = plan
        self._flyer = Flyer(plan) if workers == 1 else None
        self._executor: Executor | None = None
        if workers > 1 and native:
            self._executor = ThreadPoolExecutor(workers, initializer=_start, initargs=(plan,))
        elif workers > 1:
            self._executor = ProcessPoolExecutor(workers, initializer=_start_process, initargs=(plan,))

    def work(self, function: Callable[..., Result], tasks: Sequence[tuple]) -> Iterator[tuple[int, Result]]:
        """Call ``function(flyer, *task)`` for every task: (place of the task, result), in any order.

        The function is defined at the top of a module; tasks and results can be pickled. What has not
        begun when the iterator is closed is not done any more.
        """
        if self._executor is None:
            assert self._flyer is not None
            for place, task in enumerate(tasks):
                yield place, wait(partial(function, self._flyer, *task), self._flyer.interrupt)
                if self._flyer.halted:
                    raise KeyboardInterrupt
            return
        futures: dict[Future, int] = {
            self._executor.submit(_call, function, task): place for place, task in enumerate(tasks)
        }
        try:
            for future in as_completed(futures):
                yield futures.pop(future), future.result()
        except KeyboardInterrupt:
            yield from self._interrupted(futures)
            raise
        finally:
            for future in futures:
                future.cancel()

    def _interrupted(self, futures: dict[Future, int]) -> Iterator[tuple[int, Any]]:
        """What is done when Ctrl-C comes, and what threads have flown of the rest; processes are stopped."""
        for future in futures:
            future.cancel()
        for flyer in _flyers:
            if flyer.plan is self.plan:
                flyer.interrupt()
        if isinstance(self._executor, ProcessPoolExecutor):
            done = [future for future in futures if future.done() and not future.cancelled()]
            self._executor.shutdown(wait=False, kill_workers=True)
        else:
            done = [future for future in wait_for(list(futures), timeout=PATIENCE).done if not future.cancelled()]
        for future in done:
            if future.exception() is None:
                yield futures[future], future.result()

    def __enter__(self) -> FlyerPool:
        return self

    def __exit__(self, *_: object) -> None:
        if self._executor is not None:
            self._executor.shutdown()
        if self._flyer is not None:
            self._flyer.close()
        _close_threads(self.plan)


def fly_all(plan: BatchPlan, tasks: list[Task], workers: int, native: bool) -> Iterator[tuple[str, Trials]]:
    """Fly every task, yielding results as they come, in any order."""
    with FlyerPool(plan, workers, native) as pool:
        for place, found in pool.work(Flyer.fly, tasks):
            if found is not None:
                yield tasks[place][0], found


def _start(plan: BatchPlan) -> None:
    _local.flyer = Flyer(plan)
    _flyers.append(_local.flyer)


def _close_threads(plan: BatchPlan) -> None:
    """Free what the threads of a batch have instantiated; processes free their own."""
    for flyer in [flyer for flyer in _flyers if flyer.plan is plan]:
        flyer.close()
        _flyers.remove(flyer)


def _start_process(plan: BatchPlan) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal sends it to all; the parent decides
    atexit.register(_leave)
    warn_in_one_line()
    _start(plan)


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
