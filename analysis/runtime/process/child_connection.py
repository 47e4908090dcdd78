"""Connection to a child: one request and answer at a time, a time limit for each call, and the child's end as text."""

from __future__ import annotations

import select
import signal
import socket
import time
import weakref
from collections.abc import Callable, Sequence
from contextlib import suppress

import numpy as np

from ....common.errors import EndedError, ExitStatus
from ..flight.results import CRASHED, HUNG, OUT_OF_MEMORY
from . import messages
from .channel import ANSWER, FREED, LINE, NUMBERS, UnreadableError, read_answer, receive_frame, send_request
from .children import Child

POLL_PERIOD = 0.25  # s, between checks of a silent child
FRAME_TIMEOUT = 10.0  # s, longest time between bytes of an answer
REPEAT = "simulate again; if memory ran out, with fewer `workers`"
PATIENCE = 1.5  # s, time for a child to free its instances


class ServerEndedError(EndedError):
    """End of a child because its flight server ended, not because of an FMU."""


class ChildEndedError(Exception):
    """End of a child before it answered: ``status`` is one of LOST, ``how`` a description."""

    def __init__(self, status: str, how: str) -> None:
        super().__init__(status, how)
        self.status = status
        self.how = how


class Watchdog:
    """Limit (s) on the time without progress; the value returned by ``measure`` changes with every progress."""

    def __init__(self, measure: Callable[[], object], limit: float) -> None:
        self._measure, self.limit = measure, limit
        self.start()

    def start(self) -> None:
        """Restart the timer."""
        self._state, self._since = self._measure(), time.monotonic()

    def has_expired(self) -> bool:
        """Return True if there has been no progress for longer than the limit."""
        state = self._measure()
        if state != self._state:
            self._state, self._since = state, time.monotonic()
        return time.monotonic() - self._since > self.limit


