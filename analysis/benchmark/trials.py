"""Whole flights of a campaign per second, as `perilune batch` flies them."""

from __future__ import annotations

import time
from pathlib import Path

from ..campaigns.fly.runner import run_batch
from ..campaigns.spec.plan import read_plan
from ..runtime.system.options import SystemOptions
from .worker import Worker

CAMPAIGN = "paper"
WORKERS = (1, 2)
SECONDS = 4.0  # about how long a batch flies
ROUNDS = 3
LEAST = 20  # trials beyond the warm-up, however long they take


def trials_per_second(ssp: Path, flight: float, rounds: int = ROUNDS) -> dict[str, float]:
    """Trials of the campaign per second by number of workers; ``flight`` is about how long one takes (s).

    A short batch and a long one are timed, each ``rounds`` times: the difference of the fastest ones
    leaves out the start of the workers. Raises `Unavailable` and `WorkerError`.
    """
    sizes = {workers: (4 * workers, 4 * workers + max(LEAST, round(workers * SECONDS / flight))) for workers in WORKERS}
    best: dict[tuple[int, int], float] = {}
    with Worker("batch", ssp) as worker:
        for _ in range(rounds):
            for workers, lengths in sizes.items():
                for trials in lengths:
                    seconds = worker.ask(trials=trials, workers=workers)["seconds"]
                    best[workers, trials] = min(seconds, best.get((workers, trials), seconds))
    return {
        str(workers): (many - few) / (best[workers, many] - best[workers, few])
        for workers, (few, many) in sizes.items()
    }


def fly_batch(ssp: Path, trials: int, workers: int) -> float:
    """Fly the first trials of the campaign without its comparison; how long it took (s)."""
    plan = read_plan(ssp, CAMPAIGN, SystemOptions(), trials=trials, compare={})
    begin = time.perf_counter()
    run_batch(plan, workers=workers)
    return time.perf_counter() - begin
