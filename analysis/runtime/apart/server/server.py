"""The flight server: a process with everything loaded that a flight takes, but FMUs, which forks children to fly.

It is started by `servers`, with a socket to whom it works for, and ends with it; so do its children, and theirs.
"""

from __future__ import annotations

import gc
import itertools
import os
import resource
import selectors
import shutil
import signal
import socket
import sys
import tempfile
import time
import traceback
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NoReturn

from .....common.family.ending import end_with_parent
from .....common.process import leave
from .....common.scratch import make_folder
from ...loop.library import load_library
from ..protocol.orders import CHANNEL_CLOSED, NEAR_MEMORY_LIMIT, OUT_OF_MEMORY, Begin, End, Ended, Forget, Learn, Look
from ..protocol.requests import receive_request, send_request, unpack
from ..system.restriction import Restriction, restrict
from ..system.system_calls import (
    adopt_orphans,
    child_processes,
    limit_addresses,
    peak_memory,
    resident_memory,
)
from . import child
from .output import Output

LOOK = 0.1  # s, between looks at the children's memory
GRACE = 0.2  # s that a child has to end after it has closed its channel
NEAR = 0.9  # of its limit of memory: a child that fails there has failed for want of it


@dataclass
class _Child:
    pid: int
    output: Output
    scratch: Path
    memory: int
    status: int | None = None
    reason: str = ""


class FlightServer:
    def __init__(self, control: socket.socket) -> None:
        self._control = control
        self._subjects: dict[int, Any] = {}
        self._children: dict[int, _Child] = {}
        self._selector = selectors.DefaultSelector()
        self._selector.register(control, selectors.EVENT_READ)
        self._looked = 0.0

    def serve(self) -> None:
        """Carry out orders until the control socket is closed."""
        while True:
            for key, _ in self._selector.select(LOOK if self._children else None):
                if key.data is not None:
                    self._read(key.data)
                    continue
                try:
                    request, descriptors = receive_request(self._control)
                except (EOFError, OSError):
                    return
                self._do(request, descriptors)
            self._watch()

    def _do(self, request: Learn | Forget | Begin | Look | End, descriptors: list[int]) -> None:
        if isinstance(request, Learn):
            self._subjects[request.key] = unpack(request.content)
            gc.collect()
            gc.freeze()
        elif isinstance(request, Begin):
            self._begin(request, descriptors)
        elif isinstance(request, Forget):
            del self._subjects[request.key]
        elif isinstance(request, Look):
            send_request(self._control, self._is_over(self._children[request.number]))
        else:
            send_request(self._control, self._end(request))

    def _begin(self, request: Begin, descriptors: list[int]) -> None:
        scratch, server = make_folder(), os.getpid()
        read, write = os.pipe()
        pid = os.fork()
        if not pid:
            _work(request, self._subjects[request.key], descriptors, write, str(scratch), server)
        for descriptor in (*descriptors, write):
            os.close(descriptor)
        output = Output(read, self._subjects[request.key].printers)
        self._children[request.number] = _Child(pid, output, scratch, request.memory + resident_memory(pid))
        self._selector.register(read, selectors.EVENT_READ, output)

    def _end(self, request: End) -> Ended:
        ended = self._children.pop(request.number)
        deadline = time.monotonic() + (0.0 if request.kill else GRACE)
        while not self._is_over(ended):
            if time.monotonic() >= deadline:
                with suppress(ProcessLookupError):
                    os.kill(ended.pid, signal.SIGKILL)
                ended.reason = ended.reason or ("" if request.kill else CHANNEL_CLOSED)
                deadline = float("inf")
            time.sleep(0.0005)
        self._end_family(ended.pid)
        self._read(ended.output)
        if ended.output.descriptor in self._selector.get_map():
            self._selector.unregister(ended.output.descriptor)
        ended.output.close()
        shutil.rmtree(ended.scratch, ignore_errors=True)
        assert ended.status is not None
        return Ended(os.waitstatus_to_exitcode(ended.status), ended.reason)

    def _is_over(self, each: _Child) -> bool:
        if each.status is None:
            pid, status, usage = os.wait4(each.pid, os.WNOHANG)
            if pid:
                each.status = status
                if status and not each.reason and peak_memory(usage) > NEAR * each.memory:
                    each.reason = NEAR_MEMORY_LIMIT
        return each.status is not None

    def _end_family(self, pid: int) -> None:
        """Kill what a child has started that outlives it: its group, and who has become a child of ours."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(pid, signal.SIGKILL)
        while True:
            known = {each.pid for each in self._children.values()}
            orphans = [other for other in child_processes() if other not in known]
            if not orphans:
                return
            for orphan in orphans:
                with suppress(ProcessLookupError):
                    os.kill(orphan, signal.SIGKILL)
                with suppress(ChildProcessError):
                    os.waitpid(orphan, 0)

    def _read(self, output: Output) -> None:
        if not output.is_closed and not output.read() and output.descriptor in self._selector.get_map():
            self._selector.unregister(output.descriptor)

    def _watch(self) -> None:
        """End children that take more memory than they may."""
        if time.monotonic() < self._looked + LOOK:
            return
        self._looked = time.monotonic()
        for each in self._children.values():
            if each.status is None and not each.reason and resident_memory(each.pid) > each.memory:
                each.reason = OUT_OF_MEMORY
                with suppress(ProcessLookupError):
                    os.kill(each.pid, signal.SIGKILL)

    def close(self) -> None:
        """End all children."""
        for number in list(self._children):
            self._end(End(number, kill=True))


def _work(request: Begin, subject: Any, descriptors: list[int], output: int, scratch: str, server: int) -> NoReturn:
    """The life of a child of a ``server``, a process."""
    status = 70  # of sysexits.h: an error of our own
    try:
        end_with_parent(server)
        os.setsid()
        adopt_orphans()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # a crash writes no file
        os.dup2(output, 1)
        os.dup2(output, 2)
        _close_all_but({0, 1, 2, *descriptors})
        os.chdir(request.folder)
        limit_addresses(request.memory)
        _settle_in(scratch, request.restriction)
        channel, *memory = descriptors
        status = child.work(request.task, subject, socket.socket(fileno=channel), memory)
    except BaseException:
        traceback.print_exc()
    finally:
        with suppress(Exception):
            sys.stdout.flush()
            sys.stderr.flush()
        os._exit(status)


def _settle_in(scratch: str, restriction: Restriction | None) -> None:
    """Have a folder of one's own for temporary files, and may write nowhere else if there is a restriction."""
    for name in ("TMPDIR", "TEMP", "TMP"):
        os.environ[name] = scratch
    tempfile.tempdir = None  # determined again at its next use
    if restriction is not None:
        restrict(replace(restriction, writable=(scratch, *restriction.writable)))


def _close_all_but(remaining: set[int]) -> None:
    bounds = [*sorted(remaining), os.sysconf("SC_OPEN_MAX")]
    for before, after in itertools.pairwise(bounds):
        os.closerange(before + 1, after)


def main(control: int) -> None:
    """The process of the server; ``control`` is its end of the socket to whom it works for."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    adopt_orphans()
    server = FlightServer(socket.socket(fileno=control))
    try:
        load_library()  # which children, that write no cache, use
        server.serve()
    finally:
        server.close()
        leave(0)
