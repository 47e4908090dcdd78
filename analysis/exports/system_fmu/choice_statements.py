"""C statements for the instructions of a system's steps, applied to the blocks inside its struct.

They repeat the operations of `loop/c/loop.c` in the same order, so results are equal to the last bit. In the C code,
`self` is the system and `s` the array of its signals. On failure a statement stores a message in `fault` and returns.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from ....fmus_src.export.write.layout import NO_BREAK
from ....fmus_src.export.write.names import literal
from ...runtime.flight.orders.fmi2 import FUNCTION
from ...runtime.fmi.variable import ScalarVariable
from ...runtime.fused.statements import Instruction, table_entries
from ...runtime.loop import codes
from .model import ChoiceProgram, SlotCandidate

GET_REAL = FUNCTION["GetReal"]
SKIPPED = (codes.SETUP, codes.PARAMETERS, codes.WHOLE_PARAMETERS, codes.READ_BACK, codes.WHOLE_READ_BACK)


@dataclass
class ChoiceStatements:
    """Writer of the C statements of one choice; ``constants`` maps signals to the C constants of their indices.

    ``is_starting`` is True during initialisation. ``unsettled`` contains the numbers of components with inputs that
    were set since their last computation.
    """

    choice: ChoiceProgram
    constants: Mapping[str, str]
    unsettled: set[int] = field(default_factory=set)
    is_starting: bool = False

    def initialisation(self) -> list[str]:
        """Return the statements of the initialisation, from parameters and inputs to the first outputs."""
        program = self.choice.program
        self.unsettled, self.is_starting = set(range(len(self.choice.candidates))), True
        lines = self._of(range(program.reset_end, int(program.phases[0])))
        self.is_starting = False
        return lines

    def step(self, phase: int) -> list[str]:
        """Return the statements of one phase of a step."""
        first, end = self.choice.program.phases[phase : phase + 2].tolist()
        return self._of(range(first, end))

    def renewal(self, component: int, rows: np.ndarray) -> list[str]:
        """Return the statements that pass new system inputs to a component, from the instructions in these rows."""
        candidate = self.choice.candidates[component]
        lines: list[str] = []
        targets: list[int] = []
        for row in (Instruction(0, *each) for each in rows.tolist()):
            lines += self._write(row)
            slots = range(row.first, row.first + row.size)
            targets += (
                slots if row.code == codes.COPY else self.choice.program.target[slots.start : slots.stop].tolist()
            )
        for slot in dict.fromkeys(targets):
            variable = self.choice.names[slot].removeprefix(f"{candidate.component}.")
            if variable in candidate.fmu.variables:
                lines += [self.injection(number, "inject_again") for number in self._faults_on(slot)]
                lines += self.set_variable(candidate, slot)
        return lines

    def _faults_on(self, slot: int) -> list[int]:
        return np.flatnonzero(self.choice.program.fault_slot == slot).tolist()

    def injection(self, number: int, function: str = "inject") -> str:
        """Return the statement that applies a fault to its signal."""
        return f"{function}(&{self.signal(int(self.choice.program.fault_slot[number]))}, &self->fault[{number}]);"

    def set_variable(self, candidate: SlotCandidate, slot: int) -> list[str]:
        """Return the statements that copy the signal in a slot to a variable of a component."""
        member = candidate.source.members[int(self.choice.program.reference[slot])]
        path, signal = f"self->{candidate.identifier}.block.{member.path}", self.signal(slot)
        variable = candidate.fmu.variables[self.choice.names[slot].removeprefix(f"{candidate.component}.")]
        limits = _check_bounds(variable, signal, self.choice.names[slot]) if variable.is_tunable else []
        if member.kind == "KIND_REAL":
            return [*limits, f"{path} = {signal};"]
        whole = f"(int32_t){signal}"
        assign = f"{path} = {whole} != 0;" if member.kind == "KIND_BOOLEAN" else f"{path} = {whole};"
        return [f"CHECK_WHOLE({signal}, {quoted(self.choice.names[slot])})", *limits, assign]

    def _of(self, numbers: Iterable[int]) -> list[str]:
        rows = self.choice.program.instructions
        return [line for number in numbers for line in self._write(Instruction(number, *rows[number].tolist()))]

    def _write(self, row: Instruction) -> list[str]:
        return [] if row.code in SKIPPED else WRITERS[row.code](self, row)

    def signal(self, slot: int) -> str:
        return f"s[{self.constants[self.choice.names[slot]]}]"

    def slots(self, row: Instruction) -> list[tuple[int, str]]:
        """Return the slots of an instruction, each with its signal."""
        return [(slot, self.signal(slot)) for slot in range(row.first, row.first + row.size)]

    def variable(self, row: Instruction, slot: int) -> tuple[str, str]:
        """Return path and kind of a component's variable, for the slot of its signal."""
        candidate = self.candidate(row)
        member = candidate.source.members[int(self.choice.program.reference[slot])]
        return f"self->{candidate.identifier}.block.{member.path}", member.kind

    def candidate(self, row: Instruction) -> SlotCandidate:
        return self.choice.candidates[row.component]

    def initialise_component(self, component: int) -> list[str]:
        """Return the statements that initialise a component if its inputs were set since its last computation."""
        if not self.is_starting or component not in self.unsettled:
            return []
        self.unsettled.discard(component)
        candidate = self.choice.candidates[component]
        call = f"{candidate.source.prefix}initialize(&self->{candidate.identifier}, fault, self->start_time);"
        return [call, check(candidate.component)]


