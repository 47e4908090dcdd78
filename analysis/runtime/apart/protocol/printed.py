"""What FMUs print, passed on to standard error: so many lines, without what a terminal would take for orders."""

from __future__ import annotations

import sys
from contextlib import suppress

from ....common.visible import visible_line

BLOCK = 65536  # bytes read at once
LONGEST_LINE = 4096  # bytes
MOST_LINES = 1000  # of a child


class Printed:
    """The output of one child, as it is read."""

    def __init__(self) -> None:
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
            _print(f"... and {self._lines - MOST_LINES} lines more")

    def _write(self, line: bytes) -> None:
        self._lines += 1
        if self._lines <= MOST_LINES:
            _print(visible_line(line[:LONGEST_LINE].decode(errors="replace"), LONGEST_LINE))


def _print(line: str) -> None:
    with suppress(OSError, ValueError):
        sys.stderr.write(f"{line}\n")
        sys.stderr.flush()
