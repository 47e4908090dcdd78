"""Page of the kernel language, from the table of its rules and the functions of mathlib."""

from __future__ import annotations

import ast
import inspect
import pkgutil
from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from types import FunctionType

from perilune.fmus_src import mathlib
from perilune.fmus_src.export.judge.subset_table import (
    BUILTIN_FUNCTIONS,
    COMPARISONS,
    ELEMENTARY_FUNCTIONS,
    LANGUAGE_PAGE,
    MATH_CONSTANTS,
    MATH_FUNCTIONS,
    OPERATORS,
    REFUSED_FUNCTIONS,
    REFUSED_SYNTAX,
    RULES,
    MathFunction,
)
from perilune.fmus_src.kernel.integrators import count_steps, runge_kutta_4, runge_kutta_nystrom, simpson

from .markdown import escaped, table

STATEMENTS = (
    ("`x = ...`, `x += ...`, `self.x = ...`, `v[k] = ...`", "a local or declared variable, an element of a list"),
    ("`a, b = f(...)`", "several return values of a function"),
    ("`if`, `elif`, `else`; `a if c else b`", "a condition is a bool: compare numbers"),
    ("`for i in range(...)`, `while`, `break`, `continue`", "the step of a range is a constant"),
    ("`return`", "values of one type on every path"),
    ("`and`, `or`, `not`", "operators on bools"),
)
SYMBOLS = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.MatMult: "@", ast.Div: "/", ast.FloorDiv: "//", ast.Mod: "%",
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=",
}  # fmt: skip
INTEGRATORS = (runge_kutta_4, runge_kutta_nystrom, simpson, count_steps)
FREE = ("{", "}")  # around values in a message


def kernel_page() -> str:
    """Return the Markdown page, for reference."""
    operators = " ".join(f"`{SYMBOLS[kind]}`" for kind in (*OPERATORS, *COMPARISONS))
    constants = ", ".join(f"`math.{name}`" for name in MATH_CONSTANTS)
    parts = [
        f"# {LANGUAGE_PAGE}",
        "`initialize`, `step` and all functions that they call form a *kernel*: plain Python, which `perilune export` "
        "also translates to C with the same bits. An unsupported construct is reported with its line and an "
        "alternative. A block that needs more declares `python_only = True`, and then has only a Python FMU.",
        "## Statements",
        table(["statement", "use"], STATEMENTS),
        "## Numbers",
        f"`float`, `int` of 64 bits and `bool`, with {operators}, and the functions "
        f"{', '.join(f'`{name}`' for name in BUILTIN_FUNCTIONS)}. Two to four floats are a vector: `vector(x, y, z)`, "
        "`v.x`, `v[0]`, `v[0:2]`, with `+` `-` `*` `/`. More floats are a list of fixed size: `[0.0] * n`.",
        "A matrix of fixed size is created by `matrix([a, b], [c, d])`, `zeros(2, N + 2)` or `identity(3)`, with `+` "
        "`-` `@`, `*` and `/` by numbers, and `p.T`; `p[i, j]` is an element, `p[POSITION, VELOCITY]` a block, with "
        "`POSITION = block(0, 3)` at the top of the file.",
        'A record has named fields: `class Motion(Record)` with `speed = Field(unit="m/s")`; write '
        "`Motion(speed=v)`, `replace(s, speed=v)`, `s.speed`.",
        "## Integrators",
        "Integrators call a function passed to them: `runge_kutta_4(self.derivatives, t, self.state, h, force)`. "
        "Write `from perilune import runge_kutta_4`.",
        table(["function", "result"], _signatures(INTEGRATORS)),
        "## Elementary functions",
        f"Write `from perilune import {', '.join(list(ELEMENTARY_FUNCTIONS)[:3])}` at the top of the file. Unlike "
        "functions of `math` they give the same bits on every processor, in Python and in C; their errors are below "
        "one unit in the last place.",
        table(["function", "arguments", "ends the run with"], _rows(ELEMENTARY_FUNCTIONS, "")),
        "## math",
        f"Functions that are exact everywhere come from `math`: write `import math` at the top of the file. Constants: "
        f"{constants}.",
        table(["function", "arguments", "ends the run with"], _rows(MATH_FUNCTIONS, "math.")),
        "## mathlib",
        "Kernel functions used by the blocks of this repository; write "
        "`from perilune.fmus_src.mathlib.MODULE import NAME`. `cross`, `dot`, `norm` and `vector` also come "
        "from `perilune`.",
    ]
    for name, functions in _helpers():
        parts += [f"### {name}", table(["function", "result"], _signatures(functions))]
    refused = [(f"`{name}`", escaped(remedy)) for name, remedy in REFUSED_FUNCTIONS.items()]
    rules = [*REFUSED_SYNTAX.values(), *RULES.values()]
    said = {rule.what: rule.remedy for rule in rules if not any(mark in rule.what + rule.remedy for mark in FREE)}
    parts += [
        "## Instead of",
        table(["what is refused", "write"], [*refused, *((escaped(what), escaped(how)) for what, how in said.items())]),
    ]
    return "\n\n".join(parts) + "\n"


def _helpers() -> Iterator[tuple[str, list[FunctionType]]]:
    """Yield the public functions of each module of mathlib."""
    for module in pkgutil.walk_packages(mathlib.__path__, f"{mathlib.__name__}."):
        callables = import_module(module.name)
        functions = [
            value
            for name, value in vars(callables).items()
            if isinstance(value, FunctionType) and value.__module__ == callables.__name__ and not name.startswith("_")
        ]
        if functions:
            yield module.name.removeprefix(f"{mathlib.__name__}."), functions


def _rows(functions: Mapping[str, MathFunction], prefix: str) -> list[list[str]]:
    """Return table rows of functions: name, number of arguments, errors."""
    return [[f"`{prefix}{name}`", str(len(one.takes)), _raises(one.faults)] for name, one in functions.items()]


def _raises(faults: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in faults) or "nothing"


def _signatures(functions: Iterable[FunctionType]) -> list[list[str]]:
    return [[f"`{item.__name__}{_arguments(item)}`", escaped(_first(item))] for item in functions]


def _arguments(function: FunctionType) -> str:
    return f"({', '.join(inspect.signature(function).parameters)})"


def _first(function: FunctionType) -> str:
    """Return the first sentence of a docstring, which may span several lines."""
    return inspect.cleandoc(function.__doc__ or "").partition("\n\n")[0].replace("\n", " ")
