"""A system in memory that flies again and again: instances, program, buffers."""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ...common.errors import InputError
from ..ssp.parameter_sets import ParameterValue, parse_value
from ..system.checks import check_fault
from ..system.fault import Fault
from ..system.prepared import PreparedSystem, no_collection
from .compiled import arrays, codes, loop
from .endings import TERMINATED, Outcome, end_request, in_words
from .instance import Instance, Log, instantiate
from .instructions import write_ending
from .life_cycle import LifeCycle
from .program import NEVER, build_program, of_excitation, of_fault
from .results import Flight, Provenance, Result, provenance_of

NOTHING = np.zeros((0, 0))  # no excitation
TIME_MARGIN = 1e-6  # of a step: communication points, start + n h, carry rounding


class Simulation:
    """Instances of a system's FMUs, reset and reused from flight to flight.

    ``varied`` names the parameters (``component.variable``) that `fly` may be given anew;
    ``wanted`` the signals to record (None: all outputs, connected inputs and system connectors);
    ``faults`` those that fly unless `set_faults` says otherwise; ``excited`` the connectors that `advance` may
    add signals to; ``log`` is told what the FMUs say. Use it as a context manager: it frees the instances. Not
    shared between threads.
    """

    def __init__(
        self,
        prepared: PreparedSystem,
        *,
        varied: Collection[str] = (),
        wanted: Collection[str] | None = None,
        faults: Sequence[Fault] = (),
        excited: Sequence[str] = (),
        log: Log | None = None,
    ) -> None:
        self.prepared = prepared
        self.settings = prepared.settings
        self._varied = {name: self._key(name) for name in varied}
        self._place_varied()
        self.instances: dict[str, Instance] = {}
        self._wanted = wanted
        for fault in faults:
            check_fault(prepared.network, fault)
        self._declared = faults
        self._faults: Sequence[Fault | None] = faults
        self._excitations = [of_excitation(name, column) for column, name in enumerate(excited)]
        self._log = log
        with no_collection():
            self._instantiate()

    def _place_varied(self) -> None:
        """Give every varied parameter a place in the settings, at its start value."""
        network = self.prepared.network
        variables = dict(self.settings.variables)
        for name, (component, variable) in self._varied.items():
            declared = network.fmus[component].variables[variable]
            start = parse_value(str(declared.start), declared.type, network.fmus[component].label, name)
            variables.setdefault((component, variable), start)
        self.settings = replace(self.settings, variables=variables)

    def _key(self, name: str) -> tuple[str, str]:
        """(component, variable) of a parameter's name; raises InputError."""
        for component, fmu in self.prepared.network.fmus.items():
            variable = fmu.variables.get(name.removeprefix(f"{component}."))
            if (
                name.startswith(f"{component}.")
                and variable is not None
                and variable.causality in ("parameter", "input")
            ):
                return component, variable.name
        raise InputError(self.prepared.network.file, name, "no such parameter", "see perilune list for components")

    def _instantiate(self) -> None:
        prepared = self.prepared
        for name, fmu in prepared.network.fmus.items():
            self.instances[name] = instantiate(fmu, name, self._log)
        faults = [of_fault(fault, TIME_MARGIN * prepared.step) for fault in self._declared]
        self.program, self._instructions, self.layout = build_program(
            prepared, self.settings, self.instances, self._wanted, [*faults, *self._excitations]
        )
        self.set_faults(self._faults)
        self.signal_names = [name for name in self.layout.slots if self._wanted is None or name in self._wanted]
        for name in self._wanted or ():
            if name not in self.layout.slots:
                raise InputError(
                    prepared.network.file, name, "no such signal", "name a connector as component.variable"
                )
        self._types = {name: self.layout.types[name] for name in self.signal_names}
        self._recorded = np.array([self.layout.slots[name] for name in self.signal_names], dtype=np.int64)
        self.buffers = arrays.Buffers(
            values=np.zeros(len(self.layout.slots)),
            whole=np.zeros(len(self.layout.slots), dtype=np.int32),
            frozen=np.zeros(len(self._declared) + len(self._excitations)),
            read_back=self.layout.parameters.blank(),
            texts=self.layout.texts.memory(),
            outcome=np.zeros(6, dtype=np.int64),
            halt=np.zeros(1, dtype=np.int64),
        )
        self._record, self._times = np.empty((0, 0)), np.empty(0)
        self._loop: Callable[..., int] | None = None
        if self._log is not None:
            self._log.follow(self.buffers.outcome, prepared.start, prepared.step)
        self.life_cycle = LifeCycle(self.instances, self.program, self._instructions)
        self._under_way = threading.Lock()

    def fly(self, values: Mapping[str, ParameterValue] | None = None, *, every: int = 1) -> Result:
        """One flight from the start, with ``values`` for varied parameters; every n-th row is kept.

        The arrays of the result are the simulation's own and are overwritten by the next flight.
        """
        flight = self.run(values or {}, every=every)
        return Result(
            **vars(flight),
            units={name: self.layout.units[name] for name in self.signal_names},
            provenance=self.provenance(),
        )

    def interrupt(self, halt: bool = True) -> None:
        """End the flight that is under way in another thread at its next communication point, and all later ones."""
        self.buffers.halt[0] = halt

    def unlock(self) -> None:
        """Have the loop compiled, and flying without the interpreter lock, which Python FMUs take themselves.

        So that other threads run whatever a step does, and a clock measures flights alone.
        """
        span, recording, excitation = self._request(-1, 0, 1, False, NOTHING)
        arguments = (self.program, self.buffers, self.layout.parameters.values, span, recording, excitation)
        self._loop = loop.compile_for(arguments, locked=False)

    def run(self, values: Mapping[str, ParameterValue], *, every: int = 1) -> Flight:
        """The flight alone, for batches; see `fly`."""
        self.set(values)
        return self._advance(-1, self.prepared.steps, every, NOTHING)

    def set(self, values: Mapping[str, ParameterValue]) -> None:
        """Give varied parameters other values, from the next start on."""
        for name, value in values.items():
            self.layout.parameters[self._varied[name]] = value

    def set_faults(self, faults: Sequence[Fault | None]) -> None:
        """Give faults other values and windows, from the next start on.

        There is one for each that the simulation was made with, on its connector and of its kind, or None
        where that one does not fly.
        """
        for number, (declared, fault) in enumerate(zip(self._declared, faults, strict=True)):
            self.program.fault_window[number] = NEVER
            if fault is not None:
                assert (fault.name, fault.kind) == (declared.name, declared.kind)
                injection = of_fault(fault, TIME_MARGIN * self.prepared.step)
                self.program.fault_window[number] = injection.window
                self.program.fault_value[number] = injection.value
        self._faults = faults

    def advance(self, first: int, last: int, excitation: np.ndarray = NOTHING) -> Flight:
        """Fly on from communication point ``first`` to ``last``, as FMUs and buffers are; rows first + 1 to last.

        -1 starts anew, which adds row 0. ``excitation`` [r, e] is added to the excited connectors at the r
        communication points behind ``first``. ``last`` may lie behind the stop time. Arrays as in `fly`.
        """
        return self._advance(first, last, 1, excitation)

    def _advance(self, first: int, last: int, every: int, excitation: np.ndarray) -> Flight:
        prepared = self.prepared
        reset = first < 0 and self.life_cycle.make_ready()
        rows = (last - max(first, 0)) // every + 2
        if self._times.size < rows:
            try:
                self._record = np.empty((self._recorded.size, rows))
                self._times = np.empty(rows)
            except (MemoryError, ValueError) as error:  # the latter where numpy cannot even count them
                problem = f"{rows} rows do not fit into memory"
                remedy = "give a longer step or an earlier `stop_time`"
                raise InputError("`step`", f"{prepared.step:g}", problem, remedy) from error
        for instance in self.instances.values():
            instance.said.clear()
        count = self._call(self.program, *self._request(first, last, every, reset, excitation))
        outcome = Outcome(*self.buffers.outcome.tolist())
        if self._has_learned(outcome):
            self._replace_instances()
            return self._advance(first, last, every, excitation)
        self.life_cycle.note(outcome, self.program)
        status, message = in_words(
            outcome, prepared.start + outcome.point * prepared.step, self.layout, self.buffers, self.instances
        )
        if outcome.is_discarded_step:
            component, instance = list(self.instances.items())[outcome.subject]
            end = end_request(instance)
            if end is not None:
                self._fly_last_row(outcome.subject, end, count)
                count += 1
                said = f": {' | '.join(instance.messages)}" if instance.messages else ""
                status, message = TERMINATED, f"{component} asked for the end at t = {end:g} s{said}"
        flight = Flight(
            time=self._times[:count],
            signals=dict(zip(self.signal_names, self._record[:, :count], strict=True)),
            types=self._types,
            status=status,
            message=message,
        )
        if outcome.is_fatal:
            self._replace_instances(list(self.instances.values())[outcome.subject].fmu.digest)
        return flight

    def _request(
        self, first: int, last: int, every: int, reset: bool, excitation: np.ndarray
    ) -> tuple[arrays.Span, arrays.Recording, np.ndarray]:
        """What the loop is to fly, to keep and to add."""
        prepared = self.prepared
        span = arrays.Span(
            reset=reset,
            start=prepared.start,
            step=prepared.step,
            stop=prepared.start + max(prepared.steps, last) * prepared.step,
            first=first,
            last=last,
        )
        recording = arrays.Recording(self._recorded, every, self._record, self._times)
        return span, recording, excitation if excitation.size else np.zeros((0, len(self._excitations)))

    def _has_learned(self, outcome: Outcome) -> bool:
        """Whether an FMU has shown what not to ask of it, so that the flight is to begin anew."""
        parameters = self.layout.parameters
        if outcome.is_unreadable(self.program):
            first, count = self.program.instructions[outcome.instruction, [codes.FIRST, codes.COUNT]]
            parameters.learn_unreadable(int(first), int(count))
        elif outcome.is_refused_again(self.program):
            parameters.learn_set_once(list(self.instances)[outcome.subject])
        else:
            return False
        return True

    def _call(
        self, program: arrays.Program, span: arrays.Span, recording: arrays.Recording, excitation: np.ndarray
    ) -> int:
        """The compiled loop; returns the number of rows that it recorded."""
        arguments = (program, self.buffers, self.layout.parameters.values, span, recording, excitation)
        with self._under_way:
            if self._loop is None:
                self._loop = loop.compile_for(arguments, locked=not self.prepared.is_native)
            return self._loop(*arguments)

    def _fly_last_row(self, component: int, end: float, row: int) -> None:
        """Record what there is at the time ``end`` (s) at which a component has ended the simulation."""
        instructions = write_ending(self._instructions, component)
        whole = np.array([0, len(instructions)], dtype=np.int64)
        program = self.program._replace(instructions=instructions, phases=whole)
        span = arrays.Span(reset=False, start=end, step=0.0, stop=end, first=0, last=1)
        recording = arrays.Recording(self._recorded, 1, np.empty((self._recorded.size, 1)), self._times[row:])
        self._call(program, span, recording, np.zeros((0, len(self._excitations))))
        self._record[:, row] = recording.record[:, 0]

    def _replace_instances(self, fatal: str | None = None) -> None:
        """Everything instantiated anew, with the values that parameters have; ``fatal`` as in `LifeCycle.close`."""
        retained = self.layout.parameters
        self.life_cycle.close(fatal)
        self.instances = {}
        self._instantiate()
        self.layout.parameters.update({key: retained[key] for key in retained.keys})

    def provenance(self) -> Provenance:
        """Parameter values, hashes, options and version: what the result depends on."""
        return provenance_of(self.prepared, self.settings, self.layout.parameters, self._faults)

    def close(self) -> None:
        """Free the instances; those of a flight that still goes on in a thread, given up, end with the process."""
        if self._under_way.acquire(blocking=False):
            self.life_cycle.close()
            self.instances = {}
            self._under_way.release()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
