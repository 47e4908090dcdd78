"""Simulation in a child, with the interface and exactly the results of a simulation in this process."""

from __future__ import annotations

import time
import warnings
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from ...options.fault import Fault
from ..flight.base_memory import BaseMemory, MemoryCell
from ..flight.base_simulation import NOTHING, BaseSimulation, Choices
from ..flight.endings import FLIGHT_STATUSES
from ..flight.program import make_layout
from ..flight.recorder import FmuActivity
from ..flight.results import COMPLETE, CRASHED, Flight
from ..flight.selection import check_replaced
from ..ssp.parameter_values import ParameterValue
from ..system.prepared import PreparedSystem
from . import messages
from .child_connection import ChildEndedError, ServerEndedError
from .messages import SERVER_ENDED
from .resets import TrialWatch, find_verdicts, warn_of_processes
from .shared_recorder import SharedRecorder
from .system_process import RECORDERS, Scenario, SystemProcess

ATTEMPTS = 2  # attempts at a simulation whose server ends


class ProcessSimulation(BaseSimulation):
    """Simulation with FMU instances in a child of the flight server.

    If the child ends, the flight has the status ``crashed``, ``hung`` or ``out_of_memory``, and the rows recorded so
    far. A child is reused, but it is replaced after a failure, which may have corrupted it. Raises InputError if a
    child ends outside a simulation.
    """

    def __init__(self, prepared: PreparedSystem, **choices: Unpack[Choices]) -> None:
        super().__init__(prepared, **choices)
        injections = self._selection.injections(prepared.step)
        self.layout = make_layout(
            prepared.network, self.settings, self._selection.requested, injections, self._selection.additional
        )
        self.signal_names = self._selection.signal_names(self.layout, prepared.network.file)
        self._types = {name: self.layout.types[name] for name in self.signal_names}
        self._values: dict[str, ParameterValue] = {}
        self._announced: deque[tuple[Scenario, int]] = deque()  # sent scenarios with numbers of their recorders
        self._resets = TrialWatch()  # ends tests in another thread
        self._is_halted = False
        self._renews = True  # False once a child has ended in a reset
        self._needs_processes = False  # True if earlier simulations affect later ones in the same process
        self._noted: set[str] = set()  # texts of warnings
        self._formats = True  # as in `SystemTask`; formats with missing arguments can end a process
        try:
            self._start()
        except ServerEndedError:
            self._start()  # a child of a new server

    @property
    def recorder(self) -> SharedRecorder:  # type: ignore[override]
        """Recorder of the current simulation, or of the last one."""
        return self.process.recorder

    def _start(self) -> None:
        """Start a child. Raises InputError if an FMU cannot be instantiated."""
        self.flights = 0
        self.process = SystemProcess(
            self.prepared, self._selection, len(self.signal_names), self._log, formats=self._formats
        )
        self.process.wait_until_ready()

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """See `BaseSimulation.set`."""
        super().set(values)
        self._values |= values

    def set_faults(self, faults: Sequence[Fault | None]) -> None:
        """See `BaseSimulation.set_faults`."""
        check_replaced(self._selection.faults, faults)
        self._faults = faults

    def queue_run(self, values: Mapping[str, ParameterValue], faults: Sequence[Fault | None]) -> None:
        """See `BaseSimulation.queue_run`."""
        with suppress(ServerEndedError):  # the simulation itself raises it, too
            self._find_verdicts()
        is_ready = self.process.is_open and self._renews and not self._is_halted and not self._needs_processes
        has_recorder = not self._announced or len(self.process.recorders) == RECORDERS
        if is_ready and len(self._announced) < RECORDERS and has_recorder:
            self.set(values)
            self.set_faults(faults)
            with suppress(ChildEndedError, ServerEndedError):
                self._announced.append(self._send(self._scenario(-1, self.prepared.steps, 1, NOTHING)))

    def advance(self, first: int, last: int, excitation: np.ndarray = NOTHING, *, every: int = 1) -> Flight:
        """See `BaseSimulation.advance`. If the server ends, a simulation from the start is repeated on a new server."""
        scenario = self._scenario(first, last, every, excitation)
        for _ in range(ATTEMPTS if first < 0 else 1):
            try:
                return self._simulate(scenario)
            except ServerEndedError:
                self._announced.clear()
                self.process.connection.kill()
        return self._flight(self.recorder.count_rows(first, every), CRASHED, SERVER_ENDED)

    def _scenario(self, first: int, last: int, every: int, excitation: np.ndarray) -> Scenario:
        return Scenario(first, last, every, excitation, dict(self._values), tuple(self._faults))

    def _simulate(self, scenario: Scenario) -> Flight:
        try:
            if self._announced and not self._announced[0][0].equals(scenario):
                self._recall()
            _, self.process.turn = self._announced.popleft() if self._announced else self._send(scenario)
            self.flights += scenario.first < 0
            self.recorder.halt[0] = self._is_halted
            answer = self.process.connection.receive(messages.Simulated)
        except ChildEndedError as error:
            self._announced.clear()
            if self.recorder.phase[0] == FmuActivity.RENEWAL and self._renews:
                self._renews = False  # the child ended between two simulations
                self._note("it was terminated and reset", error.how)
                return self._simulate(scenario)
            # A format without its arguments may have ended the child: the next one does not format messages.
            self._formats = not self._formats or error.status != CRASHED
            rows = self.recorder.count_rows(scenario.first, scenario.every)
            return self._flight(rows, error.status, self.process.describe_end(error))
        if answer.status not in FLIGHT_STATUSES or not 0 <= answer.rows <= self.recorder.times.size:
            self.process.connection.kill()
            return self._flight(0, CRASHED, "answers that cannot be read")
        if (answer.status not in COMPLETE and not self.prepared.is_self_contained) or not self._formats:
            self._recall()
            self._free()
            self._formats = True
        return self._flight(answer.rows, answer.status, answer.message)

    def _recall(self) -> None:
        """Cancel announced simulations, which then end at their next communication points."""
        with suppress(ChildEndedError, ServerEndedError):
            while self._announced:
                self.process.recorders[self._announced[0][1]].halt[0] = True
                self.process.connection.receive(messages.Simulated)
                self._announced.popleft()
        self._announced.clear()

    def _send(self, scenario: Scenario) -> tuple[Scenario, int]:
        """Let the child simulate a scenario after the announced ones; return it with its recorder's number."""
        if scenario.first < 0:
            self._prepare_process()
        after = self._announced[-1][1] if self._announced else self.process.turn
        return scenario, self.process.send(scenario, after, is_halted=self._is_halted)

    def _prepare_process(self) -> None:
        """Replace a child that has ended or must not be reused, and send the new child the verdicts on FMUs."""
        self._find_verdicts()
        if not self._renews:
            self.process.connection.kill()
        if self._needs_processes and self.process.last is not None:
            self._free()
            begun = time.monotonic()
            self._start()
            warn_of_processes(self.prepared, time.monotonic() - begun)
        if not self.process.is_open:
            self._start()

    def _find_verdicts(self) -> None:
        """Send the child the verdicts on FMUs after its first simulation; note whether the child may be reused."""
        if self.process.last is None or self.process.has_verdicts or not self.process.is_open:
            return
        self._resets = TrialWatch()
        verdicts = find_verdicts(self.prepared, self._resets)
        self.process.send_verdicts(verdicts)
        self._needs_processes = any(verdict.needs_process for verdict in verdicts.values())

    def _flight(self, rows: int, status: str, message: str) -> Flight:
        recorder = self.recorder
        signals = dict(zip(self.signal_names, recorder.record[:, :rows], strict=True))
        return Flight(recorder.times[:rows], signals, self._types, status, message)

    def interrupt(self, halt: bool = True) -> None:
        """See `BaseSimulation.interrupt`."""
        self._is_halted = halt
        self.recorder.halt[0] = halt

    def abort(self, why: str) -> bool:
        """End the child of a simulation running in another thread; its flight then has the status ``hung``."""
        self._resets.cancel(why)
        self.process.abort(why)
        return True

    def memory(self) -> ProcessMemory:
        """See `BaseSimulation.memory`."""
        return ProcessMemory(self)

    def close(self) -> None:
        """Free the instances and end the child; kill a child that is still simulating for an abandoned thread."""
        if self.recorder.phase[0] == FmuActivity.IDLE and not self._announced:
            self._free()
        else:
            self.process.connection.kill()

    def _free(self) -> None:
        """End the child after its FMUs are terminated and freed; problems in doing so do not fail a simulation."""
        problem = self.process.connection.close()
        if problem:
            self._note("it was terminated and freed", problem)

    def _note(self, when: str, problem: str) -> None:
        """Warn, once, of a problem of an FMU between simulations."""
        text = f"{self.recorder.component_in_phase(self.prepared)}: when {when}, {problem}"
        if text not in self._noted:
            self._noted.add(text)
            warnings.warn(text, stacklevel=4)


