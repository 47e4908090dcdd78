"""A process of its own for one contestant, so that none disturbs another or takes the benchmark with it.

What runs in it is `serve.py`.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from .contestant import Unavailable
from .importers import MODULE


class WorkerError(Exception):
    """What a contestant's process said before it gave up."""


class Worker:
    """A contestant of a module, by name, in a process of its own; use it as a context manager."""

    def __init__(self, contestant: str, ssp: Path, module: str = MODULE) -> None:
        self.contestant = contestant
        command = [sys.executable, "-m", f"{__package__}.serve", contestant, str(ssp), module]
        # it ends without clearing up: what it unpacks lies beside the .ssp and goes with it
        paths = os.pathsep.join(filter(None, sys.path))  # where the module is
        environment = {**os.environ, "TMPDIR": tempfile.mkdtemp(dir=ssp.parent), "PYTHONPATH": paths}
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
        )
        self._answer()

    def ask(self, **request: Any) -> dict[str, Any]:
        """Send a request and wait for its answer; raises `Unavailable` and `WorkerError`."""
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
        """End the process, which frees what it holds."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()

    def __enter__(self) -> Worker:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
