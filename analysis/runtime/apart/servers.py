"""The flight server of this process: started when the first flight needs a child, again should it have ended."""

from __future__ import annotations

import itertools
import os
import socket
import subprocess
import sys
import threading
import weakref
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from ....common.process import at_end
from ..system.fmu import Fmu
from ..system.prepared import PreparedSystem
from .protocol.orders import SERVER_ENDED, Begin, End, Ended, Forget, Learn, Look
from .protocol.requests import pack, receive_request, send_request
from .started import SAME_HASHES, StartedChild
from .system.restriction import Restriction

SERVER_GONE = Ended(0, SERVER_ENDED)
PATIENCE = 2.0  # s that a server has to end
CAN_FORK = hasattr(os, "fork")
_lock = threading.RLock()
_numbers = itertools.count(1)


@dataclass(frozen=True)
class Subject:
    """System or FMU of a child, as it is sent, and its ``owner`` here: the server keeps it as long as that lives."""

    owner: object
    content: PreparedSystem | Fmu


@dataclass(frozen=True)
class Limits:
    """What a child may take, in bytes, and may not do."""

    memory: int
    restriction: Restriction | None


@dataclass(frozen=True)
class Child:
    """A process of the server's, and this end of its channel."""

    server: ServerProcess
    number: int
    channel: socket.socket

    @property
    def is_over(self) -> bool:
        """Whether it has ended, though its channel may still be open."""
        return bool(self.server.ask(Look(self.number), True))

    def end(self, *, kill: bool) -> Ended:
        """Close its channel; how it ended, of itself or killed. To be called once."""
        with suppress(OSError):
            self.channel.shutdown(socket.SHUT_RDWR)
        self.channel.close()
        ended: Ended = self.server.ask(End(self.number, kill), SERVER_GONE)
        return ended


class ServerProcess:
    """A flight server; it ends with this process."""

    def __init__(self) -> None:
        self._control, theirs = socket.socketpair()
        start = f"from {__package__}.server.server import main; main({theirs.fileno()})"
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-c", f"import sys; sys.path[:] = {sys.path!r}; {start}"],
                stdin=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                env={**os.environ, **SAME_HASHES},
                start_new_session=True,
            )
        self._keys: dict[int, int] = {}  # by identity of what the server has
        self._forgotten: deque[int] = deque()  # keys that the server is still to forget
        self.is_there, self._has_served = True, False

    def close(self) -> None:
        """End it, with all its children; at once where it never had one, as it may still be loading."""
        self.is_there = False
        if not self._has_served:
            self._process.kill()
        self._control.close()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(PATIENCE)

    def fork(self, subject: Subject, task: Any, *, folder: str, limits: Limits, files: Sequence[int] = ()) -> Child:
        """A child that does a task of `messages` in a folder. Raises OSError where the server has ended."""
        ours, theirs = socket.socketpair()
        with theirs, _lock:
            self._has_served = True
            try:
                key = self._known(subject)
                number = next(_numbers)
                send_request(
                    self._control,
                    Begin(number, key, task, folder, limits.memory, limits.restriction),
                    [theirs.fileno(), *files],
                )
            except OSError:
                ours.close()
                self.is_there = False
                raise
        return Child(self, number, ours)

    def _known(self, subject: Subject) -> int:
        """The key of what children work on, which the server is sent once."""
        identity = id(subject.owner)
        if identity not in self._keys:
            key = self._keys[identity] = next(_numbers)
            content = pack(subject.content)
            send_request(self._control, Learn(key, content))
            weakref.finalize(subject.owner, self._forget, identity).atexit = False
        while self._forgotten:
            send_request(self._control, Forget(self._forgotten.popleft()))
        return self._keys[identity]

    def _forget(self, identity: int) -> None:
        """Called by the garbage collector, at any time: also while something else is sent."""
        self._forgotten.append(self._keys.pop(identity))

    def ask(self, request: Look | End, otherwise: Any) -> Any:
        """What the server answers; ``otherwise`` where it has ended."""
        with _lock, suppress(OSError, EOFError):
            send_request(self._control, request)
            return receive_request(self._control)[0]
        self.is_there = False
        return otherwise


AnyChild = Child | StartedChild
_server: ServerProcess | None = None


def start_server() -> ServerProcess:
    """The flight server of this process. It is worth calling early: a server takes some tenths of a second to load."""
    global _server
    with _lock:
        if _server is None or not _server.is_there:
            _server = ServerProcess()
            at_end(_server.close)
        return _server


def begin_child(subject: Subject, task: Any, *, folder: str, limits: Limits, files: Sequence[int] = ()) -> AnyChild:
    """A child of the server, which is started again should it have ended; see `ServerProcess.fork`.

    Where the operating system cannot fork, a process that is started anew.
    """
    if not CAN_FORK:
        return StartedChild(subject.content, task, folder, limits.memory, files)
    try:
        return start_server().fork(subject, task, folder=folder, limits=limits, files=files)
    except OSError:
        return start_server().fork(subject, task, folder=folder, limits=limits, files=files)
