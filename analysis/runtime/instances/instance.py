"""Instance of an FMU: its fmi2Component, the addresses of its C functions, and its log messages."""

from __future__ import annotations

import ctypes
import itertools
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from fmpy import fmi2, fmi3
from fmpy.logging import addLoggerProxy

from ....common.errors import InputError
from ....common.visible import visible, visible_line
from ..system.fmu import Fmu
from ..system.options import LOG_LEVELS, SAID_FROM
from .fmu_library import LOADING, Library, acquire, release
from .slaves import Fmi3Slave, Slave

MOST_MESSAGES = 1000  # messages of a component in a simulation
LONGEST_MESSAGE = 4096  # bytes
STATUSES = ("OK", "warning", "discard", "error", "fatal", "pending")


def status_word(status: int) -> str:
    """Return the name of an fmi2Status, or a text for numbers that FMI does not define."""
    return STATUSES[status] if 0 <= status < len(STATUSES) else f"{status}, which FMI does not define"


class Log:
    """Writer of the messages of a simulation's FMUs that have ``level`` (one of `LOG_LEVELS`) or are more severe.

    At most MOST_MESSAGES are written for each component. ``place`` precedes each line; in a batch it names the trial.
    If ``emit`` is passed, it receives the lines instead of standard error.
    """

    def __init__(self, level: str, emit: Callable[[str], None] | None = None) -> None:
        self.level = level
        self.place = ""
        self.emit = self.write_line if emit is None else emit
        self._counts: dict[str, int] = {}  # numbers of messages by component
        self._clock: Callable[[], float] | None = None

    @property
    def everything(self) -> bool:
        """True if FMUs are asked to log all of their categories."""
        return self.level == LOG_LEVELS[-1]

    def follow(self, clock: Callable[[], float]) -> None:
        """Write the simulation time (s) returned by ``clock`` in front of each message."""
        self._clock = clock

    def write(self, component: str, status: int, category: str, message: str) -> None:
        """Write a message on one line; the lines of an FMU's message are joined by " | "."""
        if not 0 <= status < len(STATUSES) or status >= SAID_FROM[self.level]:
            time = "" if self._clock is None else f"t = {self._clock():.9g} s: "
            self._counts[component] = self._counts.get(component, 0) + 1
            if self._counts[component] > MOST_MESSAGES:
                return
            text = visible_line(" | ".join(line for line in message.splitlines() if line.strip()), LONGEST_MESSAGE)
            label = f" ({category})" if category else ""
            self.emit(f"{time}{component}: {status_word(status)}{label}: {text}")

    def close(self) -> None:
        """Write the numbers of omitted messages."""
        for component, count in self._counts.items():
            if count > MOST_MESSAGES:
                self.emit(f"{component}: and {count - MOST_MESSAGES} more messages")
        self._counts = {}

    def write_line(self, line: str) -> None:
        """Write a complete line to standard error, or to ``emit``."""
        sys.stderr.write(f"log: {self.place}{line}\n")
        sys.stderr.flush()


PLACED = {"Boolean": 0, "Real": 1, "Integer": 2}  # FMI types as `perilune_place` numbers them


@dataclass
class Instance:
    """Instance of an FMU with its log. Free it with `free`."""

    fmu: Fmu
    name: str
    library: Library
    slave: Slave
    raw_messages: list[bytes]
    log: Log | None = None
    uses_events: bool = False
    is_there: bool = True

    @property
    def address(self) -> int:
        """Address of the fmi2Component or fmi3Instance."""
        return int(self.slave.component)

    @property
    def is_self_contained(self) -> bool:
        """True if calls of the FMU change nothing else in the process."""
        return self.fmu.is_self_contained

    @property
    def messages(self) -> list[str]:
        """Messages of the FMU since the beginning of the current simulation."""
        return [_text(message) for message in self.raw_messages]

    def function_addresses(self) -> list[int]:
        """Return the addresses of the C functions, in the order of `library.FUNCTION_NAMES`."""
        return self.library.addresses

    def locate(self, references: np.ndarray, kind: str, *, to_set: bool = False) -> int:
        """Return the address of values that are contiguous in this instance's memory, in order.

        ``references`` are uint32 value references of variables of one ``kind``, which is a key of PLACED. The values
        may be read at this address between steps, and written if ``to_set``. The address is 0 if the values are not
        contiguous, or if the FMU does not disclose it.
        """
        if self.library.place is None:
            return 0
        return self.library.place(self.address, references.ctypes.data, references.size, PLACED[kind], to_set) or 0

    def state(self) -> object:
        """Return the FMU's state. Free it with `free_state`."""
        slave = self.slave
        return slave.getFMUState() if isinstance(slave, Fmi3Slave) else slave.getFMUstate()

    def set_state(self, state: object) -> None:
        slave = self.slave
        (slave.setFMUState if isinstance(slave, Fmi3Slave) else slave.setFMUstate)(state)

    def free_state(self, state: object) -> None:
        slave = self.slave
        (slave.freeFMUState if isinstance(slave, Fmi3Slave) else slave.freeFMUstate)(state)

    def serialize(self, state: object) -> bytes:
        slave = self.slave
        call = slave.serializeFMUState if isinstance(slave, Fmi3Slave) else slave.serializeFMUstate
        return bytes(call(state))

    def deserialize(self, serialized: bytes) -> object:
        """Return a new state from its serialised form. Free it with `free_state`."""
        slave = self.slave
        return (slave.deserializeFMUState if isinstance(slave, Fmi3Slave) else slave.deSerializeFMUstate)(serialized)

    def free(self) -> None:
        if self.is_there:
            self.is_there = False
            _logs.pop(self.slave.instanceName, None)
            if isinstance(self.slave, Fmi3Slave):
                _environments.pop(self.slave.environment, None)
                self.slave.fmi3FreeInstance(self.slave.component)
            else:
                self.slave.fmi2FreeInstance(self.slave.component)
            _alone.discard(self.fmu.digest)
            release(self.fmu)

    def abandon(self) -> None:
        """Mark the instance as unusable: it is neither called nor freed any more."""
        self.is_there = False
        _alone.discard(self.fmu.digest)

    def renew(self) -> None:
        """Instantiate the FMU again to replace the freed instance. Raises InputError."""
        fresh = instantiate(self.fmu, self.name, self.log, uses_events=self.uses_events)
        self.library, self.slave, self.raw_messages, self.is_there = (
            fresh.library,
            fresh.slave,
            fresh.raw_messages,
            True,
        )


