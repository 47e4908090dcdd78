"""The steps of a flight in C that has been compiled for its system, instead of instruction by instruction."""

from __future__ import annotations

from collections.abc import Sequence

from llvmlite import ir
from numba import types
from numba.core.base import BaseContext
from numba.core.typing import Signature

from ....common.compiler import compile_cached
from .fmi_calls import ARRAY, INT64, element, in_compiled_code
from .frame import WORDS

(
    INSTRUCTIONS, VALUES, WHOLE, FROZEN, OUTCOME, HALT, REFERENCE, FAULT_WINDOW, FAULT_VALUE, EXCITATION, DRIVE_TABLE,
    RECORD, TIMES, TEXT_REFERENCE, TEXT_ADDRESS, TEXT_GIVEN, EXCITATION_ROWS, EXCITATION_COLUMNS, DRIVE_ROWS,
    DRIVE_COLUMNS, CAPACITY, TEXT_SIZE, STRIDE, ROWS, TO_RECORD, POINT, FIRST_POINT, LAST_POINT,
) = range(len(WORDS))  # fmt: skip


@in_compiled_code(types.int64, ARRAY)
def address_of(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """Where an array's values lie."""
    return element(context, builder, signature.args[0], arguments[0], INT64(0))


@in_compiled_code(types.int64, types.int64, types.int64, types.int64)
def call_steps(_: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]) -> ir.Value:
    """The C function at an address: (address, frame, reals). Returns the number of rows in the record."""
    function_type = ir.FunctionType(INT64, [INT64, INT64])
    return builder.call(builder.inttoptr(arguments[0], function_type.as_pointer()), arguments[1:])


def _fly_steps(program, buffers, span, recording, excitation, fused, point, rows, to_record):  # type: ignore[no-untyped-def]
    """Fly from a communication point to the end; returns the number of rows in the record."""
    frame = fused.frame
    frame[INSTRUCTIONS] = address_of(program.instructions)
    frame[VALUES] = address_of(buffers.values)
    frame[WHOLE] = address_of(buffers.whole)
    frame[FROZEN] = address_of(buffers.frozen)
    frame[OUTCOME] = address_of(buffers.outcome)
    frame[HALT] = address_of(buffers.halt)
    frame[REFERENCE] = address_of(program.reference)
    frame[FAULT_WINDOW] = address_of(program.fault_window)
    frame[FAULT_VALUE] = address_of(program.fault_value)
    frame[EXCITATION] = address_of(excitation)
    frame[DRIVE_TABLE] = address_of(program.drive_table)
    frame[RECORD] = address_of(recording.record)
    frame[TIMES] = address_of(recording.times)
    frame[TEXT_REFERENCE] = address_of(buffers.texts.reference)
    frame[TEXT_ADDRESS] = address_of(buffers.texts.address)
    frame[TEXT_GIVEN] = address_of(buffers.texts.given)
    frame[EXCITATION_ROWS], frame[EXCITATION_COLUMNS] = excitation.shape
    frame[DRIVE_ROWS], frame[DRIVE_COLUMNS] = program.drive_table.shape
    frame[CAPACITY] = recording.record.shape[1]
    frame[TEXT_SIZE] = buffers.texts.rows.shape[1]
    frame[STRIDE] = recording.stride
    frame[ROWS] = rows
    frame[TO_RECORD] = to_record
    frame[POINT] = point
    frame[FIRST_POINT] = span.first
    frame[LAST_POINT] = span.last
    fused.reals[0], fused.reals[1] = span.start, span.step
    return call_steps(fused.address, address_of(frame), address_of(fused.reals))


fly_steps = compile_cached(_fly_steps)
