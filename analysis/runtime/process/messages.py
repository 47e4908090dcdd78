"""Messages between a process, its flight server and the server's children.

Orders to the server and requests to a child are pickled, since Perilune's code is on both sides. A child also executes
foreign code: its answers are JSON with declared fields.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import msgspec
import numpy as np

from ....common.errors import InputError
from ...options.fault import Fault
from ..flight.selection import Selection
from ..instances.renewal import ResetVerdict
from ..ssp.parameter_values import ParameterValue
from .restriction import ProcessLimits

# Tasks of children


@dataclass(frozen=True)
class SystemTask:
    """Task to simulate a system.

    ``log`` is the level of messages, which are printf formats if ``formats`` is true (FMI 2.0). ``signals`` and
    ``rows`` are the dimensions of the recorder, and ``recorder`` is the name of its shared memory.
    """

    selection: Selection
    log: str | None
    formats: bool
    signals: int
    rows: int
    recorder: str


@dataclass(frozen=True)
class ResetTask:
    """Task to test how an FMU can be restored; for ``formats`` see `SystemTask`, for ``with_reset`` `try_renewals`."""

    formats: bool
    with_reset: bool


Task = SystemTask | ResetTask


# Orders to a flight server, which answers `ExitQuery` and `EndChild`


@dataclass(frozen=True)
class Begin:
    """Order to fork a child; its channel and the recorder's file are attached.

    ``content`` is the pickle of the child's subject, a system or an FMU, or None if the server already has it by its
    ``key``.
    """

    number: int
    key: int
    content: bytes | None
    task: Task
    folder: str
    limits: ProcessLimits


@dataclass(frozen=True)
class Forget:
    """Order to discard a subject that no further child needs."""

    key: int


@dataclass(frozen=True)
class ExitQuery:
    """Query whether a child has exited; its channel may remain open in processes that it started."""

    number: int


@dataclass(frozen=True)
class EndChild:
    """Order to end a child, or to ``kill`` it; the answer is a `ChildExit`."""

    number: int
    kill: bool


@dataclass(frozen=True)
class SpawnOrder:
    """Order to a spawned child, on its standard input.

    ``channel`` and ``files`` are inherited descriptors; on Windows ``channel`` is a shared socket.
    """

    parent: int  # process with which the child ends
    channel: int | bytes
    files: list[int]
    task: Task
    content: bytes  # pickle of its subject


# Reasons why a child was killed, or failed
OVER_MEMORY_LIMIT = "out of memory"
NEAR_MEMORY_LIMIT = "near its memory limit"
CHANNEL_CLOSED = "it closed its channel"
SERVER_ENDED = "the flight server has ended"
NO_CHANNEL = 76  # exit status (sysexits.h) of a child that cannot use its channel


@dataclass(frozen=True)
class ChildExit:
    """Exit ``status`` of a child, negative for a signal, and the ``reason`` if it is known."""

    status: int
    reason: str = ""


# Requests to a child


@dataclass(frozen=True)
class Simulate:
    """Request to simulate between two communication points, with the values and faults that have changed.

    ``recorder`` is the number of one of the child's recorders.
    """

    recorder: int
    first: int
    last: int
    every: int
    values: dict[str, ParameterValue]
    faults: tuple[Fault | None, ...] | None
    excitation: np.ndarray | None


@dataclass(frozen=True)
class StoreVerdicts:
    """Request, without an answer, to store verdicts on FMUs by SHA-256."""

    verdicts: dict[str, ResetVerdict]


@dataclass(frozen=True)
class AddRecorder:
    """Request to add a recorder with ``rows`` rows; its file is attached, or its shared memory has a ``name``."""

    number: int
    rows: int
    name: str


@dataclass(frozen=True)
class ListMemory:
    """Request for the cells of the system's memory."""


@dataclass(frozen=True)
class ReadMemory:
    """Request for the values of all cells."""


@dataclass(frozen=True)
class TakeSnapshot:
    """Request to save the memory at a communication point."""

    point: int


@dataclass(frozen=True)
class RestoreSnapshot:
    """Request to restore a snapshot and, if there is a ``cell``, set this cell to another number."""

    snapshot: int
    cell: int | None
    number: float


@dataclass(frozen=True)
class ReleaseSnapshot:
    """Request to free a snapshot."""

    snapshot: int


# Answers of a child


class Done(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Answer to a completed request; ``number`` identifies a snapshot."""

    number: int = 0


class Simulated(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Answer with the status, the message and the number of rows of a simulation."""

    status: str
    message: str
    rows: int


class Refused(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Answer with an InputError that the child raised."""

    file: str
    element: str
    problem: str
    remedy: str

    @classmethod
    def of(cls, error: InputError) -> Refused:
        """Return the answer that reports an error."""
        return cls(error.file, error.element, error.problem, error.remedy)

    def as_error(self) -> InputError:
        """Return the error, for the caller to raise."""
        return InputError(self.file, self.element, self.problem, self.remedy)


class CellList(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Answer with the fields of each `MemoryCell` of the memory."""

    entries: list[tuple[str, str | None, str | None, int]]


class DefaultsSimulated(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Answer after an FMU was simulated with its declared values; a `ResetChecked` follows.

    ``digest`` is the SHA-256 of the FMU's outputs and parameters.
    """

    digest: str


class ResetChecked(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Answer with the fields of a `ResetVerdict`."""

    renewal: str
    reason: str


class Freed(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Last answer, after all instances have been freed."""


Answer = Done | Simulated | Refused | CellList | DefaultsSimulated | ResetChecked | Freed
Kind = TypeVar("Kind", bound=msgspec.Struct)
Order = Begin | Forget | ExitQuery | EndChild
