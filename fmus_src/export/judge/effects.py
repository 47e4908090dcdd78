"""Effects and failures of each kernel function, and the evaluation order that they require in C.

C does not define the order in which operands are evaluated. If two operands can fail differently, the first is hoisted:
assigned to a separate variable and checked before the statement. Arguments that can fail are always hoisted, so that no
function is called with them.
"""

from __future__ import annotations

import ast

from .expressions import is_read_only
from .kernel import (
    FLOAT,
    INT,
    BoundFunction,
    BuiltinCall,
    Function,
    Kernel,
    KernelCall,
    List,
    MakeMatrix,
    MathCall,
    MatrixType,
    VectorType,
    is_self_attribute,
    targets_of,
)
from .vectors import is_variable

Outcomes = frozenset[tuple[int, object]]  # (line, outcome that ends the call)
NO_OUTCOME: Outcomes = frozenset()
ZERO_DIVISION = "ZeroDivisionError"


def find_effects(kernel: Kernel) -> None:
    """Determine the effects of all functions, callees first; report changes and failures whose order cannot be
    preserved.
    """
    for function in kernel.functions:
        effects = _Effects(kernel, function)
        for statement in ast.walk(function.source.node):
            if isinstance(statement, ast.stmt):
                effects.statement(statement)


def is_nonzero_constant(function: Function, node: ast.expr) -> bool:
    """Return True if a divisor is a literal or module constant without a zero component."""
    if isinstance(node, ast.Constant):
        return bool(node.value)
    if isinstance(function.types.get(node), VectorType):
        return node in function.constants and all(function.constants[node].value)
    return node in function.constants and bool(function.constants[node].value)


def own_outcome(function: Function, node: ast.expr) -> Outcomes:
    """Return the possible outcomes of an expression itself, without its operands."""
    line = node.lineno
    if function.is_total:
        return NO_OUTCOME
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Div | ast.FloorDiv | ast.Mod):
        if function.types[node] is INT:
            return frozenset({(line, id(node))}) if node in function.unproven else NO_OUTCOME
        if is_nonzero_constant(function, node.right):
            return NO_OUTCOME
        return frozenset({(line, (ZERO_DIVISION, type(node.op)))})
    if isinstance(node, ast.Call):
        call = function.calls.get(node)
        if isinstance(call, KernelCall):
            return frozenset({(line, id(node))}) if call.callee.can_fault else NO_OUTCOME
        if isinstance(call, MathCall) and call.function.faults:
            faults = call.function.faults
            return frozenset({(line, faults[0] if len(faults) == 1 else id(node))})
        if isinstance(call, BuiltinCall) and call.name == "int" and function.types[node.args[0]] is FLOAT:
            return frozenset({(line, id(node))})
    if node in function.unproven:
        return frozenset({(line, "IndexError" if isinstance(node, ast.Subscript) else "OverflowError of an int")})
    return NO_OUTCOME


