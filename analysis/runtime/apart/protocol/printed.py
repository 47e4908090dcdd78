"""What FMUs print, passed on to standard error: so many lines, without what a terminal would take for orders."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import suppress

from .....common.visible import visible_line

BLOCK = 65536  # bytes read at once
LONGEST_LINE = 4096  # bytes
MOST_LINES = 1000  # of a child
MOST_NAMES, LONGEST_NAMES = 3, 200  # components, and characters
OURS = ("perilune", "log")  # beginnings of Perilune's lines, before a colon


class Printed:
    """The output of one child, as it is read; ``printers`` are the components of which one has printed it.

    They share standard output and error and the C library's buffer of it, so that of several nobody knows which.
    """

    def __init__(self, printers: Sequence[str]) -> None:
        self._label = _label(printers)
        self._partial = b""
        self._lines = 0

    def add(self, block: bytes) -> None:
        """Pass on the lines that are complete."""
        *lines, self._partial = (self._partial + block).split(b"\n")
        for line in lines:
            self._write(line)
        if len(self._partial) > LONGEST_LINE:
            self._write(self._partial)
            self._partial = b""

    def finish(self) -> None:
        """Pass on the last line, and say how many were left out."""
        if self._partial:
            self._write(self._partial)
        if self._lines > MOST_LINES:
            self._print(f"... and {self._lines - MOST_LINES} lines more")

    def _write(self, line: bytes) -> None:
        self._lines += 1
        if self._lines <= MOST_LINES:
            self._print(visible_line(line[:LONGEST_LINE].decode(errors="replace"), LONGEST_LINE))

    def _print(self, line: str) -> None:
        with suppress(OSError, ValueError):
            sys.stderr.write(f"{self._label}: {line}\n")
            sys.stderr.flush()


def _label(printers: Sequence[str]) -> str:
    """Return the beginning of lines: names of components, and never what lines of Perilune begin with."""
    names = visible_line(", ".join(printers[:MOST_NAMES]), LONGEST_NAMES)
    if len(printers) > MOST_NAMES:
        names += f" and {len(printers) - MOST_NAMES} more"
    return f"component {names}" if names.partition(":")[0].strip().casefold() in OURS else names
