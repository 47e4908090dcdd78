"""Orders to a flight server, which answers to `Look` and `End`; pickles, since both sides are our own code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..system.restriction import Restriction

# Why a child was ended, or failed:
OUT_OF_MEMORY = "out of memory"
NEAR_MEMORY_LIMIT = "near its memory limit"
CHANNEL_CLOSED = "it closed its channel"
SERVER_ENDED = "the flight server has ended"
NO_CHANNEL = 76  # of sysexits.h: the exit status of a child that cannot use its channel


@dataclass(frozen=True)
class Learn:
    """What children work on, pickled, by a ``key``."""

    key: int
    content: bytes


@dataclass(frozen=True)
class Forget:
    """No more children will work on this."""

    key: int


@dataclass(frozen=True)
class Begin:
    """Fork a child; its channel and its recorder's file come along.

    ``memory`` (bytes) is what it may take, ``restriction`` what it may not do.
    """

    number: int
    key: int
    task: Any  # one of `messages`
    folder: str
    memory: int
    restriction: Restriction | None


@dataclass(frozen=True)
class Single:
    """The order of a child that was not forked, on its standard input.

    ``channel`` and ``files`` are descriptors that it has inherited; on Windows ``channel`` is a socket shared with it.
    """

    parent: int  # the process with which it ends
    channel: int | bytes
    files: list[int]
    task: Any  # one of `messages`
    content: bytes  # what it works on, pickled


@dataclass(frozen=True)
class Look:
    """Tell whether a child has ended: what it has started may hold its channel open."""

    number: int


@dataclass(frozen=True)
class End:
    """Tell how a child has ended, or ``kill`` it; answered with `Ended`."""

    number: int
    kill: bool


@dataclass(frozen=True)
class Ended:
    """``status`` is the exit status, a signal if negative; ``reason`` is why it was killed or failed, where known."""

    status: int
    reason: str = ""
