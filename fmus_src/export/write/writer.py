"""Base of the writers of a kernel function: names, checks, comments, declarations."""

from __future__ import annotations

import ast

from ..judge.effects import own_outcome
from ..judge.kernel import BOOL, FLOAT, INT, Function, List, MatrixType, Scalar, Several, Value, VectorType
from ..judge.source import comments_of
from .layout import CodeLines
from .names import C_TYPES, Names, c_type, identifier
from .placement import LocalDeclarations

ZERO = {FLOAT: "0.0", INT: "0", BOOL: "false"}


class FunctionWriter:
    """Lines of C for one function in order of writing."""

    def __init__(self, function: Function, names: Names) -> None:
        self.function = function
        self.names = names
        self.placement = LocalDeclarations(function)
        self.lines = CodeLines()
        self.comments = comments_of(function.source.path)
        self.last_line = function.source.node.lineno
        self.used = {identifier(name) for name in [*function.parameters, *function.locals]}
        self.line = 0  # of the statement being written

    def fresh(self, name: str) -> str:
        """Return a name that the function does not use yet."""
        candidate = name
        number = 2
        while candidate in self.used:
            candidate = f"{name}_{number}"
            number += 1
        self.used.add(candidate)
        return candidate

    def add(self, text: str) -> None:
        """Add a line of C with the Python line as a comment on its right."""
        self.lines.add(text, self.line)

    def check(self) -> None:
        """Add a statement that returns if a fault is recorded."""
        returns = self.function.returns
        value = ""
        if isinstance(returns, Scalar):
            value = f" {ZERO[returns]}"
        elif returns is not None:
            value = f" ({c_type(returns)}){'{{0.0}}' if isinstance(returns, VectorType | MatrixType) else '{0}'}"
        self.lines.add(f"if (fault->what) return{value};")

    def keep(self, node: ast.expr, text: str, name: str) -> str:
        """Store the value of an expression in a new variable, checked if it can fail."""
        kind = self.function.types[node]
        assert isinstance(kind, Value | Several)
        variable = self.fresh(name)
        self.add(f"const {c_type(kind)} {variable} = {text};")
        if self.can_fault(node) or node in self.function.hoisted:
            self.check()
        return variable

    def hoist(self, node: ast.expr, text: str) -> str:
        """Store an operand of the statement in a variable before it."""
        return self.keep(node, text, "part")

    def can_fault(self, node: ast.expr) -> bool:
        """Return True if evaluating an expression, without its hoisted operands, can record a fault."""
        if node in self.function.hoisted:
            return False
        children = [child.value if isinstance(child, ast.keyword) else child for child in ast.iter_child_nodes(node)]
        parts = [child for child in children if isinstance(child, ast.expr)]
        return bool(own_outcome(self.function, node)) or any(self.can_fault(part) for part in parts)

    def declare(self, name: str) -> str:
        """Return the type and name of a local variable, the beginning of its declaration."""
        kind = self.function.locals[name]
        assert isinstance(kind, Value | List)
        if isinstance(kind, List):
            return f"{C_TYPES[kind.element]} {identifier(name)}[{kind.size}]"
        return f"{c_type(kind)} {identifier(name)}"

    def comments_before(self, statement: ast.stmt) -> None:
        """Add the Python comments between the previous statement and this one."""
        for number in range(self.last_line + 1, statement.lineno):
            if number in self.comments:
                self.lines.comment(self.comments[number])
        self.last_line = max(self.last_line, statement.lineno)
