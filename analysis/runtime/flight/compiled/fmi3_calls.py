"""Calls of FMI 3.0 C functions by address, as `fmi_calls` makes those of FMI 2.0. They return the fmi3Status."""

from __future__ import annotations

from collections.abc import Sequence

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.base import BaseContext
from numba.core.typing import Signature

from .fmi_calls import ARRAY, INT32, INT64, call, element, in_compiled_code


@in_compiled_code(
    types.int32, types.int64, types.int64, ARRAY, types.int64, types.int64, ARRAY, types.int64, types.int64
)
def exchange_transfer(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """fmi3SetFloat64 and its kin: (address, instance, references, first, count, values, first, count).

    Values are taken from an index on in their array, whose stored may be larger than they are.
    """
    address, instance, references, first, count, values, first_value, value_count = arguments
    reference_address = element(context, builder, signature.args[2], references, first)
    value_address = element(context, builder, signature.args[5], values, first_value)
    return call(builder, address, [instance, reference_address, count, value_address, value_count])


@in_compiled_code(
    types.int32, types.int64, types.int64, ARRAY, types.int64, types.int64, ARRAY, ARRAY, types.int64, types.int64
)
def exchange_binaries(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """fmi3SetBinary, fmi3GetBinary: (address, instance, references, first, count, sizes, addresses, first, count)."""
    address, instance, references, first, count, sizes, values, first_value, value_count = arguments
    reference_address = element(context, builder, signature.args[2], references, first)
    size_address = element(context, builder, signature.args[5], sizes, first_value)
    value_address = element(context, builder, signature.args[6], values, first_value)
    return call(builder, address, [instance, reference_address, count, size_address, value_address, value_count])


@in_compiled_code(types.int32, types.int64, types.int64, types.float64, types.float64, ARRAY, ARRAY)
def do_step_to_event(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """fmi3DoStep (address, instance, time, step, flags, times), with the promise not to go back before ``time``.

    ``flags`` become eventHandlingNeeded, terminateSimulation, earlyReturn; the first of ``times`` lastSuccessfulTime.
    """
    address, instance, time, step, flags, times = arguments
    returned = [element(context, builder, signature.args[4], flags, INT64(number)) for number in range(3)]
    last = element(context, builder, signature.args[5], times, INT64(0))
    return call(builder, address, [instance, time, step, INT32(1), *returned, last])


@in_compiled_code(types.int32, types.int64, types.int64, ARRAY, ARRAY)
def update_discrete_states(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """fmi3UpdateDiscreteStates (address, instance, flags, times).

    ``flags`` become discreteStatesNeedUpdate, terminateSimulation, and three that co-simulation does not need.
    """
    address, instance, flags, times = arguments
    returned = [element(context, builder, signature.args[2], flags, INT64(number)) for number in range(5)]
    return call(builder, address, [instance, *returned, element(context, builder, signature.args[3], times, INT64(0))])


@in_compiled_code(types.void, ARRAY, types.int64, types.int64, types.int64)
def copy_bytes(
    context: BaseContext, builder: ir.IRBuilder, signature: Signature, arguments: Sequence[ir.Value]
) -> ir.Value:
    """Copy bytes from an address to an index of an array on: (array, index, address, size)."""
    array, index, address, size = arguments
    target = builder.inttoptr(element(context, builder, signature.args[0], array, index), cgutils.voidptr_t)
    cgutils.raw_memcpy(builder, target, builder.inttoptr(address, cgutils.voidptr_t), size, 1)
    return context.get_dummy_value()
