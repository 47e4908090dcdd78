"""Child processes: forked by a flight server, or spawned if the operating system cannot fork.

The server is started for the first simulation that needs a child, and again if it has exited.
"""

from __future__ import annotations

import itertools
import os
import pickle
import shutil
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

import psutil

from ....common.process import at_end
from ....common.scratch import make_folder
from ..system.fmu import Fmu
from ..system.prepared import PreparedSystem
from . import messages
from .channel import pack, receive_frame, receive_request, send_request
from .output import forward_output
from .restriction import ProcessLimits

PATIENCE = 2.0  # s, time for a server to end
LOADING = 60.0  # s, time for a spawned child to load its modules
GRACE = 1.0  # s, time for a child to end after its channel is closed
CAN_FORK = hasattr(os, "fork")
SAME_HASHES = {"PYTHONHASHSEED": "0"}  # Python FMUs iterate over sets in the same order in every process
_lock = threading.RLock()
_numbers = itertools.count(1)
Subject = PreparedSystem | Fmu  # of a child; the server keeps it while it exists in this process


@dataclass(frozen=True)
class ForkedChild:
    """Child of a flight server, with this process's end of its channel."""

    server: ServerProcess
    number: int
    channel: socket.socket

    @property
    def is_over(self) -> bool:
        """True if the child has exited, although its channel may still be open."""
        return bool(self.server.ask(messages.ExitQuery(self.number), True))

    def end(self, *, kill: bool) -> messages.ChildExit:
        """Close the channel and wait for the child to exit, or kill it. Call this only once."""
        _close_channel(self.channel)
        child_exit: messages.ChildExit = self.server.ask(
            messages.EndChild(self.number, kill), messages.ChildExit(0, messages.SERVER_ENDED)
        )
        return child_exit


class ServerProcess:
    """Flight server of this process, which exits with this process."""

    def __init__(self) -> None:
        self._control, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                _python_command(f"from {__package__}.server import main; main({theirs.fileno()})"),
                stdin=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                env={**os.environ, **SAME_HASHES},
                start_new_session=True,
            )
        self._keys: dict[int, int] = {}  # keys of the server's subjects, by identity
        self._forgotten: deque[int] = deque()  # keys of subjects that the server has yet to discard
        self.is_running, self._has_served = True, False

    def close(self) -> None:
        """End the server and all its children; kill a server that never forked, since it may still be loading."""
        self.is_running = False
        if not self._has_served:
            self._process.kill()
        self._control.close()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(PATIENCE)

    def fork(
        self, subject: Subject, task: messages.Task, *, folder: str, limits: ProcessLimits, files: Sequence[int] = ()
    ) -> ForkedChild:
        """Fork a child that does a task in a folder. Raises OSError if the server has exited."""
        ours, theirs = socket.socketpair()
        with theirs, _lock:
            self._has_served = True
            try:
                while self._forgotten:
                    send_request(self._control, messages.Forget(self._forgotten.popleft()))
                number, (key, content) = next(_numbers), self._identify_subject(subject)
                order = messages.Begin(number, key, content, task, folder, limits)
                send_request(self._control, order, [theirs.fileno(), *files])
            except OSError:
                ours.close()
                self.is_running = False
                raise
        return ForkedChild(self, number, ours)

    def _identify_subject(self, subject: Subject) -> tuple[int, bytes | None]:
        """Return the key of a subject, and its pickle unless the server already has the subject."""
        identity = id(subject)
        if identity in self._keys:
            return self._keys[identity], None
        self._keys[identity] = next(_numbers)
        weakref.finalize(subject, self._forget, identity).atexit = False
        return self._keys[identity], _pack_subject(subject)

    def _forget(self, identity: int) -> None:
        """Note that a subject no longer exists. The garbage collector may call this even during a request."""
        self._forgotten.append(self._keys.pop(identity))

    def ask(self, request: messages.ExitQuery | messages.EndChild, otherwise: Any) -> Any:
        """Return the server's answer, or ``otherwise`` if the server has exited."""
        with _lock, suppress(OSError, EOFError):
            send_request(self._control, request)
            return receive_request(self._control)[0]
        self.is_running = False
        return otherwise


