"""Arithmetic expressions over named values, compiled once and safe to take from a file.

The text is parsed as Python, every node is checked against a list of permitted nodes, and the tree is translated to a
function of the names that it uses. Attributes of objects and builtins are inaccessible. The functions are those of
kernels, with the same bits on every processor. All numbers are doubles with IEEE arithmetic (1/0 is inf, sqrt(-1) is
nan), elementwise on arrays. Logical results are 1 and 0; any operand other than 0 counts as true.
"""

from __future__ import annotations

import ast
import functools
import math
import textwrap
import warnings
from collections.abc import Callable, Mapping
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike

from ....common.bounds import EXPRESSION_CHARACTERS
from ....common.errors import InputError, suggestion
from ...runtime.loop.elementary import elementary

Where = tuple[str, str]  # file and element, as in InputError

CONSTANTS = {"pi": math.pi, "e": math.e}


def _over(function: Callable) -> Callable:
    """Return a function of two values extended to two or more."""
    return lambda *values: functools.reduce(function, values)


# name: (function, fewest arguments, most arguments or None for any number)
FUNCTIONS: dict[str, tuple[Callable, int, int | None]] = {
    **{name: (elementary(name), 1, 1) for name in ("sin", "cos", "tan", "asin", "acos", "atan")},
    "atan2": (elementary("atan2"), 2, 2),
    "sqrt": (np.sqrt, 1, 1),
    **{name: (elementary(name), 1, 1) for name in ("exp", "log", "log10")},
    "abs": (np.abs, 1, 1),
    "min": (_over(np.minimum), 2, None),
    "max": (_over(np.maximum), 2, None),
    "floor": (np.floor, 1, 1),
    "ceil": (np.ceil, 1, 1),
    "radians": (np.radians, 1, 1),
    "degrees": (np.degrees, 1, 1),
    "hypot": (elementary("hypot"), 2, 2),
    "sign": (np.sign, 1, 1),
    "where": (np.where, 3, 3),
    "norm": (_over(elementary("hypot")), 2, None),
}
RESERVED = frozenset(CONSTANTS) | frozenset(FUNCTIONS)

ARITHMETIC = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.FloorDiv, ast.Mod)
COMPARISONS: dict[type[ast.cmpop], Callable] = {
    ast.Lt: np.less,
    ast.LtE: np.less_equal,
    ast.Gt: np.greater,
    ast.GtE: np.greater_equal,
    ast.Eq: np.equal,
    ast.NotEq: np.not_equal,
}


def _truth(value: np.ndarray) -> np.ndarray:
    """Return Booleans as doubles, since numpy adds two Booleans to True and cannot subtract them."""
    return np.multiply(value, 1.0)


def _chain(operators: list[Callable]) -> Callable:
    """Return the function of the operands that evaluates a chain of comparisons, a < b <= c ..."""

    if len(operators) == 1:
        return lambda one, other: _truth(operators[0](one, other))

    def compare(*operands: np.ndarray) -> np.ndarray:
        links = zip(operators, operands, operands[1:], strict=False)
        return _truth(functools.reduce(np.logical_and, [operator(a, b) for operator, a, b in links]))

    return compare


OPERATIONS: dict[str, Callable] = {
    "Power": elementary("pow"),
    "And": lambda *values: _truth(functools.reduce(np.logical_and, values)),
    "Or": lambda *values: _truth(functools.reduce(np.logical_or, values)),
    "Not": lambda value: _truth(np.logical_not(value)),
}
ALLOWED = "numbers, names, + - * / // % **, comparisons, and, or, not, and functions such as sqrt(x)"


def path_name(node: ast.expr) -> str | None:
    """Return the variable named by a node (``x``, ``a.b``, ``a.b[1]``, ``a[1,2].c``, ``a["2.5"].b``), or None."""
    match node:
        case ast.Name(id=name):
            return name
        case ast.Attribute(value=owner, attr=name):
            prefix = path_name(owner)
            return None if prefix is None else f"{prefix}.{name}"
        case ast.Subscript(value=ast.Name() | ast.Attribute() as owner, slice=index):
            prefix = path_name(owner)
            if prefix is not None and isinstance(index, ast.Constant) and isinstance(index.value, str):
                return f'{prefix}["{index.value}"]'
            entries = index.elts if isinstance(index, ast.Tuple) else [index]
            numbers = [entry.value for entry in entries if isinstance(entry, ast.Constant)]
            if prefix is None or not entries or [type(n) for n in numbers] != [int] * len(entries):
                return None
            return f"{prefix}[{','.join(map(str, numbers))}]"
    return None


