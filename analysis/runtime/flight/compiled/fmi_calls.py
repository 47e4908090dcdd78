"""Calls of FMI 2.0 C functions by address, from compiled code; Strings handed from FMU to FMU as rows of bytes.

The functions of `in_compiled_code` are usable inside numba-compiled code only. ``address`` is that of the FMU's
function and ``instance`` the fmi2Component, both as integers; arrays are passed by address.
They return the fmi2Status.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from inspect import Parameter
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.base import BaseContext
from numba.core.typing import Context, Signature
from numba.extending import intrinsic

from ....common.compiler import compile_cached
from . import codes

INT32 = ir.IntType(32)
INT64 = ir.IntType(64)
DOUBLE = ir.DoubleType()
ARRAY = None  # of a type of its own
Intrinsic = Callable[..., Any]  # of numbers, whose types numba knows
Emit = Callable[[BaseContext, ir.IRBuilder, Signature, Sequence[ir.Value]], ir.Value]


def in_compiled_code(result: types.Type, *parameters: types.Type | None) -> Callable[[Emit], Intrinsic]:
    """A function that compiled code can call, of these types, from what emits its code."""

    def decorate(emit: Emit) -> Intrinsic:
        def define(_: Context, *arguments: types.Type) -> tuple[Signature, Emit]:
            actual = zip(parameters, arguments, strict=True)
            return result(*(given if declared is ARRAY else declared for declared, given in actual)), emit

        define.__name__ = define.__qualname__ = emit.__name__
        names = [Parameter(f"p{index}", Parameter.POSITIONAL_OR_KEYWORD) for index in range(len(parameters) + 1)]
        vars(define)["__signature__"] = inspect.Signature(names)  # numba packs what *arguments takes into a tuple
        return intrinsic(define)

    return decorate


def call(builder: ir.IRBuilder, address: ir.Value, values: Sequence[ir.Value]) -> ir.Value:
    """Emit the call of the C function at an address; every argument has its C type already."""
    function_type = ir.FunctionType(INT32, [value.type for value in values])
    pointer = builder.inttoptr(address, cgutils.voidptr_t)
    return builder.call(builder.bitcast(pointer, function_type.as_pointer()), values)


def element(
    context: BaseContext, builder: ir.IRBuilder, array_type: types.Array, array: ir.Value, index: ir.Value
) -> ir.Value:
    """Address of an array's element, as an integer."""
    start = builder.ptrtoint(context.make_array(array_type)(context, builder, array).data, INT64)
    size = context.get_abi_sizeof(context.get_data_type(array_type.dtype))
    return builder.add(start, builder.mul(index, INT64(size)))


@in_compiled_code(types.int32, types.int64, types.int64, ARRAY, ARRAY, types.int64, types.int64)
def exchange(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """fmi2SetReal, fmi2GetInteger and their kin: (address, instance, references, values, first, count).

    Value references (uint32) and values (float64 or int32) of ``count`` variables are taken from index ``first`` on in
    their arrays.
    """
    address, instance, references, values, first, count = arguments
    reference_address = element(context, builder, signature.args[2], references, first)
    value_address = element(context, builder, signature.args[3], values, first)
    return call(builder, address, [instance, reference_address, count, value_address])


@in_compiled_code(types.int32, types.int64, types.int64, types.float64, types.float64)
def do_step(_: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]) -> ir.Value:
    """fmi2DoStep (address, instance, time, step), with the promise not to go back before the current point."""
    return call(builder, arguments[0], [*arguments[1:], INT32(1)])


@in_compiled_code(types.float64, types.int64)
def real_at(_: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]) -> ir.Value:
    """The double at an address; read as an atomic one, so that a few of them are not made vectors of."""
    return builder.load_atomic(builder.inttoptr(arguments[0], DOUBLE.as_pointer()), "monotonic", 8)


@in_compiled_code(types.int64, types.int64)
def whole_at(_: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]) -> ir.Value:
    """The int64 at an address, read as `real_at` reads."""
    return builder.load_atomic(builder.inttoptr(arguments[0], INT64.as_pointer()), "monotonic", 8)


@in_compiled_code(types.float64, types.int64)
def boolean_at(_: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]) -> ir.Value:
    """The C bool at an address, as 0 or 1."""
    return builder.uitofp(builder.load(builder.inttoptr(arguments[0], ir.IntType(8).as_pointer())), DOUBLE)


@in_compiled_code(types.void, types.int64, types.float64)
def put_real(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """Write a double to an address: (address, value)."""
    builder.store_atomic(arguments[1], builder.inttoptr(arguments[0], DOUBLE.as_pointer()), "monotonic", 8)
    return context.get_dummy_value()


@in_compiled_code(types.int32, types.int64, types.int64)
def change_mode(_: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]) -> ir.Value:
    """fmi2Reset, fmi2EnterInitializationMode, fmi2ExitInitializationMode or fmi2Terminate: (address, instance)."""
    return call(builder, arguments[0], [arguments[1]])


@in_compiled_code(
    types.int32, types.int64, types.int64, types.int32, types.float64, types.float64, types.int32, types.float64
)
def setup_experiment(
    _: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """fmi2SetupExperiment or fmi3EnterInitializationMode (address, instance, known, tolerance, start, ends, stop).

    ``known`` is 1 with a tolerance, ``ends`` with a stop time, else 0.
    """
    return call(builder, arguments[0], arguments[1:])


@in_compiled_code(types.int32, types.int64, types.int64)
def compare_texts(
    _: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """The C library's strcmp of the strings at two addresses: 0 where they are equal."""
    function_type = ir.FunctionType(INT32, [cgutils.voidptr_t, cgutils.voidptr_t])
    function = cgutils.get_or_insert_function(builder.module, function_type, "strcmp")
    return builder.call(function, [builder.inttoptr(address, cgutils.voidptr_t) for address in arguments])


@in_compiled_code(types.int64, types.int64, types.int64, types.int64)
def copy_text(_: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]) -> ir.Value:
    """The C library's strncpy (target, source, size): at most ``size`` bytes between addresses, filled with zeros."""
    function_type = ir.FunctionType(cgutils.voidptr_t, [cgutils.voidptr_t, cgutils.voidptr_t, INT64])
    function = cgutils.get_or_insert_function(builder.module, function_type, "strncpy")
    target, source, size = arguments
    pointers = [builder.inttoptr(address, cgutils.voidptr_t) for address in (target, source)]
    return builder.ptrtoint(builder.call(function, [*pointers, size]), INT64)


def _exchange_texts(instruction, texts, outcome):  # type: ignore[no-untyped-def]
    """Work off one instruction on Strings; returns the fmi2Status. A text without room becomes the outcome."""
    code = instruction[codes.CODE]
    address = instruction[codes.ADDRESS]
    instance = instruction[codes.INSTANCE]
    first = instruction[codes.FIRST]
    count = instruction[codes.COUNT]
    size = texts.rows.shape[1]
    if code == codes.COPY_TEXT:
        copy_text(texts.address[first], texts.address[address], size)
        return np.int32(0)
    if code == codes.SET_TEXT:
        return exchange(address, instance, texts.reference, texts.address, first, count)
    status = exchange(address, instance, texts.reference, texts.given, first, count)
    for t in range(first, first + count if 0 <= status <= codes.FMI_WARNING else first):
        if texts.given[t] == 0:
            texts.rows[t, 0] = 0
        else:
            copy_text(texts.address[t], texts.given[t], size)
        if texts.rows[t, size - 1] != 0:
            outcome[0] = codes.TOO_LONG
            outcome[1] = t
            return status
    return status


exchange_texts = compile_cached(_exchange_texts)
