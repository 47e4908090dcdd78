"""A dask scheduler and workers on this machine, in separate processes as on a cluster."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, suppress

import psutil

WAIT = 60.0  # s for what has to come


def can_hide():
    """Return True if a folder can be hidden from a process: another file system mounted over it."""
    if sys.platform != "linux":
        return False
    return subprocess.run(["unshare", "-rm", "true"], capture_output=True, check=False).returncode == 0


class DaskCluster:
    """A scheduler and workers, each with its folder in ``place``; ``hidden`` is one that they cannot see."""

    def __init__(self, place, hidden=None):
        self.place = place
        self._hidden = hidden
        self._processes = []
        file = place / "scheduler.json"
        self._start("scheduler", ["--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(file)])
        until(lambda: file.is_file() and file.read_text().endswith("}"))
        self.address = json.loads(file.read_text())["address"]

    def _start(self, kind, options, environment=None, hidden=None):
        folder = self.place / f"{kind}{len(self._processes)}"
        folder.mkdir()
        line = [sys.executable, "-m", "dask", kind, *options, "--no-dashboard"]
        if hidden is not None:
            words = 'mount -t tmpfs tmpfs "$0" && exec "$@"'
            line = ["unshare", "-rm", "sh", "-c", words, str(hidden), *line]
        log = (folder / "log").open("wb")
        process = subprocess.Popen(
            line, cwd=folder, stdout=log, stderr=log, env={**os.environ, **(environment or {})}, start_new_session=True
        )
        self._processes.append(process)
        return process

    def worker(self, environment=None, threads=1):
        """Add a worker, watched by dask's nanny, which restarts it when it is killed."""
        options = [self.address, "--nthreads", str(threads), "--local-directory", "."]
        return self._start("worker", options, environment, self._hidden)

    def flying(self):
        """Process ids of the workers, without the nannies."""
        collected = []
        for nanny in self._processes[1:]:
            try:
                children = psutil.Process(nanny.pid).children(recursive=True)
                collected += [child.pid for child in children if "spawn_main" in " ".join(child.cmdline())]
            except psutil.Error:  # it has just ended
                continue
        return collected

    def end(self, what):
        """Send SIGKILL to the ``scheduler``, or to all ``workers`` with their nannies."""
        for process in self._processes[:1] if what == "scheduler" else self._processes[1:]:
            with_group(process, signal.SIGKILL)

    def close(self):
        for process in reversed(self._processes):
            with_group(process, signal.SIGKILL)
        for process in self._processes:
            process.wait()


def with_group(process, number):
    """Send a signal to a process and all that it has started."""
    with suppress(ProcessLookupError):
        os.killpg(process.pid, number)


@contextmanager
def dask_cluster(place, workers=2, hidden=None):
    """Yield a `DaskCluster` whose every process is gone in the end."""
    cluster = DaskCluster(place, hidden)
    try:
        for _ in range(workers):
            cluster.worker()
        yield cluster
    finally:
        cluster.close()


def until(condition):
    """Wait for something. Raises TimeoutError."""
    end = time.monotonic() + WAIT
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.05)
