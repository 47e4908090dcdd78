"""What code of others may not do in its process: write elsewhere, use the network, reach other processes.

Linux alone has this without rights of an administrator: Landlock for files and signals (Linux 5.13 and later), seccomp
for system calls. Both stay for whatever the process starts. Reading is not restricted.
"""

from __future__ import annotations

import ctypes
import errno
import functools
import os
import platform
import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from .refused_calls import CALLER, NETWORK, OTHERS, PIDFD_SEND_SIGNAL, SETTINGS, SIGNALS, Rule, Values
from .system_calls import IS_LINUX

PR_SET_NO_NEW_PRIVS, PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 38, 22, 2
LANDLOCK_CREATE_RULESET, LANDLOCK_ADD_RULE, LANDLOCK_RESTRICT_SELF = 444, 445, 446
LANDLOCK_CREATE_RULESET_VERSION, LANDLOCK_RULE_PATH_BENEATH = 1, 1
O_PATH = 0o10000000

# LANDLOCK_ACCESS_FS_..., by the version of Landlock that has them first.
WRITE_FILE = 1 << 1
CHANGES_FOLDERS = sum(1 << bit for bit in range(4, 13))  # remove and make files, folders, devices, links
REFER, TRUNCATE, IOCTL_DEV = 1 << 13, 1 << 14, 1 << 15
FILES = ((1, WRITE_FILE | CHANGES_FOLDERS), (2, REFER), (3, TRUNCATE), (5, IOCTL_DEV))
BIND_TCP, CONNECT_TCP = 1, 2  # from version 4 on
SCOPE_ABSTRACT_UNIX_SOCKET, SCOPE_SIGNAL = 1, 2  # from version 6 on

AUDIT_ARCH_X86_64 = 0xC000003E
X32 = 0x40000000  # the bit of calls of another interface to the same kernel

# Instructions of the filter.
LOAD, IS_EQUAL, IS_AT_LEAST, RETURN = 0x20, 0x15, 0x35, 0x06
ALLOW, REFUSE = 0x7FFF0000, 0x00050000 | errno.EPERM
NUMBER, ARCHITECTURE, FIRST_ARGUMENT, ARGUMENT_SIZE = 0, 4, 16, 8  # where the filter's data has them


@dataclass(frozen=True)
class Restriction:
    """``writable`` folders and files; whether the ``network`` is open."""

    writable: tuple[str, ...]
    network: bool


@functools.cache
def find_missing() -> tuple[str, ...]:
    """What this system lacks for a restriction to hold, in words."""
    if not IS_LINUX:
        return ("only Linux restricts processes",)
    missing = []
    if _landlock_version() < 1:
        missing.append("no Landlock, so they can write wherever you can")
    if not _has_seccomp():
        missing.append("no seccomp filters, so they can use the network and reach your processes")
    return tuple(missing)


def restrict(restriction: Restriction) -> None:
    """Restrict this process, and all that it starts, for good; as far as `find_missing` says. Raises OSError."""
    if not IS_LINUX:
        return
    libc = ctypes.CDLL(None, use_errno=True)
    _check(libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0))
    version = _landlock_version()
    if version >= 1:
        _restrict_files(libc, version, restriction)
    if _has_seccomp():
        _filter_calls(libc, restriction, signals_are_free=version < 6)


def _landlock_version() -> int:
    """0 where there is none."""
    libc = ctypes.CDLL(None, use_errno=True)
    flag = ctypes.c_uint32(LANDLOCK_CREATE_RULESET_VERSION)
    return max(0, int(libc.syscall(LANDLOCK_CREATE_RULESET, None, ctypes.c_size_t(0), flag)))


def _has_seccomp() -> bool:
    """Whether the kernel takes filters: one that lies nowhere is refused for that reason alone."""
    if platform.machine() != "x86_64":
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    refused = libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, None, 0, 0) != 0
    return refused and ctypes.get_errno() == errno.EFAULT


def _check(result: int) -> int:
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
    return result


