"""Files that are complete or absent: written next to their final path, then renamed to it."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PARTIAL = ".partial"


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path and rename its file to ``path`` at the end of the block; create the folder of ``path``.

    A reader of ``path``, now or after a crash, finds either the old or the new content. Raises OSError, which names
    ``path``, if the file cannot be written, for instance on a full disk; no temporary file remains.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}{PARTIAL}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield partial
        with partial.open("rb") as file:
            os.fsync(file.fileno())
        partial.replace(path)
    except OSError as error:  # libraries raise it without a file name, or with the name of the temporary file
        code = error.errno or errno.EIO
        raise OSError(code, os.strerror(code), str(path)) from error
    finally:
        partial.unlink(missing_ok=True)


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file completely or not at all, by `whole_file`."""
    with whole_file(path) as partial:
        partial.write_bytes(content)


def remove_partial(folder: Path) -> None:
    """Remove the temporary files of killed writers from a folder that has no active writer."""
    for path in folder.glob(f".*.*{PARTIAL}"):
        path.unlink(missing_ok=True)
