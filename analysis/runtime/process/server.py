"""Flight server: a process with everything loaded for a simulation except FMUs, which forks children to simulate.

The module `children` starts it with a socket to its client process. When the client exits, so do the server, its
children and all processes that they started.
"""

from __future__ import annotations

import ctypes
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

from ....common.family.ending import end_with_parent
from ....common.process import exit_process
from ....common.scratch import make_folder
from ..loop.library import load_library
from . import messages
from .channel import receive_request, send_request, unpack
from .child import do_task
from .output import OutputPipe
from .restriction import Restriction, restrict

WATCH_PERIOD = 0.1  # s, between checks of the children's memory
GRACE = 0.2  # s, time for a child to end after closing its channel
NEAR_LIMIT = 0.9  # fraction of the memory limit above which a child that fails counts as out of memory
PR_SET_CHILD_SUBREAPER = 36
IS_LINUX = sys.platform == "linux"
RESERVED = 2  # permitted reserved memory per permitted used memory: programs reserve more than they use


@dataclass
class ServedChild:
    """Forked child; ``memory`` is its limit in bytes, ``status`` is None until it exits."""

    pid: int
    output: OutputPipe
    scratch: Path
    memory: int
    status: int | None = None
    reason: str = ""

    def check_end(self) -> bool:
        """Return True if the child has exited, and note its status."""
        if self.status is None:
            pid, status, usage = os.wait4(self.pid, os.WNOHANG)
            if pid:
                self.status = status
                peak = usage.ru_maxrss * (1024 if IS_LINUX else 1)  # bytes
                if status and not self.reason and peak > NEAR_LIMIT * self.memory:
                    self.reason = messages.NEAR_MEMORY_LIMIT
        return self.status is not None

    def kill(self, reason: str) -> None:
        """Kill the child and note the ``reason``, unless there is an earlier one."""
        self.reason = self.reason or reason
        with suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)


class FlightServer:
    """Server that executes orders; ``control`` is its end of the socket to the client process."""

    def __init__(self, control: socket.socket) -> None:
        self._control = control
        self._subjects: dict[int, Any] = {}  # systems and FMUs, by key
        self._children: dict[int, ServedChild] = {}
        self._selector = selectors.DefaultSelector()
        self._selector.register(control, selectors.EVENT_READ)
        self._watched = 0.0  # s

    def serve(self) -> None:
        """Execute orders until the control socket is closed."""
        while True:
            for key, _ in self._selector.select(WATCH_PERIOD if self._children else None):
                if key.data is not None:
                    self._read(key.data)
                    continue
                try:
                    order, descriptors = receive_request(self._control)
                except (EOFError, OSError):
                    return
                self._carry_out(order, descriptors)
            self._watch_memory()

    def _carry_out(self, order: messages.Order, descriptors: list[int]) -> None:
        match order:
            case messages.Begin():
                if order.content is not None:
                    self._subjects[order.key] = unpack(order.content)
                    gc.collect()
                    gc.freeze()
                self._begin(order, descriptors)
            case messages.Forget():
                del self._subjects[order.key]
            case messages.ExitQuery():
                send_request(self._control, self._children[order.number].check_end())
            case messages.EndChild():
                send_request(self._control, self._end(order))

    def _begin(self, order: messages.Begin, descriptors: list[int]) -> None:
        scratch, server = make_folder(), os.getpid()
        read, write = os.pipe()
        pid = os.fork()
        if not pid:
            _run_child(order, self._subjects[order.key], descriptors, write, str(scratch), server)
        for descriptor in (*descriptors, write):
            os.close(descriptor)
        output = OutputPipe(read, self._subjects[order.key].printers)
        self._children[order.number] = ServedChild(pid, output, scratch, order.limits.memory + _resident_memory(pid))
        self._selector.register(read, selectors.EVENT_READ, output)

    def _end(self, order: messages.EndChild) -> messages.ChildExit:
        child = self._children.pop(order.number)
        deadline = time.monotonic() + (0.0 if order.kill else GRACE)
        while not child.check_end():
            if time.monotonic() >= deadline:
                child.kill("" if order.kill else messages.CHANNEL_CLOSED)
                deadline = float("inf")
            time.sleep(0.0005)
        self._end_family(child.pid)
        self._read(child.output)
        if child.output.descriptor in self._selector.get_map():
            self._selector.unregister(child.output.descriptor)
        child.output.close()
        shutil.rmtree(child.scratch, ignore_errors=True)
        assert child.status is not None
        return messages.ChildExit(os.waitstatus_to_exitcode(child.status), child.reason)

    def _end_family(self, pid: int) -> None:
        """Kill the processes that a child left running: its process group, and orphans adopted by this server."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(pid, signal.SIGKILL)
        while True:
            known = {child.pid for child in self._children.values()}
            orphans = [other for other in _child_processes() if other not in known]
            if not orphans:
                return
            for orphan in orphans:
                with suppress(ProcessLookupError):
                    os.kill(orphan, signal.SIGKILL)
                with suppress(ChildProcessError):
                    os.waitpid(orphan, 0)

    def _read(self, output: OutputPipe) -> None:
        if not output.is_closed and not output.read() and output.descriptor in self._selector.get_map():
            self._selector.unregister(output.descriptor)

    def _watch_memory(self) -> None:
        """Kill children above their memory limits."""
        if time.monotonic() < self._watched + WATCH_PERIOD:
            return
        self._watched = time.monotonic()
        for child in self._children.values():
            if child.status is None and not child.reason and _resident_memory(child.pid) > child.memory:
                child.kill(messages.OVER_MEMORY_LIMIT)

    def close(self) -> None:
        """End all children."""
        for number in list(self._children):
            self._end(messages.EndChild(number, kill=True))


def main(control: int) -> None:
    """Run the server; ``descriptor`` is its end of the socket to the client process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _adopt_orphans()
    server = FlightServer(socket.socket(fileno=control))
    try:
        load_library()  # for children, which do not write to the cache
        server.serve()
    finally:
        server.close()
        exit_process(0)


