"""Server in a worker's process: answers each line of JSON with a line of JSON, until the input ends."""

from __future__ import annotations

import itertools
import json
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from perilune.common.errors import InputError
from perilune.common.process import exit_process

from .contestant import ExchangeSystem, Fly, Unavailable
from .contestants import CONTESTANTS
from .worker import fly_batch

# Simulations are repeated up to a count and a time: some start slowly and unevenly.
FLIGHTS = 3
TURN = 0.1  # s


def _turn(fly: Fly, steps: int) -> dict[str, Any]:
    """Simulate repeatedly for one turn; return the time of the fastest simulation (s) and the final values."""
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
    if name == "batch":
        answer({})
        for line in sys.stdin:
            answer({"seconds": fly_batch(ssp, **json.loads(line))})
        return
    contestant = next(each for each in CONTESTANTS if each.name == name)
    fly = contestant.prepare(ExchangeSystem(ssp))
    answer({})
    for line in sys.stdin:
        answer(_turn(fly, json.loads(line)["steps"]))


def main() -> None:
    """Serve the contestant named on the command line until the input ends."""
    # output of libraries is redirected to standard error; answers use the original standard output
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
        except Exception as error:  # a contestant may raise anything; the benchmark continues without it
            answer({"failed": f"{type(error).__name__}: {error}"})
            status = 1
    exit_process(status)


if __name__ == "__main__":
    main()
