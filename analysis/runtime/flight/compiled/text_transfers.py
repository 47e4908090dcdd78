"""Strings and Binaries exchanged with FMUs of FMI 3.0, and discrete inputs, which may be texts, given in event mode."""

from __future__ import annotations

import numpy as np

from ....common.compiler import compile_cached
from . import codes
from .events import settle
from .fmi3_calls import copy_bytes, exchange_binaries, exchange_transfer
from .fmi_calls import change_mode, copy_text
from .transfers import set_transfer, to_stored


def _give_texts(address, instance, transfer, fmi3, buffers):  # type: ignore[no-untyped-def]
    """Returns the fmi3Status."""
    reference = fmi3.transfers.reference
    start, size = transfer[codes.REFERENCE], transfer[codes.REFERENCES]
    first, count = transfer[codes.FIRST_VALUE], transfer[codes.VALUES]
    if transfer[codes.KIND] == codes.STRING:
        return exchange_transfer(address, instance, reference, start, size, buffers.texts.address, first, count)
    addresses = fmi3.binaries.address
    return exchange_binaries(address, instance, reference, start, size, fmi3.sizes, addresses, first, count)


def _take_texts(address, instance, transfer, fmi3, buffers):  # type: ignore[no-untyped-def]
    """Returns the fmi3Status; a text without room becomes the outcome."""
    reference = fmi3.transfers.reference
    start, size = transfer[codes.REFERENCE], transfer[codes.REFERENCES]
    first, count = transfer[codes.FIRST_VALUE], transfer[codes.VALUES]
    is_binary = transfer[codes.KIND] == codes.BINARY
    texts = fmi3.binaries if is_binary else buffers.texts
    if is_binary:
        status = exchange_binaries(address, instance, reference, start, size, fmi3.sizes, texts.given, first, count)
    else:
        status = exchange_transfer(address, instance, reference, start, size, texts.given, first, count)
    if status < 0 or status > codes.FMI_WARNING:
        return status
    room = texts.rows.shape[1]
    for t in range(first, first + count):
        if is_binary:
            if fmi3.sizes[t] > room:
                buffers.outcome[0] = codes.TOO_LONG
                buffers.outcome[1] = -1 - t
                return status
            copy_bytes(texts.rows, t * room, texts.given[t], fmi3.sizes[t])
        elif texts.given[t] == 0:
            texts.rows[t, 0] = 0
        else:
            copy_text(texts.address[t], texts.given[t], room)
            if texts.rows[t, room - 1] != 0:
                buffers.outcome[0] = codes.TOO_LONG
                buffers.outcome[1] = t
                return status
    return status


give_texts = compile_cached(_give_texts)
take_texts = compile_cached(_take_texts)


def _set_events(instruction, functions, fmi3, buffers):  # type: ignore[no-untyped-def]
    """Give discrete inputs, in event mode, if one of them has changed; texts count as changed."""
    instance, outcome = instruction[codes.INSTANCE], buffers.outcome
    transfers, stored = fmi3.transfers, fmi3.stored
    first = instruction[codes.FIRST]
    last = first + instruction[codes.COUNT]
    changed = False
    for p in range(first, last):
        transfer = transfers.rows[p]
        kind, slot, count = transfer[codes.KIND], transfer[codes.FIRST_VALUE], transfer[codes.VALUES]
        if kind >= codes.STRING:
            changed = True
        else:
            changed |= to_stored(kind, slot, count, buffers.values, stored, outcome)
    if not changed or outcome[0] != 0:
        return np.int32(0)
    outcome[2] = codes.ENTER_EVENT_MODE
    status = change_mode(functions[codes.ENTER_EVENT_MODE], instance)
    for p in range(first, last):
        if 0 <= status <= codes.FMI_WARNING:
            transfer = transfers.rows[p]
            outcome[2] = codes.SETTERS + transfer[codes.KIND]
            address = functions[outcome[2]]
            if transfer[codes.KIND] >= codes.STRING:
                status = give_texts(address, instance, transfer, fmi3, buffers)
            else:
                status = set_transfer(address, instance, transfer, transfers.reference, buffers.values, stored.sent)
    if 0 <= status <= codes.FMI_WARNING:
        status = settle(functions, instance, stored, outcome)
    return status


set_events = compile_cached(_set_events)


def _exchange_with_texts(instruction, fmi3, buffers, after):  # type: ignore[no-untyped-def]
    """Work off one instruction of a communication step up to ``after`` (s); returns the fmi3Status."""
    code, address, instance = instruction[codes.CODE], instruction[codes.ADDRESS], instruction[codes.INSTANCE]
    first = instruction[codes.FIRST]
    buffers.outcome[2] = instruction[codes.FUNCTION]
    if code == codes.GIVE_TEXTS:
        return give_texts(address, instance, fmi3.transfers.rows[first], fmi3, buffers)
    if code == codes.TAKE_TEXTS:
        return take_texts(address, instance, fmi3.transfers.rows[first], fmi3, buffers)
    if code == codes.COPY_BINARY:
        binaries = fmi3.binaries
        fmi3.sizes[first] = fmi3.sizes[address]
        for byte in range(fmi3.sizes[first]):
            binaries.rows[first, byte] = binaries.rows[address, byte]
        return np.int32(0)
    buffers.outcome[1] = instruction[codes.COMPONENT]
    fmi3.stored.time[1] = after
    return set_events(instruction, fmi3.transfers.functions[instruction[codes.COMPONENT]], fmi3, buffers)


exchange_with_texts = compile_cached(_exchange_with_texts)
