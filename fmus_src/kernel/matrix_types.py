"""Matrices of fixed size; operators return new matrices, and elements and blocks can be assigned.

    POSITION, VELOCITY = block(0, 3), block(3, 3)
    p = zeros(6, 6)
    p[POSITION, VELOCITY] = h * identity(3)
    p = f @ p @ f.T + q

Operators are `+` and `-` of equal sizes, `@` with a matrix or vector, `*` and `/` by a number, `-a` and `a.T`. Two
indices select a number; one index and one block or slice select a vector if it has two to four components, otherwise a
matrix of one row or column; two blocks select a matrix. `len(p)` is the number of rows. The sums of a product run from
left to right, starting from the first product.

A matrix cannot have two names: kernels reject `b = a`; `b = a.copy()` and `self.p = a` copy. A function receives the
matrix itself, like a list, and may change its elements. In C a matrix is a struct, and operators are loops.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from itertools import chain
from operator import add, sub
from typing import Any, NoReturn

from .vector_types import VECTORS, Vector, Vector3, vector


class Matrix:
    """Matrix of floats or ints."""

    __slots__ = ("rows",)
    __array_ufunc__ = None  # makes numpy leave its number times a matrix to `Matrix`
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, rows: list[list]) -> None:
        self.rows = rows

    @classmethod
    def of_elements(cls, elements: Sequence, columns: int) -> Matrix:
        """Return the matrix with these elements in row-major order."""
        return cls([list(elements[k : k + columns]) for k in range(0, len(elements), columns)])

    def elements(self) -> tuple:
        """Return all elements in row-major order."""
        return tuple(chain.from_iterable(self.rows))

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of rows and columns."""
        return len(self.rows), len(self.rows[0])

    @property
    def T(self) -> Matrix:  # noqa: N802
        """The transposed matrix."""
        return Matrix([list(column) for column in zip(*self.rows, strict=True)])

    def copy(self) -> Matrix:
        """Return a copy of the matrix."""
        return Matrix([row[:] for row in self.rows])

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, key: tuple[Any, Any]) -> Any:
        i, j = key
        if i.__class__ is not slice:
            part = self.rows[i][j]
            return part if j.__class__ is not slice else _of_three(*part) if len(part) == 3 else _narrow(part, True)
        rows = self.rows[i]
        if j.__class__ is slice:
            return Matrix([row[j] for row in rows])
        if len(rows) == 3:
            first, second, third = rows
            return _of_three(first[j], second[j], third[j])
        return _narrow([row[j] for row in rows], False)

    def __setitem__(self, key: tuple[Any, Any], right: Any) -> None:
        i, j = key
        if i.__class__ is not slice:
            if j.__class__ is not slice:
                self.rows[i][j] = right
                return
            (part,) = right.rows if right.__class__ is Matrix else (right.elements(),)
            row = self.rows[i]
            if len(part) != len(row[j]):
                _refuse_size(len(part), len(row[j]))
            row[j] = part
            return
        rows = self.rows[i]
        if j.__class__ is slice:
            others = right.rows
            if len(others) != len(rows) or len(others[0]) != len(rows[0][j]):
                _refuse_size(right.shape, (len(rows), len(rows[0][j])))
            for row, part in zip(rows, others, strict=True):
                row[j] = part
            return
        if right.__class__ is Vector3 and len(rows) == 3:
            first, second, third = rows
            first[j], second[j], third[j] = right.x, right.y, right.z
            return
        elements = [element for (element,) in right.rows] if right.__class__ is Matrix else right.elements()
        if len(elements) != len(rows):
            _refuse_size(len(elements), len(rows))
        for row, element in zip(rows, elements, strict=True):
            row[j] = element

    def __add__(self, other: Matrix) -> Matrix:
        if other.__class__ is not Matrix:
            return NotImplemented
        rows, others = self.rows, other.rows
        if len(rows) != len(others) or len(rows[0]) != len(others[0]):
            _refuse_size(other.shape, self.shape)
        return Matrix([[*map(add, a, b)] for a, b in zip(rows, others, strict=True)])

    def __sub__(self, other: Matrix) -> Matrix:
        if other.__class__ is not Matrix:
            return NotImplemented
        rows, others = self.rows, other.rows
        if len(rows) != len(others) or len(rows[0]) != len(others[0]):
            _refuse_size(other.shape, self.shape)
        return Matrix([[*map(sub, a, b)] for a, b in zip(rows, others, strict=True)])

    def __neg__(self) -> Matrix:
        return Matrix([[-x for x in row] for row in self.rows])

    def __mul__(self, factor: float) -> Matrix:
        if isinstance(factor, Matrix | Vector):
            raise TypeError("a product of matrices is a @ b")
        return Matrix([[x * factor for x in row] for row in self.rows])

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> Matrix:
        return Matrix([[x / divisor for x in row] for row in self.rows])

    def __matmul__(self, other: Matrix | Vector) -> Any:
        rows = self.rows
        if other.__class__ is Matrix:
            columns = list(zip(*other.rows, strict=True))  # type: ignore[union-attr]
            return Matrix(_sums(len(columns[0]))(rows, columns))
        if other.__class__ is Vector3 and len(rows) == 3:
            x, y, z = other.x, other.y, other.z  # type: ignore[union-attr]
            first, second, third = [a * x + b * y + c * z for a, b, c in rows]
            return _of_three(first, second, third)
        if not isinstance(other, Vector):
            return NotImplemented
        elements = other.elements()
        return _narrow(_sums_of_one(len(elements))(rows, elements), False)

    def __eq__(self, other: object) -> bool:
        return self.rows == other.rows if isinstance(other, Matrix) else NotImplemented

    def __repr__(self) -> str:
        return f"matrix({', '.join(map(repr, self.rows))})"

    def __reduce__(self) -> tuple:
        return Matrix, (self.rows,)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        import numpy as np  # not needed by kernels

        return np.array(self.rows, dtype)


