"""Foreign programs, such as compilers, that end with this process, together with all their descendants."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from . import keeper

POLLING = 0.1  # s between checks whether a program is still needed


class Ended(NamedTuple):
    """Outcome of a program: its output, and its exit status or the negative number of the signal that ended it."""

    status: int
    output: str
    errors: str


def run_program(
    command: Sequence[str], folder: str | Path, is_needed: Callable[[], bool] = lambda: True
) -> Ended | None:
    """Run a program in a folder to its end; if ``is_needed`` returns False, kill the program and return None.

    The program has a separate session, so that Ctrl-C only reaches the waiting process. Raises OSError if the program
    cannot be run.
    """
    theirs, ours = os.pipe()  # the end of this process closes ``ours``, which ends the keeper and the program
    try:
        process = subprocess.Popen(
            [sys.executable, "-I", "-S", keeper.__file__, *command],
            cwd=folder,
            stdin=theirs,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
    except OSError:
        os.close(ours)
        raise
    finally:
        os.close(theirs)
    with process:
        try:
            output, errors = _read(process, is_needed)
        except TimeoutError:
            return None
        finally:
            os.close(ours)
    texts = (text.decode(errors="replace") for text in (output, errors))
    ended = Ended(process.returncode, *texts)
    if ended.status == keeper.NOT_RUN:
        raise OSError(None, ended.errors.strip() or f"exit status {ended.status}")
    return ended


def _read(process: subprocess.Popen[bytes], is_needed: Callable[[], bool]) -> tuple[bytes, bytes]:
    """Return the output of a program when it ends. Raises TimeoutError once the program is no longer needed."""
    while True:
        try:
            return process.communicate(timeout=POLLING)
        except subprocess.TimeoutExpired:
            if not is_needed():
                raise TimeoutError from None