def _restrict_files(libc: ctypes.CDLL, version: int, restriction: Restriction) -> None:
    files = sum(bits for first, bits in FILES if version >= first)
    network = BIND_TCP | CONNECT_TCP if version >= 4 and not restriction.network else 0
    scoped = SCOPE_ABSTRACT_UNIX_SOCKET | SCOPE_SIGNAL if version >= 6 else 0
    words = [files, network, scoped][: 1 if version < 4 else 2 if version < 6 else 3]
    attributes = struct.pack(f"={len(words)}Q", *words)
    ruleset = _check(
        libc.syscall(LANDLOCK_CREATE_RULESET, attributes, ctypes.c_size_t(len(attributes)), ctypes.c_uint32(0))
    )
    try:
        for name in ("/dev/null", *restriction.writable):
            _allow_below(libc, ruleset, name, files)
        _check(libc.syscall(LANDLOCK_RESTRICT_SELF, ruleset, ctypes.c_uint32(0)))
    finally:
        os.close(ruleset)


def _allow_below(libc: ctypes.CDLL, ruleset: int, name: str, files: int) -> None:
    descriptor = os.open(name, O_PATH | os.O_CLOEXEC)
    try:
        allowed = files if os.path.isdir(name) else files & (WRITE_FILE | TRUNCATE | IOCTL_DEV)
        rule = struct.pack("=Qi", allowed, descriptor)
        _check(libc.syscall(LANDLOCK_ADD_RULE, ruleset, LANDLOCK_RULE_PATH_BENEATH, rule, ctypes.c_uint32(0)))
    finally:
        os.close(descriptor)


class _Filter(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p))


def _filter_calls(libc: ctypes.CDLL, restriction: Restriction, *, signals_are_free: bool) -> None:
    refused = [*OTHERS.values(), *(() if restriction.network else NETWORK.values())]
    rules = list(SETTINGS.values())
    if signals_are_free:
        refused.append(PIDFD_SEND_SIGNAL)
        rules += SIGNALS.values()
    code = _filter_code(refused, rules, os.getpid())
    whole = _Filter(len(code), b"".join(code))
    _check(libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(whole), 0, 0))


def _filter_code(refused: Sequence[int], rules: Iterable[Rule], process: int) -> list[bytes]:
    """Instructions: calls of another interface and ``refused`` ones fail, and such as break their ``rules``."""
    code = [
        _instruction(LOAD, ARCHITECTURE),
        _instruction(IS_EQUAL, AUDIT_ARCH_X86_64, 1, 0),
        _instruction(RETURN, REFUSE),
        _instruction(LOAD, NUMBER),
        _instruction(IS_AT_LEAST, X32, 0, 1),
        _instruction(RETURN, REFUSE),
    ]
    for number in refused:
        code += [_instruction(IS_EQUAL, number, 0, 1), _instruction(RETURN, REFUSE)]
    for number, arguments in rules:
        checks = [each for position, values in arguments.items() for each in _argument_code(position, values, process)]
        code += [_instruction(IS_EQUAL, number, 0, len(checks) + 1), *checks, _instruction(RETURN, ALLOW)]
    return [*code, _instruction(RETURN, ALLOW)]


def _argument_code(position: int, values: Values, process: int) -> list[bytes]:
    """Instructions that refuse a call whose argument is none of some values."""
    # processes and kinds of them are ints, to the kernel too: the lower half, which comes first
    code = [_instruction(LOAD, FIRST_ARGUMENT + ARGUMENT_SIZE * position)]
    for left, number in zip(range(len(values), 0, -1), values, strict=True):
        code.append(_instruction(IS_EQUAL, process if number == CALLER else int(number), left, 0))
    return [*code, _instruction(RETURN, REFUSE)]


def _instruction(code: int, operand: int, true: int = 0, false: int = 0) -> bytes:
    """One of BPF; ``true`` and ``false`` are how many a comparison skips."""
    return struct.pack("=HBBI", code, true, false, operand)
