"""A pool that is interrupted while its processes start leaves none, and nothing waits for them.

Truth: the operating system's list of this process's children; the interruption stands where loky has started processes,
but not yet the thread that would kill them.
"""

from __future__ import annotations

import time

import psutil
import pytest
from loky import ProcessPoolExecutor

from perilune.analysis.stability.progress import begin, listen
from perilune.common.family.pools import process_pool

PATIENCE = 30.0  # s


def workers() -> list[psutil.Process]:
    """Return the worker processes among the children of this process."""
    children = psutil.Process().children()
    return [each for each in children if "popen_loky" in " ".join(each.cmdline())]


def test_interrupted_during_the_start(monkeypatch):
    before = workers()
    started = []

    def interrupt(_):
        started.extend(each for each in workers() if each not in before)
        raise KeyboardInterrupt

    monkeypatch.setattr(ProcessPoolExecutor, "_start_executor_manager_thread", interrupt)
    counted: list[tuple[int, int]] = []
    with (
        pytest.raises(KeyboardInterrupt),
        listen(lambda *steps: counted.append(steps)) as pipe,
        process_pool(2, begin, pipe) as pool,
    ):
        pool.submit(time.sleep, 600.0)
    assert len(started) == 2
    _, alive = psutil.wait_procs(started, PATIENCE)
    assert not alive
