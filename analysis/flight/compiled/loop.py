"""The co-simulation loop: one compiled function that initialises the FMUs and flies them.

A system becomes a list of instructions (`instructions.py`): one part that initialises, one part
that is repeated every communication step. The loop knows nothing of algorithms; their order is
in the list. Every exchanged variable has a slot in one float64 array; Integer, Boolean and
Enumeration values pass through an int32 array of the same layout. The slots of a component are
contiguous by type and direction, so that each FMI call takes a piece of the arrays as it stands.

It is one function without calls to others of ours: numba counts references to every array that
crosses a call, which costs more than the FMI calls themselves.
"""

from __future__ import annotations

from types import FunctionType
from typing import Any

import numpy as np

from .compiler import compiled
from .fmi_calls import change_mode, compare_texts, copy_text, do_step, exchange, setup_experiment

# Instruction codes.
COPY, TRANSFORM, MAP, INJECT, SET_REAL, SET_WHOLE, GET_REAL, GET_WHOLE, STEP = range(9)
PARAMETERS, WHOLE_PARAMETERS, TEXT_PARAMETERS, SETUP, MODE, DRIVE = range(9, 15)
READ_BACK, WHOLE_READ_BACK, TEXT_READ_BACK = range(15, 18)
SET_TEXT, GET_TEXT, COPY_TEXT = range(18, 21)
# Instruction columns. FIRST and COUNT are connections, faults, slots, parameters, Strings or driven inputs; a COPY and
# a COPY_TEXT have the first target in FIRST and the first source in ADDRESS; a STEP over several communication steps
# their number in COUNT (0 for one); a DRIVE has 0 in ADDRESS while the FMUs initialise, then 1; FUNCTION numbers
# library.FUNCTION_NAMES. Exchanged values belong to the end of the step, the initialisation's to the start.
CODE, ADDRESS, INSTANCE, FIRST, COUNT, COMPONENT, FUNCTION = range(7)
COLUMNS = 7

# How a run ends: Buffers.outcome[0].
STOP_TIME, FINISHED, NONFINITE, FAILED, UNMAPPED, INTERRUPTED, NOT_TAKEN, TOO_LONG = range(8)
OVERRIDE, BIAS, FREEZE, EXCITE = range(4)
FMI_WARNING = 1
KEPT = 1e-6  # of a Real: what an FMU may lose of it, single precision or a unit of its own