def is_name(text: str) -> bool:
    """Return True if ``text`` is the name of a variable as in expressions, without spaces and quotes."""
    try:
        node = _parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    return path_name(node) == text and '"' not in text


def _parse(text: str) -> ast.expr:
    """Parse an expression. Raises SyntaxError, also if Python would only issue a warning, as for ``1if x``."""
    with warnings.catch_warnings():
        for category in (SyntaxWarning, DeprecationWarning):  # DeprecationWarning before Python 3.12
            warnings.simplefilter("error", category)
        return ast.parse(text, mode="eval").body


class _Translator:
    """Replaces the leaves of a checked syntax tree by arguments: v0, v1, ... for variables, others for numbers."""

    def __init__(self, text: str, where: Where) -> None:
        self.text = text
        self.where = where
        self.slots: dict[str, str] = {}
        self.namespace: dict[str, object] = {"__builtins__": {}, **OPERATIONS}

    def refuse(self, problem: str, remedy: str = f"use {ALLOWED}") -> NoReturn:
        raise InputError(*self.where, f"{problem} in {textwrap.shorten(self.text, 100)!r}", remedy)

    def number(self, value: float) -> ast.expr:
        """Return a number as a numpy double, so that Python does not use integer or complex arithmetic."""
        slot = f"n{len(self.namespace)}"
        self.namespace[slot] = np.float64(value)
        return ast.Name(slot, ast.Load())

    def call(self, function: str, *arguments: ast.expr) -> ast.expr:
        return ast.Call(ast.Name(function, ast.Load()), list(arguments), [])

    def variable(self, node: ast.expr) -> ast.expr:
        name = path_name(node)
        if name is None:
            self.refuse(f"{ast.unparse(node)!r} is not a name", "write names like plant.position[1], counting from 1")
        if name in CONSTANTS:
            return self.number(CONSTANTS[name])
        if name in FUNCTIONS:
            self.refuse(f"the function {name!r} lacks its arguments", f"write {name}(...)")
        return ast.Name(self.slots.setdefault(name, f"v{len(self.slots)}"), ast.Load())

    def function(self, node: ast.Call) -> ast.expr:
        name = path_name(node.func)
        if name not in FUNCTIONS:
            self.refuse(f"{ast.unparse(node.func)!r} is not a function", suggestion(str(name), FUNCTIONS))
        function, fewest, maximum = FUNCTIONS[name]
        if node.keywords or any(isinstance(argument, ast.Starred) for argument in node.args):
            self.refuse(f"{ast.unparse(node)!r} has a keyword or starred argument", f"write {name}(a, ...)")
        if len(node.args) < fewest or (maximum is not None and len(node.args) > maximum):
            permitted = f"{fewest}" if maximum == fewest else f"{fewest} or more"
            self.refuse(f"{name} is given {len(node.args)} argument(s)", f"give it {permitted} instead")
        self.namespace[f"f_{name}"] = function
        return self.call(f"f_{name}", *[self.translate(argument) for argument in node.args])

    def comparison(self, node: ast.Compare) -> ast.expr:
        for operator in node.ops:
            if type(operator) not in COMPARISONS:
                self.refuse(f"{ast.unparse(node)!r} is not a comparison of numbers", "use < <= > >= == !=")
        slot = f"c{len(self.namespace)}"
        self.namespace[slot] = _chain([COMPARISONS[type(operator)] for operator in node.ops])
        return self.call(slot, *[self.translate(operand) for operand in (node.left, *node.comparators)])

    def translate(self, node: ast.expr) -> ast.expr:
        match node:
            case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
                if not abs(value) < 1e308:
                    self.refuse(f"the number {ast.unparse(node)} is out of range", "use doubles below 1e308")
                return self.number(value)
            case ast.Name() | ast.Attribute() | ast.Subscript():
                return self.variable(node)
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return self.call("Power", self.translate(left), self.translate(right))
            case ast.BinOp(left=left, op=operator, right=right) if isinstance(operator, ARITHMETIC):
                return ast.BinOp(self.translate(left), operator, self.translate(right))
            case ast.UnaryOp(op=ast.UAdd() | ast.USub() as sign, operand=operand):
                return ast.UnaryOp(sign, self.translate(operand))
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return self.call("Not", self.translate(operand))
            case ast.BoolOp(op=operator, values=values):
                return self.call(type(operator).__name__, *map(self.translate, values))
            case ast.Compare():
                return self.comparison(node)
            case ast.Call():
                return self.function(node)
            case ast.IfExp():
                self.refuse("'... if ... else ...' is not allowed", "write where(condition, a, b)")
            case ast.BinOp(op=ast.BitAnd() | ast.BitOr()):
                self.refuse("'&' and '|' are not allowed", "write 'and', 'or'")
        self.refuse(f"{ast.unparse(node)!r} is not allowed")


