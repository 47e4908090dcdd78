"""Recorder in memory shared by two processes; its rows and progress survive the process that wrote them."""

from __future__ import annotations

import itertools
import mmap
import os
import sys
import tempfile
from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from ..flight.recorder import OUTCOME_WORDS, FlightRecorder, FmuActivity
from ..system.prepared import PreparedSystem

with suppress(ImportError):  # on Windows
    import fcntl

NUMBER_SIZE = 8  # bytes of every number in the memory
HEAD = OUTCOME_WORDS + 3  # words: outcome, halt, phase
F_SEAL_SHRINK, F_SEAL_GROW, F_SEAL_FUTURE_WRITE = 0x2, 0x4, 0x10  # from <linux/fcntl.h>
NAME = "perilune_flight"
_numbers = itertools.count(1)


class SharedRecorder(FlightRecorder):
    """Recorder with a fixed number of rows in one block of shared memory: [head, times, record].

    The other process opens it by ``files``, one open file, or on Windows by ``name``. The content is untrusted, since a
    child may write anything into it.
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
        raise MemoryError  # does not occur: the parent allocates enough rows

    def seal(self) -> None:
        """Seal the file, so that only existing mappings can write to it."""
        for descriptor in self.files:
            _add_seals(descriptor, F_SEAL_FUTURE_WRITE)

    def close(self) -> None:
        """Close the file; the rows exist as long as a process maps them."""
        while self.files:
            os.close(self.files.pop())

    def measure_progress(self) -> bytes:
        """Return bytes that change whenever a call of an FMU returns."""
        return self.outcome.tobytes() + self.phase.tobytes()

    def count_rows(self, first: int, every: int) -> int:
        """Return the number of rows that a simulation from point ``first`` has recorded, one in ``every``."""
        return min(max(-(-(self.point - max(first, -1) - 1) // every), 0), self.times.size)

    def component_in_phase(self, prepared: PreparedSystem) -> str:
        """Return the name of the component that the child is instantiating, resetting or freeing."""
        return _name_of(prepared, int(self.phase[1]))

    def describe_progress(self, prepared: PreparedSystem) -> str:
        """Return, as text, the component that was called last and the simulation time."""
        if self.phase[0] == FmuActivity.INSTANTIATION:
            return f"{self.component_in_phase(prepared)}: while it was instantiated"
        component = _name_of(prepared, self.subject)
        if not self.point:
            return f"{component}: in the initialisation"
        return f"{component}: on the way to t = {prepared.start + self.point * prepared.step:g} s"


def make_recorder(signals: int, rows: int) -> SharedRecorder:
    """Return a new recorder. The child cannot shrink it, which would kill its reader with SIGBUS. Raises OSError."""
    if sys.platform == "win32":
        return open_recorder(signals, rows, (), f"{NAME}_{os.getpid()}_{next(_numbers)}")
    descriptor = _open_memory()
    try:
        os.ftruncate(descriptor, _size_of(signals, rows))
        _add_seals(descriptor, F_SEAL_SHRINK | F_SEAL_GROW)
        return open_recorder(signals, rows, [descriptor])
    except BaseException:
        os.close(descriptor)
        raise


def open_recorder(signals: int, rows: int, files: Sequence[int], name: str = "") -> SharedRecorder:
    """Open the recorder of another process."""
    size = _size_of(signals, rows)
    if sys.platform == "win32":
        memory = mmap.mmap(-1, size, tagname=name)
    else:
        memory = mmap.mmap(files[0], size)
    return SharedRecorder(memory, signals, rows, files, name)


def _size_of(signals: int, rows: int) -> int:
    return NUMBER_SIZE * (HEAD + rows * (signals + 1))


def _open_memory() -> int:
    if hasattr(os, "memfd_create"):
        return os.memfd_create(NAME, os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    with tempfile.TemporaryFile(prefix=NAME) as file:
        return os.dup(file.fileno())


def _add_seals(descriptor: int, seals: int) -> None:
    """Add seals to a file in memory; do nothing for other files, which do not support them."""
    if sys.platform == "linux":
        with suppress(OSError):
            fcntl.fcntl(descriptor, fcntl.F_ADD_SEALS, seals)


def _name_of(prepared: PreparedSystem, number: int) -> str:
    """Return the name of a component from its number, which may be invalid because the child wrote it."""
    names = list(prepared.network.fmus)
    return names[number] if 0 <= number < len(names) else "a component"
