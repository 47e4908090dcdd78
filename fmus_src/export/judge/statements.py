"""Statements of one kernel function: checks, and types of the variables that they assign."""

from __future__ import annotations

import ast

from .calls import CallTypes, Resolver
from .expressions import is_read_only
from .kernel import (
    FLOAT,
    INT,
    Function,
    Kernel,
    List,
    MatrixType,
    RecordType,
    Returned,
    Scalar,
    Several,
    Type,
    Value,
    VectorType,
    is_self_attribute,
)
from .vectors import is_variable

UNUSED = "_"  # target for unused values
ANY_VECTOR = VectorType(0)  # declared as Vector, with unknown size
ANY_MATRIX = MatrixType(0, 0)  # declared as Matrix


def local_names(node: ast.FunctionDef) -> set[str]:
    """Return the names that a function assigns, which are therefore local throughout it."""
    return {part.id for part in ast.walk(node) if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)}


class StatementTypes(CallTypes):
    """Checker of one function's statements, which infers the types of its variables."""

    def __init__(self, kernel: Kernel, function: Function, resolve: Resolver) -> None:
        super().__init__(kernel, function, resolve, local_names(function.source.node))

    def block(self, statements: list[ast.stmt]) -> None:
        for statement in statements:
            self.check(statement)

    def check(self, statement: ast.stmt) -> None:
        """Check a statement of the subset; report other statements."""
        match statement:
            case ast.Assign():
                self.check_assign(statement)
            case ast.AnnAssign():
                self.check_annassign(statement)
            case ast.Expr():
                self.check_expr(statement)
            case ast.If():
                self.check_if(statement)
            case ast.For():
                self.check_for(statement)
            case ast.While():
                self.check_while(statement)
            case ast.Return():
                self.check_return(statement)
            case ast.Pass() | ast.Break() | ast.Continue():
                pass
            case _:
                self.refuse_syntax(statement)

    def check_expr(self, node: ast.Expr) -> None:
        if isinstance(node.value, ast.Call):
            returned = self.call(node.value)
            if not isinstance(returned, Function) and returned is not None:
                self.report(node, "no effect")
        elif isinstance(node.value, ast.Constant):
            self.report(node, "no effect")
        else:
            self.infer(node.value)
            self.report(node, "no effect")

    def check_assign(self, node: ast.Assign) -> None:
        if len(node.targets) > 1 or isinstance(node.targets[0], ast.List):
            self.report(node, "one target")
        elif isinstance(node.targets[0], ast.Tuple):
            self.unpack(node, node.targets[0].elts, node.value)
        else:
            self.assign(node, node.targets[0], node.value)

    def check_annassign(self, node: ast.AnnAssign) -> None:
        if node.value is None:
            self.report(node, "no effect")
        else:
            self.assign(node, node.target, node.value)

    def assign(self, node: ast.stmt, target: ast.expr, value: ast.expr) -> None:
        """Check ``target = value``, which also declares a local list."""
        if is_list_binding(value):
            self.bind_list(node, target, value)
            return
        kind = self.infer(value)
        if isinstance(kind, List):
            name = ast.unparse(target)
            if is_self_attribute(target) and isinstance(self.infer(target), VectorType):
                self.report(node, "list stored", name=name)
                return
            self.report(node, "list shared" if name in self.bound else "list rebound", name=name)
            return
        if isinstance(kind, MatrixType) and isinstance(target, ast.Name) and is_variable(value):
            self.report(node, "matrix shared", name=target.id, value=ast.unparse(value))
        self.store(target, kind)

    def unpack(self, node: ast.stmt, targets: list[ast.expr], value: ast.expr) -> None:
        """Check ``a, b = function(...)`` and ``x, y, z = v``."""
        if isinstance(value, ast.Tuple | ast.List):
            self.report(node, "one target")
            return
        unpacked = self.infer_several(value)
        if isinstance(unpacked, Several):
            kinds: list[Value] = list(unpacked.parts)
        elif isinstance(unpacked, VectorType):
            kinds = [FLOAT] * unpacked.size
        else:
            if unpacked is not None:
                self.report(node, "one target")
            return
        if len(kinds) != len(targets):
            self.report(node, "number of targets", targets=len(targets), got=unpacked)
            return
        for target, kind in zip(targets, kinds, strict=True):
            if isinstance(target, ast.Name) and target.id == UNUSED:
                continue
            if isinstance(target, ast.Name) or is_self_attribute(target):
                self.store(target, kind)
            else:
                self.report(target, "target")

    def store(self, target: ast.expr, kind: Type | None) -> None:
        """Check that a scalar of a type can be stored in a target."""
        if isinstance(target, ast.Name):
            expected = self.function.parameters.get(target.id) or self.function.locals.get(target.id)
            if expected is None and kind is not None:
                self.function.locals[target.id] = kind
            if isinstance(expected, MatrixType) and target.id in self.function.parameters:
                self.report(target, "matrix rebound", name=target.id)
        elif self._is_component(target):
            holder = target.value  # type: ignore[attr-defined]
            rule = "field assigned" if isinstance(self.infer(holder), RecordType) else "component assigned"
            self.report(target, rule, name=ast.unparse(holder))
            return
        elif isinstance(target, ast.Subscript):
            expected = self.infer(target)
            if is_read_only(self.function, target.value):
                self.report(target, "read-only", name=ast.unparse(target.value))
        elif is_self_attribute(target) and self.function.is_method:
            expected = self.infer(target)
            if is_read_only(self.function, target):
                self.report(target, "read-only", name=ast.unparse(target))
        else:
            self.report(target, "target")
            return
        if isinstance(expected, List):
            self.report(target, "list rebound", name=ast.unparse(target))
        elif expected is not None and kind is not None and kind != expected:
            self.report(target, "type change", name=ast.unparse(target), before=expected, after=kind)

    def _is_component(self, target: ast.expr) -> bool:
        """Return True if a target is an element or a component of a vector."""
        if isinstance(target, ast.Subscript):
            return isinstance(self.infer(target.value), VectorType)
        if not isinstance(target, ast.Attribute) or is_self_attribute(target):
            return False
        name = target.value.id if isinstance(target.value, ast.Name) else None
        known = name is None or name in self.bound or name in self.function.parameters
        return known and isinstance(self.infer(target.value), VectorType | RecordType)

    def bind_list(self, node: ast.stmt, target: ast.expr, value: ast.expr) -> None:
        """Check ``name = [0.0] * n`` or ``name = [a, b, c]``."""
        if is_self_attribute(target) and isinstance(self.infer(target), VectorType):
            self.report(node, "list stored", name=ast.unparse(target))
            return
        if not isinstance(target, ast.Name) or target.id in self.function.parameters:
            self.report(node, "list rebound", name=ast.unparse(target))
            return
        if isinstance(value, ast.BinOp):
            assert isinstance(value.left, ast.List)
            items = value.left.elts
            size = self.static_size(value.right)
            if size is None or size < 1 or len(items) != 1:
                self.report(node, "list size", name=target.id)
                return
        else:
            assert isinstance(value, ast.List)
            items = value.elts
            size = len(items)
        kinds = {self.infer(item) for item in items}
        if None in kinds:
            return
        if len(kinds) != 1 or not isinstance(next(iter(kinds)), Scalar):
            detail = f"a list of {' and '.join(sorted(map(str, kinds)))}" if kinds else "an empty list"
            self.report(node, "list literal", detail=detail)
            return
        if any(isinstance(part, ast.Name) and part.id == target.id for item in items for part in ast.walk(item)):
            self.report(node, "list replaces itself", name=target.id)
        bound = List(kinds.pop(), size)  # type: ignore[arg-type]
        before = self.function.locals.setdefault(target.id, bound)
        if before != bound:
            self.report(node, "type change", name=target.id, before=before, after=bound)
        self.function.types[value] = bound

    def check_if(self, node: ast.If) -> None:
        self.infer_condition(node.test)
        self.block(node.body)
        self.block(node.orelse)

    def check_while(self, node: ast.While) -> None:
        self.infer_condition(node.test)
        self.block(node.body)
        if node.orelse:
            self.report(node, "loop else")

    def check_for(self, node: ast.For) -> None:
        call = node.iter
        if not isinstance(call, ast.Call) or not is_range(call) or not isinstance(node.target, ast.Name):
            self.report(node, "for range")
        else:
            for argument in call.args:
                kind = self.infer(argument)
                if kind not in (INT, None):
                    self.report(argument, "argument type", name="range", expected=INT, argument="a bound", got=kind)
            if len(call.args) == 3 and not range_step(call):
                self.report(call, "range step")
            self.store(node.target, INT)
        self.block(node.body)
        if node.orelse:
            self.report(node, "loop else")

    def _check_returned_matrices(self, node: ast.Return) -> None:
        """Report a returned matrix that would have two names: an argument, a block's variable, or a repeated result."""
        results = node.value.elts if isinstance(node.value, ast.Tuple) else [node.value]
        for number, result in enumerate(results):
            if not isinstance(result, ast.expr) or not isinstance(self.function.types.get(result), MatrixType):
                continue
            local = isinstance(result, ast.Name) and result.id not in self.function.parameters
            before = [ast.unparse(each) for each in results[:number] if each is not None]
            if is_variable(result) and (not local or ast.unparse(result) in before):
                self.report(node, "matrix shared", name="what it returns", value=ast.unparse(result))

    def check_return(self, node: ast.Return) -> None:
        if isinstance(node.value, ast.Tuple):
            kinds = [self.infer(value) for value in node.value.elts]
            if not all(isinstance(kind, Value) for kind in kinds):
                if None not in kinds:
                    self.report(node, "return value", got="a list", expected=self.function.returns)
                return
            returned: Type | Several | None = Several(tuple(kinds))  # type: ignore[arg-type]
            self.function.types[node.value] = returned
        else:
            returned = self.infer_several(node.value) if node.value is not None else None
        if node.value is not None and returned is None:
            return
        self._check_returned_matrices(node)
        self.function.returns = with_size(self.function.returns, returned)
        if returned != self.function.returns:
            self.report(node, "return value", got=returned, expected=self.function.returns)


