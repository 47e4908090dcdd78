"""Calls of FMUs of FMI 3.0: exchanges of numbers and steps, and what happens once before a flight."""

from __future__ import annotations

import numpy as np

from ....common.compiler import compile_cached
from . import codes
from .beginning import LOSS
from .events import settle, step_to
from .fmi3_calls import exchange_transfer
from .fmi_calls import compare_texts, setup_experiment
from .transfers import get_transfer, set_transfer, to_stored


def _exchange_in_steps(instruction, transfers, values, stored, outcome, time, step, start, n):  # type: ignore[no-untyped-def]
    """Work off one instruction of the communication step behind point ``n``; returns the fmi3Status."""
    code = instruction[codes.CODE]
    address = instruction[codes.ADDRESS]
    instance = instruction[codes.INSTANCE]
    first = instruction[codes.FIRST]
    count = instruction[codes.COUNT]
    outcome[2] = instruction[codes.FUNCTION]
    if code == codes.SET_TRANSFER:
        transfer = transfers.rows[first]
        kind = transfer[codes.KIND]
        if kind != codes.FLOAT64:
            to_stored(kind, transfer[codes.FIRST_VALUE], transfer[codes.VALUES], values, stored, outcome)
            if outcome[0] != 0:
                return np.int32(0)
        return set_transfer(address, instance, transfer, transfers.reference, values, stored.sent)
    if code == codes.GET_TRANSFER or code == codes.READ_TRANSFER:
        transfer, checks = transfers.rows[first], code == codes.GET_TRANSFER
        return get_transfer(address, instance, transfer, transfers.reference, checks, values, stored, outcome)
    if code == codes.COPY_EXACT:
        for i in range(count):
            values[first + i] = values[address + i]
            stored.exact[first + i] = stored.exact[address + i]
        return np.int32(0)
    functions = transfers.functions[instruction[codes.COMPONENT]]
    outcome[1] = instruction[codes.COMPONENT]
    if code == codes.SETTLE:
        stored.time[1] = start
        return settle(functions, instance, stored, outcome)
    end = start + (n + 1) * step
    if count == 0:
        return step_to(functions, instance, time, step, end, first != 0, stored, outcome)
    begin = start + (n + 1 - np.int64(count)) * step
    return step_to(functions, instance, begin, count * step, end, first != 0, stored, outcome)


exchange_in_steps = compile_cached(_exchange_in_steps)


def _is_taken(kind, first, count, given, actual, requested_texts, actual_texts):  # type: ignore[no-untyped-def]
    """The first parameter of a transfer that an FMU has not taken, -1 where it has taken all.

    ``given`` and ``actual`` are words of numbers, the texts addresses.
    """
    for i in range(count):
        if kind == codes.STRING:
            p = first + i
            same = actual_texts[p] != 0 and compare_texts(actual_texts[p], requested_texts[p]) == 0
        elif kind == codes.FLOAT64 or kind == codes.FLOAT32:
            if kind == codes.FLOAT64:
                requested, stored = given.view(np.float64)[first + i], actual.view(np.float64)[first + i]
            else:
                at = 2 * first + i
                requested = np.float64(given.view(np.float32)[at])
                stored = np.float64(actual.view(np.float32)[at])
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
                same = same and actual.view(np.uint8)[byte] == given.view(np.uint8)[byte]
        if not same:
            return first + i
    return -1


first_not_taken = compile_cached(_is_taken)


def _begin(instruction, program, given, read_back, span, outcome, fmi3):  # type: ignore[no-untyped-def]
    """Work off one instruction of the initialisation, as `beginning.begin` does."""
    code = instruction[codes.CODE]
    address = instruction[codes.ADDRESS]
    instance = instruction[codes.INSTANCE]
    if code == codes.ENTER_INITIALIZATION:
        allowed = program.tolerance[instruction[codes.COMPONENT]]
        known = not np.isnan(allowed)
        tolerance, ends = allowed if known else 0.0, np.isfinite(span.stop)
        stop = span.stop if ends else 0.0
        return setup_experiment(address, instance, np.int32(known), tolerance, span.start, np.int32(ends), stop)
    transfer = fmi3.transfers.rows[instruction[codes.FIRST]]
    start, size = transfer[codes.REFERENCE], transfer[codes.REFERENCES]
    first, count, kind = transfer[codes.FIRST_VALUE], transfer[codes.VALUES], transfer[codes.KIND]
    reference, gives = fmi3.transfers.reference, code == codes.GIVE_PARAMETERS
    if kind == codes.STRING:
        texts = given.text if gives else read_back.text
        status = exchange_transfer(address, instance, reference, start, size, texts, first, count)
    else:
        words = fmi3.given if gives else fmi3.confirmed
        status = exchange_transfer(address, instance, reference, start, size, words, first, count)
    if code == codes.TAKE_BACK and 0 <= status <= codes.FMI_WARNING:
        refused = first_not_taken(kind, first, count, fmi3.given, fmi3.confirmed, given.text, read_back.text)
        if refused >= 0:
            outcome[0] = codes.NOT_TAKEN
            outcome[1] = refused
    return status


begin_fmi3 = compile_cached(_begin)
