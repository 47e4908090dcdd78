"""System calls of x86_64, a platform of FMI 2.0, denied to foreign code, and the seccomp filter that denies them."""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import struct
from collections.abc import Iterable, Sequence

Values = tuple[int | str, ...]
Rule = tuple[int, dict[int, Values]]  # number of a call, and permitted values of its arguments

SOCKET = 41
OTHERS = {
    "ptrace": 101,
    "process_vm_readv": 310,
    "process_vm_writev": 311,
    "pidfd_getfd": 438,
    "process_madvise": 440,
    "process_mrelease": 448,
    "kcmp": 312,
    "io_uring_setup": 425,  # executes calls that bypass filters
    "io_uring_enter": 426,
    "io_uring_register": 427,
    "bpf": 321,
    "perf_event_open": 298,
    "userfaultfd": 323,
    "init_module": 175,
    "finit_module": 313,
    "kexec_load": 246,
    "reboot": 169,
    "add_key": 248,
    "request_key": 249,
    "keyctl": 250,
}
PIDFD_SEND_SIGNAL = 424
# Calls that name a process: permitted values by position of the argument, from 0. CALLER is this process's number.
# A filter cannot know the numbers of this process's threads: a thread may change its own settings, as number 0.
CALLER = "caller"
ITSELF: Values = (0, CALLER)
PRIO_PROCESS, IOPRIO_WHO_PROCESS = 0, 1
SETTINGS: dict[str, Rule] = {  # calls that set limits, priority, processors and pages of memory
    "prlimit64": (302, {0: ITSELF}),
    "setpriority": (141, {0: (PRIO_PROCESS,), 1: ITSELF}),
    "ioprio_set": (251, {0: (IOPRIO_WHO_PROCESS,), 1: ITSELF}),
    "sched_setaffinity": (203, {0: ITSELF}),
    "sched_setparam": (142, {0: ITSELF}),
    "sched_setscheduler": (144, {0: ITSELF}),
    "sched_setattr": (314, {0: ITSELF}),
    "migrate_pages": (256, {0: ITSELF}),
    "move_pages": (279, {0: ITSELF}),
}
SIGNALS: dict[str, Rule] = {  # filtered unless Landlock restricts signals
    "kill": (62, {0: (CALLER,)}),
    "tkill": (200, {0: (CALLER,)}),
    "tgkill": (234, {0: (CALLER,)}),
    "rt_sigqueueinfo": (129, {0: (CALLER,)}),
    "rt_tgsigqueueinfo": (297, {0: (CALLER,)}),
}

AUDIT_ARCH_X86_64 = 0xC000003E
X32 = 0x40000000  # bit of the calls of the x32 ABI

# Instructions of the filter.
LOAD, IS_EQUAL, IS_AT_LEAST, RETURN = 0x20, 0x15, 0x35, 0x06
ALLOW, REFUSE = 0x7FFF0000, 0x00050000 | errno.EPERM
NUMBER, ARCHITECTURE, FIRST_ARGUMENT, ARGUMENT_SIZE = 0, 4, 16, 8  # offsets in the filter's data
PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 22, 2


class Filter(ctypes.Structure):
    """struct sock_fprog: a filter program and the number of its instructions."""

    _fields_ = (("length", ctypes.c_ushort), ("instructions", ctypes.c_char_p))


def has_seccomp() -> bool:
    """Return True if the kernel supports filters: setting a filter at address 0 then fails because of the address."""
    if platform.machine() != "x86_64":
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    refused = libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, None, 0, 0) != 0
    return refused and ctypes.get_errno() == errno.EFAULT


def filter_calls(libc: ctypes.CDLL, *, network: bool, signals: bool) -> None:
    """Filter the system calls of this process irrevocably, on request also calls for ``network`` and ``signals``.

    Raises OSError.
    """
    refused, rules = [*OTHERS.values()], [*SETTINGS.values()]
    if network:
        refused.append(SOCKET)
    if signals:
        refused.append(PIDFD_SEND_SIGNAL)
        rules += SIGNALS.values()
    code = _instructions(refused, rules, os.getpid())
    program = Filter(len(code), b"".join(code))
    check_result(libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.byref(program), 0, 0))


def check_result(result: int) -> int:
    """Return the result of a C function. Raises OSError with its error number if the result is negative."""
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
    return result


def _instructions(refused: Sequence[int], rules: Iterable[Rule], process: int) -> list[bytes]:
    """Return a filter that denies calls of other ABIs, calls in ``refused``, and arguments against ``rules``."""
    code = [
        instruction(LOAD, ARCHITECTURE),
        instruction(IS_EQUAL, AUDIT_ARCH_X86_64, 1, 0),
        instruction(RETURN, REFUSE),
        instruction(LOAD, NUMBER),
        instruction(IS_AT_LEAST, X32, 0, 1),
        instruction(RETURN, REFUSE),
    ]
    for number in refused:
        code += [instruction(IS_EQUAL, number, 0, 1), instruction(RETURN, REFUSE)]
    for number, arguments in rules:
        checks = [each for position, values in arguments.items() for each in _argument_code(position, values, process)]
        code += [instruction(IS_EQUAL, number, 0, len(checks) + 1), *checks, instruction(RETURN, ALLOW)]
    return [*code, instruction(RETURN, ALLOW)]


def _argument_code(position: int, values: Values, process: int) -> list[bytes]:
    """Return instructions that deny a call unless its argument is one of ``values``."""
    # only the lower half, which comes first: to the kernel, these arguments are 32-bit ints
    code = [instruction(LOAD, FIRST_ARGUMENT + ARGUMENT_SIZE * position)]
    for left, number in zip(range(len(values), 0, -1), values, strict=True):
        code.append(instruction(IS_EQUAL, process if number == CALLER else int(number), left, 0))
    return [*code, instruction(RETURN, REFUSE)]


def instruction(code: int, operand: int, true: int = 0, false: int = 0) -> bytes:
    """Return one BPF instruction; a comparison skips ``true`` or ``false`` instructions."""
    return struct.pack("=HBBI", code, true, false, operand)
