"""The end of a process that ran pythonfmu FMUs.

Their library can crash in its destructors, after everything is done (10 of 64 runs), and would spoil the exit status:
so such a process leaves without them.
"""

from __future__ import annotations

import atexit
import os
import sys
from contextlib import suppress
from typing import NoReturn


def leave(status: int) -> NoReturn:
    """End the process at once with an exit status; what was written to standard output and error is not lost."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:  # a process can be started without them
            with suppress(OSError):
                stream.flush()
    os._exit(status)


def leave_when_done() -> None:
    """Let a worker's process end with `leave` once its own handlers have run."""
    atexit.register(leave, 0)
