"""Calls of Linux for processes that Python has no function for."""

from __future__ import annotations

import ctypes
import os
import sys
from contextlib import suppress
from pathlib import Path

with suppress(ImportError):  # on Windows
    import fcntl
    import resource

PR_SET_CHILD_SUBREAPER = 36
IS_LINUX = sys.platform == "linux"
RESERVED = 2  # addresses, by what may be in memory: programs reserve more than they use


def adopt_orphans() -> None:
    """Have descendants of this process that lose their parents become its children."""
    if IS_LINUX:
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def child_processes() -> list[int]:
    """This process's children, where the system says so."""
    processes: list[int] = []
    for task in Path("/proc/self/task").glob("*/children"):
        with suppress(OSError):
            processes += map(int, task.read_text().split())
    return processes


def resident_memory(process: int) -> int:
    """Bytes that a process has in memory; 0 where the system does not say, or the process has ended."""
    return _pages(process, 1)


def peak_memory(usage: resource.struct_rusage) -> int:
    """Bytes that a process that has ended had in memory at most."""
    return usage.ru_maxrss * (1024 if IS_LINUX else 1)


def limit_addresses(memory: int) -> None:
    """Have allocations fail once this process has reserved twice so many bytes (`memory`) more than it has now.

    It ends a process that grows too fast for whoever looks at it.
    """
    if IS_LINUX:
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        limit = _pages(os.getpid(), 0) + RESERVED * memory
        resource.setrlimit(resource.RLIMIT_AS, (limit if hard < 0 else min(limit, hard), hard))


def _pages(process: int, column: int) -> int:
    """The bytes of a column of /proc/PID/statm."""
    try:
        return int(Path(f"/proc/{process}/statm").read_text().split()[column]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError, ValueError):
        return 0


def add_seals(descriptor: int, seals: int) -> None:
    """Seals of a file in memory (fcntl, F_ADD_SEALS); other files have none."""
    if IS_LINUX:
        with suppress(OSError):
            fcntl.fcntl(descriptor, fcntl.F_ADD_SEALS, seals)
