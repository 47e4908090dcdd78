"""Channels between processes: sockets for pickled orders and requests, and limited frames for children's answers.

Nothing that a child sends is executed; its frames may be malformed.
"""

from __future__ import annotations

import os
import pickle
import socket
import struct
from collections.abc import Sequence
from typing import Any

import msgspec
import numpy as np

from ....common.collection import no_collection
from .messages import Answer, Freed, Kind, Refused

LENGTH = struct.Struct("<I")
FILE_LIMIT = 2  # file descriptors with a request
HEADER = struct.Struct("<cI")
ANSWER, NUMBERS, LINE = b"A", b"N", b"L"
LONGEST = {ANSWER: 64 << 20, NUMBERS: 1 << 30, LINE: 64 << 10}  # bytes
FREED = msgspec.json.encode(Freed())
_decoder = msgspec.json.Decoder(Answer)


class ChannelError(OSError):
    """Failure of a channel, which cannot be used any more."""


class UnreadableError(Exception):
    """Bytes from a child that do not form a valid answer."""


def pack(content: Any) -> bytes:
    """Return a system or an FMU as a pickle. A large system has a million objects."""
    with no_collection():
        return pickle.dumps(content, pickle.HIGHEST_PROTOCOL)


def unpack(packed: bytes) -> Any:
    """Return the object that `pack` pickled."""
    with no_collection():
        return pickle.loads(packed)


def send_request(channel: socket.socket, request: object, descriptors: Sequence[int] = ()) -> None:
    """Send a request with its open files. Raises OSError if the receiver does not exist."""
    content = pickle.dumps(request, pickle.HIGHEST_PROTOCOL)
    head = LENGTH.pack(len(content))
    if descriptors:
        socket.send_fds(channel, [head], list(descriptors))
        channel.sendall(content)
    else:
        channel.sendall(head + content)


def receive_request(channel: socket.socket) -> tuple[Any, list[int]]:
    """Receive a request with its open files. Raises EOFError if the channel is closed, and ChannelError."""
    try:
        content, descriptors = _receive_pickle(channel)
    except OSError as error:
        raise ChannelError(error.errno, error.strerror) from None
    return pickle.loads(content), descriptors


def _receive_pickle(channel: socket.socket) -> tuple[bytes, list[int]]:
    if hasattr(socket, "recv_fds"):
        head, descriptors, _, _ = socket.recv_fds(channel, LENGTH.size, FILE_LIMIT)
    else:  # Windows
        head, descriptors = channel.recv(LENGTH.size), []
    head += _receive_bytes(channel, LENGTH.size - len(head)) if head else b""
    if not head:
        raise EOFError
    for descriptor in descriptors:
        os.set_inheritable(descriptor, False)
    return _receive_bytes(channel, *LENGTH.unpack(head)), descriptors


def _receive_bytes(channel: socket.socket, count: int) -> bytes:
    """Receive ``count`` bytes. Raises EOFError if the channel is closed before."""
    content = bytearray(count)
    view = memoryview(content)
    while view:
        received = channel.recv_into(view)
        if not received:
            raise EOFError
        view = view[received:]
    return bytes(content)


def send_answer(channel: socket.socket, answer: Answer) -> None:
    """Send the answer to a request. Raises ChannelError."""
    _send_frame(channel, ANSWER, msgspec.json.encode(answer))


def send_numbers(channel: socket.socket, numbers: np.ndarray) -> None:
    """Send an answer that consists of float64 numbers. Raises ChannelError."""
    _send_frame(channel, NUMBERS, np.ascontiguousarray(numbers, dtype=np.float64).tobytes())


def send_line(channel: socket.socket, line: str) -> None:
    """Send a message of an FMU, which the receiver writes to standard error. Raises ChannelError."""
    _send_frame(channel, LINE, line.encode(errors="replace")[: LONGEST[LINE]])


def _send_frame(channel: socket.socket, kind: bytes, content: bytes) -> None:
    try:
        channel.sendall(HEADER.pack(kind, len(content)) + content)
    except OSError as error:
        raise ChannelError(error.errno, error.strerror) from None


def receive_frame(channel: socket.socket) -> tuple[bytes, bytes]:
    """Receive a frame from a child, and return its kind and content. Raises UnreadableError and EOFError."""
    kind, length = HEADER.unpack(_receive_bytes(channel, HEADER.size))
    if length > LONGEST.get(kind, -1):
        raise UnreadableError
    return kind, _receive_bytes(channel, length)


def read_answer(content: bytes, expected: type[Kind]) -> Kind:
    """Return an answer of the expected kind. Raises UnreadableError, and any InputError that the child raised."""
    try:
        answer = _decoder.decode(content)
    except msgspec.MsgspecError:
        raise UnreadableError from None
    if isinstance(answer, Refused):
        raise answer.as_error()
    if not isinstance(answer, expected):
        raise UnreadableError
    return answer