def matrix(*rows: list) -> Matrix:
    """Return the matrix with these rows: ``matrix([1.0, h], [0.0, 1.0])``."""
    return Matrix([[float(element) for element in row] for row in rows])


def zeros(rows: int, columns: int) -> Matrix:
    """Return a matrix of zeros."""
    return Matrix([[0.0] * columns for _ in range(rows)])


def identity(n: int) -> Matrix:
    """Return the identity matrix."""
    return Matrix([[1.0 if i == j else 0.0 for j in range(n)] for i in range(n)])


def add_product(q: Matrix, a: Matrix, b: Matrix) -> Matrix:
    """Return q + a @ b, where each sum starts from the element of q."""
    columns = list(zip(*b.rows, strict=True))
    return Matrix(_sums_from(len(columns[0]))(q.rows, a.rows, columns))


def block(first: int, size: int) -> slice:
    """Return an index of consecutive rows or columns, for use as a module constant: ``POSITION = block(0, 3)``.

    Two blocks select a submatrix: ``p[POSITION, VELOCITY]``.
    """
    return slice(first, first + size)


def _refuse_size(actual: Any, required: Any) -> NoReturn:
    raise ValueError(f"elements for a matrix or block of size {required}: their size is {actual}")


def _of_three(x: float, y: float, z: float) -> Vector3:
    """Return a vector of three components, faster than `vector`, which chooses the size from its arguments."""
    created = Vector3()
    created.x = x
    created.y = y
    created.z = z
    return created


def _narrow(elements: list, across: bool) -> Any:
    """Return a slice of a row or column as a vector, or as a matrix if no vector has its size."""
    if len(elements) in VECTORS:
        return vector(*elements)
    return Matrix([elements] if across else [[element] for element in elements])


@cache
def _sums(inner: int) -> Callable[[list[list], list[tuple]], list[list]]:
    """Return an unrolled function for the products of rows with columns of ``inner`` elements."""
    a, b = (", ".join(f"{name}{k}" for k in range(inner)) for name in "ab")
    return eval(f"lambda rows, columns: [[{_terms(inner)} for {b}, in columns] for {a}, in rows]")


@cache
def _sums_of_one(inner: int) -> Callable[[list[list], tuple], list]:
    """Return an unrolled function for the products of rows with one column."""
    a, b = (", ".join(f"{name}{k}" for k in range(inner)) for name in "ab")
    namespace: dict[str, Any] = {}
    exec(f"def multiply(rows, column):\n {b}, = column\n return [{_terms(inner)} for {a}, in rows]", namespace)
    return namespace["multiply"]


@cache
def _sums_from(inner: int) -> Callable[[list[list], list[list], list[tuple]], list[list]]:
    """Return an unrolled function for the products of rows with columns, each added to an element of another matrix."""
    a, b = (", ".join(f"{name}{k}" for k in range(inner)) for name in "ab")
    inside = f"[q + {_terms(inner)} for q, ({b},) in zip(starts, columns)]"
    return eval(f"lambda q, rows, columns: [{inside} for starts, ({a},) in zip(q, rows)]")


def _terms(inner: int) -> str:
    return " + ".join(f"a{k} * b{k}" for k in range(inner))
