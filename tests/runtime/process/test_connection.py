"""Closing a connection to a child that sends arbitrary data: in bounded time.

Truth: the bytes written by the test in place of a child.
"""

from __future__ import annotations

import socket
import struct
import threading
from types import SimpleNamespace

import pytest

from perilune.analysis.runtime.process import channel, messages
from perilune.analysis.runtime.process import child_connection as module
from perilune.analysis.runtime.process.child_connection import ChildConnection, ChildEndedError, Watchdog

ANSWERS = {
    "no kind": b"x" + bytes(8),
    "too long": struct.pack("<cI", b"A", 2**32 - 1),
    "cut short": struct.pack("<cI", b"A", 100) + b"{}",
    "no JSON": struct.pack("<cI", b"A", 2) + b"{]",
    "another answer": struct.pack("<cI", b"A", 24) + b'{"type":"Done","more":1}',
    "numbers": struct.pack("<cI", b"N", 8) + bytes(8),
}


@pytest.fixture
def pair(monkeypatch):
    """Yield a connection whose child the test is; it ends on a signal of the test."""
    monkeypatch.setattr(module, "FRAME_TIMEOUT", 0.2)
    ours, theirs = socket.socketpair()

    def end(*, kill):
        ours.close()
        return messages.ChildExit(9 if kill else 0)

    lines = []
    child = SimpleNamespace(channel=ours, end=end, is_over=False)
    yield ChildConnection(child, lines.append, Watchdog(lambda: None, 0.5)), theirs, lines
    theirs.close()


@pytest.mark.parametrize("name", ANSWERS)
def test_what_is_no_answer(pair, name):
    connection, theirs, _ = pair
    theirs.sendall(ANSWERS[name])
    with pytest.raises(ChildEndedError, match="answers that cannot be read") as caught:
        connection.receive(messages.Simulated)
    assert caught.value.status == "crashed"
    assert not connection.is_open


@pytest.mark.parametrize("name", ["no JSON", "another answer"])
def test_what_are_no_numbers(pair, name):
    connection, theirs, _ = pair
    theirs.sendall(ANSWERS[name])
    with pytest.raises(ChildEndedError, match="answers that cannot be read"):
        connection.ask_numbers(messages.ReadMemory(), 3)


def test_lines_without_end_are_no_progress(pair):
    connection, theirs, lines = pair
    finished = threading.Event()

    def write():
        while not finished.is_set():
            try:
                channel.send_line(theirs, "still here")
            except OSError:
                return

    writer = threading.Thread(target=write)
    writer.start()
    with pytest.raises(ChildEndedError, match=r"a call did not return for 0.5 s") as caught:
        connection.receive(messages.Done)
    finished.set()
    writer.join()
    assert caught.value.status == "hung"
    assert set(lines) == {"still here"}


def test_an_answer(pair):
    connection, theirs, _ = pair
    channel.send_answer(theirs, messages.Simulated("stop_time", "", 3))
    assert connection.receive(messages.Simulated).rows == 3
    assert connection.is_open


def test_a_watchdog_counts_from_the_last_progress(monkeypatch):
    clock, progress = SimpleNamespace(seconds=0.0), iter([b"0", b"0", b"1", b"1", b"1"])
    monkeypatch.setattr(module.time, "monotonic", lambda: clock.seconds)
    watchdog = Watchdog(lambda: next(progress), 1.0)
    expired = []
    for clock.seconds in (0.9, 1.8, 2.7, 2.9):
        expired.append(watchdog.has_expired())
    assert expired == [False, False, False, True]  # progress at 1.8 s, and none in the 1.1 s after it
