"""A process of its own for one contestant, so that none disturbs another or takes the benchmark with it.

Run as a module it answers one line of JSON per line of JSON; `Worker` is the other end.
"""

from __future__ import annotations

import itertools
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from analysis.errors import InputError

from .contestant import Fly, Unavailable

# Flights are repeated until there are so many and so much time has passed: some take long to start, and unevenly.
FLIGHTS = 3
TURN = 0.1  # s


class WorkerError(Exception):
    """What a contestant's process said before it gave up."""


class Worker:
    """A contestant, by name, in a process of its own; use it as a context manager."""

    def __init__(self, contestant: str, ssp: Path) -> None:
        self.contestant = contestant
        command = [sys.executable, "-m", __name__, contestant, str(ssp)]
        # it ends without clearing up: what it unpacks lies beside the .ssp and goes with it
        environment = {**os.environ, "TMPDIR": tempfile.mkdtemp(dir=ssp.parent)}
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


def _turn(fly: Fly, steps: int) -> dict[str, Any]:
    """Fly for a turn; the time of its fastest flight (s) and the values at the end."""
    end = time.perf_counter() + TURN
    best = float("inf")
    for flight in itertools.count(1):
        begin = time.perf_counter()
        values = fly(steps)
        now = time.perf_counter()
        best = min(best, now - begin)
        if flight >= FLIGHTS and now > end:
            break
    return {"seconds": best, "values": values}


def _serve(answer: Callable[[dict[str, Any]], None], name: str, ssp: Path) -> None:
    from .contestants import CONTESTANTS
    from .course import Course
    from .trials import fly_batch

    if name == "batch":
        answer({})
        for line in sys.stdin:
            answer({"seconds": fly_batch(ssp, **json.loads(line))})
        return
    contestant = next(each for each in CONTESTANTS if each.name == name)
    fly = contestant.prepare(Course(ssp))
    answer({})
    for line in sys.stdin:
        answer(_turn(fly, json.loads(line)["steps"]))


def main() -> None:
    """Serve the contestant named on the command line until the input ends."""
    # libraries print: what they say goes to the error stream, the answers go where it would have gone
    with os.fdopen(os.dup(1), "w") as output:
        os.dup2(2, 1)

        def answer(message: dict[str, Any]) -> None:
            output.write(json.dumps(message) + "\n")
            output.flush()

        status = 0
        try:
            _serve(answer, sys.argv[1], Path(sys.argv[2]))
        except (Unavailable, InputError) as reason:
            answer({"unavailable": str(reason)})
        except Exception as error:  # a peer may raise anything; the benchmark goes on without it
            answer({"failed": f"{type(error).__name__}: {error}"})
            status = 1
    sys.stderr.flush()
    os._exit(status)  # pythonfmu's library can crash in its destructors


if __name__ == "__main__":
    main()
