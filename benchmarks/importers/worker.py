"""Separate process for each contestant, and measurement of trials per second.

The process runs `serve.py`.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.family.ending import end_with_parent

from .contestant import Unavailable


class WorkerError(Exception):
    """Error of a contestant's process that failed; the text contains its last output."""


class Worker:
    """Contestant, by name, in a separate process. A context manager."""

    def __init__(self, contestant: str, ssp: Path) -> None:
        self.contestant = contestant
        ending = f"from {end_with_parent.__module__} import end_with_parent; end_with_parent({os.getpid()})"
        start = f"{ending}; from {__package__}.serve import main; main()"
        command = [sys.executable, "-c", start, contestant, str(ssp)]
        # it ends without cleaning up; unpacked files are removed with the .ssp
        paths = os.pathsep.join(filter(None, sys.path))  # so that the process finds this module
        environment = {**os.environ, "TMPDIR": tempfile.mkdtemp(dir=ssp.parent), "PYTHONPATH": paths}
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
        )
        self._answer()

    def ask(self, **request: Any) -> dict[str, Any]:
        """Send a request and return its answer. Raises `Unavailable` and `WorkerError`."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(request) + "\n")
        self._process.stdin.flush()
        return self._answer()

    def _answer(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise WorkerError(f"its process ended with status {self._process.wait()}")
        answer = json.loads(line)
        if "unavailable" in answer:
            raise Unavailable(answer["unavailable"])
        if "failed" in answer:
            raise WorkerError(answer["failed"])
        return answer

    def close(self) -> None:
        """End the process, which releases its memory and files."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()

    def __enter__(self) -> Worker:
        return self

    def __exit__(self, problem: type[BaseException] | None, *_: object) -> None:
        if problem is not None:
            self._process.kill()  # killed, since its current task may take long
        self.close()


CAMPAIGN = "paper"
WORKERS = (1, 2)
SECONDS = 4.0  # approximate duration of a batch
ROUNDS = 3
LEAST = 20  # least trials beyond the warm-up


def trials_per_second(ssp: Path, flight: float, rounds: int = ROUNDS) -> dict[str, float]:
    """Return the campaign's trials per second by number of workers; ``flight`` (s) is the rough time of a trial.

    A short and a long batch are timed ``rounds`` times each; the difference of the fastest times excludes the start of
    the workers. Raises `Unavailable` and `WorkerError`.
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
    """Simulate the first trials of the campaign without its comparison of variants; return the time (s)."""
    plan = read_plan(ssp, CAMPAIGN, SystemOptions(), trials=trials, compare={})
    begin = time.perf_counter()
    run_batch(plan, workers=workers)
    return time.perf_counter() - begin
