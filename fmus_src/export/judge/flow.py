"""Order of statements in one kernel function: no read before an assignment, a return on every path."""

from __future__ import annotations

import ast
from collections.abc import Iterable

from .kernel import Function, Kernel, body_of, targets_of
from .statements import local_names

NEVER = None  # names assigned after a statement that never ends


class FlowCheck:
    """Traversal of one function's statements with the set of definitely assigned names."""

    def __init__(self, kernel: Kernel, function: Function) -> None:
        self.kernel = kernel
        self.function = function
        self.locals = local_names(function.source.node) - set(function.parameters)

    def check(self) -> None:
        """Report names that may be unbound when they are read, and a missing return."""
        node = self.function.source.node
        end = self.block(body_of(node), frozenset())
        if end is not NEVER and self.function.returns is not None:
            self.kernel.report(self.function.source, node, "missing return", name=self.function.name)

    def block(self, statements: Iterable[ast.stmt], assigned: frozenset[str] | None) -> frozenset[str] | None:
        """Return the names assigned after the statements, or NEVER."""
        for statement in statements:
            if assigned is NEVER:
                return NEVER
            assigned = self.statement(statement, assigned)
        return assigned

    def statement(self, node: ast.stmt, assigned: frozenset[str]) -> frozenset[str] | None:
        """Return the names assigned after one statement, or NEVER."""
        if isinstance(node, ast.If):
            self.reads(node.test, assigned)
            return meet(self.block(node.body, assigned), self.block(node.orelse, assigned))
        if isinstance(node, ast.While):
            self.reads(node.test, assigned)
            self.block(node.body, assigned)
            return assigned
        if isinstance(node, ast.For):
            return self.loop(node, assigned)
        self.reads(node, assigned)
        if isinstance(node, ast.Return | ast.Break | ast.Continue):
            return NEVER
        if isinstance(node, ast.Assign | ast.AnnAssign):
            return assigned | {target.id for target in targets_of(node) if isinstance(target, ast.Name)}
        return assigned

    def loop(self, node: ast.For, assigned: frozenset[str]) -> frozenset[str] | None:
        """Return the names definitely assigned after a loop.

        Names assigned in its body count if it runs at least once and has no break or continue.
        """
        self.reads(node.iter, assigned)
        inside = assigned | {node.target.id} if isinstance(node.target, ast.Name) else assigned
        after = self.block(node.body, inside)
        leaves = any(isinstance(part, ast.Break | ast.Continue) for child in node.body for part in ast.walk(child))
        if runs_at_least_once(node) and not leaves:
            return after
        return assigned

    def reads(self, node: ast.AST, assigned: frozenset[str]) -> None:
        """Report local names that code reads before they are definitely assigned."""
        unsafe = self.locals - assigned
        for part in ast.walk(node):
            if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load) and part.id in unsafe:
                self.kernel.report(self.function.source, part, "unbound", name=part.id)


def meet(left: frozenset[str] | None, right: frozenset[str] | None) -> frozenset[str] | None:
    """Return the names assigned after either of two branches."""
    if left is NEVER or right is NEVER:
        return right if left is NEVER else left
    return left & right


def runs_at_least_once(node: ast.For) -> bool:
    """Return True if a loop over range has literal, nonempty bounds."""
    if not isinstance(node.iter, ast.Call):
        return False
    literals = [argument.value for argument in node.iter.args if isinstance(argument, ast.Constant)]
    bounds = [value for value in literals if isinstance(value, int)]
    return len(bounds) == len(node.iter.args) and bounds[2:] != [0] and len(range(*bounds)) > 0
