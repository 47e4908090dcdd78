"""A flight recorder in memory that two processes share: rows survive the process that wrote them."""

from __future__ import annotations

import itertools
import mmap
import os
import sys
import tempfile
from collections.abc import Sequence

import numpy as np

from ...flight.recorder import OUTCOME_WORDS, FlightRecorder
from ..system.system_calls import add_seals

NUMBER_SIZE = 8  # bytes, of every number here
HEAD = OUTCOME_WORDS + 3  # words: outcome, halt, phase
F_SEAL_SHRINK, F_SEAL_GROW, F_SEAL_FUTURE_WRITE = 0x2, 0x4, 0x10  # of <linux/fcntl.h>
NAME = "perilune_flight"
_numbers = itertools.count(1)


class SharedRecorder(FlightRecorder):
    """As many rows as it was made for: [head, times, record] in one piece of memory.

    The other process has it by its open ``files``, one, or on Windows, where there is none, by ``name``.
    """

    def __init__(self, memory: mmap.mmap, signals: int, rows: int, files: Sequence[int], name: str) -> None:
        self.files, self.name = list(files), name
        words = np.frombuffer(memory, dtype=np.int64, count=HEAD)
        numbers = np.frombuffer(memory, dtype=np.float64, offset=HEAD * NUMBER_SIZE)
        super().__init__(
            record=numbers[rows:].reshape(signals, rows),
            times=numbers[:rows],
            outcome=words[:OUTCOME_WORDS],
            halt=words[OUTCOME_WORDS : OUTCOME_WORDS + 1],
            phase=words[OUTCOME_WORDS + 1 :],
        )

    def _allocate(self, signals: int, rows: int) -> None:
        raise MemoryError  # who shares it has made it large enough

    def seal(self) -> None:
        """Have the memory written by those alone who have mapped it, and not as a file by whoever has that open."""
        for descriptor in self.files:
            add_seals(descriptor, F_SEAL_FUTURE_WRITE)

    def close(self) -> None:
        """Close the file; the rows stay as long as someone has them."""
        while self.files:
            os.close(self.files.pop())


def size_of(signals: int, rows: int) -> int:
    return NUMBER_SIZE * (HEAD + rows * (signals + 1))


def make_recorder(signals: int, rows: int) -> SharedRecorder:
    """A recorder that the other process cannot make smaller, which would end who reads it (SIGBUS). Raises OSError."""
    if sys.platform == "win32":
        return open_recorder(signals, rows, (), f"{NAME}_{os.getpid()}_{next(_numbers)}")
    descriptor = _open()
    try:
        os.ftruncate(descriptor, size_of(signals, rows))
        add_seals(descriptor, F_SEAL_SHRINK | F_SEAL_GROW)
        return open_recorder(signals, rows, [descriptor])
    except BaseException:
        os.close(descriptor)
        raise


def open_recorder(signals: int, rows: int, files: Sequence[int], name: str = "") -> SharedRecorder:
    """The recorder that another process has made."""
    size = size_of(signals, rows)
    if sys.platform == "win32":
        memory = mmap.mmap(-1, size, tagname=name)
    else:
        memory = mmap.mmap(files[0], size)
    return SharedRecorder(memory, signals, rows, files, name)


def _open() -> int:
    if hasattr(os, "memfd_create"):
        return os.memfd_create(NAME, os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    with tempfile.TemporaryFile(prefix=NAME) as file:
        return os.dup(file.fileno())
