"""Errors of the operating system in one line: place, the system's reason, and a suitable remedy."""

from __future__ import annotations

import errno
import os

REMEDIES = {
    errno.ENOSPC: "free some space",
    errno.EDQUOT: "free some space, or have your quota raised",
    errno.EFBIG: "raise the limit of the size of files (ulimit -f), or take a file system with larger ones",
    errno.EROFS: "have its file system mounted for writing",
    errno.EIO: "check the disk",
    errno.ESTALE: "mount its file system again, which was taken away or replaced",
    errno.EXDEV: "take a folder that lies on one file system",
    errno.EMFILE: "raise the limit of open files (ulimit -n)",
    errno.ENFILE: "close other programs' files",
    errno.ENOMEM: "free some memory",
    errno.ENOENT: "put back the folder, which was removed or renamed, or correct the path",
    errno.EACCES: "change its permissions",
    errno.EPERM: "change its permissions",
    errno.ENOTDIR: "remove the file that is where a folder is needed",
    errno.EEXIST: "remove the file that is where a folder is needed",
    errno.EISDIR: "remove the folder that is where a file is needed",
    errno.ENAMETOOLONG: "give a shorter path",
}
OTHERWISE = "give another path or fix this one"
OF_MACHINE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO, errno.ESTALE, errno.EMFILE, errno.ENFILE)


def is_of_machine(error: OSError) -> bool:
    """Return True if an error is caused by the machine, whatever is written to it."""
    return error.errno in OF_MACHINE


def remedy_of(error: OSError) -> str:
    """Return the remedy for an error with files, according to its number."""
    return REMEDIES.get(error.errno or 0, OTHERWISE)


def reason_of(error: OSError) -> str:
    """Return the system's text for an error, without its number and its file."""
    return error.strerror or str(error)


def line_of(error: OSError, subject: str | os.PathLike[str] = "") -> str:
    """Return file, reason and remedy in one line; ``subject`` replaces a missing file name."""
    name = os.fsdecode(error.filename or subject)
    return f"{f'{name}: ' if name else ''}{reason_of(error)}; {remedy_of(error)}"
