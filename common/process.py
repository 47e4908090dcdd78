"""Standard streams that do not abort the work of a command, and the end of its process.

A reader that exits, or a full disk, only truncates the output. The library of pythonfmu FMUs can crash in its
destructors after all work is done (in 10 of 64 runs), which would change the exit status; `exit_process` ends a process
without destructors.
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
    """Text stream that never raises: after the first error, stored as ``error``, further output is discarded.

    Terminal control characters are escaped as by `visible`, and characters that the encoding lacks with a backslash.
    ``stream`` is None if the process was started without it.
    """

    def __init__(self, stream: TextIO | None) -> None:
        self._stream = stream
        self.error: OSError | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    @property
    def is_cut(self) -> bool:
        """True if output was lost for any reason except that a reader closed its end of a pipe."""
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
            with suppress(OSError):  # the stream's buffer, which cannot be written, is flushed once more at exit
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
    """Open the null device as standard input, output and error if the process was started without them.

    Otherwise files opened later would get the descriptor of a missing stream, and the output that libraries print to
    it.
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
    """End the process immediately with an exit status, after flushing standard output and error.

    Functions registered with `at_end` are called before.
    """
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:  # a process can be started without them
            with suppress(OSError):
                stream.flush()
    for farewell in reversed(_farewells):
        farewell()
    os._exit(status)
