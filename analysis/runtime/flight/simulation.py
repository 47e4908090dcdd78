"""Simulation of a system in this process: instances, program, buffers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Unpack

import numpy as np

from ....common.collection import no_collection
from ...options.choices import FUSED
from ...options.fault import Fault
from ..fused.fuse import fuse, is_compilable
from ..fused.refusals import can_fuse, check_fused
from ..instances.instance import Instance, instantiate
from ..loop import arrays, codes
from ..loop.loop import Loop
from ..ssp.parameter_values import ParameterValue
from ..system.namesakes.namesakes import note_loaded
from ..system.passing.flight_table import FlightTable
from ..system.prepared import PreparedSystem
from .base_simulation import NOTHING, BaseSimulation, Choices
from .endings import STATUS, TERMINATED, Outcome, describe_outcome, describe_termination, end_request
from .group import FlightGroup, flights_in_group, group_of
from .instructions import write_ending
from .life_cycle import LifeCycle
from .memory import Memory
from .orders.injections import NEVER, of_fault
from .orders.transfers import needs_events
from .program import build_program
from .recorder import FlightRecorder, FmuActivity, rows_between
from .results import Flight
from .selection import TIME_MARGIN, check_replaced


class Simulation(BaseSimulation):
    """Simulation in this process, which resets and reuses its FMU instances; ``recorder`` receives the rows."""

    def __init__(
        self, prepared: PreparedSystem, *, recorder: FlightRecorder | None = None, **choices: Unpack[Choices]
    ) -> None:
        super().__init__(prepared, **choices)
        self.recorder = FlightRecorder() if recorder is None else recorder
        self.instances: dict[str, Instance] = {}
        if self._log is not None:
            self._log.follow(self._time)
        with no_collection():
            self._instantiate()

    def _instantiate(self) -> None:
        prepared = self.prepared
        for number, (name, fmu) in enumerate(prepared.network.fmus.items()):
            self.recorder.enter(FmuActivity.INSTANTIATION, number)
            if prepared.options.trust["in_process"]:
                note_loaded(fmu)
            uses_events = needs_events(prepared.network, name)
            self.instances[name] = instantiate(fmu, name, self._log, uses_events=uses_events)
        injections = self._selection.injections(prepared.step)
        self.program, self.fmi3, self._instructions, self.layout = build_program(
            prepared, self.settings, self.instances, self._selection.requested, injections, self._selection.additional
        )
        self.set_faults(self._faults)
        self.signal_names = self._selection.signal_names(self.layout, prepared.network.file)
        self._types = {name: self.layout.types[name] for name in self.signal_names}
        self._recorded = np.array([self.layout.slots[name] for name in self.signal_names], dtype=np.int64)
        self.buffers = arrays.Buffers(
            values=np.zeros(len(self.layout.slots)),
            whole=np.zeros(len(self.layout.slots), dtype=np.int32),
            frozen=np.zeros(len(injections)),
            read_back=self.layout.parameters.blank(),
            texts=self.layout.texts.memory(),
            outcome=self.recorder.outcome,
            halt=self.recorder.halt,
        )
        self.loop = Loop(self_contained=prepared.is_self_contained)
        self.fused_steps = self._fuse(prepared)
        self.life_cycle = LifeCycle(self.instances, self.program, self.fmi3, self._instructions, self._note_subject)
        self.recorder.enter(FmuActivity.IDLE)

    def _fuse(self, prepared: PreparedSystem) -> int:
        """Return the address of the system's compiled steps, 0 if its options do not request them."""
        if prepared.options.chosen["flavour"] != FUSED:
            return 0
        check_fused(prepared)
        return fuse(self.instances, self.program, self._recorded.tolist(), self._is_needed)

    def _is_needed(self) -> bool:
        return not self.recorder.halt[0]

    def fuse(self) -> None:
        """See `BaseSimulation.fuse`. Raises InputError if the compiler rejects the steps or changes results."""
        if not self.fused_steps and can_fuse(self.prepared) and is_compilable(self.program):
            fused = replace(self.prepared, options=self.prepared.options.replace(flavour=FUSED))
            with self.loop.under_way:  # prevents `close` while the instances are in use
                self.fused_steps = self._fuse(fused)
            self.prepared = fused

    def ignore_finished(self) -> None:
        """Let later simulations continue after the system has finished."""
        self.program = self.program._replace(finished_slot=-1)
        self.fused_steps = self._fuse(self.prepared)

    def queue_run(self, _values: Mapping[str, ParameterValue], _faults: Sequence[Fault | None]) -> None:
        """No-op: in-process simulations use the calling thread."""

    def abort(self, _why: str) -> bool:
        """Return False: a thread cannot be ended."""
        return False

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """See `BaseSimulation.set`.

        Elements of partly connected arrays, and parameters that change during simulation, are set in each step, too.
        """
        super().set(values)
        self._initialise_unfed()

    def _initialise_unfed(self) -> None:
        """Initialise slots that nothing writes from the current parameters: of unconnected array elements, and of set
        values of parameters that change during simulation.
        """
        for key, slot in self.layout.bases.items():
            if key in self.layout.parameters:
                self.program.initial[slot] = float(self.layout.parameters[key])
        if self.fmi3 is not None:
            for name in self.layout.unfed & self._varied.keys():
                slot, number = self.layout.slots[name], self.layout.parameters[self._varied[name]]
                self.program.initial[slot] = float(number)
                self.fmi3.start[slot] = int(number) % 2**64

    def set_faults(self, faults: Sequence[Fault | None]) -> None:
        """See `BaseSimulation.set_faults`."""
        check_replaced(self._selection.faults, faults)
        for number, fault in enumerate(faults):
            self.program.fault_window[number] = NEVER
            if fault is not None:
                injection = of_fault(fault, TIME_MARGIN * self.prepared.step)
                self.program.fault_window[number] = injection.window
                self.program.fault_value[number] = injection.value
        self._faults = faults

    def _time(self) -> float:
        """Return the time (s) of the communication point being computed."""
        return self.prepared.start + self.recorder.point * self.prepared.step

    def _note_subject(self, component: int) -> None:
        self.recorder.phase[1] = component

    def record_into(self, recorder: FlightRecorder) -> None:
        """Write the rows of later simulations to another recorder. Terminates no FMU."""
        self.recorder = recorder
        self.buffers = self.buffers._replace(outcome=recorder.outcome, halt=recorder.halt)

    def advance(self, first: int, last: int, excitation: np.ndarray = NOTHING, *, every: int = 1) -> Flight:
        """See `BaseSimulation.advance`."""
        return self._advance(first, last, every, excitation)

    def _advance(self, first: int, last: int, every: int, excitation: np.ndarray) -> Flight:
        prepared, recorder = self.prepared, self.recorder
        if first < 0:
            recorder.enter(FmuActivity.RENEWAL)
        reset = first < 0 and self.life_cycle.make_ready()
        recorder.reserve(self._recorded.size, rows_between(first, last, every), prepared.step)
        recorder.enter(FmuActivity.FLIGHT)
        for instance in self.instances.values():
            instance.raw_messages.clear()
        count = self.loop.fly(self._run(first, last, every, reset, excitation))
        outcome = Outcome(*self.buffers.outcome.tolist())
        if self._has_learned(outcome):
            self._replace_instances()
            return self._advance(first, last, every, excitation)
        return self._conclude(outcome, 0, count)

    @property
    def group_size(self) -> int:
        """Number of simulations that can run in one group.

        Only simulations of Perilune's FMUs, whose reset is trusted, run in groups, and only without a log. The number
        is 0 for systems with FMUs of FMI 3.0, and for systems with parameters that change during simulation, because
        the loop does not set their unchanged values.
        """
        flies_groups = self.fmi3 is None and self._log is None and self.life_cycle.are_self_contained
        flies_groups = flies_groups and not self.layout.bases
        return flights_in_group(self._recorded.size, rows_between(-1, self.prepared.steps)) if flies_groups else 0

    def fly_group(self, table: FlightTable) -> FlightGroup:
        """See `BaseSimulation.fly_group`."""
        prepared, recorder = self.prepared, self.recorder
        recorder.enter(FmuActivity.RENEWAL)
        reset = self.life_cycle.make_ready()
        rows, signals = rows_between(-1, prepared.steps), self._recorded.size
        recorder.reserve(signals, rows * table.flights, prepared.step)
        recorder.enter(FmuActivity.FLIGHT)
        for instance in self.instances.values():
            instance.raw_messages.clear()  # messages of simulations without failure are not reported
        group = group_of(table, self._varied, self.layout.parameters, TIME_MARGIN * prepared.step)
        flown = self.loop.fly_group(self._run(-1, prepared.steps, 1, reset, NOTHING), group)
        ends = group.ends[:flown]
        start = int(ends[-2]) if flown > 1 else 0
        last = self._conclude(Outcome(*self.buffers.outcome.tolist()), start, int(ends[-1]))
        return FlightGroup(
            time=recorder.times[: ends[-1]],
            signals=dict(zip(self.signal_names, recorder.record[:, : ends[-1]], strict=True)),
            ends=ends,
            statuses=[*(STATUS[code] for code in group.endings[: flown - 1].tolist()), last.status],
            complete=np.append(np.ones(flown - 1, dtype=bool), last.complete),
            messages=[*[""] * (flown - 1), last.message],
        )

    def _conclude(self, outcome: Outcome, start: int, end: int) -> Flight:
        """Return the flight with these rows of the record and the status that the loop reported."""
        prepared, recorder = self.prepared, self.recorder
        recorder.enter(FmuActivity.IDLE)
        self.life_cycle.note(outcome, self.program)
        status, message = describe_outcome(
            outcome,
            prepared.start + outcome.point * prepared.step,
            self.layout,
            self.buffers,
            self.fmi3,
            self.instances,
        )
        if outcome.is_discarded_step or outcome.is_ended:
            component, instance = list(self.instances.items())[outcome.subject]
            time = float(self.fmi3.stored.time[1]) if outcome.is_ended and self.fmi3 else end_request(instance)
            if time is not None:
                last = prepared.start + outcome.point * prepared.step
                begin = last - prepared.periods.get(component, 1) * prepared.step
                status, message = describe_termination(time, begin, last, outcome.subject, self.instances)
                if status == TERMINATED:
                    self._fly_last_row(outcome.subject, time, end)
                    end += 1
        flight = Flight(
            time=recorder.times[start:end],
            signals=dict(zip(self.signal_names, recorder.record[:, start:end], strict=True)),
            types=self._types,
            status=status,
            message=message,
        )
        if outcome.is_fatal:
            self._replace_instances(list(self.instances.values())[outcome.subject].fmu.digest)
        return flight

    def _run(self, first: int, last: int, every: int, reset: bool, excitation: np.ndarray) -> arrays.Run:
        """Return the loop's arguments for a simulation between two communication points."""
        prepared = self.prepared
        span = arrays.Span(
            reset=reset,
            start=prepared.start,
            step=prepared.step,
            stop=math.inf if self._selection.open_end else prepared.start + prepared.steps * prepared.step,
            first=first,
            last=last,
        )
        return arrays.Run(
            program=self.program,
            buffers=self.buffers,
            settings=self.layout.parameters.values,
            span=span,
            recording=arrays.Recording(self._recorded, every, self.recorder.record, self.recorder.times, 0),
            excitation=excitation,
            fmi3=self.fmi3,
            fused_steps=self.fused_steps,
        )

    def _has_learned(self, outcome: Outcome) -> bool:
        """Return True if an FMU rejected a call that later starts avoid, so that the simulation must be restarted."""
        parameters = self.layout.parameters
        if outcome.is_unreadable(self.program):
            code, first, count = self.program.instructions[
                outcome.instruction, [codes.CODE, codes.FIRST, codes.COUNT]
            ].tolist()
            if code == codes.TAKE_BACK and self.fmi3 is not None:  # it concerns the transfer of one variable
                first = int(self.fmi3.transfers.rows[first, codes.FIRST_VALUE])
            parameters.learn_unreadable(first, count)
        elif outcome.is_refused_again(self.program):
            parameters.learn_set_once(list(self.instances)[outcome.subject])
        else:
            return False
        return True

    def _fly_last_row(self, component: int, end: float, row: int) -> None:
        """Record the last row, at the time ``end`` (s) at which a component ended the simulation."""
        instructions = write_ending(self._instructions, component)
        whole = np.array([0, len(instructions)], dtype=np.int64)
        record = np.empty((self._recorded.size, 1))
        run = self._run(0, 1, 1, False, NOTHING)._replace(
            program=self.program._replace(instructions=instructions, phases=whole),
            span=arrays.Span(reset=False, start=end, step=0.0, stop=end, first=0, last=1),
            recording=arrays.Recording(self._recorded, 1, record, self.recorder.times[row:], 0),
            fused_steps=0,
        )
        self.loop.fly(run)
        self.recorder.record[:, row] = record[:, 0]

    def _replace_instances(self, fatal: str | None = None) -> None:
        """Instantiate all FMUs again, with the current parameter values; ``fatal`` is as in `LifeCycle.close`."""
        retained = self.layout.parameters
        self.life_cycle.close(fatal)
        self.instances = {}
        self._instantiate()
        self.layout.parameters.update({key: retained[key] for key in retained.keys})
        self._initialise_unfed()

    def memory(self) -> Memory:
        """Return the memory of the FMUs. Raises InputError if an FMU does not describe its serialised state."""
        return Memory(self.prepared, self.layout, self.instances, self.buffers, self.fmi3)

    def close(self) -> None:
        """Free the instances. Instances that are still running in an abandoned thread exist until exit."""
        if self.loop.under_way.acquire(blocking=False):
            self.recorder.enter(FmuActivity.END)
            if self._log is not None:
                self._log.close()
            self.life_cycle.close()
            self.instances = {}
            self.loop.under_way.release()