class _Effects:
    """Effects of one function, collected statement by statement."""

    def __init__(self, kernel: Kernel, function: Function) -> None:
        self.kernel = kernel
        self.function = function

    def statement(self, node: ast.stmt) -> None:
        """Process one statement without the statements inside it."""
        whole: ast.expr | None = None
        outcomes = NO_OUTCOME
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            whole = node.value
            outcomes = self._value(node.value)
            for target in targets_of(node):
                self._changes(target.value if isinstance(target, ast.Subscript) else target)
                if isinstance(target, ast.Subscript):
                    outcomes |= self.visit(target, False)
        elif isinstance(node, ast.Expr | ast.Return) and node.value is not None:
            whole = node.value
            outcomes = self.visit(node.value, False)
        elif isinstance(node, ast.If | ast.While):
            outcomes = self.visit(node.test, False)
        elif isinstance(node, ast.For) and isinstance(node.iter, ast.Call):
            outcomes = self._in_order(node.iter.args, False)
        if outcomes:
            self.function.can_fault = True
        self._calls(node, whole)

    def _value(self, node: ast.expr) -> Outcomes:
        """Process a value to be assigned, or the elements of a new list."""
        if isinstance(node, ast.List):
            return self._in_order(node.elts, False)
        if isinstance(node, ast.BinOp) and isinstance(node.left, ast.List):
            return self.visit(node.left.elts[0], False)
        return self.visit(node, False)

    def _changes(self, holder: ast.expr) -> None:
        """Record the assignment of a variable of the block or of list elements."""
        if is_self_attribute(holder):
            self.function.changes_block = True
        elif isinstance(holder, ast.Name) and isinstance(self.function.parameters.get(holder.id), List | MatrixType):
            self.function.changed_lists.add(holder.id)

    def _calls(self, node: ast.stmt, whole: ast.expr | None) -> None:
        """Adopt the changes of a called function, which may only be a complete right-hand side or statement."""
        parts = [child for child in ast.iter_child_nodes(node) if isinstance(child, ast.expr)]
        for part in (inner for child in parts for inner in ast.walk(child)):
            call = self.function.calls.get(part) if isinstance(part, ast.Call) else None
            if not isinstance(part, ast.Call) or not isinstance(call, KernelCall):
                continue
            callee = call.callee
            for argument in part.args:
                if self._changes_when_called(callee, argument):
                    self.kernel.report(self.function.source, argument, "derivatives", name=ast.unparse(argument))
            if callee.changes_anything and part is not whole:
                self.kernel.report(self.function.source, part, "changes inside expression", name=callee.name)
            self.function.changes_block |= callee.changes_block
            for name, argument in zip(callee.parameters, part.args, strict=True):
                if name in callee.changed_lists:
                    if self._is_also_used(callee, argument, part.args):
                        self.kernel.report(
                            self.function.source,
                            part,
                            "matrix changed",
                            name=callee.name,
                            argument=ast.unparse(argument),
                        )
                    if is_read_only(self.function, argument):
                        self.kernel.report(self.function.source, argument, "read-only", name=ast.unparse(argument))
                    self._changes(argument)

    def _is_also_used(self, callee: Function, argument: ast.expr, arguments: list[ast.expr]) -> bool:
        """Return True if a matrix changed by a call is also passed to it in another way: Python and C would differ."""
        if not isinstance(self.function.types[argument], MatrixType):
            return False
        several = [ast.unparse(each) for each in arguments].count(ast.unparse(argument)) > 1
        return several or not is_variable(argument) or (is_self_attribute(argument) and callee.takes_block)

    def _changes_when_called(self, callee: Function, argument: ast.expr) -> bool:
        """Return True if an argument is a function with side effects that the callee calls."""
        kind = self.function.types.get(argument)
        functions = [
            inner
            for inner in callee.callees()
            if isinstance(kind, BoundFunction) and inner.source.function is kind.function
        ]
        return any(inner.changes_anything for inner in functions)

    def visit(self, node: ast.expr, conditional: bool) -> Outcomes:
        """Return the possible outcomes of an expression, and mark the operands to be hoisted."""
        if isinstance(node, ast.BoolOp):
            outcomes = self.visit(node.values[0], conditional)
            for value in node.values[1:]:
                outcomes |= self.visit(value, True)
            return outcomes
        if isinstance(node, ast.IfExp):
            outcomes = self.visit(node.test, conditional)
            return outcomes | self.visit(node.body, True) | self.visit(node.orelse, True)
        inside = self._in_order(
            operands(node),
            conditional,
            always=isinstance(self.function.calls.get(node), KernelCall | MakeMatrix)  # type: ignore[call-overload]
            or makes_matrix(self.function, node),
        )
        return inside | own_outcome(self.function, node)

    def _in_order(self, nodes: list[ast.expr], conditional: bool, always: bool = False) -> Outcomes:
        """Process operands from left to right; hoist operands that must be evaluated before later ones."""
        outcomes = [self.visit(node, conditional) for node in nodes]
        for position, node in enumerate(nodes):
            mine = outcomes[position]
            later = [other for other in outcomes[position + 1 :] if other and len(mine | other) > 1]
            if mine and (always or later):
                self.function.hoisted.add(node)
                if conditional:
                    self.kernel.report(self.function.source, node, "conditional order")
        return frozenset().union(*outcomes)


def makes_matrix(function: Function, node: ast.AST) -> bool:
    """Return True if C computes an expression by separate statements before the statement that contains it."""
    product = isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult)
    return product or (isinstance(function.types.get(node), MatrixType) and not is_variable(node))  # type: ignore[arg-type, call-overload]


def operands(node: ast.expr) -> list[ast.expr]:
    """Return the operands of an expression in Python's order of evaluation."""
    if isinstance(node, ast.BinOp):
        return [node.left, node.right]
    if isinstance(node, ast.UnaryOp):
        return [node.operand]
    if isinstance(node, ast.Compare):
        return [node.left, *node.comparators]
    if isinstance(node, ast.Call):
        rows = [argument.elts if isinstance(argument, ast.List) else [argument] for argument in node.args]
        arguments = [argument for row in rows for argument in row if not isinstance(argument, ast.Starred)]
        return [*arguments, *(keyword.value for keyword in node.keywords)]
    if isinstance(node, ast.Subscript):
        indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        return [node.value, *(index for index in indices if not isinstance(index, ast.Slice))]
    if isinstance(node, ast.Attribute) and not is_self_attribute(node):
        return [node.value]
    if isinstance(node, ast.Tuple):
        return node.elts
    return []
