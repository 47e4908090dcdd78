"""C statements equivalent to the loop's instructions.

Every statement has the effect that `loop/c/loop.c` gives its code, with the same order of operations and, on failure,
the same outcome: compiled and interpreted instructions have bitwise equal results.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ....fmus_src.export.write.names import literal
from ..loop import arrays, codes

INJECTIONS = {codes.OVERRIDE: "OVERRIDE", codes.BIAS: "BIAS", codes.FREEZE: "FREEZE", codes.EXCITE: "EXCITE"}
INSTANCE_POINTER = "c{}"  # pointer to a component whose C code is in the unit


class Instruction(NamedTuple):
    """Instruction of the loop with its ``number``; for the columns see `codes`."""

    number: int
    code: int
    address: int
    instance: int
    first: int
    size: int
    component: int
    function: int


@dataclass(frozen=True)
class Statements:
    """Writer of statements for a ``program``; ``prefixes`` are the prefixes of components with C code in the unit."""

    program: arrays.Program
    prefixes: Mapping[int, str]

    def of(self, instruction: Instruction) -> list[str]:
        """Return the lines for an instruction; no lines for instructions of FMI 3.0."""
        return WRITERS[instruction.code](self, instruction)

    def variable(self, row: Instruction, kind: str, index: int) -> str:
        """Return an expression for a value in the memory of a component."""
        offset = row.address - row.instance + index * (1 if kind == "bool" else 8)
        return f"*({kind} *)({self.memory(row.component)} + {offset})"

    def memory(self, component: int) -> str:
        return f"(char *){INSTANCE_POINTER.format(component)}"

    def call(self, row: Instruction, kind: str, array: str) -> str:
        """Return the call of an FMI function on a range of slots."""
        function = _function(row, f"void *, const uint32_t *, size_t, {kind} *")
        instance = INSTANCE_POINTER.format(row.component)
        return f"status = {function}({instance}, reference + {row.first}, {row.size}, {array} + {row.first});"

    def check_status(self, row: Instruction) -> str:
        return f"CHECK(status, {row.component}, {row.function}, {row.number});"

    def check_finite(self, row: Instruction) -> list[str]:
        """Return statements that end the simulation at the first slot with a value that is not finite."""
        slots = range(row.first, row.first + row.size)
        doubt = " + ".join(f"(values[{slot}] - values[{slot}])" for slot in slots)
        return [f"if ({doubt} != 0.0) CHECK_FINITE({row.first}, {row.size}, {row.number});"]


def _function(row: Instruction, parameters: str) -> str:
    """Return an expression for the FMI function of an instruction, from the function's address."""
    address = f"instructions[{row.number * codes.COLUMNS + codes.ADDRESS}]"
    return f"((int (*)({parameters}))(uintptr_t){address})"


def _copy(_: Statements, row: Instruction) -> list[str]:
    return [f"values[{row.first + i}] = values[{row.address + i}];" for i in range(row.size)]


def _put_real(to: Statements, row: Instruction) -> list[str]:
    return [f"{to.variable(row, 'double', i)} = values[{row.first + i}];" for i in range(row.size)]


def _move_real(to: Statements, row: Instruction) -> list[str]:
    copies = [(to.variable(row, "double", i), row.first + i, row.function + i) for i in range(row.size)]
    return [f"{variable} = values[{target}] = values[{source}];" for variable, target, source in copies]


def _take_real(to: Statements, row: Instruction) -> list[str]:
    reads = [f"values[{row.first + i}] = {to.variable(row, 'double', i)};" for i in range(row.size)]
    return [*reads, *to.check_finite(row)]


def _take_boolean(to: Statements, row: Instruction) -> list[str]:
    return [f"values[{row.first + i}] = {to.variable(row, 'bool', i)};" for i in range(row.size)]


def _take_whole(to: Statements, row: Instruction) -> list[str]:
    """Return statements that read integers, and a condition for the next instruction, in which the FMU rejects them."""
    reads = [f"values[{row.first + i}] = (double){to.variable(row, 'int64_t', i)};" for i in range(row.size)]
    fits = " && ".join(
        f"{variable} >= INT32_MIN && {variable} <= INT32_MAX"
        for variable in (to.variable(row, "int64_t", i) for i in range(row.size))
    )
    return [*reads, f"if (!({fits}))"]


def _get_real(to: Statements, row: Instruction) -> list[str]:
    return [to.call(row, "double", "values"), to.check_status(row), *to.check_finite(row)]


def _set_real(to: Statements, row: Instruction) -> list[str]:
    return [to.call(row, "double", "values"), to.check_status(row)]


def _get_whole(to: Statements, row: Instruction) -> list[str]:
    reads = [f"values[{slot}] = whole[{slot}];" for slot in range(row.first, row.first + row.size)]
    return ["{", to.call(row, "int32_t", "whole"), to.check_status(row), *reads, "}"]


def _set_whole(to: Statements, row: Instruction) -> list[str]:
    stored = [f"WHOLE({slot}, {row.number});" for slot in range(row.first, row.first + row.size)]
    return [*stored, to.call(row, "int32_t", "whole"), to.check_status(row)]


