"""Commands in children of one process that has everything imported: a hundred take seconds, each with its own memory.

`python -m tests.hostile.server` reads requests, a line of JSON each, and answers likewise.
"""

from __future__ import annotations

import importlib
import json
import os
import resource
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

DEADLINE = 60  # s, after which a child is ended: a guard against hangs
SPACE = 6 << 30  # bytes that a child may address: a guard of the machine
MODULES = ("batch", "compare", "describe", "open_results", "replay", "result", "run", "shard", "stability", "validate")


@dataclass(frozen=True)
class Outcome:
    """``status`` is negative for a signal, ``memory`` (bytes) the most that was resident, ``seconds`` of wall clock."""

    status: int
    output: str
    errors: str
    memory: int
    seconds: float


class Server:
    """The process, started with the first command."""

    def __init__(self, root: Path) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.hostile.server"],
            cwd=root,
            env={**os.environ, "PYTHONPATH": str(root)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def carry_out(self, arguments: list[str], folder: Path, temporary: Path) -> Outcome:
        """Carry out one command in a folder, with another for temporary files and for the home."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        request = {"arguments": arguments, "folder": str(folder), "temporary": str(temporary)}
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        texts = [(temporary.parent / name).read_text(encoding="utf-8", errors="replace") for name in ("out", "err")]
        return Outcome(answer["status"], *texts, answer["memory"], answer["seconds"])

    def close(self) -> None:
        """End it."""
        self.process.communicate()


def serve() -> None:
    """Answer requests until there are no more."""
    for name in MODULES:
        importlib.import_module(f"perilune.analysis.verbs.{name}")
    importlib.import_module("perilune.fmus_src.catalogue").catalogue()
    answers = os.fdopen(os.dup(1), "w")
    for line in sys.stdin:
        begin = time.monotonic()
        child = os.fork()
        if not child:
            _carry_out(json.loads(line))
        _, ending, usage = os.wait4(child, 0)
        status = os.waitstatus_to_exitcode(ending)
        answer = {"status": status, "memory": usage.ru_maxrss * 1024, "seconds": time.monotonic() - begin}
        print(json.dumps(answer), file=answers, flush=True)


def _carry_out(request: dict[str, Any]) -> None:
    """Carry out the command in the child, then end it."""
    signal.alarm(DEADLINE)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (SPACE, SPACE))
    temporary = request["temporary"]
    for stream, name in ((1, "out"), (2, "err")):
        os.dup2(os.open(os.path.join(os.path.dirname(temporary), name), os.O_WRONLY | os.O_CREAT | os.O_TRUNC), stream)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.environ |= {"TMPDIR": temporary, "HOME": temporary}
    os.chdir(request["folder"])
    sys.argv = ["perilune", *request["arguments"]]
    importlib.import_module("perilune.analysis.cli").run()


if __name__ == "__main__":
    serve()
