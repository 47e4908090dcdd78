"""What FMUs print, passed on to standard error: so many lines, without what a terminal would take for orders."""

from __future__ import annotations

import os
import sys
from contextlib import suppress

from ....common.visible import visible_line

BLOCK = 65536  # bytes read at once
LONGEST_LINE = 4096  # bytes
MOST_LINES = 1000  # of a child


class Printed:
    """The reading end of a pipe, ``descriptor``, which does not block."""

    def __init__(self, descriptor: int) -> None:
        self.descriptor = descriptor
        self._partial = b""
        self._lines = 0
        self.is_closed = False

    def read(self) -> bool:
        """Pass on what there is; returns whether more may come."""
        while True:
            try:
                block = os.read(self.descriptor, BLOCK)
            except BlockingIOError:
                return True
            if not block:
                return False
            *lines, self._partial = (self._partial + block).split(b"\n")
            for line in lines:
                self._write(line)
            if len(self._partial) > LONGEST_LINE:
                self._write(self._partial)
                self._partial = b""

    def close(self) -> None:
        """Pass on the last line, say how many were left out, and close the pipe."""
        self.is_closed = True
        os.close(self.descriptor)
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
