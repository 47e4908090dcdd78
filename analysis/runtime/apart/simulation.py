"""A simulation in a child, with the methods and the bits of one in this process."""

from __future__ import annotations

import time
import warnings
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from ....common.errors import InputError
from ....common.machine.room import check_room
from ...options.fault import Fault
from ..flight.base_simulation import NOTHING, BaseSimulation, Choices
from ..flight.endings import FLIGHT_STATUSES
from ..flight.program import layout_of
from ..flight.recorder import Phase, rows_between
from ..flight.results import COMPLETE, CRASHED, Flight
from ..flight.selection import check_replaced
from ..ssp.given_values import ParameterValue
from ..system.prepared import PreparedSystem
from . import progress
from .connection import ChildEndedError, Connection, ServerEndedError, Stillness
from .containment import limits_for
from .memory import ApartMemory
from .protocol import messages
from .protocol.orders import SERVER_ENDED
from .protocol.shared_recorder import SharedRecorder, make_recorder
from .resets import TrialWatch, find_verdicts, note_processes
from .servers import Subject, begin_child

ATTEMPTS = 2  # at a flight, whose server ends
RECORDERS = 2  # one flight is looked at while the next one flies
SEE_LOG = "perilune run --log info shows what it logs"


@dataclass(frozen=True)
class _Departure:
    """A flight that a child is to fly, with ``values`` of varied parameters and ``faults``."""

    request: messages.Fly
    values: Mapping[str, ParameterValue]
    faults: tuple[Fault | None, ...]


