"""Matrices of a kernel function as C text: each element of what is assigned by one expression.

Small matrices are written out, others are loops. What an element would need more than once, products and what calls
return, is computed before, in a matrix of its own.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import TYPE_CHECKING

from ..judge.effects import own_outcome
from ..judge.kernel import KernelCall, MakeMatrix, Matrix, Vector
from ..judge.ranges import indices_of
from ..judge.vectors import is_variable
from .expressions import ATOM, CONDITIONAL, PRODUCT, SUM, UNARY
from .names import c_type, identifier

if TYPE_CHECKING:
    from .writer import FunctionWriter

Index = int | str
Entry = Callable[[Index, Index], tuple[str, int]]  # of row and column: text and precedence

FEW = 16  # elements that are written out,
FEW_TERMS = 64  # if they have no more terms of sums together
SHORT = 4  # terms of a sum that is one expression


class MatrixWriter:
    """Writes the matrices of one function."""

    def __init__(self, out: FunctionWriter) -> None:
        self.out = out
        self.function = out.function

    def write(self, node: ast.expr) -> tuple[str, int]:
        """A matrix that is no variable, or a vector made by one: C text after the statements it needs."""
        kind = self.function.types[node]
        if isinstance(kind, Vector):
            entry = self.prepare(node)
            return self.out.expressions.vector([entry(i, 0)[0] for i in range(kind.size)]), ATOM
        return self._materialise(node), ATOM

    def write_part(self, node: ast.Subscript) -> str:
        """``p[i, j]`` as a number, ``p[i, 0:3]`` as a vector."""
        rows, columns = self.function.blocks[node]
        if rows is None and columns is None:
            return f"{self.holder(node.value)}[{self.place(node)}]"
        entry = self._block(node)
        size = len(rows or columns or ())
        return self.out.expressions.vector([entry(k, 0)[0] if rows else entry(0, k)[0] for k in range(size)])

    def holder(self, node: ast.expr) -> str:
        """What is indexed to mean an element: ``p->x``, ``self->covariance.x``."""
        text = self.out.expressions.write(node, ATOM)
        return f"{text[2:-1]}->x" if text.startswith("(*") else f"{text}.x"

    def place(self, node: ast.Subscript) -> str:
        """The place of ``p[i, j]`` in row order."""
        kind = self.function.types[node.value]
        assert isinstance(kind, Matrix)
        row, column = (self._index(node, *each) for each in indices_of(self.function, node))
        return str(_place(row, column, kind.columns))

    def _index(self, node: ast.Subscript, index: ast.expr, size: int) -> Index:
        """An index, checked where it was not proven."""
        text = self.out.expressions.write(index, SUM)
        if index in self.function.unproven_indices:
            return self.out.expressions.write_checked(node, "py_index", text, str(size))[0]
        return int(text) if text.isdigit() else text

    def assign(self, statement: ast.stmt, target: ast.expr, value: ast.expr) -> None:
        """``target = value``, of a matrix, or of a block, row or column."""
        if isinstance(target, ast.Subscript):
            self._assign_block(target, value)
            return
        name = target.id if isinstance(target, ast.Name) else ""
        if name and self.out.placement.declares(statement, name):
            self._fill(value, self.out.declare(name), identifier(name), True)
        elif self._is_disturbed(value, ast.unparse(target), ast.unparse(target)):
            part = self._materialise(value)
            self.out.add(f"{self.out.expressions.write(target)} = {part};")
        else:
            text = self.out.expressions.write(target)
            self._fill(value, text, text, False)

    def _assign_block(self, target: ast.Subscript, value: ast.expr) -> None:
        kind = self.function.types[target]
        if isinstance(kind, Vector):
            text = self.out.expressions.write(value)
            text = text if text.isidentifier() else self.out.keep(value, text, "part")
            rows, _ = self.function.blocks[target]
            entry = self._block(target)
            for k in range(kind.size):
                self.out.add(f"{entry(*((k, 0) if rows else (0, k)))[0]} = {text}.x[{k}];")
            return
        assert isinstance(kind, Matrix)
        if self._is_disturbed(value, ast.unparse(target), ast.unparse(target.value)):
            entry = _entry_of(f"{self._materialise(value)}.x", kind.columns)
        else:
            entry = self.prepare(value)
        place = self._block(target)
        self._each(kind, self._is_small(value), lambda i, j: [f"{place(i, j)[0]} = {entry(i, j)[0]};"])

    def _materialise(self, node: ast.expr) -> str:
        """The name of a matrix of its own that holds an expression."""
        name = self.out.fresh("part")
        kind = self.function.types[node]
        assert isinstance(kind, Matrix)
        self._fill(node, f"{c_type(kind)} {name}", name, True)
        return name

    def _fill(self, node: ast.expr, left: str, name: str, declares: bool) -> None:
        """Compute a matrix that nothing else reads meanwhile."""
        kind = self.function.types[node]
        assert isinstance(kind, Matrix)
        call = self.function.calls.get(node) if isinstance(node, ast.Call) else None
        if self._is_small(node):
            if isinstance(call, MakeMatrix) and call.name == "matrix":
                elements = [each for row in node.args for each in row.elts]  # type: ignore[attr-defined]
                texts = [self.out.expressions.write(each) for each in elements]
            else:
                entry = self.prepare(node)
                texts = [entry(i, j)[0] for i in range(kind.rows) for j in range(kind.columns)]
            cast = "" if declares else f"({c_type(kind)})"
            self.out.add(f"{left} = {cast}{{{{{', '.join(texts)}}}}};")
            return
        if isinstance(call, MakeMatrix) and call.name == "zeros":
            self.out.add(f"{left} = {'' if declares else f'({c_type(kind)})'}{{{{0.0}}}};")
            return
        target = _entry_of(f"{name}.x", kind.columns)
        if self._is_long(node):
            start, row, column = self._factors(node)
            k, total = self.out.fresh("k"), self.out.fresh("total")
            self.out.used -= {k, total}

            begin, inner = 0 if start else 1, self._inner(node)

            def write(i: Index, j: Index) -> list[str]:
                first, each = (_times(row(i, at), column(at, j)) for at in (0, k))
                return [
                    f"double {total} = {start(i, j)[0] if start else first};",
                    f"for (int {k} = {begin}; {k} < {inner}; {k}++) {total} = {total} + {each};",
                    f"{target(i, j)[0]} = {total};",
                ]
        else:
            entry = self.prepare(node)

            def write(i: Index, j: Index) -> list[str]:
                return [f"{target(i, j)[0]} = {entry(i, j)[0]};"]

        if declares:
            self.out.add(f"{left};")
        self._each(kind, False, write)

    def _each(self, kind: Matrix, small: bool, write: Callable[[Index, Index], list[str]]) -> None:
        """Statements for each element: written out, or in loops."""
        if small:
            for i in range(kind.rows):
                for j in range(kind.columns):
                    self.out.add(*write(i, j))
            return
        indices: list[Index] = []
        for name, count in (("i", kind.rows), ("j", kind.columns)):
            index = self.out.fresh(name) if count > 1 else 0
            indices.append(index)
            if count > 1:
                self.out.lines.open(f"for (int {index} = 0; {index} < {count}; {index}++) {{", self.out.line)
        for line in write(*indices):
            self.out.add(line)
        for index in indices:
            if isinstance(index, str):
                self.out.used.discard(index)
                self.out.lines.close("}")

    def prepare(self, node: ast.expr) -> Entry:
        """The elements of a matrix, or of a vector as its column, after the statements that they need."""
        kind = self.function.types[node]
        if isinstance(kind, Vector) and not _is_product(node):
            text = self.out.expressions.write(node)
            text = text if text.isidentifier() else self.out.keep(node, text, "part")
            return lambda i, j: (f"{text}.x[{i}]", ATOM)
        if is_variable(node):
            assert isinstance(kind, Matrix)
            return _entry_of(self.holder(node), kind.columns)
        if isinstance(node, ast.Attribute):
            inner = self.prepare(node.value)
            return lambda i, j: inner(j, i)
        if isinstance(node, ast.UnaryOp):
            operand = self.prepare(node.operand)
            return lambda i, j: (f"-{_paren(operand(i, j), ATOM)}", UNARY)
        if isinstance(node, ast.Subscript):
            return self._block(node)
        if isinstance(node, ast.Call):
            return self._call(node)
        assert isinstance(node, ast.BinOp)
        return self._product(node) if _is_product(node) else self._elementwise(node)

    def _block(self, node: ast.Subscript) -> Entry:
        """The elements of a block, row or column."""
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
        return lambda i, j: inner(_plus(starts[0], i), _plus(starts[1], j))

    def _call(self, node: ast.Call) -> Entry:
        kind, call = self.function.types[node], self.function.calls[node]
        assert isinstance(kind, Matrix)
        write = self.out.expressions.write
        if isinstance(call, KernelCall):
            text = write(node)
            name = text if text.isidentifier() else self.out.keep(node, text, "part")
            return _entry_of(f"{name}.x", kind.columns)
        assert isinstance(call, MakeMatrix)
        if call.name == "add_product":
            return self._product(node)
        if call.name == "copy":
            assert isinstance(node.func, ast.Attribute)
            return self.prepare(node.func.value)
        if call.name == "matrix":
            return _entry_of(f"{self._materialise(node)}.x", kind.columns)
        if call.name == "zeros":
            return lambda i, j: ("0.0", ATOM)
        return lambda i, j: (
            ("1.0" if i == j else "0.0", ATOM)
            if isinstance(i, int) and isinstance(j, int)
            else (f"{i} == {j} ? 1.0 : 0.0", CONDITIONAL)
        )

    def _elementwise(self, node: ast.BinOp) -> Entry:
        """``+`` and ``-`` of matrices, ``*`` and ``/`` with a number."""
        if isinstance(node.op, ast.Add | ast.Sub):
            left, right = self.prepare(node.left), self.prepare(node.right)
            sign = "+" if isinstance(node.op, ast.Add) else "-"
            return lambda i, j: (f"{_paren(left(i, j), SUM)} {sign} {_paren(right(i, j), SUM + 1)}", SUM)
        if isinstance(node.op, ast.Div):
            left, divisor = self.prepare(node.left), self._scalar(node.right, node)
            return lambda i, j: (f"{_paren(left(i, j), PRODUCT)} / {divisor}", PRODUCT)
        number, holder = node.left, node.right
        if isinstance(self.function.types[number], Matrix):
            holder, number = number, holder
            entry, factor = self.prepare(holder), self._scalar(number)
        else:
            factor, entry = self._scalar(number), self.prepare(holder)
        return lambda i, j: (f"{factor} * {_paren(entry(i, j), PRODUCT + 1)}", PRODUCT)

    def _scalar(self, node: ast.expr, division: ast.BinOp | None = None) -> str:
        """A number that all elements are multiplied with, or divided by."""
        text = self.out.expressions.write_as_float(node, ATOM)
        if division is not None and own_outcome(self.function, division):
            text = self.out.expressions.write_checked(division, "py_divisor", text)[0]
        elif text.isidentifier() or isinstance(node, ast.Constant):
            return text
        name = self.out.fresh("divisor" if division else "factor")
        self.out.add(f"const double {name} = {text};")
        if text.startswith("py_divisor") or self.out.can_fault(node):
            self.out.check()
        return name

    def _product(self, node: ast.expr) -> Entry:
        """``a @ b``, whose sums run from the first product on, or ``add_product(q, a, b)``."""
        if self._is_long(node):
            kind = self.function.types[node]
            assert isinstance(kind, Matrix)
            return _entry_of(f"{self._materialise(node)}.x", kind.columns)
        start, row, column = self._factors(node)
        inner = self._inner(node)

        def entry(i: Index, j: Index) -> tuple[str, int]:
            terms = [_times(row(i, k), column(k, j)) for k in range(inner)]
            terms = [_paren(start(i, j), SUM), *terms] if start else terms
            return " + ".join(terms), SUM if len(terms) > 1 else PRODUCT

        return entry

    def _factors(self, node: ast.expr) -> tuple[Entry | None, Entry, Entry]:
        """Elements of what a product is added to, and of both factors.

        Factors are in a matrix of their own where an element is used more than once and takes computing.
        """
        parts = _terms_of(node)
        kind, right = self.function.types[parts[-2]], self.function.types[parts[-1]]
        assert isinstance(kind, Matrix)
        once = (isinstance(right, Vector) or right.columns == 1, kind.rows == 1)  # type: ignore[union-attr]
        start = self.prepare(parts[0]) if len(parts) == 3 else None
        entries = []
        for factor, single in zip(parts[-2:], once, strict=True):
            kind = self.function.types[factor]
            if single or self._is_cheap(factor) or not isinstance(kind, Matrix):
                entries.append(self.prepare(factor))
            else:
                entries.append(_entry_of(f"{self._materialise(factor)}.x", kind.columns))
        return start, entries[0], entries[1]

    def _inner(self, node: ast.expr) -> int:
        """How many products a sum of a product has."""
        left = self.function.types[_terms_of(node)[-2]]
        assert isinstance(left, Matrix)
        return left.columns

    def _is_product(self, node: ast.AST) -> bool:
        """Whether an expression is a product, or one that is added to something."""
        call = self.function.calls.get(node) if isinstance(node, ast.Call) else None
        return _is_product(node) or (isinstance(call, MakeMatrix) and call.name == "add_product")

    def _is_long(self, node: ast.expr) -> bool:
        """Whether sums of a product take a loop."""
        return self._is_product(node) and self._inner(node) > SHORT

    def _is_cheap(self, node: ast.expr) -> bool:
        """Whether an element is read, not computed."""
        if isinstance(node, ast.Attribute | ast.Subscript) and not is_variable(node):
            return self._is_cheap(node.value)
        return is_variable(node) or isinstance(self.function.calls.get(node), KernelCall)  # type: ignore[call-overload]

    def _is_small(self, node: ast.expr) -> bool:
        """Whether a matrix is written out."""
        kind = self.function.types[node]
        assert isinstance(kind, Matrix)
        if isinstance(node, ast.Call) and any(isinstance(row, ast.List) for row in node.args):
            return True
        if self._is_long(node):
            return False
        terms = [self._inner(part) for part in ast.walk(node) if isinstance(part, ast.expr) and self._is_product(part)]
        size = kind.rows * kind.columns
        return size <= FEW and size * max([1, *(count for count in terms if count <= SHORT)]) <= FEW_TERMS

    def _is_disturbed(self, node: ast.expr, target: str, variable: str) -> bool:
        """Whether an element of a value reads the variable elsewhere than at the element that is assigned.

        An argument may be the block's matrix that is assigned.
        """
        if ast.unparse(node) == target or (self._is_argument(node) and target == variable):
            return False
        if isinstance(node, ast.BinOp) and not _is_product(node):
            matrices = [each for each in (node.left, node.right) if isinstance(self.function.types[each], Matrix)]
            return any(self._is_disturbed(each, target, variable) for each in matrices)
        if isinstance(node, ast.UnaryOp):
            return self._is_disturbed(node.operand, target, variable)
        parts = [part for part in ast.walk(node) if isinstance(part, ast.Name | ast.Attribute)]
        aliases = variable.startswith("self.") and any(map(self._is_argument, parts))
        return aliases or variable in map(ast.unparse, parts)

    def _is_argument(self, node: ast.expr) -> bool:
        """Whether an expression is a matrix that the function was given."""
        name = node.id if isinstance(node, ast.Name) else ""
        return isinstance(self.function.parameters.get(name), Matrix)


def _is_product(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult)


def _terms_of(node: ast.expr) -> list[ast.expr]:
    """The factors of a product, after what it may be added to."""
    if isinstance(node, ast.Call):
        return node.args
    assert isinstance(node, ast.BinOp)
    return [node.left, node.right]


def _entry_of(holder: str, columns: int) -> Entry:
    """The elements of what is stored in row order."""
    return lambda i, j: (f"{holder}[{_place(i, j, columns)}]", ATOM)


def _place(i: Index, j: Index, columns: int) -> Index:
    """Where an element is in row order."""
    if columns == 1:
        return _plus(i, j)
    if isinstance(i, int):
        return _plus(columns * i, j)
    return _plus(f"{columns} * {f'({i})' if ' ' in i else i}", j)


def _plus(a: Index, b: Index) -> Index:
    if isinstance(a, int) and isinstance(b, int):
        return a + b
    return b if a == 0 else a if b == 0 else f"{a} + {b}"


def _paren(entry: tuple[str, int], outer: int) -> str:
    """The text of an element, in parentheses where the operator around it binds tighter."""
    text, precedence = entry
    return f"({text})" if precedence < outer else text


def _times(a: tuple[str, int], b: tuple[str, int]) -> str:
    return f"{_paren(a, PRODUCT)} * {_paren(b, PRODUCT + 1)}"