Listener = Callable[[int, str, str], None]  # fmi2Status, category, message


class _MessageLog(list[bytes]):
    """Messages of an FMU in order of arrival, with an additional listener."""

    listener: Listener | None = None


# FMPy's proxy, which formats printf messages, has one logger per process, which finds the log by instance name.
_logs: dict[str, _MessageLog] = {}
_environments: dict[int, _MessageLog] = {}  # the same for FMI 3.0, by the pointer passed to instances
_instances = itertools.count(1)
_alone: set[str] = set()  # digests of instantiated FMUs that a process can only instantiate once


def _log(_environment: object, instance: bytes, status: int, category: bytes, message: bytes) -> None:
    _log_message(_logs.get((instance or b"").decode(errors="replace")), status, category, message)


def _log_of_fmi3(environment: int | None, status: int, category: bytes, message: bytes) -> None:
    _log_message(_environments.get(environment or 0), status, category, message)


def _log_message(log: _MessageLog | None, status: int, category: bytes, message: bytes) -> None:
    if log is not None and message:
        if len(log) < MOST_MESSAGES:
            log.append(message[:LONGEST_MESSAGE])
        if log.listener is not None:
            log.listener(status, _text(category or b""), _text(message))


def _text(message: bytes) -> str:
    return visible(message[:LONGEST_MESSAGE].decode(errors="replace").strip())


def _make_callbacks() -> fmi2.fmi2CallbackFunctions:
    callbacks = fmi2.fmi2CallbackFunctions()
    callbacks.logger = _logger
    callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
    callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
    return callbacks


def _make_formatting_callbacks() -> fmi2.fmi2CallbackFunctions:
    """Return callbacks that format printf messages (FMI 2.0), whose arguments may be missing.

    FMPy's formatting library has one logger for the entire process, which FMPy replaces by its own whenever it
    simulates.
    """
    callbacks = _make_callbacks()
    addLoggerProxy(ctypes.byref(callbacks))
    return callbacks


_logger = fmi2.fmi2CallbackLoggerTYPE(_log)
_plain_callbacks = _make_callbacks()
_fmi3_callback = fmi3.fmi3LogMessageCallback(_log_of_fmi3)  # messages of FMI 3.0 contain no format
_formats = True


def leave_messages_unformatted() -> None:
    """Write messages of FMUs that are instantiated from now on without formatting their arguments."""
    global _formats
    _formats = False


def instantiate(fmu: Fmu, name: str, log: Log | None = None, *, uses_events: bool = False) -> Instance:
    """Instantiate an FMU for the component ``name``, to which a suffix is added that is unique in the process.

    ``log`` receives its messages. With ``uses_events`` the instance uses event mode of FMI 3.0, which the FMU must
    support. Raises InputError.
    """
    if fmu.is_alone:
        with LOADING:
            if fmu.digest in _alone:
                problem = "can be instantiated only once in a process (canBeInstantiatedOnlyOncePerProcess)"
                raise InputError(
                    fmu.label, name, problem, "run one simulation at a time, or export the FMU for several instances"
                )
            _alone.add(fmu.digest)
    number = next(_instances)
    unique = f"{name}#{number}"
    _logs[unique] = _MessageLog()
    if log is not None:
        _logs[unique].listener = partial(log.write, name)
    library = None
    try:
        library = acquire(fmu)
        slave = library.slave(unique)
        if isinstance(slave, Fmi3Slave):
            _environments[number] = _logs[unique]
            slave.begin(number, _fmi3_callback, uses_events=uses_events)
        else:
            callbacks = _make_formatting_callbacks() if _formats else _plain_callbacks
            slave.instantiate(callbacks=callbacks, loggingOn=True)
        if log is not None and log.everything:
            slave.setDebugLogging(True, [])  # all categories, as none is named
    except Exception as error:  # fmpy raises bare Exception when the library does not load or instantiate
        _alone.discard(fmu.digest)
        if library is not None:
            release(fmu)
        said = " | ".join([str(error), *map(_text, _logs.pop(unique))])
        raise InputError(fmu.label, name, f"cannot be instantiated: {said}", "see the FMU's log") from error
    return Instance(fmu, name, library, slave, _logs[unique], log, uses_events)
