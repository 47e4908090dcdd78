"""What a worker process says before it ends itself, since a step of an FMU does not return: which trial that was.

A step that releases the interpreter lock is found out by the clock of `flight.interruptible`, one that keeps it by that
of faulthandler, which needs no lock. Either way the process goes with the step, and those after it read why.
"""

from __future__ import annotations

import faulthandler
import json
import os
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

from ...common.process import leave
from ...runtime.flight.interruptible import PATIENCE

GRACE = 2 * PATIENCE  # s beyond a flight's time: after the other clock


class LastWords:
    """The words of this process, in a file of its own in a folder that outlives it; it flies one trial at a time.

    ``hung`` says of trials, by variant and number, that no process needs to fly them any more, and why.
    """

    def __init__(self, folder: Path, timeout: float) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder
        self._timeout = timeout
        self.look()
        self._file = (folder / f"{os.getpid()}_{time.time_ns()}").open("w", encoding="utf-8")

    def look(self) -> None:
        """Read what others have said meanwhile."""
        self.hung = hung_trials(self._folder)

    @contextmanager
    def of(self, variant: str, trial: int) -> Iterator[None]:
        """End this process where the flight inside takes far longer than it may."""
        self._file.seek(0)
        self._file.truncate()
        locked = f"an FMU kept Python's lock {GRACE:g} s after its time limit of {self._timeout:g} s"
        self._file.write(json.dumps([variant, trial, locked]) + "\n")
        self._file.flush()
        faulthandler.dump_traceback_later(self._timeout + GRACE, exit=True, file=self._file)
        try:
            yield
        finally:
            faulthandler.cancel_dump_traceback_later()

    def say(self, variant: str, trial: int, message: str) -> NoReturn:
        """End this process, which holds a step that does not return."""
        self._file.seek(0)
        self._file.truncate()
        self._file.write(json.dumps([variant, trial, message]) + "\nended\n")
        self._file.flush()
        leave(1)


def hung_trials(folder: Path) -> Mapping[tuple[str, int], str]:
    """Why no process needs to fly a trial any more, by variant and number; one that was killed has said nothing."""
    messages = {}
    for path in folder.iterdir():
        first, _, more = path.read_text(encoding="utf-8", errors="replace").partition("\n")
        if more:
            variant, trial, message = json.loads(first)
            messages[variant, trial] = message
    return messages
