"""Work of a child process: instantiates a system, or tests one FMU, and answers requests until its channel closes.

Foreign FMUs are loaded only in this module and in modules that it imports.
"""

from __future__ import annotations

import pickle
import random
import shutil
import socket
import sys
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from functools import cached_property, singledispatchmethod
from pathlib import Path
from typing import Any

import numpy as np
import numpy.random

from ....common.errors import InputError
from ....common.family.ending import end_after
from ....common.machine.os_errors import reason_of
from ....common.process import exit_process
from ..flight.base_simulation import NOTHING
from ..flight.memory import Memory, Snapshot
from ..flight.simulation import Simulation
from ..instances.instance import Log, leave_messages_unformatted
from ..instances.renewal import store_verdict
from ..instances.reset_check import try_renewals
from ..loop.library import load_library
from ..system.fmu import Fmu
from ..system.prepared import PreparedSystem
from . import messages
from .channel import ChannelError, receive_request, send_answer, send_line, send_numbers, unpack
from .shared_recorder import SharedRecorder, open_recorder

SEED = 0  # seed of generators that FMUs do not seed; C's rand() also starts from a fixed seed


def main() -> None:
    """Do the task read from standard input, and exit; for a process that was not forked."""
    order: messages.SpawnOrder = pickle.load(sys.stdin.buffer)
    end_after(order.parent)
    if sys.platform == "win32":
        assert isinstance(order.channel, bytes)
        channel = socket.fromshare(order.channel)
    else:
        assert isinstance(order.channel, int)
        channel = socket.socket(fileno=order.channel)
    subject = unpack(order.content)
    load_library()  # before time limits on calls of FMUs apply
    send_answer(channel, messages.Done())
    exit_process(do_task(order.task, subject, channel, order.files))


def do_task(task: messages.Task, subject: Any, channel: socket.socket, files: Sequence[int]) -> int:
    """Do a task with a system or an FMU, and return the exit status of the process.

    ``files`` are the open files of its recorder. The caller must exit at once: FMUs may have closed descriptors that
    they did not open.
    """
    if not task.formats:
        leave_messages_unformatted()
    try:
        try:
            _initialise_process(subject)
            if isinstance(task, messages.ResetTask):
                verdict = try_renewals(
                    subject,
                    lambda digest: send_answer(channel, messages.DefaultsSimulated(digest)),
                    with_reset=task.with_reset,
                )
                send_answer(channel, messages.ResetChecked(verdict.renewal, verdict.reason))
                return 0
            handler = RequestHandler(channel, task, subject, files)
        except InputError as error:
            send_answer(channel, messages.Refused.of(error))
            return 0
        send_answer(channel, messages.Done())
        handler.serve()
    except ChannelError:
        return messages.NO_CHANNEL
    return 0


def _initialise_process(subject: PreparedSystem | Fmu) -> None:
    """Bring this process to a reproducible state: freshly unpacked files of FMUs, seeded random number generators.

    Children of one server would inherit the same state of Python's and numpy's generators, but children of another
    server would not. Raises InputError if the files cannot be copied.
    """
    fmus = [subject] if isinstance(subject, Fmu) else list(subject.network.fmus.values())
    copies: dict[Path, Path] = {}
    for fmu in fmus:
        if not fmu.is_self_contained:
            if fmu.folder not in copies:
                copies[fmu.folder] = _copy_files(fmu)
            fmu.folder = copies[fmu.folder]
    random.seed(SEED)
    np.random.seed(SEED)


def _copy_files(fmu: Fmu) -> Path:
    """Copy an FMU's unpacked files to a folder of this process, and return the folder. Raises InputError."""
    folder = Path(tempfile.gettempdir())
    try:
        return Path(shutil.copytree(fmu.folder, Path(tempfile.mkdtemp(dir=folder)) / "fmu"))
    except OSError as error:
        reason = (
            error.args[0][0][2] if isinstance(error, shutil.Error) else reason_of(error)
        )  # reason for the first file
        problem, remedy = f"the FMU's files cannot be copied to it: {reason}", "free some space there, or set TMPDIR"
        raise InputError(fmu.label, str(folder), problem, remedy) from error


