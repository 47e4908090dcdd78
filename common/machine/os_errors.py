"""Errors of the operating system in one line: place, reason and a suitable remedy."""

from __future__ import annotations

import errno
import os

REMEDIES = {
    errno.ENOSPC: "free some space",
    errno.EDQUOT: "free some space, or ask for a larger quota",
    errno.EFBIG: "raise the limit on file size (ulimit -f), or use a file system that allows larger files",
    errno.EROFS: "mount its file system writable",
    errno.EIO: "check the disk",
    errno.ESTALE: "remount its file system, which was removed or replaced",
    errno.EXDEV: "use a folder on a single file system",
    errno.EMFILE: "raise the limit on open files (ulimit -n)",
    errno.ENFILE: "close files in other programs",
    errno.ENOMEM: "free some memory",
    errno.ENOENT: "restore the folder, which was removed or renamed, or correct the path",
    errno.EACCES: "change its permissions",
    errno.EPERM: "change its permissions",
    errno.ENOTDIR: "remove the file in the place of the folder",
    errno.EEXIST: "remove the file in the place of the folder",
    errno.EISDIR: "remove the folder in the place of the file",
    errno.ENAMETOOLONG: "give a shorter path",
}
OTHERWISE = "give another path or fix this one"
OF_MACHINE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO, errno.ESTALE, errno.EMFILE, errno.ENFILE)


def is_of_machine(error: OSError) -> bool:
    """Return True if the machine causes an error, such as a full disk, independently of the file that is written."""
    return error.errno in OF_MACHINE


def remedy_of(error: OSError) -> str:
    """Return the remedy for an error with files, according to its error number."""
    return REMEDIES.get(error.errno or 0, OTHERWISE)


def reason_of(error: OSError) -> str:
    """Return the system's text for an error, without error number and file name."""
    return error.strerror or str(error)


def line_of(error: OSError, subject: str | os.PathLike[str] = "") -> str:
    """Return file, reason and remedy in one line; ``subject`` replaces a missing file name."""
    name = os.fsdecode(error.filename or subject)
    return f"{f'{name}: ' if name else ''}{reason_of(error)}; {remedy_of(error)}"
