"""Parallel trials on this machine: a thread for each worker, and children for FMUs that cannot share a process."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor
from concurrent.futures import wait as wait_for
from functools import partial
from typing import TypeVar, get_args

from loky import cpu_count

from ....common.errors import InputError, suggestion
from ...options.choices import Engine
from ...runtime.flight.interruptible import PATIENCE, wait
from ...runtime.process.opening import may_load_here
from ...runtime.system.prepared import PreparedSystem
from ..definition.plan import BatchPlan
from .flyer import Flyer

Result = TypeVar("Result")
ENGINES: tuple[Engine, ...] = get_args(Engine)
WAITING = 4  # tasks submitted in advance for each worker


def in_threads(systems: Iterable[PreparedSystem], engine: str | None) -> bool:
    """Return True if trials run in threads, as requested or where possible. Raises InputError if this is impossible."""
    systems = list(systems)
    foreign = not all(map(may_load_here, systems))
    can = all(prepared.flies_in_threads for prepared in systems) and not foreign
    if engine is None:
        return can
    if engine not in ENGINES:
        raise InputError("`engine`", engine, "unknown", suggestion(engine, ENGINES))
    if engine == "threads" and foreign:
        problem = "FMUs not built by Perilune run in separate processes"
        raise InputError("`engine`", engine, problem, "use processes, or give `in_process` if you trust these FMUs")
    if engine == "threads" and not can:
        problem = "Python FMUs, and FMUs limited to one instance per process, cannot run in threads"
        raise InputError("`engine`", engine, problem, "use processes, or native FMUs")
    return engine == "threads"


def needs_children(workers: int, threads: bool, engine: str | None) -> bool:
    """Return True if trials that could run in this process must run in children of the flight server."""
    return engine == "processes" or (workers > 1 and not threads)


def worker_count(workers: int | None) -> int:
    """Return the number of parallel simulations: as requested, or one for each processor. Raises InputError."""
    count = workers if workers is not None else cpu_count()
    if count < 1:
        raise InputError("`workers`", str(count), "not a positive number", "give 1 or more")
    return count


class FlyerPool:
    """Workers, each with a `Flyer` of the same plan, while the pool is open.

    Each worker is a thread; a single worker uses the caller's thread. Perilune's native FMUs are simulated in these
    threads. Python FMUs hold the interpreter lock, and foreign FMUs are not trusted: unless ``threads`` are requested,
    they are simulated in children of the flight server if there are at least two workers, or if ``in_child``.
    ``trials`` is the number of each variant's trials, if known.
    """

    def __init__(
        self, plan: BatchPlan, workers: int, threads: bool, *, in_child: bool = False, trials: int | None = None
    ) -> None:
        self.plan = plan
        self._workers = workers
        self._trials = trials
        self._in_child = in_child or needs_children(workers, threads, None)
        self._flyers: list[Flyer] = []
        self._thread = threading.local()
        if workers == 1:
            self._start()
        self._executor = None if workers == 1 else ThreadPoolExecutor(workers, initializer=self._start)

    def _start(self) -> None:
        self._thread.flyer = Flyer(self.plan, in_child=self._in_child, trials=self._trials, workers=self._workers)
        self._flyers.append(self._thread.flyer)

    def work(self, function: Callable[..., Result], tasks: Iterable[tuple]) -> Iterator[tuple[int, Result]]:
        """Call ``function(flyer, *task)`` for every task; yield pairs (index of the task, result) in any order.

        Tasks that have not begun when the iterator is closed are dropped.
        """
        if self._executor is not None:
            yield from self._hand_out(self._executor, function, enumerate(tasks))
            return
        (flyer,) = self._flyers
        for index, task in enumerate(tasks):
            outcome = wait(partial(function, flyer, *task), flyer.interrupt, flyer.abort)
            if flyer.halted:
                raise KeyboardInterrupt
            yield index, outcome

    def _hand_out(
        self, executor: ThreadPoolExecutor, function: Callable[..., Result], tasks: Iterator[tuple[int, tuple]]
    ) -> Iterator[tuple[int, Result]]:
        """Yield the results of tasks, of which only a few are submitted at a time to limit memory."""
        futures: dict[Future, int] = {}
        try:
            while True:
                for place, task in itertools.islice(tasks, WAITING * self._workers - len(futures)):
                    futures[executor.submit(self._call, function, task)] = place
                if not futures:
                    return
                for future in wait_for(futures, return_when=FIRST_COMPLETED).done:
                    place, outcome = futures.pop(future), future.result()
                    yield place, outcome
        except KeyboardInterrupt:
            self._halt(list(futures))
            raise
        finally:
            for future in futures:
                future.cancel()

    def _call(self, function: Callable[..., Result], task: tuple) -> Result:
        return function(self._thread.flyer, *task)

    def _halt(self, futures: list[Future]) -> None:
        """End running simulations at their next communication points; kill children that do not reach one."""
        for future in futures:
            future.cancel()
        for flyer in self._flyers:
            flyer.interrupt()
        wait_for(futures, timeout=PATIENCE)
        for flyer in self._flyers:
            flyer.abort()

    def __enter__(self) -> FlyerPool:
        return self

    def __exit__(self, *_: object) -> None:
        if self._executor is not None:
            self._executor.shutdown()
        for flyer in self._flyers:
            flyer.close()
