"""Values exchanged with FMUs of FMI 3.0, in the types that these have: whole variables of one type in one call.

A slot is a float64; what an FMU is given of another type is converted into words of eight bytes, one a slot, of which a
transfer fills the first ones. Whole numbers of 64 bits are exchanged exactly: ``exact`` has them next to the slots, and
counts wherever its number is that of the slot, rounded to a float64.
"""

from __future__ import annotations

import numpy as np

from ....common.compiler import compile_cached
from . import codes
from .fmi3_calls import exchange_transfer

WIDE = 2.0**63


def _to_stored(kind, first, count, values, stored, outcome):  # type: ignore[no-untyped-def]
    """Convert slots to what an FMU is given; returns whether they have changed. One out of range is the outcome."""
    changed = False
    sent = stored.sent
    if kind == codes.FLOAT64:
        for slot in range(first, first + count):
            bits = values.view(np.uint64)[slot]
            changed |= sent[slot] != bits
            sent[slot] = bits
    elif kind == codes.FLOAT32:
        single = sent.view(np.float32)
        for i in range(count):
            rounded = np.float32(values[first + i])
            if not abs(rounded) < np.inf:
                outcome[0] = codes.NONFINITE
                outcome[1] = first + i
            changed |= single[2 * first + i] != rounded
            single[2 * first + i] = rounded
    elif kind == codes.INT64 or kind == codes.UINT64:
        low, high = (-WIDE, WIDE) if kind == codes.INT64 else (0.0, 2.0 * WIDE)
        for slot in range(first, first + count):
            number, exact = values[slot], stored.exact[slot]
            if (float(np.int64(exact)) if kind == codes.INT64 else float(exact)) != number:
                if not low <= number < high:
                    outcome[0] = codes.NONFINITE
                    outcome[1] = slot
                    continue
                exact = np.uint64(np.int64(number)) if number < WIDE else np.uint64(number)
            changed |= sent[slot] != exact
            sent[slot] = exact
    elif kind == codes.BOOLEAN:
        truths = sent.view(np.uint8)
        for i in range(count):
            truth = np.uint8(values[first + i] != 0.0)
            changed |= truths[8 * first + i] != truth
            truths[8 * first + i] = truth
    elif kind == codes.INT8:
        changed = _to_whole(sent.view(np.int8), 8 * first, -128.0, 127.0, first, count, values, outcome)
    elif kind == codes.UINT8:
        changed = _to_whole(sent.view(np.uint8), 8 * first, 0.0, 255.0, first, count, values, outcome)
    elif kind == codes.INT16:
        changed = _to_whole(sent.view(np.int16), 4 * first, -32768.0, 32767.0, first, count, values, outcome)
    elif kind == codes.UINT16:
        changed = _to_whole(sent.view(np.uint16), 4 * first, 0.0, 65535.0, first, count, values, outcome)
    elif kind == codes.INT32:
        changed = _to_whole(sent.view(np.int32), 2 * first, -(2.0**31), 2.0**31 - 1.0, first, count, values, outcome)
    elif kind == codes.UINT32:
        changed = _to_whole(sent.view(np.uint32), 2 * first, 0.0, 2.0**32 - 1.0, first, count, values, outcome)
    return changed


def _convert(numbers, start, low, high, first, count, values, outcome):  # type: ignore[no-untyped-def]
    changed = False
    for i in range(count):
        number = values[first + i]
        if not low <= number <= high:
            outcome[0] = codes.NONFINITE
            outcome[1] = first + i
            continue
        changed |= numbers[start + i] != number
        numbers[start + i] = np.int64(number)
    return changed


_to_whole = compile_cached(_convert)


def _from_stored(kind, first, count, values, stored):  # type: ignore[no-untyped-def]
    """Convert what an FMU has given to slots."""
    sent = stored.sent
    for i in range(count):
        slot = first + i
        if kind == codes.FLOAT32:
            values[slot] = sent.view(np.float32)[2 * first + i]
        elif kind == codes.INT64:
            stored.exact[slot] = sent[slot]
            values[slot] = float(np.int64(sent[slot]))
        elif kind == codes.UINT64:
            stored.exact[slot] = sent[slot]
            values[slot] = float(sent[slot])
        elif kind == codes.BOOLEAN or kind == codes.UINT8:
            values[slot] = sent.view(np.uint8)[8 * first + i]
        elif kind == codes.INT8:
            values[slot] = sent.view(np.int8)[8 * first + i]
        elif kind == codes.INT16:
            values[slot] = sent.view(np.int16)[4 * first + i]
        elif kind == codes.UINT16:
            values[slot] = sent.view(np.uint16)[4 * first + i]
        elif kind == codes.INT32:
            values[slot] = sent.view(np.int32)[2 * first + i]
        elif kind == codes.UINT32:
            values[slot] = sent.view(np.uint32)[2 * first + i]


to_stored = compile_cached(_to_stored)
from_stored = compile_cached(_from_stored)


def _set_transfer(address, instance, transfer, reference, values, sent):  # type: ignore[no-untyped-def]
    """Give an FMU numbers that are converted already; returns the fmi3Status."""
    start, size = transfer[codes.REFERENCE], transfer[codes.REFERENCES]
    first, count = transfer[codes.FIRST_VALUE], transfer[codes.VALUES]
    if transfer[codes.KIND] == codes.FLOAT64:
        return exchange_transfer(address, instance, reference, start, size, values, first, count)
    return exchange_transfer(address, instance, reference, start, size, sent, first, count)


def _get_transfer(address, instance, transfer, reference, checks, values, stored, outcome):  # type: ignore[no-untyped-def]
    """Take numbers of an FMU; returns the fmi3Status. ``checks``: a Real that is not finite becomes the outcome."""
    start, size = transfer[codes.REFERENCE], transfer[codes.REFERENCES]
    first, count, kind = transfer[codes.FIRST_VALUE], transfer[codes.VALUES], transfer[codes.KIND]
    if kind == codes.FLOAT64:
        status = exchange_transfer(address, instance, reference, start, size, values, first, count)
    else:
        status = exchange_transfer(address, instance, reference, start, size, stored.sent, first, count)
        from_stored(kind, first, count, values, stored)
    if checks and kind <= codes.FLOAT32 and 0 <= status <= codes.FMI_WARNING:
        for slot in range(first, first + count):
            if not abs(values[slot]) < np.inf:
                outcome[0] = codes.NONFINITE
                outcome[1] = slot
                return status
    return status


set_transfer = compile_cached(_set_transfer)
get_transfer = compile_cached(_get_transfer)
