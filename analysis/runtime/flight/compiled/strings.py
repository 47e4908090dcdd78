"""Strings that components exchange: rows of bytes, handed from FMU to FMU."""

from __future__ import annotations

import numpy as np

from ....common.compiler import compile_cached
from .codes import ADDRESS, CODE, COPY_TEXT, COUNT, FIRST, FMI_WARNING, INSTANCE, SET_TEXT, TOO_LONG
from .fmi_calls import copy_text, exchange


def _exchange_texts(instruction, texts, outcome):  # type: ignore[no-untyped-def]
    """Work off one instruction on Strings; returns the fmi2Status. A text without room becomes the outcome."""
    code = instruction[CODE]
    address = instruction[ADDRESS]
    instance = instruction[INSTANCE]
    first = instruction[FIRST]
    count = instruction[COUNT]
    size = texts.rows.shape[1]
    if code == COPY_TEXT:
        copy_text(texts.address[first], texts.address[address], size)
        return np.int32(0)
    if code == SET_TEXT:
        return exchange(address, instance, texts.reference, texts.address, first, count)
    status = exchange(address, instance, texts.reference, texts.given, first, count)
    for t in range(first, first + count if 0 <= status <= FMI_WARNING else first):
        if texts.given[t] == 0:
            texts.rows[t, 0] = 0
        else:
            copy_text(texts.address[t], texts.given[t], size)
        if texts.rows[t, size - 1] != 0:
            outcome[0] = TOO_LONG
            outcome[1] = t
            return status
    return status


exchange_texts = compile_cached(_exchange_texts)