def _step(to: Statements, row: Instruction) -> list[str]:
    begin = "time" if row.size == 0 else f"start + (double)(point + 1 - {row.size}) * step"
    size = "step" if row.size == 0 else f"{row.size}.0 * step"
    prefix, instance = to.prefixes.get(row.component), INSTANCE_POINTER.format(row.component)
    if prefix is None:
        call = f"{_function(row, 'void *, double, double, int')}({instance}, {begin}, {size}, 1)"
    else:
        call = f'(int){prefix}do_step({instance}, "fmi2DoStep", {begin}, {size})'
    return [f"outcome[1] = {row.component};", f"status = {call};", to.check_status(row)]


def _transformed(to: Statements, number: int) -> tuple[int, str]:
    program = to.program
    factor, offset = float(program.factor[number]), float(program.offset[number])
    return int(program.target[number]), f"values[{program.source[number]}] * {literal(factor)} + {literal(offset)}"


def _transform(to: Statements, row: Instruction, sign: str = "=") -> list[str]:
    terms = (_transformed(to, number) for number in range(row.first, row.first + row.size))
    return [f"values[{target}] {sign} {term};" for target, term in terms]


def _add(to: Statements, row: Instruction) -> list[str]:
    return _transform(to, row, "+=")


def table_entries(program: arrays.Program, number: int) -> list[tuple[float, float]]:
    """Return the mapping of a connection as pairs (from, to); with a pair from NaN, other values stay unchanged."""
    first, count = program.table[number].tolist()
    entries = slice(first, first + count)
    return list(zip(program.table_from[entries].tolist(), program.table_to[entries].tolist(), strict=True))


def _map(to: Statements, row: Instruction) -> list[str]:
    program, lines = to.program, []
    for number in range(row.first, row.first + row.size):
        source, target = int(program.source[number]), int(program.target[number])
        otherwise = f"END(UNMAPPED, {source}, {row.number});"
        tests = []
        for entry, becomes in table_entries(program, number):
            if np.isnan(entry):
                otherwise = f"values[{target}] = values[{source}];"
            else:
                tests.append(f"if (values[{source}] == {literal(entry)}) values[{target}] = {literal(becomes)};")
        lines.append(" else ".join([*tests, otherwise]))
    return lines


def _inject(to: Statements, row: Instruction) -> list[str]:
    program = to.program
    return [
        f"INJECT_{INJECTIONS[int(program.fault_kind[fault])]}({fault}, {program.fault_slot[fault]});"
        for fault in range(row.first, row.first + row.size)
    ]


def _drive(to: Statements, row: Instruction) -> list[str]:
    slots = [(d, int(to.program.drive_slot[d])) for d in range(row.first, row.first + row.size)]
    row_number = f"(point + 1 + {row.address} < drive_rows - 1 ? point + 1 + {row.address} : drive_rows - 1)"
    return [f"values[{slot}] = drive_table[{row_number} * drive_columns + {column}];" for column, slot in slots]


def _copy_text(_: Statements, row: Instruction) -> list[str]:
    return [f"strncpy(text_address[{row.first}], text_address[{row.address}], (size_t)text_size);"]


def _call_text(to: Statements, row: Instruction, array: str) -> list[str]:
    function = _function(row, "void *, const uint32_t *, size_t, const void *")
    instance = INSTANCE_POINTER.format(row.component)
    call = f"{function}({instance}, text_reference + {row.first}, {row.size}, {array} + {row.first})"
    return [f"status = {call};", to.check_status(row)]


def _set_text(to: Statements, row: Instruction) -> list[str]:
    return _call_text(to, row, "text_address")


def _get_text(to: Statements, row: Instruction) -> list[str]:
    texts = [f"TAKE_TEXT({text}, {row.number});" for text in range(row.first, row.first + row.size)]
    return [*_call_text(to, row, "text_given"), *texts]


def _restore_floats(_: Statements, __: Instruction) -> list[str]:
    return ["restore_default_floats();"]


Writer = Callable[[Statements, Instruction], list[str]]
WRITERS: dict[int, Writer] = {
    codes.COPY: _copy,
    codes.TRANSFORM: _transform,
    codes.MAP: _map,
    codes.INJECT: _inject,
    codes.SET_REAL: _set_real,
    codes.SET_WHOLE: _set_whole,
    codes.GET_REAL: _get_real,
    codes.GET_WHOLE: _get_whole,
    codes.STEP: _step,
    codes.DRIVE: _drive,
    codes.ADD: _add,
    codes.PUT_REAL: _put_real,
    codes.MOVE_REAL: _move_real,
    codes.TAKE_REAL: _take_real,
    codes.TAKE_WHOLE: _take_whole,
    codes.TAKE_BOOLEAN: _take_boolean,
    codes.SET_TEXT: _set_text,
    codes.GET_TEXT: _get_text,
    codes.COPY_TEXT: _copy_text,
    codes.RESTORE_FLOATS: _restore_floats,
}