class SpawnedChild:
    """Child with a new interpreter, which takes a second to load, and with the interface of `ForkedChild`."""

    def __init__(self, subject: Subject, task: messages.Task, folder: str, memory: int, files: Sequence[int]):
        self.channel, theirs = socket.socketpair()
        self._scratch, self._memory, self._reason = make_folder(), memory, ""
        with theirs:
            self._process = subprocess.Popen(
                _python_command(f"from {__package__}.child import main; main()"),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                cwd=folder,
                env={**os.environ, **SAME_HASHES, **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(self._scratch))},
                pass_fds=() if sys.platform == "win32" else [theirs.fileno(), *files],
            )
            channel: int | bytes = theirs.fileno()
            if sys.platform == "win32":
                channel = theirs.share(self._process.pid)
            order = messages.SpawnOrder(os.getpid(), channel, list(files), task, _pack_subject(subject))
            assert self._process.stdin is not None
            with suppress(OSError), self._process.stdin as standard_input:  # the child may have ended
                standard_input.write(pickle.dumps(order, pickle.HIGHEST_PROTOCOL))
        self.channel.settimeout(LOADING)
        with suppress(OSError, EOFError):  # if this fails, so does the first request
            receive_frame(self.channel)  # the child is loaded, and time limits on calls of FMUs apply from here on
        self._reader = threading.Thread(
            target=forward_output, args=(self._process.stdout, subject.printers), daemon=True
        )
        self._reader.start()

    @property
    def is_over(self) -> bool:
        """True if the child has exited. Kills it if it exceeds its memory limit."""
        with suppress(psutil.Error):
            if psutil.Process(self._process.pid).memory_info().rss > self._memory:
                self._reason = messages.OVER_MEMORY_LIMIT
                self._process.kill()
                self._process.wait()
        return self._process.poll() is not None

    def end(self, *, kill: bool) -> messages.ChildExit:
        """See `ForkedChild.end`."""
        _close_channel(self.channel)
        try:
            self._process.wait(0.0 if kill else GRACE)
        except subprocess.TimeoutExpired:
            self._reason = self._reason or ("" if kill else messages.CHANNEL_CLOSED)
            self._process.kill()
            self._process.wait()
        self._reader.join(GRACE)  # its output may remain open in a process that it started
        shutil.rmtree(self._scratch, ignore_errors=True)
        return messages.ChildExit(self._process.returncode, self._reason)


Child = ForkedChild | SpawnedChild
_server: ServerProcess | None = None


def start_server() -> ServerProcess:
    """Return the flight server of this process; the first call starts it, and loading takes some tenths of a second."""
    global _server
    with _lock:
        if _server is None or not _server.is_running:
            _server = ServerProcess()
            at_end(_server.close)
        return _server


def begin_child(
    subject: Subject, task: messages.Task, *, folder: str, limits: ProcessLimits, files: Sequence[int] = ()
) -> Child:
    """Return a child that does a task in a folder; start the server again if it has exited."""
    if not CAN_FORK:
        return SpawnedChild(subject, task, folder, limits.memory, files)
    try:
        return start_server().fork(subject, task, folder=folder, limits=limits, files=files)
    except OSError:
        return start_server().fork(subject, task, folder=folder, limits=limits, files=files)


def _pack_subject(subject: Subject) -> bytes:
    """Return the pickle of what a child needs from a system or an FMU."""
    return pack(subject.of_flights() if isinstance(subject, PreparedSystem) else subject)


def _python_command(program: str) -> list[str]:
    """Return the command line of a Python process that has this process's module path."""
    return [sys.executable, "-c", f"import sys; sys.path[:] = {sys.path!r}; {program}"]


def _close_channel(channel: socket.socket) -> None:
    with suppress(OSError):
        channel.shutdown(socket.SHUT_RDWR)
    channel.close()
