"""How requests travel, to a server and to a child: as pickles behind their lengths, with open files if they have any.

Quick to import: a server is started before anything else is.
"""

from __future__ import annotations

import os
import pickle
import socket
import struct
from collections.abc import Sequence
from typing import Any

from .....common.collection import no_collection

LENGTH = struct.Struct("<I")
MOST_FILES = 2


class ChannelError(OSError):
    """A channel that cannot be used any more, at this end or the other."""


def pack(content: Any) -> bytes:
    """What children work on, as a pickle; a large system has a million objects."""
    with no_collection():
        return pickle.dumps(content, pickle.HIGHEST_PROTOCOL)


def unpack(packed: bytes) -> Any:
    """What `pack` was given."""
    with no_collection():
        return pickle.loads(packed)


def send_request(channel: socket.socket, request: Any, descriptors: Sequence[int] = ()) -> None:
    """A request, with open files if it has any. Raises OSError where nobody listens."""
    content = pickle.dumps(request, pickle.HIGHEST_PROTOCOL)
    head = LENGTH.pack(len(content))
    if descriptors:
        socket.send_fds(channel, [head], list(descriptors))
        channel.sendall(content)
    else:
        channel.sendall(head + content)


def receive_request(channel: socket.socket) -> tuple[Any, list[int]]:
    """A request and its open files; raises EOFError at the end, and ChannelError."""
    try:
        content, descriptors = _receive(channel)
    except OSError as error:
        raise ChannelError(error.errno, error.strerror) from None
    return pickle.loads(content), descriptors


def _receive(channel: socket.socket) -> tuple[bytes, list[int]]:
    if hasattr(socket, "recv_fds"):
        head, descriptors, _, _ = socket.recv_fds(channel, LENGTH.size, MOST_FILES)
    else:  # Windows
        head, descriptors = channel.recv(LENGTH.size), []
    head += receive_bytes(channel, LENGTH.size - len(head)) if head else b""
    if not head:
        raise EOFError
    for descriptor in descriptors:
        os.set_inheritable(descriptor, False)
    return receive_bytes(channel, *LENGTH.unpack(head)), descriptors


def receive_bytes(channel: socket.socket, count: int) -> bytes:
    """So many bytes; raises EOFError where they end before."""
    content = bytearray(count)
    view = memoryview(content)
    while view:
        received = channel.recv_into(view)
        if not received:
            raise EOFError
        view = view[received:]
    return bytes(content)
