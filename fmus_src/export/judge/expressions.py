"""Types of the expressions in one kernel function, and rejection of expressions outside the subset."""

from __future__ import annotations

import ast
import builtins
import math
import operator
from abc import abstractmethod
from collections.abc import Callable
from types import ModuleType
from typing import Any

from ...face import HOME_OF
from ...kernel import vector_types
from ...kernel.enumerations import Enumeration
from ...variables import Input, Parameter, Variable
from .kernel import (
    BOOL,
    FLOAT,
    INT,
    Constant,
    Function,
    Kernel,
    List,
    MatrixType,
    RecordType,
    Type,
    VectorType,
    is_self_attribute,
    length_of,
)
from .matrices import MatrixTypes
from .source import find_global, origin_of_constant
from .subset_table import (
    COMPARISONS,
    ELEMENTARY_FUNCTIONS,
    MATH_CONSTANTS,
    MATH_FUNCTIONS,
    OPERATORS,
    OTHER_SYNTAX,
    REFUSED_SYNTAX,
    SubsetRule,
)

SCALARS = {float: FLOAT, int: INT, bool: BOOL}
INT64_MAX = 2**63 - 1
SIZE_OPERATORS: dict[type[ast.operator], Callable[[int, int], int]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}


class ExpressionTypes(MatrixTypes):
    """Bottom-up type inference; the type None means unknown because of a violation already reported."""

    def __init__(self, kernel: Kernel, function: Function, bound: set[str]) -> None:
        self.kernel = kernel
        self.function = function
        self.bound = bound  # names that are local to the function

    def report(self, node: ast.AST, rule: str | SubsetRule, **details: object) -> None:
        self.kernel.report(self.function.source, node, rule, **details)

    def refuse_syntax(self, node: ast.AST) -> None:
        """Report unsupported syntax, with the remedy in the table of rules."""
        self.report(node, REFUSED_SYNTAX.get(type(node), OTHER_SYNTAX), name=type(node).__name__)

    def infer(self, node: ast.expr) -> Type | None:
        """Infer the type of an expression; the types of all operands are stored in the function."""
        self.function.types[node] = inferred = self._infer_by_syntax(node)
        return inferred

    def _infer_by_syntax(self, node: ast.expr) -> Type | None:
        """Return the type of an expression of the subset; report other expressions."""
        match node:
            case ast.Constant():
                return self.infer_constant(node)
            case ast.Name():
                return self.infer_name(node)
            case ast.Attribute():
                return self.infer_attribute(node)
            case ast.Subscript():
                return self.infer_subscript(node)
            case ast.Call():
                return self.infer_call(node)
            case ast.BinOp():
                return self.infer_binop(node)
            case ast.UnaryOp():
                return self.infer_unaryop(node)
            case ast.BoolOp():
                return self.infer_boolop(node)
            case ast.Compare():
                return self.infer_compare(node)
            case ast.IfExp():
                return self.infer_ifexp(node)
        self.refuse_syntax(node)
        return None

    @abstractmethod
    def infer_call(self, node: ast.Call) -> Type | None:
        """Return the type of a call used as a value."""

    def static_size(self, node: ast.expr) -> int | None:
        """Return the constant value of an int literal, constant or length, or of a sum, product or quotient of these.

        Such values are sizes of lists and matrices, and bounds of slices. Returns None for an int that is not constant.
        """
        return self._fold(node) if self.infer(node) is INT else None

    def _fold(self, node: ast.expr) -> int | None:
        """Return the value of a constant int expression."""
        if node in self.function.constants:
            return self.function.constants[node].value
        match node:
            case ast.Constant(value=int(number)):
                return number
            case ast.Call(func=ast.Name(id="len")):
                return length_of(self.function.types[node.args[0]])
            case ast.BinOp():
                left, right = self._fold(node.left), self._fold(node.right)
                operate = SIZE_OPERATORS.get(type(node.op))
                divides = isinstance(node.op, ast.FloorDiv | ast.Mod)
                if operate is None or left is None or right is None or (divides and right <= 0):
                    return None
                return operate(left, right)
        return None

    def infer_condition(self, node: ast.expr) -> None:
        """Check an operand that must be a bool."""
        kind = self.infer(node)
        if kind not in (BOOL, None):
            self.report(node, "condition", got=kind)

    def infer_constant(self, node: ast.Constant) -> Type | None:
        kind = SCALARS.get(type(node.value))
        if kind is None:
            self.report(node, "string")
        elif kind is INT and node.value > INT64_MAX:  # type: ignore[operator]
            self.report(node, "int literal")
        return kind

    def infer_name(self, node: ast.Name) -> Type | None:
        if node.id in self.function.parameters:
            return self.function.parameters[node.id]
        if node.id in self.bound:
            return self.function.locals.get(node.id)  # unknown: flow.py reports it as unbound
        module = origin_of_constant(self.function.source.function, node.id)
        return self._constant(node, module, node.id, find_global(self.function.source.function, node.id))

    def infer_attribute(self, node: ast.Attribute) -> Type | None:
        if is_self_attribute(node) and self.function.is_method:
            variable = self.function.block_class.variables.get(node.attr)
            if variable is None:
                self.report(node, "undeclared", name=node.attr)
                return None
            return type_of_variable(variable)
        module = self._module(node.value)
        if module is math and node.attr in MATH_CONSTANTS:
            return self._constant(node, "math", node.attr, MATH_CONSTANTS[node.attr])
        if module is not None and module is not math:
            return self._constant(node, module.__name__, node.attr, getattr(module, node.attr, None))
        enumeration = self._enumeration(node.value)
        if enumeration is not None:
            return self._constant(node, enumeration.__module__, node.attr, vars(enumeration).get(node.attr))
        if not isinstance(node.value, ast.Name) or node.value.id in {*self.bound, *self.function.parameters}:
            holder = self.infer(node.value)
            if isinstance(holder, VectorType):
                return self.component(node, holder)
            if isinstance(holder, MatrixType):
                return self.transpose(node, holder)
            if isinstance(holder, RecordType):
                return self.field(node, holder)
            if holder is None:
                return None
        if not self.report_missing(node):
            self.report(node, "unknown name", name=ast.unparse(node))
        return None

    def report_missing(self, node: ast.expr) -> bool:
        """Report a name of `math` or `perilune` used without import; return True if it is such a name."""
        name = node.value if isinstance(node, ast.Attribute) else node
        if not isinstance(name, ast.Name) or name.id in {*self.bound, *self.function.parameters}:
            return False
        if find_global(self.function.source.function, name.id) is not None:
            return False
        if name is not node and name.id == "math":
            refused = node.attr in ELEMENTARY_FUNCTIONS  # type: ignore[attr-defined]
            words = f"from perilune import {node.attr}" if refused else "import math"  # type: ignore[attr-defined]
        elif name is node and name.id in MATH_FUNCTIONS and not hasattr(builtins, name.id):
            words = f"import math, and math.{name.id} here,"
        elif name is node and name.id in HOME_OF:
            words = f"from perilune import {name.id}"
        else:
            return False
        self.report(node, "no import", name=name.id, words=words)
        return True

    def _module(self, node: ast.expr) -> ModuleType | None:
        """Return the module that a name refers to, or None."""
        if isinstance(node, ast.Name) and node.id not in self.bound and node.id not in self.function.parameters:
            value = find_global(self.function.source.function, node.id)
            return value if isinstance(value, ModuleType) else None
        return None

    def _enumeration(self, node: ast.expr) -> type[Enumeration] | None:
        """Return the enumeration that a name refers to, or None."""
        if isinstance(node, ast.Name) and node.id not in {*self.bound, *self.function.parameters}:
            value = find_global(self.function.source.function, node.id)
            return value if isinstance(value, type) and issubclass(value, Enumeration) else None
        return None

    def _constant(self, node: ast.expr, module: str, name: str, value: Any) -> Type | None:
        if isinstance(value, vector_types.Vector):
            self.function.constants[node] = Constant(module, name, value)
            return VectorType(len(value))
        elements = value if isinstance(value, tuple) else (value,)
        kinds = {type(element) for element in elements}
        if len(kinds) != 1 or not kinds <= set(SCALARS):
            self.report(node, "unknown name", name=ast.unparse(node))
            return None
        self.function.constants[node] = Constant(module, name, value)
        scalar = SCALARS[kinds.pop()]
        return List(scalar, len(elements)) if isinstance(value, tuple) else scalar

    def infer_subscript(self, node: ast.Subscript) -> Type | None:
        container = self.infer(node.value)
        if isinstance(container, MatrixType):
            return self.part_of_matrix(node, container)
        if isinstance(node.slice, ast.Slice):
            return self.part_of_vector(node, container)
        if isinstance(node.slice, ast.Tuple):
            self.refuse_syntax(node.slice)
            return None
        index = self.infer(node.slice)
        if index not in (INT, None):
            self.report(node, "argument type", name="an index", expected=INT, argument="its value", got=index)
        if isinstance(container, List):
            return container.element
        if isinstance(container, VectorType):
            return FLOAT
        if container is not None:
            self.report(node, "number", name="an index", got=container)
        return None

    def infer_binop(self, node: ast.BinOp) -> Type | None:
        if not isinstance(node.op, OPERATORS):
            self.refuse_syntax_at(node, node.op)
            return None
        if isinstance(node.left, ast.List) or isinstance(node.right, ast.List):
            self.refuse_syntax(node.left if isinstance(node.left, ast.List) else node.right)
            return None
        kinds = self.infer(node.left), self.infer(node.right)
        if kinds[0] is None or kinds[1] is None:
            return None
        if isinstance(kinds[0], RecordType) or isinstance(kinds[1], RecordType):
            return self.operate_on_records(node, node.op, kinds[0], kinds[1])
        if isinstance(node.op, ast.MatMult) or isinstance(kinds[0], MatrixType) or isinstance(kinds[1], MatrixType):
            return self.operate_on_matrices(node, node.op, kinds[0], kinds[1])
        if isinstance(kinds[0], VectorType) or isinstance(kinds[1], VectorType):
            return self.operate_on_vectors(node, node.op, kinds[0], kinds[1])
        for operand, kind in zip((node.left, node.right), kinds, strict=True):
            if kind not in (FLOAT, INT):
                self.report(operand, "number", name=f"operator {type(node.op).__name__}", got=kind)
                return None
        if isinstance(node.op, ast.Div) or FLOAT in kinds:
            return FLOAT
        return INT

    def refuse_syntax_at(self, node: ast.AST, part: ast.AST) -> None:
        """Report an operator, which has no line number, at the expression that contains it."""
        self.report(node, REFUSED_SYNTAX.get(type(part), OTHER_SYNTAX), name=type(part).__name__)

    def infer_unaryop(self, node: ast.UnaryOp) -> Type | None:
        if isinstance(node.op, ast.Not):
            self.infer_condition(node.operand)
            return BOOL
        if isinstance(node.op, ast.USub | ast.UAdd):
            kind = self.infer(node.operand)
            space = isinstance(kind, VectorType | MatrixType) or (isinstance(kind, RecordType) and kind.is_space)
            if kind in (FLOAT, INT) or (space and isinstance(node.op, ast.USub)):
                return kind
            if kind is not None:
                self.report(node.operand, "number", name="a sign", got=kind)
            return None
        self.refuse_syntax_at(node, node.op)
        return None

    def infer_boolop(self, node: ast.BoolOp) -> Type | None:
        for value in node.values:
            self.infer_condition(value)
        return BOOL

    def infer_compare(self, node: ast.Compare) -> Type | None:
        if len(node.ops) > 1:
            self.report(node, "chained comparison")
            return BOOL
        left, right = self.infer(node.left), self.infer(node.comparators[0])
        if not isinstance(node.ops[0], COMPARISONS):
            self.refuse_syntax_at(node, node.ops[0])
        elif left is not None and right is not None:
            numbers = left in (FLOAT, INT) and right in (FLOAT, INT)
            bools = left is BOOL and right is BOOL and isinstance(node.ops[0], ast.Eq | ast.NotEq)
            if not numbers and not bools:
                self.report(node, "comparison", left=left, right=right)
        return BOOL

    def infer_ifexp(self, node: ast.IfExp) -> Type | None:
        self.infer_condition(node.test)
        left, right = self.infer(node.body), self.infer(node.orelse)
        if left is None or right is None:
            return None
        if left != right or isinstance(left, List | MatrixType):
            self.report(node, "branches", left=left, right=right)
            return None
        return left


def type_of_variable(variable: Variable) -> Type:
    """Return the type of a declared variable."""
    if variable.record is not None:
        return RecordType(variable.record)
    scalar = SCALARS[type(variable.elements[0])]
    if variable.shape is not None:
        return MatrixType(*variable.shape, scalar)
    if variable.is_vector:
        return VectorType(variable.size)
    return List(scalar, variable.size) if variable.is_array else scalar


def is_read_only(function: Function, node: ast.expr) -> bool:
    """Return True if a list or scalar belongs to an input, a parameter or a constant."""
    if is_self_attribute(node):
        assert isinstance(node, ast.Attribute)
        return isinstance(function.block_class.variables.get(node.attr), Input | Parameter)
    return node in function.constants
