"""Types of matrix expressions: operators, elements, blocks, construction."""

from __future__ import annotations

import ast
from typing import Any

from ...kernel import matrix_types
from ...kernel.vector_types import VECTORS
from .kernel import FLOAT, INT, MakeMatrix, MatrixType, Several, Type, VectorType
from .source import find_global
from .vectors import RecordTypes, is_variable

MAKERS = {
    maker: maker.__name__
    for maker in (matrix_types.matrix, matrix_types.zeros, matrix_types.identity, matrix_types.add_product)
}


class MatrixTypes(RecordTypes):
    """Type inference of matrix expressions."""

    bound: set[str]

    def operate_on_matrices(
        self, node: ast.AST, operator: ast.operator, left: Type | Several, right: Type | Several
    ) -> Type | None:
        """Infer the type of ``left operator right`` if one is a matrix of floats or the operator is ``@``."""
        if isinstance(left, MatrixType) and left.element is FLOAT:
            if isinstance(right, MatrixType) and right.element is FLOAT:
                return self._operate_on_two(node, operator, left, right)
            if isinstance(right, VectorType) and isinstance(operator, ast.MatMult):
                return self._operate_on_two(node, operator, left, MatrixType(right.size, 1))
            if right in (FLOAT, INT) and isinstance(operator, ast.Mult | ast.Div):
                return left
        elif left in (FLOAT, INT) and isinstance(right, MatrixType) and isinstance(operator, ast.Mult):
            return right if right.element is FLOAT else None
        self.report(node, "matrix operator", name=type(operator).__name__, left=left, right=right)
        return None

    def _operate_on_two(
        self, node: ast.AST, operator: ast.operator, left: MatrixType, right: MatrixType
    ) -> Type | None:
        product = isinstance(operator, ast.MatMult)
        if not product and not isinstance(operator, ast.Add | ast.Sub):
            self.report(node, "matrix operator", name=type(operator).__name__, left=left, right=right)
        elif (left.columns != right.rows) if product else (left != right):
            self.report(node, "matrix sizes", left=left, right=right)
        elif not product:
            return left
        elif isinstance(node, ast.BinOp) and isinstance(self.function.types[node.right], VectorType):
            return narrow(left.rows, False)
        else:
            return MatrixType(left.rows, right.columns)
        return None

    def transpose(self, node: ast.Attribute, kind: MatrixType) -> Type | None:
        """Infer the type of ``p.T``."""
        if node.attr != "T":
            self.report(node, "component", name=node.attr, kind=kind, names="T, copy() and p[i, j]")
            return None
        return MatrixType(kind.columns, kind.rows, kind.element)

    def part_of_matrix(self, node: ast.Subscript, kind: MatrixType) -> Type | None:
        """Infer the type of ``p[i, j]``, ``p[POSITION, j]``, ``p[POSITION, :]``."""
        indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else []
        if len(indices) != 2:
            self.report(node, "matrix index", name=ast.unparse(node.value))
            return None
        first, second = (self._index(*each) for each in zip(indices, (kind.rows, kind.columns), strict=True))
        if first == "wrong" or second == "wrong":
            return None
        self.function.blocks[node] = (first, second)  # type: ignore[assignment]
        if first is None and second is None:
            return kind.element
        if kind.element is not FLOAT:
            self.report(node, "matrix block", part=ast.unparse(node.slice))
            return None
        if first is None or second is None:
            return narrow(len(first if second is None else second), second is not None)  # type: ignore[arg-type]
        return MatrixType(len(first), len(second))

    def _index(self, node: ast.expr, size: int) -> range | str | None:
        """Return the rows or columns of a block; None for a single index."""
        if isinstance(node, ast.Slice):
            first = 0 if node.lower is None else self.static_size(node.lower)
            end = size if node.upper is None else self.static_size(node.upper)
            step = node.step
        else:
            constant = self._find_block(node)
            if constant is None:
                if self.infer(node) not in (INT, None):
                    self.report(node, "matrix block", part=ast.unparse(node))
                    return "wrong"
                return None
            first, end, step = constant.start, constant.stop, constant.step
        if first is None or end is None or step is not None or not 0 <= first < end <= size:
            self.report(node, "matrix block", part=ast.unparse(node))
            return "wrong"
        return range(first, end)

    def _find_block(self, node: ast.expr) -> slice | None:
        """Return the module constant that a name refers to if it is a block."""
        function = self.function
        if not isinstance(node, ast.Name) or node.id in {*function.parameters, *self.bound}:
            return None
        value = find_global(function.source.function, node.id)
        return value if isinstance(value, slice) else None

    def make_matrix(self, node: ast.Call, callee: Any) -> Type | None:
        """Infer the type of a call that creates a matrix; None for other and for invalid calls."""
        name = MAKERS.get(callee) if callee is not None else None
        if name is None:
            return self._copy(node)
        if name == "matrix":
            kind, rule = self._literal(node), "matrix rows"
        elif name == "add_product":
            kind, rule = self._sum(node), "matrix sum"
        else:
            rule = "matrix size"
            sizes = [self.static_size(argument) for argument in node.args]
            count = 2 if name == "zeros" else 1
            good = len(sizes) == count and not node.keywords and all(size is not None and size > 0 for size in sizes)
            kind = MatrixType(sizes[0], sizes[-1]) if good else None  # type: ignore[arg-type]
        if kind is None:
            self.report(node, rule, name=name)
            return None
        self.function.calls[node] = MakeMatrix(name)
        return kind

    def _literal(self, node: ast.Call) -> MatrixType | None:
        """Infer the type of ``matrix([a, b], [c, d])``."""
        if not node.args or node.keywords or not all(isinstance(row, ast.List) for row in node.args):
            return None
        rows: list[list[ast.expr]] = [row.elts for row in node.args]  # type: ignore[attr-defined]
        kinds = [self.infer(element) for row in rows for element in row]
        if not rows[0] or len({len(row) for row in rows}) != 1 or not set(kinds) <= {FLOAT, None}:
            return None
        return MatrixType(len(rows), len(rows[0]))

    def _sum(self, node: ast.Call) -> MatrixType | None:
        """Infer the type of ``add_product(q, a, b)``."""
        kinds = [self.infer(argument) for argument in node.args]
        if len(kinds) != 3 or node.keywords or not all(isinstance(kind, MatrixType) for kind in kinds):
            return None
        q, a, b = kinds
        fits = (q.rows, q.columns, a.columns) == (a.rows, b.columns, b.rows)  # type: ignore[union-attr]
        return q if fits else None  # type: ignore[return-value]

    def _copy(self, node: ast.Call) -> Type | None:
        """Infer the type of ``p.copy()``."""
        function = node.func
        if not isinstance(function, ast.Attribute) or function.attr != "copy" or node.args or node.keywords:
            return None
        holder = function.value
        known = isinstance(holder, ast.Name) and holder.id in {*self.function.parameters, *self.function.locals}
        if not known and not (is_variable(holder) and not isinstance(holder, ast.Name)):
            return None
        kind = self.infer(holder)
        if isinstance(kind, MatrixType):
            self.function.calls[node] = MakeMatrix("copy")
            return kind
        return None


def narrow(size: int, across: bool) -> MatrixType | VectorType:
    """Return the type of a slice of a row or column."""
    if size in VECTORS:
        return VectorType(size)
    return MatrixType(1, size) if across else MatrixType(size, 1)
