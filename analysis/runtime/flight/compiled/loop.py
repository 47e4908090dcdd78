"""The co-simulation loop: one compiled function that initialises the FMUs and flies them.

Every exchanged variable has a slot in one float64 array; Integer, Boolean and Enumeration values pass through an
int32 array of the same layout. The slots of a component are contiguous by type and direction, so that each FMI call
takes a piece of the arrays as it stands.

What is repeated every step is one function without calls to others of ours: numba counts references to every array
that crosses a call, which costs more than the FMI calls themselves; and all that is done once, or rarely, stands in
others, since every name that is kept alive here is read from memory instead of a register.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from types import FunctionType
from typing import Any

import numpy as np
from numba import typeof

from ....common.compiler import compile_cached
from . import arrays
from .beginning import begin
from .codes import (
    ADD,
    ADDRESS,
    BIAS,
    CODE,
    COMPONENT,
    COPY,
    COPY_BINARY,
    COPY_TEXT,
    COUNT,
    DRIVE,
    EXCITE,
    FAILED,
    FINISHED,
    FIRST,
    FIRST_OF_FMI3,
    FMI_WARNING,
    FUNCTION,
    GET_REAL,
    GET_WHOLE,
    GIVE_PARAMETERS,
    INJECT,
    INSTANCE,
    INTERRUPTED,
    MAP,
    MOVE_REAL,
    NONFINITE,
    OVERRIDE,
    PUT_REAL,
    RESTORE_FLOATS,
    SET_REAL,
    SET_WHOLE,
    STEP,
    STOP_TIME,
    TAKE_BOOLEAN,
    TAKE_REAL,
    TAKE_WHOLE,
    TRANSFORM,
    UNMAPPED,
)
from .floats import restore_floats
from .fmi3 import begin_fmi3, exchange_in_steps
from .fmi_calls import boolean_at, do_step, exchange, exchange_texts, put_real, real_at, whole_at
from .fused import fly_steps
from .text_transfers import exchange_with_texts

ONE = np.uint64(1)
WITH_FMI3 = WITH_FUSED = False  # constants of each compilation
WHOLE_MIN, WHOLE_MAX = -(2**31), 2**31 - 1  # of FMI's Integers


def _fly(program, buffers, settings, span, recording, excitation, fmi3, fused):  # type: ignore[no-untyped-def]
    """Initialise and run; returns the number of rows in the record, buffers.outcome says how it ended.

    The rows of ``excitation``, float64 [r, e], are added to the excited slots at the communication points behind
    ``span.first``. ``fmi3`` is used by FMUs of FMI 3.0 alone, ``fused`` where the steps
    are compiled for the system.
    """
    instructions = program.instructions
    reference = program.reference
    source, target = program.source, program.target
    factor, offset = program.factor, program.offset
    table, table_from, table_to = program.table, program.table_from, program.table_to
    fault_slot, fault_kind = program.fault_slot, program.fault_kind
    fault_window, fault_value = program.fault_window, program.fault_value
    drive_slot, drive_table = program.drive_slot, program.drive_table
    values, whole, frozen, outcome = buffers.values, buffers.whole, buffers.frozen, buffers.outcome
    start, step, first_point, steps = span.start, span.step, span.first, span.last
    recorded, stride, record, times = recording.slots, recording.stride, recording.record, recording.times
    halt = buffers.halt
    outcome[:] = 0
    rows = recording.offset
    phases, parts = program.phases, program.phases.size - 1
    n = first_point  # -1: the initialisation
    phase = max(n, 0) % parts
    to_record = 0
    if n < 0:
        values[:] = program.initial
        frozen[:] = np.nan
        buffers.texts.rows[:] = buffers.texts.initial
        if WITH_FMI3:
            fmi3.binaries.rows[:] = fmi3.binaries.initial
            fmi3.sizes[:] = fmi3.initial_sizes
            fmi3.stored.exact[:] = fmi3.start
        first_instruction = np.uint64(0 if span.reset else program.reset_end)
        last_instruction = np.uint64(phases[0])
        after = start
    else:
        first_instruction = np.uint64(phases[phase])
        last_instruction = np.uint64(phases[phase + 1])
        after = start + n * step
    while True:
        if WITH_FUSED and n >= 0:
            return fly_steps(program, buffers, span, recording, excitation, fused, n, rows, to_record)
        time = after
        after = start + (n + 1) * step
        outcome[4] = n + 1
        following = first_instruction
        while following < last_instruction:
            k = following
            following = k + ONE
            code = instructions[k, CODE]
            address = instructions[k, ADDRESS]
            instance = instructions[k, INSTANCE]
            first = instructions[k, FIRST]
            count = instructions[k, COUNT]
            status = np.int32(0)
            doubt = 0.0  # NaN as soon as a value is taken that is not finite
            if code == COPY:
                for i in range(count):
                    values[first + i] = values[address + i]
            elif code == PUT_REAL:
                for i in range(count):
                    put_real(address + np.uint64(8) * np.uint64(i), values[first + i])
            elif code == MOVE_REAL:
                origin = instructions[k, FUNCTION]
                for i in range(count):
                    moved = values[origin + i]
                    values[first + i] = moved
                    put_real(address + np.uint64(8) * np.uint64(i), moved)
            elif code == TAKE_REAL:
                for i in range(count):
                    value = real_at(address + np.uint64(8) * np.uint64(i))
                    values[first + i] = value
                    doubt += value - value  # where there are few: less work than a comparison of each
            elif code == SET_REAL:
                status = exchange(address, instance, reference, values, first, count)
            elif code == GET_REAL:
                status = exchange(address, instance, reference, values, first, count)
                finite = True
                for slot in range(first, first + count):
                    finite &= abs(values[slot]) < np.inf
                if not finite:
                    doubt = np.nan
            elif code == TAKE_WHOLE:
                fits = True
                for i in range(count):
                    number = whole_at(address + np.uint64(8) * np.uint64(i))
                    values[first + i] = number
                    fits &= WHOLE_MIN <= number <= WHOLE_MAX
                if fits:
                    following = k + ONE + ONE
            elif code == TAKE_BOOLEAN:
                for i in range(count):
                    values[first + i] = boolean_at(address + np.uint64(i))
            elif code == STEP:
                outcome[1] = instructions[k, COMPONENT]
                if count == 0:
                    status = do_step(address, instance, time, step)
                else:
                    status = do_step(address, instance, start + (n + 1 - np.int64(count)) * step, count * step)
            elif code == GET_WHOLE:
                status = exchange(address, instance, reference, whole, first, count)
                for slot in range(first, first + count):
                    values[slot] = whole[slot]
            elif code == SET_WHOLE:
                for slot in range(first, first + count):
                    if not WHOLE_MIN <= values[slot] <= WHOLE_MAX:
                        outcome[0] = NONFINITE
                        outcome[1] = slot
                        outcome[5] = k
                        return rows
                    whole[slot] = np.int32(values[slot])
                status = exchange(address, instance, reference, whole, first, count)
            elif code == TRANSFORM:
                for c in range(first, first + count):
                    values[target[c]] = values[source[c]] * factor[c] + offset[c]
            elif code == ADD:
                for c in range(first, first + count):
                    values[target[c]] += values[source[c]] * factor[c] + offset[c]
            elif code == MAP:
                for c in range(first, first + count):
                    last = table[c, 0] + table[c, 1] - 1
                    mapped = np.isnan(table_from[last])  # what no entry has stays
                    if mapped:
                        values[target[c]] = values[source[c]]
                    for entry in range(table[c, 0], table[c, 0] + table[c, 1]):
                        if table_from[entry] == values[source[c]]:
                            values[target[c]] = table_to[entry]
                            mapped = True
                            break
                    if not mapped:
                        outcome[0] = UNMAPPED
                        outcome[1] = source[c]
                        outcome[5] = k
                        return rows
            elif code == INJECT:
                for f in range(first, first + count):
                    faulty = fault_slot[f]
                    if not fault_window[f, 0] <= after < fault_window[f, 1]:
                        continue
                    if fault_kind[f] == OVERRIDE:
                        values[faulty] = fault_value[f]
                    elif fault_kind[f] == BIAS:
                        values[faulty] += fault_value[f]
                    elif fault_kind[f] == EXCITE:
                        row = n - first_point
                        if row < excitation.shape[0]:
                            values[faulty] += excitation[row, int(fault_value[f])]
                    else:
                        if np.isnan(frozen[f]):
                            frozen[f] = values[faulty]
                        values[faulty] = frozen[f]
            elif code == DRIVE:
                driven_row = min(n + 1 + np.int64(address), drive_table.shape[0] - 1)
                for d in range(first, first + count):
                    values[drive_slot[d]] = drive_table[driven_row, d]
            elif code == RESTORE_FLOATS:
                restore_floats()
            else:
                if code <= COPY_TEXT:
                    status = exchange_texts(instructions[k], buffers.texts, outcome)
                elif code < FIRST_OF_FMI3:
                    status = begin(instructions[k], program, settings, buffers.read_back, span, outcome)
                elif WITH_FMI3:
                    if code < COPY_BINARY:
                        transfers, stored = fmi3.transfers, fmi3.stored
                        status = exchange_in_steps(
                            instructions[k], transfers, values, stored, outcome, time, step, start, n
                        )
                    elif code < GIVE_PARAMETERS:
                        status = exchange_with_texts(instructions[k], fmi3, buffers, after)
                    else:
                        status = begin_fmi3(instructions[k], program, settings, buffers.read_back, span, outcome, fmi3)
                if outcome[0] != 0:
                    outcome[5] = k
                    return rows
            if status > FMI_WARNING or status < 0:
                outcome[0] = FAILED
                outcome[1] = instructions[k, COMPONENT]
                if not FIRST_OF_FMI3 <= code < GIVE_PARAMETERS:
                    outcome[2] = instructions[k, FUNCTION]
                outcome[3] = status
                outcome[5] = k
                return rows
            if doubt != 0.0:
                for slot in range(first, first + count):
                    if not abs(values[slot]) < np.inf:
                        outcome[0] = NONFINITE
                        outcome[1] = slot
                        outcome[5] = k
                        return rows
        n += 1
        finished = program.finished_slot >= 0 and values[program.finished_slot] != 0.0
        halted = halt[0] != 0
        last = finished or n == steps or halted
        if last or to_record == 0:
            to_record = stride
            times[rows] = after
            for c in range(recorded.size):
                record[c, rows] = values[recorded[c]]
            rows += 1
        to_record -= 1
        if last:
            outcome[0] = FINISHED if finished else STOP_TIME if n == steps else INTERRUPTED
            return rows
        if n > 0:
            phase = phase + 1 if phase + 1 < parts else 0
        first_instruction = np.uint64(phases[phase])
        last_instruction = np.uint64(phases[phase + 1])


def under_another_name(
    function: Callable[..., int], names: Mapping[str, object], name: str, **constants: object
) -> FunctionType:
    """A copy for another compilation, with the ``names`` of its module and ``constants``.

    numba's cache tells functions apart by name, not by options or constants.
    """
    copy = FunctionType(function.__code__.replace(co_name=name, co_qualname=name), {**names, **constants}, name)
    copy.__qualname__ = name
    return copy


@cache
def function(*, locked: bool, with_fmi3: bool, with_fused: bool) -> Any:
    """For Python FMUs, which need the interpreter lock at every call, or native ones; compiled when it is called."""
    name = f"_fly{'' if locked else '_unlocked'}{'_fmi3' if with_fmi3 else ''}{'_fused' if with_fused else ''}"
    copy = under_another_name(_fly, globals(), name, WITH_FMI3=with_fmi3, WITH_FUSED=with_fused)
    return compile_cached(copy, nogil=not locked)


def compile_for(arguments: tuple, *, locked: bool, with_fmi3: bool, with_fused: bool = False) -> Callable[..., int]:
    """The loop for arguments of these types, as all flights of a simulation have them; ``locked`` for Python FMUs.

    One that is not ``with_fmi3`` has no instructions of FMI 3.0, which take twice as long to compile as all others.
    Called by itself numba's dispatcher would look at the type of every array in every flight.
    """
    chosen = function(locked=locked, with_fmi3=with_fmi3, with_fused=with_fused)
    return chosen.compile(tuple(typeof(part) for part in arguments))


def load(*, locked: bool, with_fmi3: bool = False) -> None:
    """Have the loop compiled, or read from the cache, before a system is there to fly."""
    compile_for(arrays.blank(with_fmi3=with_fmi3), locked=locked, with_fmi3=with_fmi3)
