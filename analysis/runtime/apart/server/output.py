"""The end of a pipe that a child prints into, read by the server between other work."""

from __future__ import annotations

import os
from collections.abc import Sequence

from ..protocol.printed import BLOCK, Printed


class Output:
    """Output of one child; ``descriptor`` is the reading end, ``printers`` are as in `Printed`."""

    def __init__(self, descriptor: int, printers: Sequence[str]) -> None:
        os.set_blocking(descriptor, False)
        self.descriptor = descriptor
        self.is_closed = False
        self._printed = Printed(printers)

    def read(self) -> bool:
        """Pass on what there is; returns whether more may come."""
        while True:
            try:
                block = os.read(self.descriptor, BLOCK)
            except BlockingIOError:
                return True
            if not block:
                return False
            self._printed.add(block)

    def close(self) -> None:
        """Close the pipe, and pass on the last line."""
        self.is_closed = True
        os.close(self.descriptor)
        self._printed.finish()
