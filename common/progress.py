"""Progress of long work: a bar on a terminal or in a notebook, otherwise a line on standard error every ten seconds."""

from __future__ import annotations

import sys
import time
from io import StringIO
from typing import Any

from tqdm.auto import tqdm
from tqdm.std import tqdm as text_bar

IN_NOTEBOOK = any(base.__module__ == "tqdm.notebook" for base in tqdm.__mro__)
PERIOD = 10.0  # s between lines


class ProgressLines(text_bar):
    """Progress bar in the form of log lines; the first appears after `PERIOD`, so quick work writes none."""

    monitor_interval = 0  # disables the thread that refreshes

    def __init__(self, **options: Any) -> None:
        lines = {"file": StringIO(), "delay": PERIOD, "mininterval": PERIOD, "miniters": 1, "disable": False}
        self._written = time.time()
        super().__init__(**options | lines)

    def display(self, msg: str | None = None, pos: int | None = None) -> bool:
        """Write a line if `PERIOD` has passed since the last line or the start, unless tqdm is clearing its bar."""
        now = self._time()
        if msg is None and now - self._written >= PERIOD:
            self._written = now
            print(f"perilune: {self._line()}", file=sys.stderr, flush=True)
        return True

    def _line(self) -> str:
        state = self.format_dict
        done, total, seconds = state["n"], state["total"], state["elapsed"]
        of = f" of {total}" if total else ""
        left = f", {self.format_interval((total - done) * seconds / done)} left" if total and 0 < done <= total else ""
        more = f", {state['postfix']}" if state["postfix"] else ""
        return f"{done}{of} {state['unit']}s in {self.format_interval(seconds)}{left}{more}"


def progress_bar(**options: Any) -> text_bar:
    """Return tqdm's bar, which disappears at the end, or log lines if standard error is not a terminal."""
    # tqdm checks that its file is a terminal, and the output of a notebook cell is none
    if IN_NOTEBOOK or sys.stderr.isatty():
        return tqdm(**options, disable=False, leave=False)
    return ProgressLines(**options, leave=False)
