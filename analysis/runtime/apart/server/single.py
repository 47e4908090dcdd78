"""The process of a child that was not forked: it loads what a flight takes, and does one task."""

from __future__ import annotations

import pickle
import socket
import sys

from .....common.family.ending import end_after
from .....common.process import leave
from ...loop.library import load_library
from ..protocol.messages import Done, send_answer
from ..protocol.orders import Single
from ..protocol.requests import unpack
from . import child


def main() -> None:
    """Do what standard input says, and end."""
    order: Single = pickle.load(sys.stdin.buffer)
    end_after(order.parent)
    if sys.platform == "win32":
        assert isinstance(order.channel, bytes)
        channel = socket.fromshare(order.channel)
    else:
        assert isinstance(order.channel, int)
        channel = socket.socket(fileno=order.channel)
    subject = unpack(order.content)
    load_library()  # before limits on calls of FMUs hold
    send_answer(channel, Done())
    leave(child.work(order.task, subject, channel, order.files))
