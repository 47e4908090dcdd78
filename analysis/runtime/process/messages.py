"""Messages between a process, its flight server and the server's children.

Orders to the server and requests to a child are pickles, since both sides are Perilune's code. A child runs code of
others: its answers are JSON with declared fields.
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
from ..ssp.given_values import ParameterValue
from .restriction import ProcessLimits

# Tasks of children


@dataclass(frozen=True)
class SystemTask:
    """Simulation of a system. ``log`` is the level of messages; the recorder has ``rows`` of ``signals``.

    ``formats``: messages of FMUs are formats of printf, as FMI 2.0 has them; ``recorder`` is the name of its memory.
    """

    selection: Selection
    log: str | None
    formats: bool
    signals: int
    rows: int
    recorder: str


@dataclass(frozen=True)
class ResetTask:
    """Trial of what renews an FMU; ``formats`` as in `SystemTask`, ``with_reset`` as in `try_renewals`."""

    formats: bool
    with_reset: bool


Task = SystemTask | ResetTask


# Orders to a flight server, which answers `IsOver` and `EndChild`


@dataclass(frozen=True)
class Begin:
    """Fork of a child, whose channel and recorder's file are attached.

    ``content`` is its subject, a system or an FMU, pickled; None if the server has it by its ``key``.
    """

    number: int
    key: int
    content: bytes | None
    task: Task
    folder: str
    limits: ProcessLimits


@dataclass(frozen=True)
class Forget:
    """End of a subject: no more children need it."""

    key: int


@dataclass(frozen=True)
class IsOver:
    """Question if a child has ended: a process that it has started may keep its channel open."""

    number: int


@dataclass(frozen=True)
class EndChild:
    """End of a child, which may be a ``kill``; the answer is a `ChildExit`."""

    number: int
    kill: bool


@dataclass(frozen=True)
class SpawnOrder:
    """Order to a child that was not forked, on its standard input.

    ``channel`` and ``files`` are descriptors that it inherits; on Windows ``channel`` is a socket shared with it.
    """

    parent: int  # the process with which it ends
    channel: int | bytes
    files: list[int]
    task: Task
    content: bytes  # its subject, pickled


# Reasons for which a child was killed, or failed
OVER_MEMORY_LIMIT = "out of memory"
NEAR_MEMORY_LIMIT = "near its memory limit"
CHANNEL_CLOSED = "it closed its channel"
SERVER_ENDED = "the flight server has ended"
NO_CHANNEL = 76  # of sysexits.h: the exit status of a child that cannot use its channel


@dataclass(frozen=True)
class ChildExit:
    """Exit ``status`` of a child, a signal if negative, and the ``reason`` where it is known."""

    status: int
    reason: str = ""


# Requests to a child


@dataclass(frozen=True)
class Simulate:
    """Simulation between two communication points; new values of varied parameters, and faults, where they change.

    ``recorder`` is the number of one that the child has.
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
    """Verdicts on FMUs by their SHA-256; there is no answer."""

    verdicts: dict[str, ResetVerdict]


@dataclass(frozen=True)
class AddRecorder:
    """Memory for ``rows``, whose file is attached, or which has a ``name``."""

    number: int
    rows: int
    name: str


@dataclass(frozen=True)
class ListMemory:
    """Question for the cells of the system's memory."""


@dataclass(frozen=True)
class ReadMemory:
    """Question for the numbers in these cells."""


@dataclass(frozen=True)
class TakeSnapshot:
    """Copy of the memory at a communication point."""

    point: int


@dataclass(frozen=True)
class RestoreSnapshot:
    """Return to a snapshot, with another number in one cell if there is a ``cell``."""

    snapshot: int
    cell: int | None
    number: float


@dataclass(frozen=True)
class ReleaseSnapshot:
    """End of a snapshot."""

    snapshot: int


# Answers of a child


class Done(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """A request is carried out; ``number`` names a snapshot."""

    number: int = 0


class Simulated(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Status, message and number of rows of a simulation."""

    status: str
    message: str
    rows: int


class Refused(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """An InputError of the child."""

    file: str
    element: str
    problem: str
    remedy: str

    @classmethod
    def of(cls, error: InputError) -> Refused:
        """Return the answer that carries an error."""
        return cls(error.file, error.element, error.problem, error.remedy)

    def as_error(self) -> InputError:
        """Return the error, to be raised."""
        return InputError(self.file, self.element, self.problem, self.remedy)


class CellList(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Fields of each `Cell` of the memory."""

    entries: list[tuple[str, str | None, str | None, int]]


class Tried(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """An FMU has been simulated with its declared values; a `Renewed` follows.

    ``digest`` is the SHA-256 of its outputs and parameters.
    """

    digest: str


class Renewed(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Fields of a `ResetVerdict`."""

    renewal: str
    reason: str


class Freed(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """The last answer: all instances are freed."""


Answer = Done | Simulated | Refused | CellList | Tried | Renewed | Freed
Kind = TypeVar("Kind", bound=msgspec.Struct)
Order = Begin | Forget | IsOver | EndChild
