"""Temporary folders, removed when their process ends or, if it is killed, when another process creates one."""

from __future__ import annotations

import shutil
import stat
import tempfile
import time
from contextlib import suppress
from functools import cache
from pathlib import Path

from filelock import FileLock, Timeout

from .process import at_end

PREFIX = "perilune_"
LOCK = "lock"  # in each process's folder, locked while the process exists
YOUNG = 60.0  # s, age up to which a folder may not be locked yet


def make_folder() -> Path:
    """Create a temporary folder, which is removed by the caller or at the end of the process."""
    return Path(tempfile.mkdtemp(dir=_folder()[0]))


def _remove_all() -> None:
    """Remove all temporary folders of this process at its end."""
    if _folder.cache_info().currsize:
        shutil.rmtree(_folder()[0], ignore_errors=True)


@cache
def _folder() -> tuple[Path, FileLock]:
    """Return the folder that contains all temporary folders of this process, and its lock."""
    folder = Path(tempfile.mkdtemp(prefix=PREFIX))
    _sweep(folder.stat().st_uid)
    at_end(_remove_all)
    lock = FileLock(folder / LOCK)
    lock.acquire(blocking=False)
    return folder, lock


def _sweep(user: int) -> None:
    """Remove the folders of this user's ended processes; skip locks that are links, which could lead to any file."""
    for path in Path(tempfile.gettempdir()).glob(f"{PREFIX}*/{LOCK}"):
        with suppress(OSError, Timeout):
            state = path.lstat()
            is_ours = state.st_uid == path.parent.stat().st_uid == user and stat.S_ISREG(state.st_mode)
            if is_ours and time.time() - state.st_mtime > YOUNG:
                with FileLock(path, blocking=False):
                    shutil.rmtree(path.parent)
