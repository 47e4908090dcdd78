"""Process of a command: standard streams that do not abort its work, and its end.

A reader that exits, or a full disk, only truncates the output. The library of pythonfmu FMUs can crash in its
destructors, after all work is done (10 of 64 runs), and would change the exit status: a process that ran them exits
without them.
"""

from __future__ import annotations

import atexit
import errno
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from typing import Any, NoReturn, TextIO

from .visible import visible

CLOSED = (errno.EPIPE, errno.ESHUTDOWN)


class Stream:
    """Text stream that never raises: after the first error, kept as ``error``, further output is dropped.

    Terminal control characters are written as by `visible`, characters that the encoding lacks as by Python. ``stream``
    is None if the process was started without it.
    """

    def __init__(self, stream: TextIO | None) -> None:
        self._stream = stream
        self.error: OSError | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    @property
    def is_cut(self) -> bool:
        """True if output was lost, other than by a reader that closed its end of a pipe."""
        return self.error is not None and self.error.errno not in CLOSED

    def write(self, text: str) -> int:
        encoding = getattr(self._stream, "encoding", None) or "utf-8"
        self._try("write", visible(text).encode(encoding, "backslashreplace").decode(encoding))
        return len(text)

    def flush(self) -> None:
        self._try("flush")

    def isatty(self) -> bool:
        return self._stream is not None and self._stream.isatty()

    def _try(self, name: str, *arguments: str) -> None:
        if self._stream is None or self.error is not None:
            return
        try:
            getattr(self._stream, name)(*arguments)
        except OSError as error:
            self.error = error
            with suppress(OSError):  # its buffer still holds what cannot be written, and is flushed once more at exit
                nowhere = os.open(os.devnull, os.O_WRONLY)
                os.dup2(nowhere, self._stream.fileno())
                os.close(nowhere)


@contextmanager
def guard_streams() -> Iterator[Stream]:
    """Replace standard output and error by streams that do not raise; yield standard output, flushed at the end."""
    output, errors = Stream(sys.stdout), Stream(sys.stderr)
    with redirect_stdout(output), redirect_stderr(errors):  # type: ignore[type-var]
        try:
            yield output
        finally:
            output.flush()
            errors.flush()


def open_closed_streams() -> None:
    """Open the null device as standard input, output or error if the process was started without it.

    Otherwise files opened later would get its number, and with it the output that libraries print.
    """
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)


_farewells: list[Callable[[], object]] = []


def at_end(farewell: Callable[[], object]) -> None:
    """Register a function to call when this process ends, also by `exit_process`; the last one is called first."""
    _farewells.append(farewell)
    atexit.register(farewell)


def exit_process(status: int) -> NoReturn:
    """End the process at once with an exit status, after flushing standard output and error.

    Functions registered with `at_end` are called.
    """
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:  # a process can be started without them
            with suppress(OSError):
                stream.flush()
    for farewell in reversed(_farewells):
        farewell()
    os._exit(status)
