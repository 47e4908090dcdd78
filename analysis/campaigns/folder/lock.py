"""Lock of a campaign's folder: several processes may simulate its shards, but none may replace them meanwhile."""

from __future__ import annotations

import os
import sqlite3
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from filelock import ReadWriteLock, Timeout

from ....common.errors import InputError
from ....common.regular import check_regular

FILE = ".lock"  # an empty database; its lock ends with the process


@contextmanager
def lock_folder(folder: Path | None, *, alone: bool = False) -> Iterator[None]:
    """Lock a folder, shared with other users or ``alone``; do nothing for None.

    Raises InputError if another process has a conflicting lock. Warns if the file system does not support locks.
    """
    with ExitStack() as entered:
        if folder is not None:
            entered.enter_context(_lock(folder, alone))
        yield


@contextmanager
def _lock(folder: Path, alone: bool) -> Iterator[None]:
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / FILE
    if os.path.lexists(path):
        check_regular(path, "remove this file")
    with ExitStack() as entered:
        try:
            lock = ReadWriteLock(path, blocking=False, is_singleton=False)
            entered.callback(lock.close)
            entered.enter_context(lock.write_lock() if alone else lock.read_lock())
        except Timeout:
            problem = "another process simulates this campaign" if alone else "another process replaces this campaign"
            raise InputError(folder, "", problem, "wait until it has ended, or give another folder") from None
        except sqlite3.OperationalError as error:
            warnings.warn(f"{folder} cannot be locked ({error}): do not write to it from another process", stacklevel=4)
        except (OSError, ValueError, sqlite3.Error) as error:
            raise InputError(path, "", f"cannot be locked: {error}", "remove this file") from error
        yield
