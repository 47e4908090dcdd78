"""Child that simulates a system: messages sent to it, state that it already has, and shared recorders."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass

import numpy as np

from ....common.errors import InputError
from ....common.machine.table_memory import check_table_memory
from ...options.fault import Fault
from ..flight.recorder import FmuActivity, rows_between
from ..flight.selection import Selection
from ..instances.instance import Log
from ..instances.renewal import ResetVerdict
from ..ssp.parameter_values import ParameterValue
from ..system.prepared import PreparedSystem
from . import messages
from .child_connection import ChildConnection, ChildEndedError, Watchdog
from .children import begin_child
from .restriction import limits_for
from .shared_recorder import SharedRecorder, make_recorder

RECORDERS = 2  # one is read by the caller while the next simulation runs
SEE_LOG = "perilune run --log info shows its messages"


@dataclass(frozen=True)
class Scenario:
    """Inputs of a simulation, see `BaseSimulation.advance`; ``values`` contains all parameters set so far."""

    first: int
    last: int
    every: int
    excitation: np.ndarray
    values: Mapping[str, ParameterValue]
    faults: tuple[Fault | None, ...]

    def equals(self, other: Scenario) -> bool:
        """Return True if both scenarios are equal and have no excitation."""
        span, other_span = ((each.first, each.last, each.every) for each in (self, other))
        is_same = span == other_span and not self.excitation.size and not other.excitation.size
        return is_same and self.values == other.values and self.faults == other.faults


class SystemProcess:
    """Child with instances of a system's FMUs, which records ``signals`` signals.

    It starts in parallel; `wait_until_ready` waits for it. ``formats`` is as in `SystemTask`.
    """

    def __init__(
        self, prepared: PreparedSystem, selection: Selection, signals: int, log: Log | None, *, formats: bool
    ) -> None:
        self.prepared = prepared
        self._signals, self._log = signals, log
        self.turn = 0  # number of the current recorder
        self.recorders = [self._make_recorder(rows_between(-1, prepared.steps))]
        self.recorder.enter(FmuActivity.INSTANTIATION)
        self.last: Scenario | None = None  # the last scenario that was sent
        self.has_verdicts, self._is_ready = False, False
        self.connection = self._begin(selection, formats=formats)

    @property
    def recorder(self) -> SharedRecorder:
        """Recorder of the current simulation, or of the last one."""
        return self.recorders[self.turn]

    @property
    def is_open(self) -> bool:
        """True if the FMUs are instantiated and the child has not been ended."""
        return self._is_ready and self.connection.is_open

    def _make_recorder(self, rows: int) -> SharedRecorder:
        check_table_memory(self._signals, rows, self.prepared.step)
        return make_recorder(self._signals, rows)

    def _begin(self, selection: Selection, *, formats: bool) -> ChildConnection:
        prepared, options, recorder = self.prepared, self.prepared.options, self.recorder
        level = None if self._log is None else self._log.level
        try:
            child = begin_child(
                prepared,
                messages.SystemTask(selection, level, formats, self._signals, recorder.times.size, recorder.name),
                folder=options.folder,
                limits=limits_for(prepared.network.fmus.values(), options),
                files=recorder.files,
            )
        except BaseException:
            recorder.close()
            raise
        watchdog = Watchdog(lambda: self.recorder.measure_progress(), options.limits["call_timeout"])
        return ChildConnection(child, self._write, watchdog)

    def wait_until_ready(self) -> None:
        """Wait until all FMUs are instantiated. Raises InputError if that fails, and ServerEndedError."""
        recorder, network = self.recorder, self.prepared.network
        with closing(recorder):
            try:
                self.connection.receive(messages.Done)
            except ChildEndedError as error:
                component = recorder.component_in_phase(self.prepared)
                fmu = network.fmus.get(component)
                label = fmu.label if fmu is not None else network.file
                raise InputError(label, component, f"cannot be instantiated: {error.how}", SEE_LOG) from None
            recorder.seal()
        self._is_ready = True

    def _write(self, line: str) -> None:
        if self._log is not None:
            self._log.write_line(line)

    def send_verdicts(self, verdicts: Mapping[str, ResetVerdict]) -> None:
        """Send the child the verdicts on how to restore FMUs, by SHA-256."""
        self.has_verdicts = True
        self.connection.send(messages.StoreVerdicts(dict(verdicts)))

    def send(self, scenario: Scenario, after: int, *, is_halted: bool) -> int:
        """Send the next scenario; return the number of its recorder, the next one after number ``after``.

        Values and faults are sent only if they differ from those sent before.
        """
        number = self._next_recorder(after, rows_between(scenario.first, scenario.last, scenario.every))
        self.recorders[number].halt[0] = is_halted
        values: Mapping[str, ParameterValue] = scenario.values
        faults: tuple[Fault | None, ...] | None = scenario.faults
        if self.last is not None:
            known = self.last.values
            values = {name: value for name, value in values.items() if known.get(name, self) != value}
            faults = None if faults == self.last.faults else faults
        excitation = scenario.excitation if scenario.excitation.size else None
        self.connection.send(
            messages.Simulate(number, scenario.first, scenario.last, scenario.every, dict(values), faults, excitation)
        )
        self.last = scenario
        return number

    def _next_recorder(self, before: int, rows: int) -> int:
        """Return the number of the next recorder; send it to the child if it is new or had to be enlarged."""
        number = (before + 1) % RECORDERS
        if number == len(self.recorders) or self.recorders[number].times.size < rows:
            fresh = self._make_recorder(max(rows, self.recorder.times.size))
            with closing(fresh):
                request = messages.AddRecorder(number, fresh.times.size, fresh.name)
                self.connection.ask(request, messages.Done, fresh.files)
                fresh.seal()
            self.recorders[number : number + 1] = [fresh]
        return number

    def describe_end(self, error: ChildEndedError) -> str:
        """Describe which component was running, and when and why the child ended."""
        return f"{self.recorder.describe_progress(self.prepared)}: {error.how}"

    @contextmanager
    def refusing_end(self) -> Iterator[ChildConnection]:
        """Yield the connection for requests other than simulations. Raises InputError if the child ends."""
        try:
            yield self.connection
        except ChildEndedError as error:
            raise InputError(self.prepared.network.file, "", self.describe_end(error), SEE_LOG) from None

    def abort(self, why: str) -> None:
        """End the child while another thread waits for its simulation."""
        if self._is_ready:
            self.connection.abort(why)
