"""What FMUs print, passed on to standard error: so many lines, without what a terminal would take for orders."""

from __future__ import annotations

import os
import sys
from contextlib import suppress

from ...common.visible import visible_line

PIECE = 65536  # bytes read at once
LONGEST_LINE = 4096  # bytes
MOST_LINES = 1000  # of a child


class Printed:
    """The reading end of a pipe, ``descriptor``, which does not block."""

    def __init__(self, descriptor: int) -> None:
        self.descriptor = descriptor
        self._rest = b""
        self._lines = 0
        self.is_closed = False

    def read(self) -> bool:
        """Pass on what there is; returns whether more may come."""
        while True:
            try:
                piece = os.read(self.descriptor, PIECE)
            except BlockingIOError:
                return True
            if not piece:
                return False
            *lines, self._rest = (self._rest + piece).split(b"\n")
            for line in lines:
                self._write(line)
            if len(self._rest) > LONGEST_LINE:
                self._write(self._rest)
                self._rest = b""

    def close(self) -> None:
        """Pass on the last line, say how many were left out, and close the pipe."""
        self.is_closed = True
        os.close(self.descriptor)
        if self._rest:
            self._write(self._rest)
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