def _check_bounds(variable: ScalarVariable, signal: str, name: str) -> list[str]:
    """Return the statements that check a tunable parameter, with any fault applied, against the bounds in its FMU."""
    lines = [f"CHECK_FINITE({signal}, {quoted(name)})"] if variable.type == "Real" else []
    for sign, bound, side in (
        ("<", variable.minimum, "below its minimum"),
        (">", variable.maximum, "above its maximum"),
    ):
        if bound is not None:
            problem = quoted(f"TuningError: its value is {side} {bound}")
            lines.append(f"if ({signal} {sign} {literal(float(bound))}) FAIL({quoted(name)}, {problem})")
    return lines


def check(subject: str) -> str:
    """Return a statement that returns from the C function if the previous statement failed in ``subject``."""
    return f"FAILED_IN({quoted(subject)})"


def quoted(text: str) -> str:
    """Return a text as a C string literal on one line."""
    escaped = text.replace("\\", r"\\").replace('"', r"\"").replace("?", r"\?").replace(" ", NO_BREAK)
    return f'"{escaped}"'


def _mode(to: ChoiceStatements, row: Instruction) -> list[str]:
    return to.initialise_component(row.component) if row.function == FUNCTION["ExitInitializationMode"] else []


def _copy(to: ChoiceStatements, row: Instruction) -> list[str]:
    return [f"{to.signal(row.first + i)} = {to.signal(row.address + i)};" for i in range(row.size)]


def _transform(to: ChoiceStatements, row: Instruction, assign: str = "=") -> list[str]:
    program, lines = to.choice.program, []
    for number in range(row.first, row.first + row.size):
        target, source = to.signal(int(program.target[number])), to.signal(int(program.source[number]))
        factor, offset = literal(float(program.factor[number])), literal(float(program.offset[number]))
        lines.append(f"{target} {assign} {source} * {factor} + {offset};")
    return lines


def _add(to: ChoiceStatements, row: Instruction) -> list[str]:
    return _transform(to, row, "+=")


def _map(to: ChoiceStatements, row: Instruction) -> list[str]:
    program, lines = to.choice.program, []
    for number in range(row.first, row.first + row.size):
        slot = int(program.source[number])
        source, target = to.signal(slot), to.signal(int(program.target[number]))
        lines += map_value(source, target, table_entries(program, number), to.choice.names[slot])
    return lines


def map_value(source: str, target: str, entries: Iterable[tuple[float, float]], subject: str) -> list[str]:
    """Return the statements that map a value by a table.

    A table with an entry for NaN leaves unlisted values unchanged; otherwise an unlisted value is a failure.
    """
    tests, otherwise = [], f"FAIL({quoted(subject)}, {quoted('a mapping has no entry for its value')})"
    for entry, becomes in entries:
        if math.isnan(entry):
            otherwise = f"{target} = {source};"
        else:
            tests.append(f"if ({source} == {literal(entry)}) {target} = {literal(becomes)};")
    return [" else ".join([*tests, f"{{ {otherwise} }}"])]


def _set_real(to: ChoiceStatements, row: Instruction) -> list[str]:
    if row.function == GET_REAL:  # a READ_REAL, whose values are not checked
        return [
            *to.initialise_component(row.component),
            *(f"{s} = {to.variable(row, slot)[0]};" for slot, s in to.slots(row)),
        ]
    return _set_variables(to, row)


def _set_variables(to: ChoiceStatements, row: Instruction) -> list[str]:
    to.unsettled.add(row.component)
    return [line for slot, _ in to.slots(row) for line in to.set_variable(to.candidate(row), slot)]


def _get_real(to: ChoiceStatements, row: Instruction) -> list[str]:
    reads = [f"{signal} = {to.variable(row, slot)[0]};" for slot, signal in to.slots(row)]
    checks = [f"CHECK_FINITE({signal}, {quoted(to.choice.names[slot])})" for slot, signal in to.slots(row)]
    return [*to.initialise_component(row.component), *reads, *checks]


def _get_whole(to: ChoiceStatements, row: Instruction) -> list[str]:
    lines = to.initialise_component(row.component)
    for slot, signal in to.slots(row):
        path, kind = to.variable(row, slot)
        if kind == "KIND_INTEGER":
            lines.append(f"CHECK_32_BITS({path}, {quoted(to.choice.names[slot])})")
        lines.append(f"{signal} = (double){path};")
    return lines


def _step(to: ChoiceStatements, row: Instruction) -> list[str]:
    candidate = to.candidate(row)
    times = "time, SYSTEM_STEP"
    if row.size:
        times = f"self->start_time + (double)(self->point + 1 - {row.size}) * SYSTEM_STEP, {row.size}.0 * SYSTEM_STEP"
    call = f"{candidate.source.prefix}advance(&self->{candidate.identifier}, fault, self->start_time, {times});"
    return [call, check(candidate.component)]


def _inject(to: ChoiceStatements, row: Instruction) -> list[str]:
    return [to.injection(number) for number in range(row.first, row.first + row.size)]


WRITERS: dict[int, Callable[[ChoiceStatements, Instruction], list[str]]] = {
    codes.MODE: _mode,
    codes.COPY: _copy,
    codes.TRANSFORM: _transform,
    codes.ADD: _add,
    codes.MAP: _map,
    codes.INJECT: _inject,
    codes.SET_REAL: _set_real,
    codes.SET_WHOLE: _set_variables,
    codes.GET_REAL: _get_real,
    codes.GET_WHOLE: _get_whole,
    codes.STEP: _step,
}