class Expression:
    """Arithmetic expression over named values.

    ``text`` may span lines; ``where`` (file, element) is named in errors. ``names`` are the variables that it needs:
    identifiers or dotted paths, with an index if there is one, as in ``plant.position[1]``, or with a quoted text, as
    in ``default.groups["2.5"].trials``. Raises InputError for invalid text.
    """

    def __init__(self, text: str, where: Where = ("expression", "")) -> None:
        self.text = " ".join(text.split())
        self.where = where
        EXPRESSION_CHARACTERS.check(len(self.text), *where)
        translator = _Translator(self.text, where)
        if "#" in self.text:
            translator.refuse("contains a comment", "remove it, or put it outside the text")
        if "\0" in self.text:  # versions of Python report it differently
            translator.refuse("contains a null character", "write plain characters")
        try:
            body = translator.translate(_parse(self.text))
            arguments = [ast.arg(slot) for slot in translator.slots.values()]
            function = ast.Lambda(ast.arguments([], arguments, None, [], [], None, []), body)
            code = compile(ast.fix_missing_locations(ast.Expression(function)), "<expression>", "eval")
        except SyntaxError as error:
            translator.refuse(f"{error.msg} at character {error.offset or 1}")
        except (ValueError, RecursionError, MemoryError) as error:
            if isinstance(error, InputError):
                raise
            translator.refuse(f"{type(error).__name__}", "write a shorter expression of plain characters")
        self._function: Callable = eval(code, translator.namespace)
        self._order = list(translator.slots)
        self.names = frozenset(self._order)

    @property
    def is_truth(self) -> bool:
        """True if the value is 0 or 1 by construction: a comparison, or a logical expression."""
        body = ast.parse(self.text, mode="eval").body
        return isinstance(body, ast.Compare | ast.BoolOp) or (
            isinstance(body, ast.UnaryOp) and isinstance(body.op, ast.Not)
        )

    def evaluate(self, values: Mapping[str, ArrayLike]) -> float | np.ndarray:
        """Return the value: a float, or an array of doubles if one of the values is an array.

        ``values`` maps at least ``names`` to floats, integers, booleans or arrays of the same shape. Raises InputError
        for a missing name. Division by zero and the like yield inf or nan.
        """
        arguments = []
        for name in self._order:
            if name not in values:
                raise InputError(*self.where, f"{name!r} in {self.text!r} is unknown", suggestion(name, values))
            # contiguous, since numpy may use other code, with other last bits, for strided arrays
            arguments.append(np.asarray(values[name], dtype=np.float64, order="C"))
        with np.errstate(all="ignore"):
            result = np.asarray(self._function(*arguments))
        return result if result.ndim else float(result)

    def __reduce__(self) -> tuple:
        return Expression, (self.text, self.where)  # the text is picklable, code is not

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Expression) and other.text == self.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"Expression({self.text!r})"
