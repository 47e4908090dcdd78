"""The floating-point environment of a thread, which the code of an FMU may leave changed.

On x86-64 it is two words: MXCSR of SSE (rounding, flush to zero, denormals are zero, exception masks) and the control
word of the x87; on aarch64 it is FPCR. Other processors are left alone. Flags of past exceptions are no part of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

from llvmlite import binding, ir
from numba import types
from numba.core import cgutils
from numba.core.base import BaseContext
from numba.core.typing import Signature

from ....common.compiler import compile_cached
from .fmi_calls import INT32, INT64, in_compiled_code

# Intel 64 and IA-32 Architectures Software Developer's Manual, volume 1: MXCSR (10.2.3) and the control word (8.1.5),
# their defaults and the bits that are settings.
MXCSR, MXCSR_SETTINGS = 0x1F80, 0xFFC0
X87_CONTROL, X87_CONTROL_SETTINGS = 0x037F, 0x0F3F
FPCR = 0  # Arm Architecture Reference Manual, C5.2.8: all bits are settings

INT16 = ir.IntType(16)
binding.initialize_native_asmparser()  # numba starts LLVM without it, and LLVM has no intrinsic for these words


@in_compiled_code(types.void)
def restore_floats(context: BaseContext, builder: ir.IRBuilder, _: Signature, __: Sequence[ir.Value]) -> ir.Value:
    """Put the environment of this thread back to the default, where it is another one.

    Reading takes a nanosecond; C's fegetenv and fesetenv, which save and load everything, a hundred.
    """
    machine = binding.get_process_triple().partition("-")[0]
    if machine == "x86_64":
        _restore_x86_64(builder)
    elif machine in ("aarch64", "arm64"):
        _restore_aarch64(builder)
    return context.get_dummy_value()


def _restore_x86_64(builder: ir.IRBuilder) -> None:
    # Words are read as they were written, 32 and 16 bits: a wider read would wait for the store to leave the processor.
    mxcsr, control = cgutils.alloca_once(builder, INT32), cgutils.alloca_once(builder, INT16)
    _access(builder, "stmxcsr ($0)", mxcsr)
    _access(builder, "fnstcw ($0)", control)
    sse, x87 = (
        builder.icmp_unsigned("!=", builder.and_(read, read.type(settings)), read.type(default & settings))
        for read, settings, default in (
            (builder.load(mxcsr), MXCSR_SETTINGS, MXCSR),
            (builder.load(control), X87_CONTROL_SETTINGS, X87_CONTROL),
        )
    )
    with builder.if_then(builder.or_(sse, x87), likely=False):
        builder.store(INT32(MXCSR), mxcsr)
        builder.store(INT16(X87_CONTROL), control)
        _access(builder, "ldmxcsr ($0)", mxcsr)
        _access(builder, "fldcw ($0)", control)


def _access(builder: ir.IRBuilder, instruction: str, address: ir.Value) -> None:
    """Emit an instruction that reads or writes memory at an address."""
    kind = ir.FunctionType(ir.VoidType(), [address.type])
    builder.asm(kind, instruction, "r,~{memory}", [address], side_effect=True)


def _restore_aarch64(builder: ir.IRBuilder) -> None:
    fpcr = builder.asm(ir.FunctionType(INT64, []), "mrs $0, fpcr", "=r", [], side_effect=True)
    with builder.if_then(builder.icmp_unsigned("!=", fpcr, INT64(FPCR)), likely=False):
        kind = ir.FunctionType(ir.VoidType(), [INT64])
        builder.asm(kind, "msr fpcr, $0", "r", [INT64(FPCR)], side_effect=True)


def _restore() -> None:
    restore_floats()


@cache
def float_restorer() -> Any:
    """Return a function of no arguments that does the same for Python."""
    return compile_cached(_restore)