def _run_child(
    order: messages.Begin, subject: Any, descriptors: list[int], output: int, scratch: str, server: int
) -> NoReturn:
    """Do the task of a child that the process ``server`` has just forked, and exit."""
    status = 70  # an internal error (sysexits.h)
    try:
        end_with_parent(server)
        os.setsid()
        _adopt_orphans()
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))  # a crash writes no core file
        os.dup2(output, 1)
        os.dup2(output, 2)
        _close_all_but({0, 1, 2, *descriptors})
        os.chdir(order.folder)
        _limit_addresses(order.limits.memory)
        _use_scratch(scratch, order.limits.restriction)
        channel, *memory = descriptors
        status = do_task(order.task, subject, socket.socket(fileno=channel), memory)
    except BaseException:
        traceback.print_exc()
    finally:
        with suppress(Exception):
            sys.stdout.flush()
            sys.stderr.flush()
        os._exit(status)


def _use_scratch(scratch: str, restriction: Restriction | None) -> None:
    """Use the folder ``scratch`` for temporary files; under a restriction nothing else is writable."""
    for name in ("TMPDIR", "TEMP", "TMP"):
        os.environ[name] = scratch
    tempfile.tempdir = None  # it is determined again at its next use
    if restriction is not None:
        restrict(replace(restriction, writable=(scratch, *restriction.writable)))


def _close_all_but(remaining: set[int]) -> None:
    bounds = [*sorted(remaining), os.sysconf("SC_OPEN_MAX")]
    for before, after in itertools.pairwise(bounds):
        os.closerange(before + 1, after)


def _adopt_orphans() -> None:
    """Become the parent of descendants whose parents exit."""
    if IS_LINUX:
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def _child_processes() -> list[int]:
    """Return the numbers of this process's children, if the operating system lists them."""
    processes: list[int] = []
    for task in Path("/proc/self/task").glob("*/children"):
        with suppress(OSError):
            processes += map(int, task.read_text().split())
    return processes


def _limit_addresses(memory: int) -> None:
    """Make allocations fail once this process has reserved ``RESERVED * memory`` more bytes than now.

    This stops a process with memory that grows too fast for the server's periodic checks.
    """
    if IS_LINUX:
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        limit = _pages(os.getpid(), 0) + RESERVED * memory
        resource.setrlimit(resource.RLIMIT_AS, (limit if hard < 0 else min(limit, hard), hard))


def _resident_memory(process: int) -> int:
    """Return a process's resident memory in bytes; 0 if it is unknown or the process has exited."""
    return _pages(process, 1)


def _pages(process: int, column: int) -> int:
    """Return a column of /proc/PID/statm, converted to bytes."""
    try:
        return int(Path(f"/proc/{process}/statm").read_text().split()[column]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError, ValueError):
        return 0
