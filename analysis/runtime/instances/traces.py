"""Traces that an FMU leaves in its process and folder, where later instances would find them."""

from __future__ import annotations

import ctypes
import itertools
import locale
import os
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

BYTECODE = "__pycache__"  # folder of the bytecode that Python writes when it imports sources


@dataclass(frozen=True)
class Traces:
    """State of a process and a folder that outlives freed instances. Compare two states with `changes_since`."""

    working_folder: str
    locale: str
    environment: frozenset[bytes]
    files: Mapping[str, tuple[int, int]]  # by name: size (bytes), time of change (ns)

    def changes_since(self, before: Traces) -> str:
        """Return the changes since an earlier state as text, "" if there are none."""
        if self.files != before.files:
            names = sorted(name for name, _ in self.files.items() ^ before.files.items())
            return f"its folder has changed: {names[0]}"
        if self.working_folder != before.working_folder:
            return "it changes the working folder of its process"
        if self.locale != before.locale:
            return "it changes the locale of its process"
        if self.environment != before.environment:
            entry = min(self.environment ^ before.environment)
            name = entry.partition(b"=")[0].decode(errors="replace")
            return f"it changes the environment of its process: {name}"
        return ""


def read_traces(folder: Path) -> Traces:
    """Return the state of this process, and of the folder into which an FMU is unpacked."""
    return Traces(os.getcwd(), locale.setlocale(locale.LC_ALL), _environment(), _files(folder))


def _environment() -> frozenset[bytes]:
    """Return the entries of C's environment, which Python's copy does not track."""
    if sys.platform != "linux":
        return frozenset(f"{name}={content}".encode() for name, content in os.environ.items())
    entries = ctypes.POINTER(ctypes.c_char_p).in_dll(ctypes.CDLL(None), "environ")
    numbers = itertools.count()
    return frozenset(iter(lambda: entries[next(numbers)], None)) if entries else frozenset()


def _files(folder: Path) -> dict[str, tuple[int, int]]:
    files = {}
    for path in folder.rglob("*"):
        name = path.relative_to(folder)
        if BYTECODE not in name.parts and not path.is_dir():
            state = path.lstat()
            files[name.as_posix()] = state.st_size, state.st_mtime_ns
    return files
