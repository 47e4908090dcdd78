"""Reading of untrusted files, only regular ones, since opening a pipe may block and a link may lead to any file."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from .bounds import Bound
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
    """Return True if a regular file exists and is not a link; its folder may be a link."""
    try:
        return stat.S_ISREG(path.lstat().st_mode)
    except OSError:
        return False


def check_regular(path: Path, remedy: str) -> None:
    """Reject a path that does not exist or is not a regular file. Raises InputError."""
    _size(path, remedy, follow_links=False)


def check_folder(path: Path, remedy: str) -> None:
    """Reject a path that exists and is not a folder, or that is a link. Raises InputError."""
    if path.is_symlink() or (path.exists() and not path.is_dir()):
        raise InputError(path, "", f"{KINDS.get(stat.S_IFMT(path.lstat().st_mode), 'a file')}, not a folder", remedy)


def names_file(path: str | os.PathLike[str]) -> bool:
    """Return True if a path leads to a regular file, also through a link; False for text that cannot be a path."""
    try:
        return Path(path).is_file()
    except (OSError, ValueError):
        return False


def read_input(path: str | os.PathLike[str], remedy: str, bound: Bound) -> bytes:
    """Read a regular file, also through a link; nothing else is opened. Raises InputError."""
    bound.check(_size(Path(path), remedy, follow_links=True), path, "")
    return _read(Path(path), remedy)


def read_regular(path: Path, remedy: str, limit: float) -> bytes:
    """Read a regular file of at most ``limit`` bytes that is not a link. Raises InputError."""
    size = _size(path, remedy, follow_links=False)
    if size > limit:
        raise InputError(path, "", f"{size} bytes, at most {limit:.6g} are read", remedy)
    return _read(path, remedy)


def _size(path: Path, remedy: str, *, follow_links: bool) -> int:
    """Return the size of a regular file in bytes. Raises InputError for anything else."""
    try:
        state = path.stat(follow_symlinks=follow_links)
    except (OSError, ValueError) as error:
        reason = "not found" if isinstance(error, FileNotFoundError) else getattr(error, "strerror", None) or str(error)
        raise InputError(path, "", reason, remedy) from error
    if not stat.S_ISREG(state.st_mode):
        kind = KINDS.get(stat.S_IFMT(state.st_mode), "no file")
        raise InputError(path, "", f"{kind}, not a regular file", remedy)
    return state.st_size


def _read(path: Path, remedy: str) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputError(path, "", error.strerror or str(error), remedy) from error
