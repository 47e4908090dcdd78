"""Requests to a child and its answers, one at a time, and what its end means."""

from __future__ import annotations

import select
import signal
import socket
import time
import weakref
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....common.errors import EndedError, ExitStatus, InputError
from ..flight.results import CRASHED, HUNG, OUT_OF_MEMORY
from .protocol.messages import (
    ANSWER,
    FREED,
    LINE,
    NUMBERS,
    Kind,
    Refused,
    UnreadableError,
    read_answer,
    receive_frame,
)
from .protocol.orders import CHANNEL_CLOSED, NEAR_MEMORY_LIMIT, NO_CHANNEL, SERVER_ENDED, Ended
from .protocol.orders import OUT_OF_MEMORY as TOO_LARGE
from .protocol.requests import send_request
from .servers import AnyChild

LOOK = 0.25  # s, between looks at a child that says nothing
FRAME = 10.0  # s in which the next bytes of an answer follow, once it has begun
REPEAT = "simulate again, where memory ran out with fewer `workers`"
PATIENCE = 1.5  # s that a child has to free its instances


class ServerEndedError(EndedError):
    """A child that ended with its flight server, for no fault of an FMU."""


class ChildEndedError(Exception):
    """A child that ended before it had answered: ``status`` of LOST, and ``how`` in words."""

    def __init__(self, status: str, how: str) -> None:
        super().__init__(status, how)
        self.status = status
        self.how = how


@dataclass(frozen=True)
class Stillness:
    """Whether a child has stood still for too long: ``measure`` gives what changes as long as it goes on."""

    measure: Callable[[], Any]
    limit: float  # s


class Connection:
    """Not shared between threads, but for `give_up`."""

    def __init__(self, child: AnyChild, write: Callable[[str], None], stillness: Stillness) -> None:
        self._child = child
        self._write = write
        self._stillness = stillness
        self._given_up = ""
        child.channel.settimeout(FRAME)
        self._end = weakref.finalize(self, child.end, kill=True)

    @property
    def is_open(self) -> bool:
        return self._end.alive

    def ask(self, request: Any, expected: type[Kind], files: Sequence[int] = ()) -> Kind:
        """An answer. Raises ChildEndedError, and InputError where the child raised it."""
        self.send(request, files)
        return self.hear(expected)

    def send(self, request: Any, files: Sequence[int] = ()) -> None:
        """Send what has no answer, or one that is heard later: the child may have ended by then."""
        with suppress(OSError):
            send_request(self._child.channel, request, files)

    def hear(self, expected: type[Kind]) -> Kind:
        """The answer to the last request."""
        kind, content = self._receive()
        try:
            if kind != ANSWER:
                raise UnreadableError
            answer = read_answer(content, expected)
        except UnreadableError:
            raise self._unreadable() from None
        if isinstance(answer, Refused):
            raise InputError(answer.file, answer.element, answer.problem, answer.remedy)
        return answer

    def ask_numbers(self, request: Any, count: int) -> np.ndarray:
        """An answer of so many float64."""
        self.send(request)
        kind, content = self._receive()
        if kind == NUMBERS and len(content) == 8 * count:
            return np.frombuffer(content)
        try:
            refused = read_answer(content if kind == ANSWER else b"", Refused)
        except UnreadableError:
            raise self._unreadable() from None
        raise InputError(refused.file, refused.element, refused.problem, refused.remedy)

    def give_up(self, why: str) -> None:
        """End the child, for whoever waits for it in another thread: a call does not return."""
        self._given_up = why
        with suppress(OSError):
            self._child.channel.shutdown(socket.SHUT_RDWR)  # wakes whoever waits

    def close(self) -> str:
        """Let the child free its instances, and end; what went wrong, if something did. PATIENCE is limited."""
        if not self.is_open:
            return ""
        answer = self._last_answer()
        ended = self._finish(kill=answer is None)
        if ended is not None and ended.reason == SERVER_ENDED:
            return ""
        if answer is None:
            return f"its process did not end within {PATIENCE:g} s"
        return "" if ended is None or answer == FREED else f"its process ended {_in_words(ended.status)}"

    def kill(self) -> None:
        """End the child at once."""
        self._finish(kill=True)

    def _last_answer(self) -> bytes | None:
        """Ask the child to free its instances; what it answers before it ends, None if it does not end."""
        answer = b""
        channel, deadline = self._child.channel, time.monotonic() + PATIENCE
        try:
            channel.shutdown(socket.SHUT_WR)
            while time.monotonic() < deadline:
                channel.settimeout(max(deadline - time.monotonic(), LOOK))
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

    def _finish(self, *, kill: bool) -> Ended | None:
        """End the child; None where that was done before."""
        return None if self._end.detach() is None else self._child.end(kill=kill)

    def _receive(self) -> tuple[bytes, bytes]:
        channel = self._child.channel
        before, since = self._stillness.measure(), time.monotonic()
        while True:
            try:
                is_ready = bool(select.select([channel], [], [], LOOK)[0])
                now = self._stillness.measure()
                if now != before:
                    before, since = now, time.monotonic()
                if time.monotonic() - since > self._stillness.limit:
                    self._given_up = f"a call did not return for {self._stillness.limit:g} s"
                if self._given_up or (not is_ready and self._child.is_over):
                    raise EOFError
                if not is_ready:
                    continue
                kind, content = receive_frame(channel)
            except (UnreadableError, TimeoutError):
                raise self._unreadable() from None
            except (EOFError, OSError, ValueError):
                raise self._ended() from None
            if kind != LINE:
                return kind, content
            self._write(content.decode(errors="replace"))

    def _unreadable(self) -> ChildEndedError:
        self._finish(kill=True)
        return ChildEndedError(CRASHED, "its process sent answers that cannot be read")

    def _ended(self) -> ChildEndedError | ServerEndedError:
        ended = self._finish(kill=bool(self._given_up))
        if self._given_up:
            return ChildEndedError(HUNG, self._given_up)
        if ended is not None and ended.reason == SERVER_ENDED:
            return ServerEndedError(f"{SERVER_ENDED}; {REPEAT}", ExitStatus.NOT_MET)
        if ended is None:
            return ChildEndedError(CRASHED, "its process has ended")
        if ended.reason == TOO_LARGE:
            return ChildEndedError(OUT_OF_MEMORY, "its process took more memory than it may")
        if ended.reason == NEAR_MEMORY_LIMIT:
            how = f"its process ended {_in_words(ended.status)} near its memory limit"
            return ChildEndedError(OUT_OF_MEMORY, how)
        if ended.status == NO_CHANNEL:
            return ChildEndedError(CRASHED, CHANNEL_CLOSED)
        return ChildEndedError(CRASHED, ended.reason or f"its process ended {_in_words(ended.status)}")


def _in_words(status: int) -> str:
    """How a process ended, by the status of `Ended`."""
    if status >= 0:
        return f"with exit status {status if status < 256 else hex(status)}"  # Windows has codes such as 0xc0000005
    try:
        return f"by {signal.Signals(-status).name}"
    except ValueError:
        return f"by signal {-status}"
