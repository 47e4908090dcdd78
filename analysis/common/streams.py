"""Standard output and error of a command: a reader that goes away, or a full disk, keeps no work from being done."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from typing import Any, TextIO

CLOSED = (errno.EPIPE, errno.ESHUTDOWN)


class Stream:
    """A text stream that takes everything: from the first error on, which ``error`` keeps, what is written is dropped.

    ``stream`` is None where the process was started without it.
    """

    def __init__(self, stream: TextIO | None) -> None:
        self._stream = stream
        self.error: OSError | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    @property
    def is_cut(self) -> bool:
        """Whether something was lost that a reader was there for: not where it has closed its end of a pipe."""
        return self.error is not None and self.error.errno not in CLOSED

    def write(self, text: str) -> int:
        self._try("write", text)
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
def steady_streams() -> Iterator[Stream]:
    """Let a command write to streams that raise nothing; gives standard output, flushed at the end."""
    output, errors = Stream(sys.stdout), Stream(sys.stderr)
    with redirect_stdout(output), redirect_stderr(errors):  # type: ignore[type-var]
        try:
            yield output
        finally:
            output.flush()
            errors.flush()
