"""What FMUs of FMI 3.0 are asked for: exchanges, steps with early returns and events, and what happens once before."""

from __future__ import annotations

import numpy as np

from ....common.compiler import compile_cached
from . import codes
from .beginning import LOSS
from .fmi3_calls import (
    do_step_to_event,
    enter_initialization_mode,
    exchange_transfer,
    update_discrete_states,
)
from .fmi_calls import change_mode, compare_texts
from .transfers import get_transfer, set_transfer, to_stored

# Of library.FUNCTION_NAMES.
SETTERS, GETTERS, DO_STEP = 14, 27, 40
ENTER_EVENT_MODE, UPDATE_DISCRETE_STATES, ENTER_STEP_MODE = 46, 47, 48
ROUNDING = 1e-9  # of a step: what an early return may lack of its end
MOST_ROUNDS = 1000  # of event iterations, and of steps that return where they began


def _settle(functions, instance, stored, outcome):  # type: ignore[no-untyped-def]
    """From event mode to step mode, as soon as the discrete states have settled; returns the fmi3Status.

    An FMU that ends the simulation, or that never settles, becomes the outcome.
    """
    for _ in range(MOST_ROUNDS):
        outcome[2] = UPDATE_DISCRETE_STATES
        status = update_discrete_states(functions[UPDATE_DISCRETE_STATES], instance, stored.flags, stored.time)
        if status < 0 or status > codes.FMI_WARNING:
            return status
        if stored.flags[1] != 0:
            outcome[0] = codes.ENDED
            return status
        if stored.flags[0] == 0:
            outcome[2] = ENTER_STEP_MODE
            return change_mode(functions[ENTER_STEP_MODE], instance)
    outcome[0] = codes.STUCK
    return status


settle = compile_cached(_settle)


def _step(functions, instance, begin, step, end, uses_events, stored, outcome):  # type: ignore[no-untyped-def]
    """A step, continued to its end where it returns early; events are handled when they occur."""
    time, rounds = begin, 0
    while True:
        outcome[2] = DO_STEP
        status = do_step_to_event(functions[DO_STEP], instance, time, step, stored.flags, stored.time)
        if status < 0 or status > codes.FMI_WARNING:
            return status
        last = stored.time[0]
        is_early = stored.flags[2] != 0 and end - last > ROUNDING * (end - begin)
        now = last if is_early else end
        if stored.flags[1] != 0:
            outcome[0] = codes.ENDED
            stored.time[1] = now
            return status
        if stored.flags[0] != 0 and uses_events:
            outcome[2] = ENTER_EVENT_MODE
            status = change_mode(functions[ENTER_EVENT_MODE], instance)
            if 0 <= status <= codes.FMI_WARNING:
                status = settle(functions, instance, stored, outcome)
            if outcome[0] != 0 or status < 0 or status > codes.FMI_WARNING:
                stored.time[1] = now
                return status
        if not is_early:
            return status
        rounds = rounds + 1 if last <= time else 0
        if rounds > MOST_ROUNDS:
            outcome[0] = codes.STUCK
            return status
        time, step = last, end - last


step_to = compile_cached(_step)


def _set_events(instruction, functions, transfers, buffers):  # type: ignore[no-untyped-def]
    """Give discrete inputs, in event mode, if one of them has changed; texts count as changed."""
    instance, outcome = instruction[codes.INSTANCE], buffers.outcome
    first = instruction[codes.FIRST]
    last = first + instruction[codes.COUNT]
    changed = False
    for p in range(first, last):
        transfer = transfers.rows[p]
        kind = transfer[codes.KIND]
        if kind >= codes.STRING:
            changed = True
        else:
            changed |= to_stored(
                kind, transfer[codes.FIRST_VALUE], transfer[codes.VALUES], buffers.values, buffers.stored, outcome
            )
    if not changed or outcome[0] != 0:
        return np.int32(0)
    outcome[2] = ENTER_EVENT_MODE
    status = change_mode(functions[ENTER_EVENT_MODE], instance)
    for p in range(first, last):
        if 0 <= status <= codes.FMI_WARNING:
            outcome[2] = SETTERS + transfers.rows[p, codes.KIND]
            address = functions[SETTERS + transfers.rows[p, codes.KIND]]
            status = set_transfer(address, instance, transfers.rows[p], transfers.reference, buffers)
    if 0 <= status <= codes.FMI_WARNING:
        status = settle(functions, instance, buffers.stored, outcome)
    return status


set_events = compile_cached(_set_events)


