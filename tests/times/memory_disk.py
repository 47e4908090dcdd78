"""A folder in memory for temporary files of tests: files that live for a second take half of the system time."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

import psutil

SHARED_MEMORY = Path("/dev/shm")
ROOM = 4 << 30  # bytes, of which a whole run takes about half
MEMORY = 8 << 30  # bytes, of the machine and available


def use_memory_disk() -> None:
    """Let temporary files lie in /dev/shm, where it has room and libraries can be loaded from it, unless TMPDIR is set.

    Child processes inherit it.
    """
    if "TMPDIR" not in os.environ and _is_fit():
        os.environ["TMPDIR"] = str(SHARED_MEMORY)
        tempfile.tempdir = None


def _is_fit() -> bool:
    if not (SHARED_MEMORY.is_dir() and os.access(SHARED_MEMORY, os.W_OK)):
        return False
    executable = not os.statvfs(SHARED_MEMORY).f_flag & os.ST_NOEXEC
    free = shutil.disk_usage(SHARED_MEMORY).free
    return executable and free > ROOM and psutil.virtual_memory().available > MEMORY
