"""Printed output of children, forwarded to standard error in a limited number of lines that are safe for a terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from typing import IO

from ....common.visible import visible_line

BLOCK = 65536  # bytes read at a time
LONGEST_LINE = 4096  # bytes
LINE_LIMIT = 1000  # lines of a child
NAME_LIMIT, LONGEST_NAMES = 3, 200  # number of components, and of characters
OWN_PREFIXES = ("perilune", "log")  # prefixes of Perilune's own lines, before a colon


class PrintedLines:
    """Output of a child, split into lines; ``printers`` are the components that may have printed them.

    Components share standard output, standard error and the C library's buffer, so the source of a line is unknown.
    """

    def __init__(self, printers: Sequence[str]) -> None:
        self._label = _label(printers)
        self._partial = b""
        self._lines = 0

    def add(self, block: bytes) -> None:
        """Add output, and forward its complete lines."""
        *lines, self._partial = (self._partial + block).split(b"\n")
        for line in lines:
            self._write(line)
        if len(self._partial) > LONGEST_LINE:
            self._write(self._partial)
            self._partial = b""

    def finish(self) -> None:
        """Forward the last line, and report the number of omitted lines."""
        if self._partial:
            self._write(self._partial)
        if self._lines > LINE_LIMIT:
            self._print(f"... and {self._lines - LINE_LIMIT} more lines")

    def _write(self, line: bytes) -> None:
        self._lines += 1
        if self._lines <= LINE_LIMIT:
            self._print(visible_line(line[:LONGEST_LINE].decode(errors="replace"), LONGEST_LINE))

    def _print(self, line: str) -> None:
        with suppress(OSError, ValueError):
            sys.stderr.write(f"{self._label}: {line}\n")
            sys.stderr.flush()


class OutputPipe:
    """Reading end of the pipe into which a forked child prints; the server reads it between other tasks."""

    def __init__(self, descriptor: int, printers: Sequence[str]) -> None:
        os.set_blocking(descriptor, False)
        self.descriptor = descriptor
        self.is_closed = False
        self._lines = PrintedLines(printers)

    def read(self) -> bool:
        """Forward the output so far; return True if more may follow."""
        while True:
            try:
                block = os.read(self.descriptor, BLOCK)
            except BlockingIOError:
                return True
            if not block:
                return False
            self._lines.add(block)

    def close(self) -> None:
        """Close the pipe, and forward the last line."""
        self.is_closed = True
        os.close(self.descriptor)
        self._lines.finish()


def forward_output(output: IO[bytes], printers: Sequence[str]) -> None:
    """Forward the output of a spawned child until it exits."""
    lines = PrintedLines(printers)
    with output:
        while block := os.read(output.fileno(), BLOCK):
            lines.add(block)
    lines.finish()


def _label(printers: Sequence[str]) -> str:
    """Return the prefix of lines: names of components, distinct from all prefixes of Perilune's own lines."""
    names = visible_line(", ".join(printers[:NAME_LIMIT]), LONGEST_NAMES)
    if len(printers) > NAME_LIMIT:
        names += f" and {len(printers) - NAME_LIMIT} more"
    return f"component {names}" if names.partition(":")[0].strip().casefold() in OWN_PREFIXES else names