class RequestHandler:
    """Executes the requests to a child, with its simulation, recorders and snapshots."""

    def __init__(
        self, channel: socket.socket, task: messages.SystemTask, prepared: PreparedSystem, files: Sequence[int]
    ) -> None:
        self._channel = channel
        self._signals = task.signals
        recorder = self._open_recorder(task.rows, files, task.recorder)
        log = None if task.log is None else Log(task.log, self._write)
        self._simulation = Simulation(prepared, recorder=recorder, log=log, **vars(task.selection))
        self._recorders = {0: recorder}
        self._snapshots: dict[int, Snapshot] = {}

    def _write(self, line: str) -> None:
        with suppress(ChannelError):  # if it fails during a call of an FMU, the next answer fails, too
            send_line(self._channel, line)

    def _open_recorder(self, rows: int, files: Sequence[int], name: str) -> SharedRecorder:
        recorder = open_recorder(self._signals, rows, files, name)
        recorder.close()
        return recorder

    def serve(self) -> None:
        """Answer requests until the channel closes, then free the instances and send a last answer."""
        while True:
            try:
                request, files = receive_request(self._channel)
            except EOFError:
                break
            try:
                self._answer(request, files)
            except InputError as error:
                send_answer(self._channel, messages.Refused.of(error))
        self._simulation.close()
        send_answer(self._channel, messages.Freed())

    @singledispatchmethod
    def _answer(self, request: Any, _files: list[int]) -> None:
        raise TypeError(f"no request: {request!r}")

    @_answer.register
    def _(self, request: messages.Simulate, _files: list[int]) -> None:
        simulation = self._simulation
        recorder = self._recorders[request.recorder]
        if recorder is not simulation.recorder:
            simulation.record_into(recorder)
        simulation.set(request.values)
        if request.faults is not None:
            simulation.set_faults(request.faults)
        excitation = NOTHING if request.excitation is None else request.excitation
        flight = simulation.advance(request.first, request.last, excitation, every=request.every)
        send_answer(self._channel, messages.Simulated(flight.status, flight.message, flight.time.size))

    @_answer.register
    def _(self, request: messages.StoreVerdicts, _files: list[int]) -> None:
        for digest, verdict in request.verdicts.items():
            store_verdict(digest, verdict)

    @_answer.register
    def _(self, request: messages.AddRecorder, files: list[int]) -> None:
        self._recorders[request.number] = self._open_recorder(request.rows, files, request.name)
        send_answer(self._channel, messages.Done())

    @cached_property
    def _memory(self) -> Memory:
        return self._simulation.memory()

    @_answer.register
    def _(self, _request: messages.ListMemory, _files: list[int]) -> None:
        entries = [(cell.name, cell.unit, cell.component, cell.place) for cell in self._memory.cells]
        send_answer(self._channel, messages.CellList(entries))

    @_answer.register
    def _(self, _request: messages.ReadMemory, _files: list[int]) -> None:
        send_numbers(self._channel, self._memory.read())

    @_answer.register
    def _(self, request: messages.TakeSnapshot, _files: list[int]) -> None:
        number = max(self._snapshots, default=0) + 1
        self._snapshots[number] = self._memory.save(request.point)
        send_answer(self._channel, messages.Done(number))

    @_answer.register
    def _(self, request: messages.RestoreSnapshot, _files: list[int]) -> None:
        cell = None if request.cell is None else self._memory.cells[request.cell]
        self._memory.restore(self._snapshots[request.snapshot], cell, request.number)
        send_answer(self._channel, messages.Done())

    @_answer.register
    def _(self, request: messages.ReleaseSnapshot, _files: list[int]) -> None:
        self._memory.release(self._snapshots.pop(request.snapshot))
        send_answer(self._channel, messages.Done())
