"""What happens once, before a flight: parameters, modes, and whether the FMUs took what they were given."""

from __future__ import annotations

import numpy as np

from ....common.compiler import compile_cached
from . import codes
from .fmi_calls import change_mode, compare_texts, exchange, setup_experiment

LOSS = 1e-6  # of a Real: what an FMU may lose of it, single precision or a unit of its own


def _begin(instruction, program, given, read_back, span, outcome):  # type: ignore[no-untyped-def]
    """Work off one instruction of the initialisation; returns the fmi2Status.

    A parameter that an FMU has not taken becomes the outcome.
    """
    code = instruction[codes.CODE]
    address = instruction[codes.ADDRESS]
    instance = instruction[codes.INSTANCE]
    first = instruction[codes.FIRST]
    count = instruction[codes.COUNT]
    reference = program.parameter_reference
    if code == codes.PARAMETERS:
        return exchange(address, instance, reference, given.real, first, count)
    if code == codes.WHOLE_PARAMETERS:
        return exchange(address, instance, reference, given.whole, first, count)
    if code == codes.TEXT_PARAMETERS:
        return exchange(address, instance, reference, given.text, first, count)
    if code == codes.SETUP:
        allowed = program.tolerance[instruction[codes.COMPONENT]]
        known = not np.isnan(allowed)
        tolerance, ends = allowed if known else 0.0, np.isfinite(span.stop)
        stop = span.stop if ends else 0.0
        return setup_experiment(address, instance, np.int32(known), tolerance, span.start, np.int32(ends), stop)
    if code == codes.MODE:
        return change_mode(address, instance)
    if code == codes.READ_BACK:
        status = exchange(address, instance, reference, read_back.real, first, count)
    elif code == codes.WHOLE_READ_BACK:
        status = exchange(address, instance, reference, read_back.whole, first, count)
    else:  # TEXT_READ_BACK
        status = exchange(address, instance, reference, read_back.text, first, count)
    if status < 0 or status > codes.FMI_WARNING:
        return status
    for p in range(first, first + count):
        if code == codes.READ_BACK:
            requested, stored = given.real[p], read_back.real[p]
            selected = (
                stored == requested
                or abs(stored - requested) <= LOSS * abs(requested)
                or (np.isnan(stored) and np.isnan(requested))
            )
        elif code == codes.WHOLE_READ_BACK:
            selected = read_back.whole[p] == given.whole[p]
        else:
            selected = read_back.text[p] != 0 and compare_texts(read_back.text[p], given.text[p]) == 0
        if not selected:
            outcome[0] = codes.NOT_TAKEN
            outcome[1] = p
            return status
    return status


begin = compile_cached(_begin)
