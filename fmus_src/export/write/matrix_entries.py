"""C text of the elements of a matrix expression, after the statements that they need.

Products, results of calls, and operands with elements that are needed several times are first computed in a new matrix.
"""

from __future__ import annotations

import ast
from collections.abc import Callable

from ..judge.effects import own_outcome
from ..judge.kernel import KernelCall, MakeMatrix, MatrixType, VectorType
from ..judge.ranges import indices_of
from ..judge.vectors import is_variable
from .expressions import ExpressionWriter
from .matrix_plan import MatrixPlan, is_matmul, terms_of
from .operators import ATOM, CONDITIONAL, PRODUCT, SUM, UNARY, parenthesise
from .writer import FunctionWriter

Index = int | str
Entry = Callable[[Index, Index], tuple[str, int]]  # of row and column: text and precedence


class MatrixEntries:
    """Writer of the elements of one function's matrices."""

    def __init__(self, out: FunctionWriter, expressions: ExpressionWriter) -> None:
        self.out = out
        self.expressions = expressions
        self.function = out.function
        self.plan = MatrixPlan(out.function)

    def materialise(self, node: ast.expr) -> str:
        """Return the name of a new matrix that contains an expression."""
        raise NotImplementedError

    def prepare(self, node: ast.expr) -> Entry:
        """Return the elements of a matrix, or of a vector as a column, after adding the statements that they need."""
        kind = self.function.types[node]
        if isinstance(kind, VectorType) and not is_matmul(node):
            text = self.expressions.write(node)
            text = text if text.isidentifier() else self.out.keep(node, text, "part")
            return lambda i, j: (f"{text}.x[{i}]", ATOM)
        if is_variable(node):
            assert isinstance(kind, MatrixType)
            return entry_of(self.holder(node), kind.columns)
        if isinstance(node, ast.Attribute):
            inner = self.prepare(node.value)
            return lambda i, j: inner(j, i)
        if isinstance(node, ast.UnaryOp):
            operand = self.prepare(node.operand)
            return lambda i, j: (f"-{parenthesise(operand(i, j), ATOM)}", UNARY)
        if isinstance(node, ast.Subscript):
            return self.block(node)
        if isinstance(node, ast.Call):
            return self._call(node)
        assert isinstance(node, ast.BinOp)
        return self._product(node) if is_matmul(node) else self._elementwise(node)

    def holder(self, node: ast.expr) -> str:
        """Return the C text of the array that contains an element: ``p->x``, ``self->covariance.x``."""
        text = self.expressions.write(node, ATOM)
        return f"{text[2:-1]}->x" if text.startswith("(*") else f"{text}.x"

    def place(self, node: ast.Subscript) -> str:
        """Return the index of ``p[i, j]`` in row order."""
        kind = self.function.types[node.value]
        assert isinstance(kind, MatrixType)
        row, column = (self._index(node, *each) for each in indices_of(self.function, node))
        return str(row_order_index(row, column, kind.columns))

    def _index(self, node: ast.Subscript, index: ast.expr, size: int) -> Index:
        """Return the C text of an index, checked if it was not proven valid."""
        text = self.expressions.write(index, SUM)
        if index in self.function.unproven_indices:
            return self.expressions.write_checked(node, "py_index", text, str(size))[0]
        return int(text) if text.isdigit() else text

    def block(self, node: ast.Subscript) -> Entry:
        """Return the elements of a block, row or column."""
        inner = self.prepare(node.value)
        indices = iter(indices_of(self.function, node))
        starts: list[Index] = []
        for block in self.function.blocks[node]:
            start: Index = block.start if block else self._index(node, *next(indices))
            if isinstance(start, str) and not start.isidentifier():
                name = self.out.fresh("index")
                self.out.add(f"const int64_t {name} = {start};")
                if start.startswith("py_index"):
                    self.out.check()
                start = name
            starts.append(start)
        return lambda i, j: inner(plus(starts[0], i), plus(starts[1], j))

    def _call(self, node: ast.Call) -> Entry:
        kind, call = self.function.types[node], self.function.calls[node]
        assert isinstance(kind, MatrixType)
        write = self.expressions.write
        if isinstance(call, KernelCall):
            text = write(node)
            name = text if text.isidentifier() else self.out.keep(node, text, "part")
            return entry_of(f"{name}.x", kind.columns)
        assert isinstance(call, MakeMatrix)
        if call.name == "add_product":
            return self._product(node)
        if call.name == "copy":
            assert isinstance(node.func, ast.Attribute)
            return self.prepare(node.func.value)
        if call.name == "matrix":
            return entry_of(f"{self.materialise(node)}.x", kind.columns)
        if call.name == "zeros":
            return lambda i, j: ("0.0", ATOM)
        return lambda i, j: (
            ("1.0" if i == j else "0.0", ATOM)
            if isinstance(i, int) and isinstance(j, int)
            else (f"{i} == {j} ? 1.0 : 0.0", CONDITIONAL)
        )

    def _elementwise(self, node: ast.BinOp) -> Entry:
        """Return the elements of ``+`` and ``-`` of matrices, or of ``*`` and ``/`` with a number."""
        if isinstance(node.op, ast.Add | ast.Sub):
            left, right = self.prepare(node.left), self.prepare(node.right)
            sign = "+" if isinstance(node.op, ast.Add) else "-"
            return lambda i, j: (f"{parenthesise(left(i, j), SUM)} {sign} {parenthesise(right(i, j), SUM + 1)}", SUM)
        if isinstance(node.op, ast.Div):
            left, divisor = self.prepare(node.left), self._scalar(node.right, node)
            return lambda i, j: (f"{parenthesise(left(i, j), PRODUCT)} / {divisor}", PRODUCT)
        number, holder = node.left, node.right
        if isinstance(self.function.types[number], MatrixType):
            holder, number = number, holder
            entry, factor = self.prepare(holder), self._scalar(number)
        else:
            factor, entry = self._scalar(number), self.prepare(holder)
        return lambda i, j: (f"{factor} * {parenthesise(entry(i, j), PRODUCT + 1)}", PRODUCT)

    def _scalar(self, node: ast.expr, division: ast.BinOp | None = None) -> str:
        """Return the C text of a number by which all elements are multiplied or divided."""
        text = self.expressions.write_as_float(node, ATOM)
        if division is not None and own_outcome(self.function, division):
            text = self.expressions.write_checked(division, "py_divisor", text)[0]
        elif text.isidentifier() or isinstance(node, ast.Constant):
            return text
        name = self.out.fresh("divisor" if division else "factor")
        self.out.add(f"const double {name} = {text};")
        if text.startswith("py_divisor") or self.out.can_fault(node):
            self.out.check()
        return name

    def _product(self, node: ast.expr) -> Entry:
        """Return the elements of ``a @ b`` (sums that start with the first product) or ``add_product(q, a, b)``."""
        if self.plan.is_long(node):
            kind = self.function.types[node]
            assert isinstance(kind, MatrixType)
            return entry_of(f"{self.materialise(node)}.x", kind.columns)
        start, row, column = self.factors(node)
        inner = self.plan.inner(node)

        def entry(i: Index, j: Index) -> tuple[str, int]:
            terms = [times(row(i, k), column(k, j)) for k in range(inner)]
            terms = [parenthesise(start(i, j), SUM), *terms] if start else terms
            return " + ".join(terms), SUM if len(terms) > 1 else PRODUCT

        return entry

    def factors(self, node: ast.expr) -> tuple[Entry | None, Entry, Entry]:
        """Return the elements of both factors of a product and of the matrix to which it is added.

        A factor is computed in a separate matrix if its elements are used several times and need computation.
        """
        *addend, first, second = terms_of(node)
        kind, right = self.function.types[first], self.function.types[second]
        assert isinstance(kind, MatrixType)
        start = self.prepare(addend[0]) if addend else None
        is_column = isinstance(right, VectorType) or right.columns == 1  # type: ignore[union-attr]
        entries = []
        for factor, single in ((first, is_column), (second, kind.rows == 1)):
            kind = self.function.types[factor]
            if single or self.plan.is_cheap(factor) or not isinstance(kind, MatrixType):
                entries.append(self.prepare(factor))
            else:
                entries.append(entry_of(f"{self.materialise(factor)}.x", kind.columns))
        return start, entries[0], entries[1]


def entry_of(holder: str, columns: int) -> Entry:
    """Return the elements of an array stored in row order."""
    return lambda i, j: (f"{holder}[{row_order_index(i, j, columns)}]", ATOM)


def row_order_index(i: Index, j: Index, columns: int) -> Index:
    """Return the index of an element in row order."""
    if columns == 1:
        return plus(i, j)
    if isinstance(i, int):
        return plus(columns * i, j)
    return plus(f"{columns} * {f'({i})' if ' ' in i else i}", j)


def plus(a: Index, b: Index) -> Index:
    if isinstance(a, int) and isinstance(b, int):
        return a + b
    return b if a == 0 else a if b == 0 else f"{a} + {b}"


def times(a: tuple[str, int], b: tuple[str, int]) -> str:
    return f"{parenthesise(a, PRODUCT)} * {parenthesise(b, PRODUCT + 1)}"