class ApartSimulation(BaseSimulation):
    """Instances of a system's FMUs in a child of the flight server.

    A flight whose process ends comes back ``crashed``, ``hung`` or ``out_of_memory``, with its rows. A child flies
    again and again, but is replaced after a flight that has gone wrong, since an FMU that did may have harmed it.
    Raises InputError where a child ends otherwise than in flight.
    """

    def __init__(self, prepared: PreparedSystem, **choices: Unpack[Choices]) -> None:
        super().__init__(prepared, **choices)
        injections = self._selection.injections(prepared.step)
        self.layout = layout_of(
            prepared.network, self.settings, self._selection.wanted, injections, self._selection.more
        )
        self.signal_names = self._selection.signal_names(self.layout, prepared.network.file)
        self._types = {name: self.layout.types[name] for name in self.signal_names}
        self._values: dict[str, ParameterValue] = {}
        self._last: _Departure | None = None  # of the child, which has its values and faults
        self._knows_verdicts = False  # whether the child does
        self._recorders: list[SharedRecorder] = []  # of the child
        self._turn = 0  # which of them takes the flight that is under way
        self._announced: deque[_Departure] = deque()  # under way, or to follow
        self._resets = TrialWatch()  # of trials that are under way in another thread
        self._is_halted = False
        self._renews = True  # whether a child flies more than once
        self._needs_processes = False  # whether it may not, since FMUs leave behind what only a new process is without
        self._noted: set[str] = set()  # what has been warned of
        self._formats = True  # of messages, which can end a process whose arguments are missing
        try:
            self._connection = self._begin()
        except ServerEndedError:
            self._connection = self._begin()  # of another server

    @property
    def recorder(self) -> SharedRecorder:  # type: ignore[override]
        """Of the flight that is under way, or the last one."""
        return self._recorders[self._turn]

    def _make_recorder(self, rows: int) -> SharedRecorder:
        check_room(len(self.signal_names), rows, self.prepared.step)
        return make_recorder(len(self.signal_names), rows)

    def _begin(self) -> Connection:
        """A child with everything instantiated. Raises InputError where that does not do."""
        prepared, options = self.prepared, self.prepared.options
        recorder = self._make_recorder(rows_between(-1, prepared.steps))
        recorder.enter(Phase.INSTANTIATION)
        self._recorders, self._turn = [recorder], 0
        self.flights, self._last, self._knows_verdicts = 0, None, False
        level = None if self._log is None else self._log.level
        with closing(recorder):
            child = begin_child(
                Subject(prepared, prepared.of_flights()),
                messages.SystemFlights(
                    self._selection, level, self._formats, len(self.signal_names), recorder.times.size, recorder.name
                ),
                folder=options.folder,
                limits=limits_for(prepared.network.fmus.values(), options),
                files=recorder.files,
            )
            connection = Connection(
                child, self._write, Stillness(lambda: progress.measure(self.recorder), options.call_timeout)
            )
            try:
                connection.hear(messages.Done)
            except ChildEndedError as error:
                component = progress.component_in_phase(prepared, recorder)
                fmu = prepared.network.fmus.get(component)
                label = fmu.label if fmu is not None else prepared.network.file
                problem = f"cannot be instantiated: {error.how}"
                raise InputError(label, component, problem, SEE_LOG) from None
            recorder.seal()
        return connection

    def _write(self, line: str) -> None:
        if self._log is not None:
            self._log.write_line(line)

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """Give varied parameters other values, from the next start on."""
        super().set(values)
        self._values |= values

    def set_faults(self, faults: Sequence[Fault | None]) -> None:
        """Give faults other values and windows, from the next start on."""
        check_replaced(self._selection.faults, faults)
        self._faults = faults

    def announce(self, values: Mapping[str, ParameterValue], faults: Sequence[Fault | None]) -> None:
        """See `BaseSimulation.announce`."""
        with suppress(ServerEndedError):  # which the flight itself comes to, too
            self._find_verdicts()
        is_ready = self._connection.is_open and self._renews and not self._is_halted and not self._needs_processes
        if is_ready and len(self._announced) < RECORDERS and (not self._announced or len(self._recorders) == RECORDERS):
            self.set(values)
            self.set_faults(faults)
            with suppress(ChildEndedError, ServerEndedError):
                self._announced.append(self._depart(-1, self.prepared.steps, 1, NOTHING))

    def advance(self, first: int, last: int, excitation: np.ndarray = NOTHING, *, every: int = 1) -> Flight:
        """See `BaseSimulation.advance`; a flight whose server ends is simulated once more, if from its start."""
        for _ in range(ATTEMPTS if first < 0 else 1):
            try:
                return self._advance(first, last, excitation, every)
            except ServerEndedError:
                self._announced.clear()
                self._connection.kill()
        return self._flight(progress.count_rows(self.recorder, first, every), CRASHED, SERVER_ENDED)

    def _advance(self, first: int, last: int, excitation: np.ndarray, every: int) -> Flight:
        try:
            if self._announced and not self._is_as_announced(self._announced[0], first, last, every, excitation):
                self._recall()
            departed = self._announced.popleft() if self._announced else self._depart(first, last, every, excitation)
            self._turn = departed.request.recorder
            self.flights += first < 0
            self.recorder.halt[0] = self._is_halted
            flown = self._connection.hear(messages.Flown)
        except ChildEndedError as error:
            self._announced.clear()
            if self.recorder.phase[0] == Phase.RENEWAL and self._renews:
                self._renews = False  # it happened after a flight, and before this one
                self._note("it was terminated and reset", error.how)
                return self._advance(first, last, excitation, every)
            return self._lost(error, first, every)
        if flown.status not in FLIGHT_STATUSES or not 0 <= flown.rows <= self.recorder.times.size:
            self._connection.kill()
            return self._flight(0, CRASHED, "answers that cannot be read")
        if (flown.status not in COMPLETE and not self.prepared.is_self_contained) or not self._formats:
            self._recall()
            self._free()
            self._formats = True
        return self._flight(flown.rows, flown.status, flown.message)

    def _is_as_announced(
        self, announced: _Departure, first: int, last: int, every: int, excitation: np.ndarray
    ) -> bool:
        """Whether the flight that was announced is the one that `advance` is called for."""
        request = announced.request
        is_same = (first, last, every, excitation.size) == (request.first, request.last, request.every, 0)
        return is_same and announced.values == self._values and announced.faults == tuple(self._faults)

    def _recall(self) -> None:
        """Do without the flights that were announced: they end at their next communication points."""
        with suppress(ChildEndedError, ServerEndedError):
            while self._announced:
                self._recorders[self._announced[0].request.recorder].halt[0] = True
                self._connection.hear(messages.Flown)
                self._announced.popleft()
        self._announced.clear()

    def _depart(self, first: int, last: int, every: int, excitation: np.ndarray) -> _Departure:
        """Let the child fly, behind what was announced, into the recorder whose turn it is then."""
        self._make_ready(first)
        recorder = self._recorder_for(rows_between(first, last, every))
        faults, known = tuple(self._faults), self._last
        if known is None:
            values, is_known = dict(self._values), False
        else:
            values = {name: value for name, value in self._values.items() if known.values.get(name, self) != value}
            is_known = faults == known.faults
        excited = excitation if excitation.size else None
        request = messages.Fly(recorder, first, last, every, values, None if is_known else faults, excited)
        self._connection.send(request)
        self._last = _Departure(request, dict(self._values), faults)
        return self._last

    def _make_ready(self, first: int) -> None:
        """Have a child that can fly, and knows whose reset cannot be trusted."""
        if first >= 0:
            return
        self._find_verdicts()
        if not self._renews:
            self._connection.kill()
        if self._needs_processes and self._last is not None:
            self._free()
            begun = time.monotonic()
            self._connection = self._begin()
            note_processes(self.prepared, time.monotonic() - begun)
        if not self._connection.is_open:
            self._connection = self._begin()

    def _find_verdicts(self) -> None:
        """Send the child what renews FMUs, once it has simulated; note whether it may do so again."""
        if self._last is None or self._knows_verdicts or not self._connection.is_open:
            return
        self._resets = TrialWatch()
        verdicts = find_verdicts(self.prepared, self._resets)
        self._knows_verdicts = True
        self._connection.send(messages.KnownVerdicts(dict(verdicts)))
        self._needs_processes = any(verdict.needs_process for verdict in verdicts.values())

    def _recorder_for(self, rows: int) -> int:
        """The number of the recorder whose turn it is; the child is given one where it has none, or too small a one."""
        before = self._announced[-1].request.recorder if self._announced else self._turn
        turn = (before + 1) % RECORDERS
        if turn == len(self._recorders) or self._recorders[turn].times.size < rows:
            fresh = self._make_recorder(max(rows, self.recorder.times.size))
            with closing(fresh):
                request = messages.NewRecorder(turn, fresh.times.size, fresh.name)
                self._connection.ask(request, messages.Done, fresh.files)
                fresh.seal()
            self._recorders[turn : turn + 1] = [fresh]
        self._recorders[turn].halt[0] = self._is_halted
        return turn

    def _flight(self, rows: int, status: str, message: str) -> Flight:
        recorder = self.recorder
        signals = dict(zip(self.signal_names, recorder.record[:, :rows], strict=True))
        return Flight(recorder.times[:rows], signals, self._types, status, message)

    def _lost(self, error: ChildEndedError, first: int, every: int) -> Flight:
        """A flight whose process ended, with the rows that it left.

        The next one flies with messages as they are: a format without its arguments may have ended this one.
        """
        self._formats = not self._formats or error.status != CRASHED
        message = f"{progress.describe(self.prepared, self.recorder)}: {error.how}"
        return self._flight(progress.count_rows(self.recorder, first, every), error.status, message)

    def interrupt(self, halt: bool = True) -> None:
        """See `BaseSimulation.interrupt`."""
        self._is_halted = halt
        self.recorder.halt[0] = halt

    def give_up(self, why: str) -> bool:
        """End the child of a flight that is under way in another thread, which then comes back ``hung``."""
        self._resets.give_up(why)
        self._connection.give_up(why)
        return True

    def memory(self) -> ApartMemory:
        """What the FMUs remember. Raises InputError where one does not tell how it serialises it."""
        return ApartMemory(self)

    def ask(self, request: object, expected: type[messages.Kind]) -> messages.Kind:
        """Something else than a flight. Raises InputError, also where the child ends."""
        try:
            return self._connection.ask(request, expected)
        except ChildEndedError as error:
            raise self._refusal(error) from None

    def ask_numbers(self, request: object, count: int) -> np.ndarray:
        """Likewise, for so many float64."""
        try:
            return self._connection.ask_numbers(request, count)
        except ChildEndedError as error:
            raise self._refusal(error) from None

    def _refusal(self, error: ChildEndedError) -> InputError:
        return InputError(
            self.prepared.network.file, "", f"{progress.describe(self.prepared, self.recorder)}: {error.how}", SEE_LOG
        )

    def close(self) -> None:
        """Free the instances, and end the child; at once, where a flight is under way in a thread, given up."""
        if self.recorder.phase[0] == Phase.IDLE and not self._announced:
            self._free()
        else:
            self._connection.kill()

    def _free(self) -> None:
        """End the child once its FMUs are terminated and freed; flights that were flown before stand as they are."""
        problem = self._connection.close()
        if problem:
            self._note("it was terminated and freed", problem)

    def _note(self, when: str, problem: str) -> None:
        """Warn, once, of what an FMU does between flights, which no flight is to blame for."""
        text = f"{progress.component_in_phase(self.prepared, self.recorder)}: when {when}, {problem}"
        if text not in self._noted:
            self._noted.add(text)
            warnings.warn(text, stacklevel=4)