class ChildConnection:
    """Connection to a child; ``write`` receives log lines of FMUs. Other threads may only call `abort`."""

    def __init__(self, child: Child, write: Callable[[str], None], watchdog: Watchdog) -> None:
        self._child = child
        self._write = write
        self._watchdog = watchdog
        self._abort_reason = ""
        child.channel.settimeout(FRAME_TIMEOUT)
        self._end = weakref.finalize(self, child.end, kill=True)

    @property
    def is_open(self) -> bool:
        return self._end.alive

    def ask(self, request: object, expected: type[messages.Kind], files: Sequence[int] = ()) -> messages.Kind:
        """Send a request and return its answer.

        Raises ChildEndedError, ServerEndedError, and any InputError that the child raised.
        """
        self.send(request, files)
        return self.receive(expected)

    def ask_numbers(self, request: object, count: int) -> np.ndarray:
        """Send a request and return its answer, ``count`` float64 numbers; errors are as in `ask`."""
        self.send(request)
        kind, content = self._receive()
        if kind == NUMBERS and len(content) == 8 * count:
            return np.frombuffer(content)
        self._read(kind, content, messages.Refused)
        raise AssertionError  # `Refused` raises its error

    def send(self, request: object, files: Sequence[int] = ()) -> None:
        """Send a request without an answer, or with an answer for `receive`; do nothing if the child has exited."""
        with suppress(OSError):
            send_request(self._child.channel, request, files)

    def receive(self, expected: type[messages.Kind]) -> messages.Kind:
        """Return the answer to the last request; errors are as in `ask`."""
        return self._read(*self._receive(), expected)

    def abort(self, why: str) -> None:
        """End the child because a call does not return, and wake the thread that waits for it."""
        self._abort_reason = why
        with suppress(OSError):
            self._child.channel.shutdown(socket.SHUT_RDWR)  # wakes the waiting thread

    def close(self) -> str:
        """Let the child free its instances within PATIENCE and exit; return the description of a problem, or ""."""
        if not self.is_open:
            return ""
        answer = self._last_answer()
        ended = self._finish(kill=answer is None)
        if ended is not None and ended.reason == messages.SERVER_ENDED:
            return ""
        if answer is None:
            return f"its process did not end within {PATIENCE:g} s"
        return "" if ended is None or answer == FREED else f"its process ended {_in_words(ended.status)}"

    def kill(self) -> None:
        """Kill the child."""
        self._finish(kill=True)

    def _last_answer(self) -> bytes | None:
        """Let the child free its instances; return its last answer, or None if its channel does not close in time."""
        answer = b""
        channel, deadline = self._child.channel, time.monotonic() + PATIENCE
        try:
            channel.shutdown(socket.SHUT_WR)
            while time.monotonic() < deadline:
                channel.settimeout(max(deadline - time.monotonic(), POLL_PERIOD))
                kind, content = receive_frame(channel)
                if kind == LINE:
                    self._write(content.decode(errors="replace"))
                else:
                    answer = content
        except EOFError:
            return answer
        except (OSError, ValueError, UnreadableError):
            pass
        return None

    def _finish(self, *, kill: bool) -> messages.ChildExit | None:
        """End the child and return its exit; return None if it was ended before."""
        return None if self._end.detach() is None else self._child.end(kill=kill)

    def _receive(self) -> tuple[bytes, bytes]:
        """Return kind and content of the next frame that is no log line; write the log lines before it."""
        self._watchdog.start()
        while True:
            try:
                kind, content = self._next_frame()
            except (UnreadableError, TimeoutError):
                raise self._unreadable() from None
            except (EOFError, OSError, ValueError):
                raise self._error_of_end() from None
            if kind != LINE:
                return kind, content
            self._write(content.decode(errors="replace"))

    def _next_frame(self) -> tuple[bytes, bytes]:
        """Wait for a frame. Raises EOFError if the child has ended or has been aborted."""
        channel = self._child.channel
        while True:
            is_ready = bool(select.select([channel], [], [], POLL_PERIOD)[0])
            if self._watchdog.has_expired():
                self._abort_reason = f"a call did not return for {self._watchdog.limit:g} s"
            if self._abort_reason or (not is_ready and self._child.is_over):
                raise EOFError
            if is_ready:
                return receive_frame(channel)

    def _read(self, kind: bytes, content: bytes, expected: type[messages.Kind]) -> messages.Kind:
        try:
            return read_answer(content if kind == ANSWER else b"", expected)
        except UnreadableError:
            raise self._unreadable() from None

    def _unreadable(self) -> ChildEndedError:
        self._finish(kill=True)
        return ChildEndedError(CRASHED, "its process sent answers that cannot be read")

    def _error_of_end(self) -> ChildEndedError | ServerEndedError:
        """End the child, and return the error that describes its end."""
        ended = self._finish(kill=bool(self._abort_reason))
        if self._abort_reason:
            return ChildEndedError(HUNG, self._abort_reason)
        if ended is not None and ended.reason == messages.SERVER_ENDED:
            return ServerEndedError(f"{messages.SERVER_ENDED}; {REPEAT}", ExitStatus.NOT_MET)
        if ended is None:
            return ChildEndedError(CRASHED, "its process has ended")
        if ended.reason == messages.OVER_MEMORY_LIMIT:
            return ChildEndedError(OUT_OF_MEMORY, "its process exceeded its memory limit")
        if ended.reason == messages.NEAR_MEMORY_LIMIT:
            how = f"its process ended {_in_words(ended.status)} near its memory limit"
            return ChildEndedError(OUT_OF_MEMORY, how)
        if ended.status == messages.NO_CHANNEL:
            return ChildEndedError(CRASHED, messages.CHANNEL_CLOSED)
        return ChildEndedError(CRASHED, ended.reason or f"its process ended {_in_words(ended.status)}")


def _in_words(status: int) -> str:
    """Return how a process ended, as text, from its `ChildExit` status."""
    if status >= 0:
        return f"with exit status {status if status < 256 else hex(status)}"  # Windows has codes such as 0xc0000005
    try:
        return f"by {signal.Signals(-status).name}"
    except ValueError:
        return f"by signal {-status}"