def with_size(declared: Returned | None, returned: Type | Several | None) -> Returned | None:
    """Return a function's declared return type, completed by the inferred size of a vector or matrix."""
    if isinstance(declared, Several) and isinstance(returned, Several) and len(declared.parts) == len(returned.parts):
        return Several(tuple(with_size(*pair) for pair in zip(declared.parts, returned.parts, strict=True)))  # type: ignore[misc]
    if declared == ANY_VECTOR and isinstance(returned, VectorType):
        return returned
    return returned if declared == ANY_MATRIX and isinstance(returned, MatrixType) else declared


def is_list_binding(value: ast.expr) -> bool:
    """Return True if an expression creates a list: ``[a, b]`` or ``[a] * n``."""
    return isinstance(value, ast.List) or (
        isinstance(value, ast.BinOp) and isinstance(value.op, ast.Mult) and isinstance(value.left, ast.List)
    )


def is_range(call: ast.Call) -> bool:
    """Return True if a call is `range` with one to three arguments."""
    named = isinstance(call.func, ast.Name) and call.func.id == "range"
    return named and not call.keywords and 1 <= len(call.args) <= 3


def range_step(call: ast.Call) -> int:
    """Return the step of a call of `range`; 0 if it is not a literal."""
    if len(call.args) < 3:
        return 1
    node = call.args[2]
    sign = 1
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        node, sign = node.operand, -1
    return sign * node.value if isinstance(node, ast.Constant) and type(node.value) is int else 0
