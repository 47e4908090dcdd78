"""Many trials on this machine: processes for Python FMUs, threads for native ones."""

from __future__ import annotations

import atexit
import contextlib
import gc
import os
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor, as_completed
from typing import Any

from loky import ProcessPoolExecutor

from .flyer import Flyer
from .plan import BatchPlan
from .trials import Trials

Task = tuple[str, range]
_local = threading.local()
_flyers: list[Flyer] = []  # of this process's threads


def tasks_of(plan: BatchPlan, workers: int) -> list[Task]:
    """Trials in pieces large enough to send and small enough to share out, variants in turn."""
    trials = plan.campaign.trials
    size = max(1, min(250, trials // (4 * workers)))
    pieces = [range(first, min(first + size, trials)) for first in range(0, trials, size)]
    return [(variant.name, piece) for piece in pieces for variant in plan.campaign.variants()]


def fly_all(plan: BatchPlan, tasks: list[Task], workers: int, native: bool) -> Iterator[tuple[str, Trials]]:
    """Fly every task, yielding results as they come, in any order.

    Python FMUs hold the interpreter lock, so they get a process per worker; native ones
    release it and get threads. With one worker everything happens here.
    """
    if workers == 1:
        flyer = Flyer(plan)
        try:
            for variant, trials in tasks:
                yield variant, flyer.fly(variant, trials)
        finally:
            flyer.close()
        return
    executor: Executor
    if native:
        executor = ThreadPoolExecutor(workers, initializer=_start, initargs=(plan,))
    else:
        executor = ProcessPoolExecutor(workers, initializer=_start_process, initargs=(plan,))
    with contextlib.ExitStack() as ending, executor:
        ending.callback(_close_threads, plan)
        futures: dict[Future, str] = {executor.submit(_fly, *task): task[0] for task in tasks}
        for future in as_completed(futures):
            yield futures.pop(future), future.result()


def _start(plan: BatchPlan) -> None:
    _local.flyer = Flyer(plan)
    _flyers.append(_local.flyer)


def _close_threads(plan: BatchPlan) -> None:
    """Free what the threads of a batch have instantiated; processes free their own."""
    for flyer in [flyer for flyer in _flyers if flyer.plan is plan]:
        flyer.close()
        _flyers.remove(flyer)


def _start_process(plan: BatchPlan) -> None:
    atexit.register(_leave)
    _start(plan)


def _leave() -> None:
    """Remove the unpacked FMUs, then leave: pythonfmu's library can crash in its destructors afterwards."""
    try:
        _local.flyer.close()
        del _local.flyer
        gc.collect()
    finally:
        os._exit(0)


def _fly(variant: str, trials: range) -> Trials:
    flyer: Any = _local.flyer
    return flyer.fly(variant, trials)
