"""Export of a matrix of formulas as a kernel function: Python that `perilune export` translates to C."""

from __future__ import annotations

import importlib
import keyword
from typing import Any

from ....common.errors import InputError
from .algebra import Expression, Symbols, sympy

_FUNCTIONS = ("sin", "cos", "tan", "exp", "log", "asin", "acos", "atan")
_RESERVED = (*_FUNCTIONS, "gain", "math", "zeros", "Matrix")


def kernel_text(name: str, letter: str, matrix: Symbols) -> str:
    """Return a module with the function ``name``, in which common terms are computed once. Raises InputError."""
    sp = sympy()
    arguments = sorted(str(symbol) for symbol in matrix.free_symbols)
    for each in (name, *arguments):
        if not each.isidentifier() or keyword.iskeyword(each):
            raise InputError("modal", f"the name {each!r}", "not a Python identifier", "use letters, digits and _")
        if each in _RESERVED:
            raise InputError(
                "modal", f"the name {each!r}", "the generated function already uses this name", "rename the symbol"
            )
    names = {name, *arguments}
    numbers = (symbol for symbol in sp.numbered_symbols("part_") if str(symbol) not in names)
    terms, (reduced,) = sp.cse([matrix], symbols=numbers, optimizations="basic")
    printer = _printer()
    lines = [f"    {symbol} = {printer.doprint(term)}" for symbol, term in terms]
    lines.append(f"    gain = zeros({matrix.rows}, {matrix.cols})")
    for i in range(matrix.rows):
        for j in range(matrix.cols):
            if reduced[i, j] != 0:
                lines.append(f"    gain[{i}, {j}] = {printer.doprint(reduced[i, j])}")
    body = "\n".join(lines)
    used = [each for each in _FUNCTIONS if f"{each}(" in body]
    imports = ["import math", ""] if "math.sqrt(" in body else []
    if used:
        imports.append(f"from perilune.fmus_src.kernel.functions import {', '.join(sorted(used))}")
    imports.append("from perilune.fmus_src.kernel.matrices import Matrix, zeros")
    return "\n".join(
        [
            f'"""The gain {letter} as a formula, written by perilune.modal."""',
            "",
            *imports,
            "",
            "",
            f"def {name}(",
            *(f"    {each}: float," for each in arguments),
            ") -> Matrix:",
            f'    """{letter}, {matrix.rows} x {matrix.cols}."""',
            body,
            "    return gain",
            "",
        ]
    )


def _printer() -> Any:
    """Return a printer with floats, products instead of powers, and only the functions that kernels support."""
    printing = importlib.import_module("sympy.printing.str")
    methods = {"Integer": _integer, "Rational": _rational, "Pow": _power, "Function": _function}
    named = {f"_print_{name}": method for name, method in methods.items()}
    return type("KernelPrinter", (printing.StrPrinter,), named)()


def _integer(_: Any, number: Expression) -> str:
    return f"{int(number)}.0"


def _rational(_: Any, number: Expression) -> str:
    return f"({int(number.p)}.0/{int(number.q)}.0)"


def _power(printer: Any, power: Expression, rational: bool = False) -> str:
    """Return a power as a product or a root, in parentheses, so that it may be a divisor."""
    base, exponent = power.args
    if not (2 * exponent).is_Integer:
        raise InputError(
            "modal", "kernel", f"kernels do not support the power {power}", "replace this power by a symbol"
        )
    whole, half = divmod(int(2 * abs(exponent)), 2)
    printed = printer.doprint(base)
    factors = [f"({printed})" if base.args else printed] * whole + [f"math.sqrt({printed})"] * half
    product = f"({'*'.join(factors)})"
    return product if exponent > 0 else f"(1.0/{product})"


def _function(printer: Any, call: Expression) -> str:
    function = type(call).__name__
    if function not in _FUNCTIONS:
        raise InputError(
            "modal", "kernel", f"kernels do not support the function {function}", "replace this function by a symbol"
        )
    return f"{function}({printer.doprint(call.args[0])})"
