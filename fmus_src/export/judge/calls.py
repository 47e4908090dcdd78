"""Resolution of the calls in one kernel function, and the types of their values."""

from __future__ import annotations

import ast
import builtins
import math
from collections.abc import Callable
from types import FunctionType

from ...kernel.functions import FAULTS
from ...kernel.records import Record, replace
from ...kernel.vector_types import vector
from .expressions import ExpressionTypes
from .kernel import (
    BOOL,
    FLOAT,
    INT,
    BoundFunction,
    BuiltinCall,
    Function,
    Kernel,
    KernelCall,
    MathCall,
    Scalar,
    Several,
    Type,
    is_self_attribute,
    length_of,
)
from .matrices import MAKERS
from .source import find_global, find_method
from .subset_table import (
    BUILTIN_FUNCTIONS,
    ELEMENTARY_FUNCTIONS,
    MATH_FUNCTIONS,
    OTHER_FUNCTION,
    REFUSED_FUNCTIONS,
    REFUSED_MATH,
    RULES,
)

# Gives the Function for a callee and the types of its arguments; None after a violation in its declaration.
Resolver = Callable[[FunctionType, type | None, ast.Call, list[Type]], Function | None]


class CallTypes(ExpressionTypes):
    """Resolver of calls of other kernel functions, of `math` and of built-ins."""

    def __init__(self, kernel: Kernel, function: Function, resolve: Resolver, bound: set[str]) -> None:
        super().__init__(kernel, function, bound)
        self.resolve = resolve

    def infer_call(self, node: ast.Call) -> Type | None:
        """Infer the type of a call used as a value; calls without a value are statements."""
        returned = self._value_of(node)
        if not isinstance(returned, Several):
            return returned
        self.report(node, "several values", name=ast.unparse(node.func), got=returned)
        return None

    def infer_several(self, node: ast.expr) -> Type | Several | None:
        """Infer the type of an expression that is returned or assigned to several targets."""
        if not isinstance(node, ast.Call):
            return self.infer(node)
        self.function.types[node] = returned = self._value_of(node)
        return returned

    def _value_of(self, node: ast.Call) -> Type | Several | None:
        returned = self.call(node)
        if not isinstance(returned, Function):
            return returned
        if returned.returns is None:
            self.report(node, "number", name="the value", got=f"{returned.name}, which returns None")
        return returned.returns

    def call(self, node: ast.Call) -> Function | Type | Several | None:
        """Resolve a call; return the called kernel function, otherwise the type of the value."""
        if self._callee(node.func)[0] is vector:
            return self.make_vector(node)
        matrix = self.make_matrix(node, self._callee(node.func)[0])
        if matrix is not None or node in self.function.calls:
            return matrix
        if self._callee(node.func)[0] in MAKERS:
            return None
        record = self._record(node.func)
        if record is not None:
            return self.make_record(node, record)
        if node.keywords:
            self.report(node, "keyword")
        for argument in node.args:
            self._infer_argument(argument)
        name = ast.unparse(node.func)
        callee, owner = self._callee(node.func)
        if isinstance(callee, FunctionType):
            types = [self.function.types[argument] for argument in node.args]
            if node.keywords or None in types:
                return None
            computing = getattr(callee, "__wrapped__", None)
            if computing in FAULTS:
                function = self.resolve(computing, None, node, types)  # type: ignore[arg-type]
                if function is not None:
                    known = ELEMENTARY_FUNCTIONS[callee.__name__]
                    self.function.calls[node] = MathCall(callee.__name__, known, function)
                return FLOAT
            function = self.resolve(callee, owner, node, types)  # type: ignore[arg-type]
            if function is not None:
                self.function.calls[node] = KernelCall(function)
            return function
        if callee in BUILTIN_FUNCTIONS:
            return self._builtin(node, name)
        if isinstance(callee, str) and callee in MATH_FUNCTIONS:
            return self._math(node, name, callee)
        if self.report_missing(node.func):
            return None
        if isinstance(callee, str) and callee in ELEMENTARY_FUNCTIONS:
            self.report(node, RULES["function"], name=name, remedy=REFUSED_MATH.format(name=callee))
            return FLOAT
        short = name.split(".")[-1]
        self.report(node, RULES["function"], name=name, remedy=REFUSED_FUNCTIONS.get(short, OTHER_FUNCTION))
        return None

    def _infer_argument(self, node: ast.expr) -> None:
        """Infer the type of an argument, which may be a function or a method of the block."""
        if is_self_attribute(node) and self.function.source.owner is not None:
            assert isinstance(node, ast.Attribute)
            method = find_method(self.function.block_class, node.attr)
            if method is not None:
                self.function.types[node] = BoundFunction(*method)
                return
        if isinstance(node, ast.Name) and node.id not in self.bound and node.id not in self.function.parameters:
            value = find_global(self.function.source.function, node.id)
            if isinstance(value, FunctionType):
                self.function.types[node] = BoundFunction(value, None)
                return
        self.infer(node)

    def _record(self, node: ast.expr) -> type[Record] | FunctionType | None:
        """Return the record class that a call creates, or `replace`."""
        if not isinstance(node, ast.Name) or node.id in self.bound or node.id in self.function.parameters:
            return None
        value = find_global(self.function.source.function, node.id)
        if value is replace:
            return replace  # type: ignore[return-value]
        return value if isinstance(value, type) and issubclass(value, Record) else None

    def _callee(self, node: ast.expr) -> tuple[FunctionType | str | None, type | None]:
        """Return the target of a call: a Python function with its class, or the name of a permitted built-in or math
        function.
        """
        source = self.function.source
        bound = self.function.parameters.get(node.id) if isinstance(node, ast.Name) else None
        if isinstance(bound, BoundFunction):
            return bound.function, bound.owner
        if isinstance(node, ast.Name) and node.id not in self.bound and node.id not in self.function.parameters:
            value = find_global(source.function, node.id)
            if isinstance(value, FunctionType):
                return value, None
            if value is None and hasattr(builtins, node.id):
                return node.id if node.id in BUILTIN_FUNCTIONS else None, None
            is_math = value is not None and getattr(math, getattr(value, "__name__", ""), None) is value
            return (value.__name__ if is_math else None), None
        if not isinstance(node, ast.Attribute):
            return None, None
        if source.owner is not None:
            after = source.owner if is_super(node.value) else None
            if is_self_attribute(node) or after is not None:
                return find_method(self.function.block_class, node.attr, after) or (None, None)
        module = self._module(node.value)
        if module is math:
            return node.attr, None
        value = getattr(module, node.attr, None) if module else None
        return (value if isinstance(value, FunctionType) else None), None

    def _math(self, node: ast.Call, name: str, callee: str) -> Type | Several:
        """Infer the type of a call of a `math` function."""
        function = MATH_FUNCTIONS[callee]
        self.function.calls[node] = MathCall(callee, function)
        self._count(node, name, len(function.takes))
        to_int = function.returns == ("int",)
        for argument, takes in zip(node.args, function.takes, strict=False):
            got = self.function.types[argument]
            widened = takes == "float" and got is INT and not to_int
            if got not in (Scalar(takes), None) and not widened:
                self.report(argument, "number", name=name, got=got)
        returns = tuple(Scalar(kind) for kind in function.returns)
        return returns[0] if len(returns) == 1 else Several(returns)

    def _builtin(self, node: ast.Call, name: str) -> Type | None:
        self.function.calls[node] = BuiltinCall(name)
        if not self._count(node, name, 1):
            return None
        argument = self.function.types[node.args[0]]
        if name == "len":
            if argument is not None and length_of(argument) is None:
                self.report(
                    node,
                    "argument type",
                    name=name,
                    expected="a list, vector or matrix",
                    argument="its argument",
                    got=argument,
                )
            return INT
        if argument is not None and (not isinstance(argument, Scalar) or (name == "abs" and argument is BOOL)):
            self.report(node, "number", name=name, got=argument)
            return None
        if name == "abs" and isinstance(argument, Scalar):
            return argument
        return FLOAT if name == "float" else INT

    def _count(self, node: ast.Call, name: str, expected: int) -> bool:
        if len(node.args) != expected:
            self.report(node, "argument count", name=name, expected=expected, got=len(node.args))
        return len(node.args) == expected


def is_super(node: ast.expr) -> bool:
    """Return True if a node is ``super()``."""
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "super" and not node.args
