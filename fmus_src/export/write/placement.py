"""Placement of the C declarations of one kernel function, in the innermost scope that every use allows."""

from __future__ import annotations

import ast

from ..judge.kernel import Function, body_of, targets_of
from ..judge.statements import UNUSED

Path = tuple[tuple[int, int], ...]  # (block, position in it) from the function's body inwards


class LocalDeclarations:
    """Declarations of local variables, and loops whose variable C can declare in the for statement.

    ``with_value`` maps an assignment to the names it declares; ``before`` maps a statement to names declared without a
    value before it.
    """

    def __init__(self, function: Function) -> None:
        self.with_value: dict[ast.stmt, set[str]] = {}
        self.before: dict[ast.stmt, list[str]] = {}
        self.plain_loops: set[ast.For] = set()
        self._unused: set[str] = set()  # locals that no statement reads
        self._function = function
        self._blocks: dict[int, list[ast.stmt]] = {}
        self._uses: dict[str, list[Path]] = {}
        body = body_of(function.source.node)
        self._plain_loops(function.source.node)
        self._collect(body, ())
        for name in function.locals:
            if name in self._uses and name not in self._unused:
                self._place(name, self._uses[name])

    def declares(self, node: ast.stmt, name: str) -> bool:
        """Return True if an assignment declares a variable."""
        return name in self.with_value.get(node, ())

    def _plain_loops(self, root: ast.FunctionDef) -> None:
        """Return the loops over a variable that nothing else assigns and that is not read after the loop."""
        loops = [node for node in ast.walk(root) if isinstance(node, ast.For)]
        by_name: dict[str, list[ast.For]] = {}
        for loop in loops:
            assert isinstance(loop.target, ast.Name)
            by_name.setdefault(loop.target.id, []).append(loop)
        for name, same_target in by_name.items():
            inside = [part for loop in same_target for child in loop.body for part in ast.walk(child)]
            reads = {part for part in ast.walk(root) if _is_use(part, name, ast.Load)}
            stores = {part for part in ast.walk(root) if _is_use(part, name, ast.Store)}
            nested = any(_is_use(part, name, ast.Store) for part in inside)
            if name == UNUSED and not reads:
                self.plain_loops |= set(same_target)
                self._unused.add(name)
            elif reads <= set(inside) and stores == {loop.target for loop in same_target} and not nested:
                self.plain_loops |= set(same_target)

    def _collect(self, statements: list[ast.stmt], outer: Path) -> None:
        block = id(statements)
        self._blocks[block] = statements
        for position, statement in enumerate(statements):
            path = (*outer, (block, position))
            for field, value in ast.iter_fields(statement):
                if field in ("body", "orelse"):
                    self._collect(value, path)
                elif not (field == "target" and statement in self.plain_loops):
                    self._use(value, path)

    def _use(self, value: object, path: Path) -> None:
        for item in value if isinstance(value, list) else [value]:
            if isinstance(item, ast.AST):
                for part in ast.walk(item):
                    if isinstance(part, ast.Name):
                        self._uses.setdefault(part.id, []).append(path)

    def _place(self, name: str, paths: list[Path]) -> None:
        if all(self._is_plain_target(path, name) for path in paths):
            return
        depth = 0
        while all(len(path) > depth + 1 for path in paths) and len({path[: depth + 2][-1][0] for path in paths}) == 1:
            if len({path[depth] for path in paths}) != 1:
                break
            depth += 1
        block = paths[0][depth][0]
        first = self._blocks[block][min(path[depth][1] for path in paths)]
        if isinstance(first, ast.Assign | ast.AnnAssign):
            names = [target.id for target in targets_of(first) if isinstance(target, ast.Name)]
            if name in names:
                self.with_value.setdefault(first, set()).add(name)
                return
        self.before.setdefault(first, []).append(name)

    def _is_plain_target(self, path: Path, name: str) -> bool:
        """Return True if a use is inside a loop that declares the variable."""
        for block, position in path[:-1]:
            statement = self._blocks[block][position]
            if statement in self.plain_loops and _is_use(statement.target, name, ast.Store):  # type: ignore[attr-defined]
                return True
        return False


def _is_use(node: ast.AST, name: str, context: type[ast.expr_context]) -> bool:
    return isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, context)


def list_assigned(statements: list[ast.stmt]) -> set[str]:
    """Return the names that statements assign, including loops inside them."""
    parts = (part for statement in statements for part in ast.walk(statement))
    return {part.id for part in parts if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)}
