"""Restrictions of a child: a memory limit and, with foreign FMUs, limited access to files, network and other processes.

Only Linux offers such restrictions without administrator rights: Landlock for files and signals (Linux 5.13 and later),
seccomp for system calls. Processes that the child starts inherit both. Reading is not restricted.
"""

from __future__ import annotations

import ctypes
import functools
import os
import struct
import sys
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ....common.errors import InputError
from ..system.fmu import Fmu
from ..system.options import NETWORK, SystemOptions
from .seccomp import check_result, filter_calls, has_seccomp

GB = 1e9  # bytes
PR_SET_NO_NEW_PRIVS = 38
LANDLOCK_CREATE_RULESET, LANDLOCK_ADD_RULE, LANDLOCK_RESTRICT_SELF = 444, 445, 446
LANDLOCK_CREATE_RULESET_VERSION, LANDLOCK_RULE_PATH_BENEATH = 1, 1
O_PATH = 0o10000000

# LANDLOCK_ACCESS_FS_..., by the first version of Landlock that supports them.
WRITE_FILE = 1 << 1
CHANGES_FOLDERS = sum(1 << bit for bit in range(4, 13))  # removal and creation of files, folders, devices, links
REFER, TRUNCATE, IOCTL_DEV = 1 << 13, 1 << 14, 1 << 15
FILES = ((1, WRITE_FILE | CHANGES_FOLDERS), (2, REFER), (3, TRUNCATE), (5, IOCTL_DEV))
BIND_TCP, CONNECT_TCP = 1, 2  # from version 4 of Landlock on
SCOPE_ABSTRACT_UNIX_SOCKET, SCOPE_SIGNAL = 1, 2  # from version 6 of Landlock on


@dataclass(frozen=True)
class Restriction:
    """Restriction to ``writable`` folders and files; ``network`` is True if network access is allowed."""

    writable: tuple[str, ...]
    network: bool


@dataclass(frozen=True)
class ProcessLimits:
    """Memory limit of a child, in bytes in addition to its server's memory, and its restriction or None."""

    memory: int
    restriction: Restriction | None


def limits_for(fmus: Iterable[Fmu], options: SystemOptions) -> ProcessLimits:
    """Return the limits of a child with these FMUs; only a child with a foreign FMU is restricted.

    If the operating system does not support all restrictions, warns or, if the options are strict, raises InputError.
    """
    memory = round(options.limits["memory"] * GB)
    if all(fmu.is_own for fmu in fmus):
        return ProcessLimits(memory, None)
    missing = find_missing()
    if missing and options.trust["isolate"] == "strict":
        raise InputError(
            "`isolate`",
            options.trust["isolate"],
            "; ".join(missing),
            "leave out `isolate`, or use another operating system",
        )
    if missing:
        warnings.warn(f"foreign FMUs are not restricted here: {'; '.join(missing)}", stacklevel=2)
    allowed = [str(Path(options.folder, folder)) for folder in options.writable]
    return ProcessLimits(memory, Restriction(tuple(allowed), network=NETWORK in options.trust["allow"]))


@functools.cache
def find_missing() -> tuple[str, ...]:
    """Return the features that the operating system lacks to enforce a restriction, as text."""
    if sys.platform != "linux":
        return ("only Linux restricts processes",)
    missing = []
    if _landlock_version() < 1:
        missing.append("no Landlock, so they can write wherever you can write")
    if not has_seccomp():
        missing.append("no seccomp filters, so they can use the network and reach your processes")
    return tuple(missing)


def restrict(restriction: Restriction) -> None:
    """Restrict this process and all processes that it starts, irrevocably. Raises OSError.

    Restrictions that `find_missing` lists are omitted.
    """
    if sys.platform != "linux":
        return
    libc = ctypes.CDLL(None, use_errno=True)
    check_result(libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))
    version = _landlock_version()
    if version >= 1:
        _restrict_files(libc, version, restriction)
    if has_seccomp():
        filter_calls(libc, network=not restriction.network, signals=version < 6)


def _landlock_version() -> int:
    """Return the version of Landlock, 0 if it is not available."""
    libc = ctypes.CDLL(None, use_errno=True)
    flag = ctypes.c_uint32(LANDLOCK_CREATE_RULESET_VERSION)
    return max(0, int(libc.syscall(LANDLOCK_CREATE_RULESET, None, ctypes.c_size_t(0), flag)))


def _restrict_files(libc: ctypes.CDLL, version: int, restriction: Restriction) -> None:
    files = sum(bits for first, bits in FILES if version >= first)
    network = BIND_TCP | CONNECT_TCP if version >= 4 and not restriction.network else 0
    scoped = SCOPE_ABSTRACT_UNIX_SOCKET | SCOPE_SIGNAL if version >= 6 else 0
    words = [files, network, scoped][: 1 if version < 4 else 2 if version < 6 else 3]
    attributes = struct.pack(f"={len(words)}Q", *words)
    ruleset = check_result(
        libc.syscall(LANDLOCK_CREATE_RULESET, attributes, ctypes.c_size_t(len(attributes)), ctypes.c_uint32(0))
    )
    try:
        for name in ("/dev/null", *restriction.writable):
            _allow_below(libc, ruleset, name, files)
        check_result(libc.syscall(LANDLOCK_RESTRICT_SELF, ruleset, ctypes.c_uint32(0)))
    finally:
        os.close(ruleset)


def _allow_below(libc: ctypes.CDLL, ruleset: int, name: str, files: int) -> None:
    descriptor = os.open(name, O_PATH | os.O_CLOEXEC)
    try:
        allowed = files if os.path.isdir(name) else files & (WRITE_FILE | TRUNCATE | IOCTL_DEV)
        rule = struct.pack("=Qi", allowed, descriptor)
        check_result(libc.syscall(LANDLOCK_ADD_RULE, ruleset, LANDLOCK_RULE_PATH_BENEATH, rule, ctypes.c_uint32(0)))
    finally:
        os.close(descriptor)
