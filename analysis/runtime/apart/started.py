"""A child where the operating system cannot fork: a process that is started anew, which takes a second to load."""

from __future__ import annotations

import os
import pickle
import shutil
import socket
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from typing import IO, Any

import psutil

from ....common.scratch import make_folder
from ..system.fmu import Fmu
from ..system.prepared import PreparedSystem
from .protocol.messages import receive_frame
from .protocol.orders import CHANNEL_CLOSED, OUT_OF_MEMORY, Ended, Single
from .protocol.printed import BLOCK, Printed
from .protocol.requests import pack

LOADING = 60.0  # s that it has to load what a flight takes
SAME_HASHES = {"PYTHONHASHSEED": "0"}  # so that Python FMUs go through sets in one order, whichever process they are in
GRACE = 1.0  # s that it has to end after it has closed its channel


class StartedChild:
    """Its process, and this end of its channel; as `servers.Child`. ``memory`` (bytes) is what it may take."""

    def __init__(
        self, content: PreparedSystem | Fmu, task: Any, folder: str, memory: int, files: Sequence[int]
    ) -> None:
        self.channel, theirs = socket.socketpair()
        self._scratch, self._memory, self._reason = make_folder(), memory, ""
        start = f"from {__package__}.server.single import main; main()"
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-c", f"import sys; sys.path[:] = {sys.path!r}; {start}"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                cwd=folder,
                env={**os.environ, **SAME_HASHES, **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(self._scratch))},
                pass_fds=() if sys.platform == "win32" else [theirs.fileno(), *files],
            )
            channel: int | bytes = theirs.fileno()
            if sys.platform == "win32":
                channel = theirs.share(self._process.pid)
            order = Single(os.getpid(), channel, list(files), task, pack(content))
            assert self._process.stdin is not None
            with suppress(OSError), self._process.stdin as standard_input:  # it may have ended
                standard_input.write(pickle.dumps(order, pickle.HIGHEST_PROTOCOL))
        self.channel.settimeout(LOADING)
        with suppress(OSError, EOFError):  # which whoever asks for something comes to, too
            receive_frame(self.channel)  # it is loaded: limits on calls of FMUs hold from here on
        assert self._process.stdout is not None
        self._reader = threading.Thread(target=_pass_on, args=(self._process.stdout, content.printers), daemon=True)
        self._reader.start()

    @property
    def is_over(self) -> bool:
        """Whether it has ended; it is killed if it takes too much memory."""
        with suppress(psutil.Error):
            if psutil.Process(self._process.pid).memory_info().rss > self._memory:
                self._reason = OUT_OF_MEMORY
                self._process.kill()
                self._process.wait()
        return self._process.poll() is not None

    def end(self, *, kill: bool) -> Ended:
        """Close its channel; how it ended, of itself or killed. To be called once."""
        with suppress(OSError):
            self.channel.shutdown(socket.SHUT_RDWR)
        self.channel.close()
        try:
            self._process.wait(0.0 if kill else GRACE)
        except subprocess.TimeoutExpired:
            self._reason = self._reason or ("" if kill else CHANNEL_CLOSED)
            self._process.kill()
            self._process.wait()
        self._reader.join(GRACE)  # what it has started may still have its output
        shutil.rmtree(self._scratch, ignore_errors=True)
        return Ended(self._process.returncode, self._reason)


def _pass_on(output: IO[bytes], printers: Sequence[str]) -> None:
    """Pass on what it prints, until it ends."""
    printed = Printed(printers)
    with output:
        while block := os.read(output.fileno(), BLOCK):
            printed.add(block)
    printed.finish()
