"""What a child does: it instantiates a system, or tries one FMU, and answers requests until its channel is closed.

Only here, and in what this calls, are the libraries of FMUs loaded that fly in children.
"""

from __future__ import annotations

import random
import shutil
import socket
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from functools import singledispatchmethod
from pathlib import Path
from typing import Any

import numpy as np
import numpy.random

from .....common.errors import InputError
from .....common.machine.os_errors import reason_of
from ...flight.base_simulation import NOTHING
from ...flight.memory import Memory, Snapshot
from ...flight.simulation import Simulation
from ...instances.instance import Log, leave_messages_unformatted
from ...instances.renewal import store_verdict
from ...instances.reset_check import try_renewals
from ...system.fmu import Fmu
from ...system.prepared import PreparedSystem
from ..protocol import messages
from ..protocol.messages import ResetTrial, SystemFlights, send_answer, send_line, send_numbers
from ..protocol.orders import NO_CHANNEL
from ..protocol.requests import ChannelError, receive_request
from ..protocol.shared_recorder import SharedRecorder, open_recorder

SEED = 0  # of generators that FMUs leave at their start, as that of C's rand() is


def work(task: SystemFlights | ResetTrial, subject: Any, channel: socket.socket, memory: Sequence[int]) -> int:
    """Do a task with a system or an FMU; ``memory`` is the file of the recorder, if there is one.

    Returns the exit status of the process, whose FMUs may close what they did not open.
    """
    try:
        _do(task, subject, channel, memory)
    except ChannelError:
        return NO_CHANNEL
    return 0


def _do(task: SystemFlights | ResetTrial, subject: Any, channel: socket.socket, memory: Sequence[int]) -> None:
    if not task.formats:
        leave_messages_unformatted()
    try:
        _settle(subject)
        if isinstance(task, ResetTrial):
            verdict = try_renewals(
                subject, lambda digest: send_answer(channel, messages.Tried(digest)), with_reset=task.with_reset
            )
            send_answer(channel, messages.Verdict(verdict.renewal, verdict.reason))
            return
        recorder = open_recorder(task.signals, task.rows, memory, task.recorder)
        recorder.close()
        pilot = _Pilot(channel, task, subject, recorder)
    except InputError as error:
        send_answer(channel, _refusal(error))
        return
    send_answer(channel, messages.Done())
    pilot.serve()


def _settle(subject: PreparedSystem | Fmu) -> None:
    """Bring this process to the state of every other that simulates this: files as unpacked, generators at their start.

    Children of one server would share the state of Python's and numpy's generators, and those of another not. Raises
    InputError where the files cannot be copied.
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
    """Return a folder of this process with the files of an FMU as unpacked. Raises InputError."""
    folder = Path(tempfile.gettempdir())
    try:
        return Path(shutil.copytree(fmu.folder, Path(tempfile.mkdtemp(dir=folder)) / "fmu"))
    except OSError as error:
        reason = error.args[0][0][2] if isinstance(error, shutil.Error) else reason_of(error)  # of the first file
        problem, remedy = f"its files cannot be copied to it: {reason}", "free some space there, or set TMPDIR"
        raise InputError(fmu.label, str(folder), problem, remedy) from error


class _Pilot:
    """Carries out the requests to one simulation."""

    def __init__(
        self, channel: socket.socket, task: SystemFlights, prepared: PreparedSystem, recorder: SharedRecorder
    ) -> None:
        self._channel = channel
        self._signals = task.signals
        selection = task.selection
        self._simulation = Simulation(
            prepared,
            varied=selection.varied,
            wanted=selection.wanted,
            more=selection.more,
            faults=selection.faults,
            excited=selection.excited,
            open_end=selection.open_end,
            log=None if task.log is None else Log(task.log, self._write),
            recorder=recorder,
        )
        self._recorders = {0: recorder}
        self._memory: Memory | None = None
        self._snapshots: dict[int, Snapshot] = {}

    def _write(self, line: str) -> None:
        with suppress(ChannelError):  # an FMU's function is under way: the next answer fails, too
            send_line(self._channel, line)

    def serve(self) -> None:
        """Answer requests until there are no more, then free the instances and say so."""
        while True:
            try:
                request, descriptors = receive_request(self._channel)
            except EOFError:
                break
            try:
                self._answer(request, descriptors)
            except InputError as error:
                send_answer(self._channel, _refusal(error))
        self._simulation.close()
        send_answer(self._channel, messages.Freed())

    @singledispatchmethod
    def _answer(self, request: Any, _descriptors: list[int]) -> None:
        raise TypeError(f"no request: {request!r}")

    @_answer.register
    def _(self, request: messages.Fly, _descriptors: list[int]) -> None:
        simulation = self._simulation
        recorder = self._recorders[request.recorder]
        if recorder is not simulation.recorder:
            simulation.record_into(recorder)
        simulation.set(request.values)
        if request.faults is not None:
            simulation.set_faults(request.faults)
        excitation = NOTHING if request.excitation is None else request.excitation
        flight = simulation.advance(request.first, request.last, excitation, every=request.every)
        send_answer(self._channel, messages.Flown(flight.status, flight.message, flight.time.size))

    @_answer.register
    def _(self, request: messages.KnownVerdicts, _descriptors: list[int]) -> None:
        for digest, verdict in request.verdicts.items():
            store_verdict(digest, verdict)

    @_answer.register
    def _(self, request: messages.NewRecorder, descriptors: list[int]) -> None:
        recorder = open_recorder(self._signals, request.rows, descriptors, request.name)
        recorder.close()
        self._recorders[request.number] = recorder
        send_answer(self._channel, messages.Done())

    @property
    def _system_memory(self) -> Memory:
        if self._memory is None:
            self._memory = self._simulation.memory()
        return self._memory

    @_answer.register
    def _(self, _request: messages.ListMemory, _descriptors: list[int]) -> None:
        entries = [(cell.name, cell.unit, cell.component, cell.place) for cell in self._system_memory.cells]
        send_answer(self._channel, messages.CellList(entries))

    @_answer.register
    def _(self, _request: messages.ReadMemory, _descriptors: list[int]) -> None:
        send_numbers(self._channel, self._system_memory.read())

    @_answer.register
    def _(self, request: messages.TakeSnapshot, _descriptors: list[int]) -> None:
        number = max(self._snapshots, default=0) + 1
        self._snapshots[number] = self._system_memory.take(request.point)
        send_answer(self._channel, messages.Done(number))

    @_answer.register
    def _(self, request: messages.PutBack, _descriptors: list[int]) -> None:
        cell = None if request.cell is None else self._system_memory.cells[request.cell]
        self._system_memory.put_back(self._snapshots[request.snapshot], cell, request.number)
        send_answer(self._channel, messages.Done())

    @_answer.register
    def _(self, request: messages.ReleaseSnapshot, _descriptors: list[int]) -> None:
        self._system_memory.release(self._snapshots.pop(request.snapshot))
        send_answer(self._channel, messages.Done())


def _refusal(error: InputError) -> messages.Refused:
    return messages.Refused(error.file, error.element, error.problem, error.remedy)
