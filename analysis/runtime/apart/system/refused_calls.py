"""System calls of x86_64, a platform of FMI 2.0, that code of others may not do, or not to other processes."""

from __future__ import annotations

Values = tuple[int | str, ...]
Rule = tuple[int, dict[int, Values]]  # the number of a call, and what its arguments may be

NETWORK = {"socket": 41}
OTHERS = {
    "ptrace": 101,
    "process_vm_readv": 310,
    "process_vm_writev": 311,
    "pidfd_getfd": 438,
    "process_madvise": 440,
    "process_mrelease": 448,
    "kcmp": 312,
    "io_uring_setup": 425,  # carries out calls that no filter sees
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
# Calls that name a process: positions of arguments, from 0, and what each may be, CALLER this process's number.
# Threads of this process have numbers that no filter knows: they set themselves, as 0.
CALLER = "own"
ITSELF: Values = (0, CALLER)
PRIO_PROCESS, IOPRIO_WHO_PROCESS = 0, 1
SETTINGS: dict[str, Rule] = {  # of limits, priority, processors and pages of memory
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
SIGNALS: dict[str, Rule] = {  # to be filtered where Landlock does not
    "kill": (62, {0: (CALLER,)}),
    "tkill": (200, {0: (CALLER,)}),
    "tgkill": (234, {0: (CALLER,)}),
    "rt_sigqueueinfo": (129, {0: (CALLER,)}),
    "rt_tgsigqueueinfo": (297, {0: (CALLER,)}),
}
