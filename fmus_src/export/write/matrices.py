"""C text of the matrices in a kernel function, with one expression for each assigned element.

Small matrices are unrolled, others use loops.
"""

from __future__ import annotations

import ast
from collections.abc import Callable

from ..judge.kernel import MakeMatrix, MatrixType, VectorType
from .matrix_entries import Index, MatrixEntries, entry_of, times
from .names import c_type, identifier
from .operators import ATOM


class MatrixWriter(MatrixEntries):
    """Writer of the matrices of one function."""

    def write(self, node: ast.expr) -> tuple[str, int]:
        """Add the statements that a matrix or a vector computed from a matrix needs; return its C text."""
        kind = self.function.types[node]
        if isinstance(kind, VectorType):
            entry = self.prepare(node)
            return self.expressions.vector([entry(i, 0)[0] for i in range(kind.size)]), ATOM
        return self.materialise(node), ATOM

    def write_part(self, node: ast.Subscript) -> str:
        """Return the C text of ``p[i, j]`` as a number or ``p[i, 0:3]`` as a vector."""
        rows, columns = self.function.blocks[node]
        if rows is None and columns is None:
            return f"{self.holder(node.value)}[{self.place(node)}]"
        entry = self.block(node)
        size = len(rows or columns or ())
        return self.expressions.vector([entry(k, 0)[0] if rows else entry(0, k)[0] for k in range(size)])

    def assign(self, statement: ast.stmt, target: ast.expr, expression: ast.expr) -> None:
        """Write ``target = expression`` for a matrix, block, row or column."""
        if isinstance(target, ast.Subscript):
            self._assign_block(target, expression)
            return
        name = target.id if isinstance(target, ast.Name) else ""
        if name and self.out.placement.declares(statement, name):
            self._fill(expression, self.out.declare(name), identifier(name), True)
        elif self.plan.is_disturbed(expression, ast.unparse(target), ast.unparse(target)):
            part = self.materialise(expression)
            self.out.add(f"{self.expressions.write(target)} = {part};")
        else:
            text = self.expressions.write(target)
            self._fill(expression, text, text, False)

    def _assign_block(self, target: ast.Subscript, expression: ast.expr) -> None:
        kind = self.function.types[target]
        if isinstance(kind, VectorType):
            text = self.expressions.write(expression)
            text = text if text.isidentifier() else self.out.keep(expression, text, "part")
            rows, _ = self.function.blocks[target]
            entry = self.block(target)
            for k in range(kind.size):
                self.out.add(f"{entry(*((k, 0) if rows else (0, k)))[0]} = {text}.x[{k}];")
            return
        assert isinstance(kind, MatrixType)
        if self.plan.is_disturbed(expression, ast.unparse(target), ast.unparse(target.value)):
            entry = entry_of(f"{self.materialise(expression)}.x", kind.columns)
        else:
            entry = self.prepare(expression)
        stored = self.block(target)
        self._each(kind, self.plan.is_small(expression), lambda i, j: [f"{stored(i, j)[0]} = {entry(i, j)[0]};"])

    def materialise(self, node: ast.expr) -> str:
        """Return the name of a new matrix that contains an expression."""
        name = self.out.fresh("part")
        kind = self.function.types[node]
        assert isinstance(kind, MatrixType)
        self._fill(node, f"{c_type(kind)} {name}", name, True)
        return name

    def _fill(self, node: ast.expr, left: str, name: str, declares: bool) -> None:
        """Write the computation of a matrix that no other expression reads in the meantime."""
        kind = self.function.types[node]
        assert isinstance(kind, MatrixType)
        call = self.function.calls.get(node) if isinstance(node, ast.Call) else None
        if self.plan.is_small(node):
            if isinstance(call, MakeMatrix) and call.name == "matrix":
                elements = [each for row in node.args for each in row.elts]  # type: ignore[attr-defined]
                texts = [self.expressions.write(each) for each in elements]
            else:
                entry = self.prepare(node)
                texts = [entry(i, j)[0] for i in range(kind.rows) for j in range(kind.columns)]
            cast = "" if declares else f"({c_type(kind)})"
            self.out.add(f"{left} = {cast}{{{{{', '.join(texts)}}}}};")
            return
        if isinstance(call, MakeMatrix) and call.name == "zeros":
            self.out.add(f"{left} = {'' if declares else f'({c_type(kind)})'}{{{{0.0}}}};")
            return
        target = entry_of(f"{name}.x", kind.columns)
        if self.plan.is_long(node):
            start, row, column = self.factors(node)
            k, total = self.out.fresh("k"), self.out.fresh("total")
            self.out.used -= {k, total}

            begin, inner = 0 if start else 1, self.plan.inner(node)

            def write(i: Index, j: Index) -> list[str]:
                first, each = (times(row(i, at), column(at, j)) for at in (0, k))
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

    def _each(self, kind: MatrixType, small: bool, write: Callable[[Index, Index], list[str]]) -> None:
        """Write statements for each element, unrolled or in loops."""
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
