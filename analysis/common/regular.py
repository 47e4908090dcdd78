"""Files that others may have left: regular ones alone, since opening a pipe waits and a link may lead anywhere."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from .errors import InputError

KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFLNK: "a link",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}


def is_regular(path: Path) -> bool:
    """Whether a file is there, and no link; its folder may be one."""
    try:
        return stat.S_ISREG(path.lstat().st_mode)
    except OSError:
        return False


def check_regular(path: Path, remedy: str) -> None:
    """Refuse what is no regular file, or is not there. Raises InputError."""
    try:
        mode = path.lstat().st_mode
    except OSError as error:
        reason = "not found" if isinstance(error, FileNotFoundError) else error.strerror or str(error)
        raise InputError(path, "", reason, remedy) from error
    if not stat.S_ISREG(mode):
        raise InputError(path, "", f"{KINDS.get(stat.S_IFMT(mode), 'no file')}, not a regular file", remedy)


def read_regular(path: Path, remedy: str, limit: float) -> bytes:
    """The content of a regular file of at most so many bytes. Raises InputError."""
    check_regular(path, remedy)
    size = os.path.getsize(path)
    if size > limit:
        raise InputError(path, "", f"{size} bytes, at most {limit:.6g} are read", remedy)
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputError(path, "", error.strerror or str(error), remedy) from error