@dataclass(frozen=True)
class ProcessSnapshot:
    """Snapshot of a child, by its number and communication point."""

    point: int
    number: int


class ProcessMemory(BaseMemory[ProcessSnapshot]):
    """Memory of a system that is simulated in a child. All methods raise InputError."""

    def __init__(self, simulation: ProcessSimulation) -> None:
        self._simulation = simulation
        with simulation.process.refusing_end() as connection:
            entries = connection.ask(messages.ListMemory(), messages.CellList).entries
        self.cells = [MemoryCell(*entry) for entry in entries]

    def read(self) -> np.ndarray:
        """See `BaseMemory.read`."""
        with self._simulation.process.refusing_end() as connection:
            return connection.ask_numbers(messages.ReadMemory(), len(self.cells))

    def save(self, point: int) -> ProcessSnapshot:
        """See `BaseMemory.save`."""
        return ProcessSnapshot(point, self._ask(messages.TakeSnapshot(point)))

    def restore(self, snapshot: ProcessSnapshot, cell: MemoryCell | None = None, number: float = 0.0) -> None:
        """See `BaseMemory.restore`."""
        index = None if cell is None else self.cells.index(cell)
        self._ask(messages.RestoreSnapshot(snapshot.number, index, number))

    def release(self, snapshot: ProcessSnapshot) -> None:
        """See `BaseMemory.release`."""
        self._ask(messages.ReleaseSnapshot(snapshot.number))

    def _ask(self, request: object) -> int:
        with self._simulation.process.refusing_end() as connection:
            return connection.ask(request, messages.Done).number
