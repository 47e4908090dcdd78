"""Choice of the form of a matrix expression in C: unrolled, in loops, or computed first in a new matrix."""

from __future__ import annotations

import ast

from ..judge.kernel import Function, KernelCall, MakeMatrix, MatrixType
from ..judge.vectors import is_variable

FEW = 16  # elements of an unrolled matrix,
FEW_TERMS = 64  # if their sums have at most this number of terms together
SHORT = 4  # terms of a sum that is one expression


class MatrixPlan:
    """Forms of the matrix expressions of one function."""

    def __init__(self, function: Function) -> None:
        self.function = function

    def inner(self, node: ast.expr) -> int:
        """Return the number of products in each sum of a matrix product."""
        left = self.function.types[terms_of(node)[-2]]
        assert isinstance(left, MatrixType)
        return left.columns

    def _is_product(self, node: ast.AST) -> bool:
        """Return True if an expression is a product, or a product added to a matrix."""
        call = self.function.calls.get(node) if isinstance(node, ast.Call) else None
        return is_matmul(node) or (isinstance(call, MakeMatrix) and call.name == "add_product")

    def is_long(self, node: ast.expr) -> bool:
        """Return True if the sums of a product need a loop."""
        return self._is_product(node) and self.inner(node) > SHORT

    def is_cheap(self, node: ast.expr) -> bool:
        """Return True if the elements of an expression can be read without computation."""
        if isinstance(node, ast.Attribute | ast.Subscript) and not is_variable(node):
            return self.is_cheap(node.value)
        return is_variable(node) or isinstance(self.function.calls.get(node), KernelCall)  # type: ignore[call-overload]

    def is_small(self, node: ast.expr) -> bool:
        """Return True if a matrix is unrolled."""
        kind = self.function.types[node]
        assert isinstance(kind, MatrixType)
        if isinstance(node, ast.Call) and any(isinstance(row, ast.List) for row in node.args):
            return True
        if self.is_long(node):
            return False
        terms = [self.inner(part) for part in ast.walk(node) if isinstance(part, ast.expr) and self._is_product(part)]
        size = kind.rows * kind.columns
        return size <= FEW and size * max([1, *(count for count in terms if count <= SHORT)]) <= FEW_TERMS

    def is_disturbed(self, node: ast.expr, target: str, variable: str) -> bool:
        """Return True if an element of a value depends on elements of the assigned variable other than itself.

        An argument may be the matrix of the block that is assigned.
        """
        if ast.unparse(node) == target or (self._is_argument(node) and target == variable):
            return False
        if isinstance(node, ast.BinOp) and not is_matmul(node):
            matrices = [each for each in (node.left, node.right) if isinstance(self.function.types[each], MatrixType)]
            return any(self.is_disturbed(each, target, variable) for each in matrices)
        if isinstance(node, ast.UnaryOp):
            return self.is_disturbed(node.operand, target, variable)
        names = [each for each in ast.walk(node) if isinstance(each, ast.Name | ast.Attribute)]
        aliases = variable.startswith("self.") and any(map(self._is_argument, names))
        return aliases or variable in map(ast.unparse, names)

    def _is_argument(self, node: ast.expr) -> bool:
        """Return True if an expression is a matrix argument of the function."""
        name = node.id if isinstance(node, ast.Name) else ""
        return isinstance(self.function.parameters.get(name), MatrixType)


def is_matmul(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult)


def terms_of(node: ast.expr) -> list[ast.expr]:
    """Return the factors of a product, preceded by the matrix to which it is added, if any."""
    if isinstance(node, ast.Call):
        return node.args
    assert isinstance(node, ast.BinOp)
    return [node.left, node.right]
