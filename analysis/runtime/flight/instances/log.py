"""Log messages of FMUs, as lines on standard error: time, component, status, category, message."""

from __future__ import annotations

import sys

import numpy as np

from ...system.options import LOG_LEVELS, SAID_FROM

STATUSES = ("OK", "warning", "discard", "error", "fatal", "pending")


def status_word(status: int) -> str:
    """An fmi2Status as text, also one that FMI does not have."""
    return STATUSES[status] if 0 <= status < len(STATUSES) else f"{status}, a status that FMI does not have"


class Log:
    """Writes the messages of a simulation's FMUs as they come, those of a ``level`` of `LOG_LEVELS` and graver.

    ``place`` is put before each line: in a batch the trial.
    """

    def __init__(self, level: str) -> None:
        self.level = level
        self.place = ""
        self._clock: tuple[np.ndarray, float, float] | None = None

    @property
    def everything(self) -> bool:
        """Whether FMUs are asked for all of their categories."""
        return self.level == LOG_LEVELS[-1]

    def follow(self, outcome: np.ndarray, start: float, step: float) -> None:
        """Take the time (s) from the loop's `Buffers.outcome`, whose communication points are ``step`` apart."""
        self._clock = outcome, start, step

    def write(self, component: str, status: int, category: str, message: str) -> None:
        """One message, on one line: what an FMU breaks into several is put together with bars."""
        if not 0 <= status < len(STATUSES) or status >= SAID_FROM[self.level]:
            time = ""
            if self._clock is not None:
                outcome, start, step = self._clock
                time = f"t = {start + int(outcome[4]) * step:.9g} s: "
            text = " | ".join(" ".join(line.split()) for line in message.splitlines() if line.strip())
            label = f" ({category})" if category else ""
            sys.stderr.write(f"log: {self.place}{time}{component}: {status_word(status)}{label}: {text}\n")
            sys.stderr.flush()