def _exchange_in_steps(instruction, transfers, buffers, time, step, start, n):  # type: ignore[no-untyped-def]
    """Work off one instruction of the communication step behind point ``n``; returns the fmi3Status."""
    code = instruction[codes.CODE]
    address = instruction[codes.ADDRESS]
    instance = instruction[codes.INSTANCE]
    first = instruction[codes.FIRST]
    count = instruction[codes.COUNT]
    values, stored, outcome = buffers.values, buffers.stored, buffers.outcome
    outcome[2] = instruction[codes.FUNCTION]
    if code == codes.SET_TRANSFER:
        transfer = transfers.rows[first]
        kind = transfer[codes.KIND]
        if codes.FLOAT64 < kind < codes.STRING:
            to_stored(kind, transfer[codes.FIRST_VALUE], transfer[codes.VALUES], values, stored, outcome)
            if outcome[0] != 0:
                return np.int32(0)
        return set_transfer(address, instance, transfer, transfers.reference, buffers)
    if code == codes.GET_TRANSFER or code == codes.READ_TRANSFER:
        return get_transfer(
            address, instance, transfers.rows[first], transfers.reference, code == codes.GET_TRANSFER, buffers
        )
    if code == codes.COPY_EXACT:
        for i in range(count):
            values[first + i] = values[address + i]
            stored.exact[first + i] = stored.exact[address + i]
        return np.int32(0)
    if code == codes.COPY_BINARY:
        binaries = buffers.binaries
        binaries.sizes[first] = binaries.sizes[address]
        for byte in range(binaries.sizes[first]):
            binaries.rows[first, byte] = binaries.rows[address, byte]
        return np.int32(0)
    functions = transfers.functions[instruction[codes.COMPONENT]]
    outcome[1] = instruction[codes.COMPONENT]
    if code == codes.SET_EVENTS:
        stored.time[1] = time + step
        return set_events(instruction, functions, transfers, buffers)
    if code == codes.SETTLE:
        stored.time[1] = start
        return settle(functions, instance, stored, outcome)
    end = start + (n + 1) * step
    if count == 0:
        return step_to(functions, instance, time, step, end, first != 0, stored, outcome)
    begin = start + (n + 1 - np.int64(count)) * step
    return step_to(functions, instance, begin, count * step, end, first != 0, stored, outcome)


exchange_in_steps = compile_cached(_exchange_in_steps)


def _is_taken(kind, first, count, given, actual):  # type: ignore[no-untyped-def]
    """The first parameter of a transfer that an FMU has not taken, -1 where it has taken all."""
    for i in range(count):
        if kind == codes.STRING:
            p = first + i
            same = actual.text[p] != 0 and compare_texts(actual.text[p], given.text[p]) == 0
        elif kind == codes.FLOAT64 or kind == codes.FLOAT32:
            if kind == codes.FLOAT64:
                requested, stored = given.stored.view(np.float64)[first + i], actual.stored.view(np.float64)[first + i]
            else:
                at = 2 * first + i
                requested = np.float64(given.stored.view(np.float32)[at])
                stored = np.float64(actual.stored.view(np.float32)[at])
            same = stored == requested or abs(stored - requested) <= LOSS * abs(requested)
            same = same or (np.isnan(stored) and np.isnan(requested))
        else:
            size = 8
            if kind == codes.INT8 or kind == codes.UINT8 or kind == codes.BOOLEAN:
                size = 1
            elif kind == codes.INT16 or kind == codes.UINT16:
                size = 2
            elif kind == codes.INT32 or kind == codes.UINT32:
                size = 4
            at = 8 * first + size * i
            same = True
            for byte in range(at, at + size):
                same = same and actual.stored.view(np.uint8)[byte] == given.stored.view(np.uint8)[byte]
        if not same:
            return first + i
    return -1


first_not_taken = compile_cached(_is_taken)


def _begin(instruction, program, given, read_back, span, outcome):  # type: ignore[no-untyped-def]
    """Work off one instruction of the initialisation, as `beginning.begin` does."""
    code = instruction[codes.CODE]
    address = instruction[codes.ADDRESS]
    instance = instruction[codes.INSTANCE]
    if code == codes.ENTER_INITIALIZATION:
        allowed = program.tolerance[instruction[codes.COMPONENT]]
        known = not np.isnan(allowed)
        tolerance = allowed if known else 0.0
        return enter_initialization_mode(address, instance, np.int32(known), tolerance, span.start, span.stop)
    transfer = program.transfers.rows[instruction[codes.FIRST]]
    start, size = transfer[codes.REFERENCE], transfer[codes.REFERENCES]
    first, count, kind = transfer[codes.FIRST_VALUE], transfer[codes.VALUES], transfer[codes.KIND]
    reference = program.transfers.reference
    target = given if code == codes.GIVE_PARAMETERS else read_back
    if kind == codes.STRING:
        status = exchange_transfer(address, instance, reference, start, size, target.text, first, count)
    else:
        status = exchange_transfer(address, instance, reference, start, size, target.stored, first, count)
    if code == codes.TAKE_BACK and 0 <= status <= codes.FMI_WARNING:
        refused = first_not_taken(kind, first, count, given, read_back)
        if refused >= 0:
            outcome[0] = codes.NOT_TAKEN
            outcome[1] = refused
    return status


begin_fmi3 = compile_cached(_begin)
