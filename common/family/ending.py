"""Ending of a process when the process that started it ends, even if that process crashes or is killed."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import threading
from contextlib import suppress

import psutil

PR_SET_PDEATHSIG = 1
IS_LINUX = sys.platform == "linux"


def end_with_parent(parent: int) -> None:
    """End this process when its ``parent`` (a process ID) ends, or immediately if the parent has ended already.

    Linux ends this process when the thread that started it ends, so the thread must live as long as this process.
    """
    if not IS_LINUX:
        end_after(parent)
        return
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, int(signal.SIGKILL), 0, 0, 0)
    if os.getppid() != parent:
        os._exit(1)


def end_after(process: int) -> None:
    """Start a thread that ends this process when another process ends, whichever of its threads started this one."""
    threading.Thread(target=_wait_and_end, args=(process,), daemon=True).start()


def _wait_and_end(process: int) -> None:
    with suppress(psutil.Error):  # raised if the process has ended
        psutil.Process(process).wait()
    os._exit(1)
