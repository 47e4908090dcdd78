"""Calls of FMI 2.0 C functions by address, from compiled code; Strings handed from FMU to FMU as rows of bytes.

Each function here is usable inside numba-compiled code only. ``address`` is that of the FMU's
function and ``instance`` the fmi2Component, both as integers; arrays are passed by address.
They return the fmi2Status.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic

from ....common.compiler import compile_cached
from .codes import (
    ADDRESS,
    CODE,
    COPY_TEXT,
    COUNT,
    FIRST,
    FMI_WARNING,
    INSTANCE,
    SET_TEXT,
    TOO_LONG,
)

INT32 = ir.IntType(32)
INT64 = ir.IntType(64)


def _call(builder: Any, address: Any, values: list) -> Any:
    """Emit the call of the C function at an address; every argument has its C type already."""
    function_type = ir.FunctionType(INT32, [value.type for value in values])
    pointer = builder.inttoptr(address, cgutils.voidptr_t)
    return builder.call(builder.bitcast(pointer, function_type.as_pointer()), values)


def _element(context: Any, builder: Any, array_type: Any, array: Any, index: Any) -> Any:
    """Address of an array's element, as an integer."""
    start = builder.ptrtoint(context.make_array(array_type)(context, builder, array).data, INT64)
    size = context.get_abi_sizeof(context.get_data_type(array_type.dtype))
    return builder.add(start, builder.mul(index, INT64(size)))


@intrinsic
def exchange(typing: Any, address: Any, instance: Any, references: Any, values: Any, first: Any, count: Any) -> Any:
    """fmi2SetReal, fmi2GetInteger and their kin for ``count`` variables.

    Value references (uint32) and values (float64 or int32) are taken from index ``first`` on in
    their arrays.
    """
    signature = types.int32(types.int64, types.int64, references, values, types.int64, types.int64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        address, instance, references, values, first, count = arguments
        reference_address = _element(context, builder, signature.args[2], references, first)
        value_address = _element(context, builder, signature.args[3], values, first)
        return _call(builder, address, [instance, reference_address, count, value_address])

    return signature, emit


@intrinsic
def do_step(typing: Any, address: Any, instance: Any, time: Any, step: Any) -> Any:
    """fmi2DoStep, with the promise not to go back before the current point."""
    signature = types.int32(types.int64, types.int64, types.float64, types.float64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _call(builder, arguments[0], [*arguments[1:], INT32(1)])

    return signature, emit


@intrinsic
def real_at(typing: Any, address: Any) -> Any:
    """The double at an address; read as an atomic one, so that a few of them are not made vectors of."""
    signature = types.float64(types.int64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.load_atomic(builder.inttoptr(arguments[0], ir.DoubleType().as_pointer()), "monotonic", 8)

    return signature, emit


@intrinsic
def whole_at(typing: Any, address: Any) -> Any:
    """The int64 at an address, read as `real_at` reads."""
    signature = types.int64(types.int64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.load_atomic(builder.inttoptr(arguments[0], INT64.as_pointer()), "monotonic", 8)

    return signature, emit


@intrinsic
def boolean_at(typing: Any, address: Any) -> Any:
    """The C bool at an address, as 0 or 1."""
    signature = types.float64(types.int64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        byte = builder.load(builder.inttoptr(arguments[0], ir.IntType(8).as_pointer()))
        return builder.uitofp(byte, ir.DoubleType())

    return signature, emit


@intrinsic
def put_real(typing: Any, address: Any, value: Any) -> Any:
    """Write a double to an address."""
    signature = types.void(types.int64, types.float64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        builder.store_atomic(arguments[1], builder.inttoptr(arguments[0], ir.DoubleType().as_pointer()), "monotonic", 8)
        return context.get_dummy_value()

    return signature, emit


@intrinsic
def change_mode(typing: Any, address: Any, instance: Any) -> Any:
    """fmi2Reset, fmi2EnterInitializationMode, fmi2ExitInitializationMode or fmi2Terminate."""
    signature = types.int32(types.int64, types.int64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _call(builder, arguments[0], [arguments[1]])

    return signature, emit


@intrinsic
def setup_experiment(
    typing: Any, address: Any, instance: Any, known: Any, tolerance: Any, start: Any, stop: Any
) -> Any:
    """fmi2SetupExperiment with start and stop time; ``known`` 1 where there is a tolerance, else 0."""
    signature = types.int32(types.int64, types.int64, types.int32, types.float64, types.float64, types.float64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        address, instance, known, tolerance, start, stop = arguments
        return _call(builder, address, [instance, known, tolerance, start, INT32(1), stop])

    return signature, emit


@intrinsic
def compare_texts(typing: Any, first: Any, second: Any) -> Any:
    """The C library's strcmp of the strings at two addresses: 0 where they are equal."""
    signature = types.int32(types.int64, types.int64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        function_type = ir.FunctionType(INT32, [cgutils.voidptr_t, cgutils.voidptr_t])
        function = cgutils.get_or_insert_function(builder.module, function_type, "strcmp")
        return builder.call(function, [builder.inttoptr(value, cgutils.voidptr_t) for value in arguments])

    return signature, emit


@intrinsic
def copy_text(typing: Any, target: Any, source: Any, size: Any) -> Any:
    """The C library's strncpy: at most ``size`` bytes from one address to another, filled up with zeros."""
    signature = types.int64(types.int64, types.int64, types.int64)

    def emit(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        function_type = ir.FunctionType(cgutils.voidptr_t, [cgutils.voidptr_t, cgutils.voidptr_t, INT64])
        function = cgutils.get_or_insert_function(builder.module, function_type, "strncpy")
        target, source, size = arguments
        pointers = [builder.inttoptr(value, cgutils.voidptr_t) for value in (target, source)]
        return builder.ptrtoint(builder.call(function, [*pointers, size]), INT64)

    return signature, emit


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