def _fly(program, buffers, settings, span, recording, excitation):  # type: ignore[no-untyped-def]
    """Initialise and run; returns the number of rows recorded, buffers.outcome says how it ended.

    The rows of ``excitation``, float64 [r, e], are added to the excited slots at the communication points behind
    ``span.first``.
    """
    instructions = program.instructions
    reference, parameter_reference = program.reference, program.parameter_reference
    source, target = program.source, program.target
    factor, offset = program.factor, program.offset
    table, table_from, table_to = program.table, program.table_from, program.table_to
    fault_slot, fault_kind = program.fault_slot, program.fault_kind
    fault_window, fault_value = program.fault_window, program.fault_value
    drive_slot, drive_table = program.drive_slot, program.drive_table
    values, whole, frozen, outcome = buffers.values, buffers.whole, buffers.frozen, buffers.outcome
    parameters, whole_parameters, text_parameters = settings.real, settings.whole, settings.text
    found, whole_found, text_found = buffers.read_back.real, buffers.read_back.whole, buffers.read_back.text
    tolerance, texts = program.tolerance, buffers.texts
    text_reference, text_address, text_given = texts.reference, texts.address, texts.given
    text_rows, text_initial, text_size = texts.rows, texts.initial, texts.rows.shape[1]
    start, step, stop, first_point, steps = span.start, span.step, span.stop, span.first, span.last
    recorded, stride, record, times = recording.slots, recording.stride, recording.rows, recording.times
    halt = buffers.halt
    outcome[:] = 0
    rows = 0
    phases, parts = program.phases, program.phases.size - 1
    n = first_point  # -1: the initialisation
    phase = max(n, 0) % parts
    to_record = 0
    if n < 0:
        values[:] = program.initial
        frozen[:] = np.nan
        text_rows[:] = text_initial
        first_instruction = np.uint64(0 if span.reset else program.reset_end)
        last_instruction = np.uint64(phases[0])
        after = start
    else:
        first_instruction = np.uint64(phases[phase])
        last_instruction = np.uint64(phases[phase + 1])
        after = start + n * step
    while True:
        time = after
        after = start + (n + 1) * step
        outcome[4] = n + 1
        for k in range(first_instruction, last_instruction):
            code = instructions[k, CODE]
            address = instructions[k, ADDRESS]
            instance = instructions[k, INSTANCE]
            first = instructions[k, FIRST]
            count = instructions[k, COUNT]
            status = np.int32(0)
            if code == COPY:
                for i in range(count):
                    values[first + i] = values[address + i]
            elif code == SET_REAL:
                status = exchange(address, instance, reference, values, first, count)
            elif code == GET_REAL:
                status = exchange(address, instance, reference, values, first, count)
                finite = True
                for slot in range(first, first + count):
                    finite &= abs(values[slot]) < np.inf
                if not finite and status <= FMI_WARNING:
                    for slot in range(first, first + count):
                        if not abs(values[slot]) < np.inf:
                            outcome[0] = NONFINITE
                            outcome[1] = slot
                            outcome[5] = k
                            return rows
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
                    whole[slot] = np.int32(values[slot])
                status = exchange(address, instance, reference, whole, first, count)
            elif code == TRANSFORM:
                for c in range(first, first + count):
                    values[target[c]] = values[source[c]] * factor[c] + offset[c]
            elif code == MAP:
                for c in range(first, first + count):
                    mapped = False
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
            elif code == PARAMETERS:
                status = exchange(address, instance, parameter_reference, parameters, first, count)
            elif code == WHOLE_PARAMETERS:
                status = exchange(address, instance, parameter_reference, whole_parameters, first, count)
            elif code == TEXT_PARAMETERS:
                status = exchange(address, instance, parameter_reference, text_parameters, first, count)
            elif code == SETUP:
                allowed = tolerance[instructions[k, COMPONENT]]
                known = not np.isnan(allowed)
                status = setup_experiment(address, instance, np.int32(known), allowed if known else 0.0, start, stop)
            elif code == MODE:
                status = change_mode(address, instance)
            elif code == READ_BACK:
                status = exchange(address, instance, parameter_reference, found, first, count)
                for p in range(first, first + count if 0 <= status <= FMI_WARNING else first):
                    given = parameters[p]
                    near = abs(found[p] - given) <= KEPT * abs(given)
                    if not (near or found[p] == given or (np.isnan(found[p]) and np.isnan(given))):
                        outcome[0] = NOT_TAKEN
                        outcome[1] = p
                        outcome[5] = k
                        return rows
            elif code == WHOLE_READ_BACK:
                status = exchange(address, instance, parameter_reference, whole_found, first, count)
                for p in range(first, first + count if 0 <= status <= FMI_WARNING else first):
                    if whole_found[p] != whole_parameters[p]:
                        outcome[0] = NOT_TAKEN
                        outcome[1] = p
                        outcome[5] = k
                        return rows
            elif code == TEXT_READ_BACK:
                status = exchange(address, instance, parameter_reference, text_found, first, count)
                for p in range(first, first + count if 0 <= status <= FMI_WARNING else first):
                    if text_found[p] == 0 or compare_texts(text_found[p], text_parameters[p]) != 0:
                        outcome[0] = NOT_TAKEN
                        outcome[1] = p
                        outcome[5] = k
                        return rows
            elif code == SET_TEXT:
                status = exchange(address, instance, text_reference, text_address, first, count)
            elif code == GET_TEXT:
                status = exchange(address, instance, text_reference, text_given, first, count)
                for t in range(first, first + count if 0 <= status <= FMI_WARNING else first):
                    if text_given[t] == 0:
                        text_rows[t, 0] = 0
                    else:
                        copy_text(text_address[t], text_given[t], text_size)
                    if text_rows[t, text_size - 1] != 0:
                        outcome[0] = TOO_LONG
                        outcome[1] = t
                        outcome[5] = k
                        return rows
            elif code == COPY_TEXT:
                copy_text(text_address[first], text_address[address], text_size)
            if status > FMI_WARNING or status < 0:
                outcome[0] = FAILED
                outcome[1] = instructions[k, COMPONENT]
                outcome[2] = instructions[k, FUNCTION]
                outcome[3] = status
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
                record[rows, c] = values[recorded[c]]
            rows += 1
        to_record -= 1
        if last:
            outcome[0] = FINISHED if finished else STOP_TIME if n == steps else INTERRUPTED
            return rows
        if n > 0:
            phase = phase + 1 if phase + 1 < parts else 0
        first_instruction = np.uint64(phases[phase])
        last_instruction = np.uint64(phases[phase + 1])


def _under_another_name(function: Any, name: str) -> FunctionType:
    """A copy for another compilation: numba's cache tells functions apart by name, not by options."""
    copy = FunctionType(function.__code__.replace(co_name=name, co_qualname=name), globals(), name)
    copy.__qualname__ = name
    return copy


# For Python FMUs, which need the interpreter lock at every call, and for native ones, which run without.
fly_locked = compiled(_fly)
fly_unlocked = compiled(_under_another_name(_fly, "_fly_unlocked"), nogil=True)
