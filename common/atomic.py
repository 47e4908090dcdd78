"""Atomic files, whole or absent: written next to their path, then moved to it."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PARTIAL = ".partial"


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path, which replaces ``path`` when all is written; its folder is created.

    A reader of ``path``, now or after a crash, finds the old content or the new one. Raises OSError naming
    ``path`` where it cannot be written, a full disk for instance, with nothing left of it.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}{PARTIAL}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield partial
        with partial.open("rb") as file:
            os.fsync(file.fileno())
        partial.replace(path)
    except OSError as error:  # libraries raise it without the file's name, or with that of the partial one
        code = error.errno or errno.EIO
        raise OSError(code, os.strerror(code), str(path)) from error
    finally:
        partial.unlink(missing_ok=True)


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file, whole or not at all; see `whole_file`."""
    with whole_file(path) as partial:
        partial.write_bytes(content)


def remove_partial(folder: Path) -> None:
    """Remove what writers that were killed left in a folder, in which nobody writes any more."""
    for path in folder.glob(f".*.*{PARTIAL}"):
        path.unlink(missing_ok=True)
