"""What a process and its children tell each other: requests are pickles, answers JSON and numbers within bounds.

A child runs code of others, so nothing that it sends is executed, and nothing is believed to be well-formed.
"""

from __future__ import annotations

import socket
import struct
from dataclasses import dataclass
from typing import TypeVar

import msgspec
import numpy as np

from ....options.fault import Fault
from ...flight.selection import Selection
from ...instances.renewal import ResetVerdict
from ...ssp.given_values import ParameterValue
from .requests import ChannelError, receive_bytes

HEADER = struct.Struct("<cI")
ANSWER, NUMBERS, LINE = b"A", b"N", b"L"
LONGEST = {ANSWER: 64 << 20, NUMBERS: 1 << 30, LINE: 64 << 10}  # bytes


class UnreadableError(Exception):
    """What a child sent is no answer."""


# Tasks of children


@dataclass(frozen=True)
class SystemFlights:
    """To simulate a system. ``log`` is the level of messages, ``rows`` of ``signals`` what the recorder holds.

    ``formats``: messages of FMUs are formats of printf, as FMI 2.0 has them; ``recorder`` is the name of its memory.
    """

    selection: Selection
    log: str | None
    formats: bool
    signals: int
    rows: int
    recorder: str


@dataclass(frozen=True)
class ResetTrial:
    """To try what renews an FMU; ``formats`` as in `SystemFlights`, ``with_reset`` as in `try_renewals`."""

    formats: bool
    with_reset: bool


# Requests, to a child


@dataclass(frozen=True)
class Fly:
    """From one communication point to another; new values of varied parameters and faults, if there are.

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
class KnownVerdicts:
    """The verdicts on FMUs by their SHA-256; has no answer."""

    verdicts: dict[str, ResetVerdict]


@dataclass(frozen=True)
class NewRecorder:
    """Other memory for so many rows, whose file comes along, or its ``name``."""

    number: int
    rows: int
    name: str


@dataclass(frozen=True)
class ListMemory:
    """The cells of the system's memory."""


@dataclass(frozen=True)
class ReadMemory:
    """Their values."""


@dataclass(frozen=True)
class TakeSnapshot:
    point: int


@dataclass(frozen=True)
class PutBack:
    snapshot: int
    cell: int | None
    number: float


@dataclass(frozen=True)
class ReleaseSnapshot:
    snapshot: int


# Answers, from a child


class Done(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """The request is carried out; ``number`` names a snapshot."""

    number: int = 0


class Flown(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    status: str
    message: str
    rows: int


class Refused(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """An `InputError`."""

    file: str
    element: str
    problem: str
    remedy: str


class CellList(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """Names, units, components and places of `memory.Cell`."""

    entries: list[tuple[str, str | None, str | None, int]]


class Verdict(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """A `ResetVerdict`."""

    renewal: str
    reason: str


class Tried(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """The FMU has been simulated with its declared values; a `Verdict` follows.

    ``digest`` is the SHA-256 of its outputs and parameters.
    """

    digest: str


class Freed(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """The last answer: all instances are freed."""


Answer = Done | Flown | Refused | CellList | Verdict | Tried | Freed
Kind = TypeVar("Kind", bound=msgspec.Struct)
_decoder = msgspec.json.Decoder(Answer)
FREED = msgspec.json.encode(Freed())


def send_answer(channel: socket.socket, answer: Answer) -> None:
    _send(channel, ANSWER, msgspec.json.encode(answer))


def send_numbers(channel: socket.socket, values: np.ndarray) -> None:
    _send(channel, NUMBERS, np.ascontiguousarray(values, dtype=np.float64).tobytes())


def send_line(channel: socket.socket, line: str) -> None:
    """A message of an FMU, which the receiver writes to standard error."""
    _send(channel, LINE, line.encode(errors="replace")[: LONGEST[LINE]])


def _send(channel: socket.socket, kind: bytes, content: bytes) -> None:
    """Send a frame. Raises ChannelError."""
    try:
        channel.sendall(HEADER.pack(kind, len(content)) + content)
    except OSError as error:
        raise ChannelError(error.errno, error.strerror) from None


def receive_frame(channel: socket.socket) -> tuple[bytes, bytes]:
    """Kind and content of what a child sends. Raises UnreadableError and EOFError."""
    kind, length = HEADER.unpack(receive_bytes(channel, HEADER.size))
    if length > LONGEST.get(kind, -1):
        raise UnreadableError
    return kind, receive_bytes(channel, length)


def read_answer(content: bytes, expected: type[Kind]) -> Kind | Refused:
    """An answer of the expected kind. Raises UnreadableError."""
    try:
        answer = _decoder.decode(content)
    except msgspec.MsgspecError:
        raise UnreadableError from None
    if not isinstance(answer, (expected, Refused)):
        raise UnreadableError
    return answer
