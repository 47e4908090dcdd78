"""Import of sympy, and matrices with exact elements and their simplification."""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np

from ....common.errors import InputError

Expression = Any  # sympy expression, untyped
Symbols = Any  # a sympy matrix


@cache
def sympy() -> ModuleType:
    """Return the module sympy, from the optional extra `symbolic`. Raises InputError if it is not installed."""
    try:
        return importlib.import_module("sympy")
    except ImportError as error:
        remedy = "pip install 'perilune[symbolic]'"
        raise InputError("modal", "sympy", "symbolic formulas need sympy, which is not installed", remedy) from error


def exact(value: object) -> Expression:
    """Return a number or expression with exact numbers: 0.1 becomes 1/10."""
    sp = sympy()
    expression = sp.sympify(value.item() if isinstance(value, np.generic) else value)
    return expression.xreplace({number: sp.Rational(str(number)) for number in expression.atoms(sp.Float)})


def matrix_of(name: str, value: Any, shape: tuple[int | None, int | None] = (None, None)) -> Symbols:
    """Return a matrix with exact elements and the required ``shape``. Raises InputError."""
    sp = sympy()
    try:
        rows = value.tolist() if hasattr(value, "tolist") else value
        matrix = sp.Matrix([[exact(element) for element in row] for row in rows])
    except (TypeError, ValueError, sp.SympifyError):
        raise InputError("modal", name, "not a matrix of numbers and symbols", "give a list of rows") from None
    for size, required, unit in zip(matrix.shape, shape, ("rows", "columns"), strict=True):
        if required is not None and size != required:
            raise InputError("modal", name, f"has {size} {unit}", f"give {required}")
    return matrix


def factor_elements(matrix: Symbols) -> Symbols:
    """Return the matrix with each element factored, in a form in which zeros are detected."""
    return matrix.applyfunc(_tidy)


def _tidy(expression: Expression) -> Expression:
    """Return an expression as a quotient of factored products, with sin^2 = 1 - cos^2, so that zeros are detected."""
    sp = sympy()
    angles = sorted({each.args[0] for each in expression.atoms(sp.sin, sp.cos)}, key=str)
    if not angles:
        return sp.factor(sp.cancel(expression))
    named = {function(angle): sp.Dummy() for angle in angles for function in (sp.sin, sp.cos)}
    terms = sp.fraction(sp.cancel(expression.xreplace(named)))
    for angle in angles:
        sine, cosine = named[sp.sin(angle)], named[sp.cos(angle)]
        terms = [sp.rem(term, sine**2 + cosine**2 - 1, sine) for term in terms]
    numerator, denominator = terms
    back = {dummy: function for function, dummy in named.items()}
    return sp.factor(sp.cancel(numerator / denominator)).xreplace(back)


def is_zero(expression: Expression) -> bool:
    """Return True if an expression is 0 for all values of its symbols."""
    return bool(_tidy(expression) == 0)


def inverse_of(matrix: Symbols) -> Symbols | None:
    """Return the inverse for general values of the symbols, None for a singular matrix."""
    determinant = _tidy(matrix.det(method="berkowitz"))
    return None if determinant == 0 else factor_elements(matrix.adjugate() / determinant)


def left_inverse(matrix: Symbols) -> Symbols:
    """Return the pseudo-inverse of a matrix with full column rank, (M' M)^-1 M'."""
    return factor_elements(inverse_of(factor_elements(matrix.T * matrix)) * matrix.T)


def powers(matrix: Symbols, start: Symbols, count: int) -> Iterable[Symbols]:
    """Yield ``start``, start M, .., start M^count."""
    row = start
    yield row
    for _ in range(count):
        row = factor_elements(row * matrix)
        yield row
