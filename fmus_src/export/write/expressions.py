"""C text of the expressions in a kernel function."""

from __future__ import annotations

import ast
from typing import Protocol

from ..judge.effects import makes_matrix, own_outcome
from ..judge.kernel import (
    FLOAT,
    INT,
    KernelCall,
    List,
    MatrixType,
    RecordType,
    Several,
    VectorType,
    is_self_attribute,
)
from .calls import CallWriter
from .names import c_type, identifier, literal
from .operators import (
    AND,
    ATOM,
    CHECKED_INT,
    CONDITIONAL,
    EQUALITY,
    OPERATORS,
    OR,
    SUM,
    UNARY,
    VECTOR_NAMES,
    parenthesise,
)


class MatrixText(Protocol):
    """Interface of the matrix writer that the expression writer uses."""

    def write(self, node: ast.expr) -> tuple[str, int]:
        """Return C text and precedence of a matrix that is not a variable, or of a vector computed from a matrix."""

    def write_part(self, node: ast.Subscript) -> str:
        """Return the C text of ``p[i, j]`` or ``p[i, 0:3]``."""


class ExpressionWriter(CallWriter):
    """Writer of one function's expressions.

    The statement writer sets ``matrices``, since elements of matrices contain expressions in turn.
    """

    matrices: MatrixText

    def write(self, node: ast.expr, outer: int = CONDITIONAL) -> str:
        """Return the C text of an expression, in parentheses if the surrounding operator has higher precedence."""
        if makes_matrix(self.function, node) and not isinstance(self.function.calls.get(node), KernelCall):  # type: ignore[call-overload]
            return parenthesise(self.matrices.write(node), outer)
        text, precedence = self._write_by_syntax(node)
        if node in self.function.hoisted:
            return self.hoist(node, text)
        return parenthesise((text, precedence), outer)

    def _write_by_syntax(self, node: ast.expr) -> tuple[str, int]:
        """Return the C text of an accepted expression with its precedence."""
        match node:
            case ast.Constant():
                return self.write_constant(node)
            case ast.Name():
                return self.write_name(node)
            case ast.Attribute():
                return self.write_attribute(node)
            case ast.Subscript():
                return self.write_subscript(node)
            case ast.Call():
                return self.write_call(node)
            case ast.BinOp():
                return self.write_binop(node)
            case ast.UnaryOp():
                return self.write_unaryop(node)
            case ast.BoolOp():
                return self.write_boolop(node)
            case ast.Compare():
                return self.write_compare(node)
            case ast.IfExp():
                return self.write_ifexp(node)
            case ast.Tuple():
                return self.write_tuple(node)
        raise TypeError(f"{type(node).__name__} passed the kernel check but cannot be translated")

    def write_constant(self, node: ast.Constant) -> tuple[str, int]:
        return literal(node.value), ATOM  # type: ignore[arg-type]

    def write_name(self, node: ast.Name) -> tuple[str, int]:
        if isinstance(self.function.types.get(node), MatrixType) and node.id in self.function.parameters:
            return f"(*{identifier(node.id)})", ATOM
        constant = self.function.constants.get(node)
        return (self.names.constants[constant] if constant else identifier(node.id)), ATOM

    def write_attribute(self, node: ast.Attribute) -> tuple[str, int]:
        if is_self_attribute(node):
            return f"self->{identifier(node.attr)}", ATOM
        if node in self.function.fields:
            return f"{self.write(node.value, ATOM)}.{identifier(node.attr)}", ATOM
        if node in self.function.components:
            return f"{self.write(node.value, ATOM)}.x[{self.function.components[node]}]", ATOM
        return self.names.constants[self.function.constants[node]], ATOM

    def write_subscript(self, node: ast.Subscript) -> tuple[str, int]:
        if node in self.function.blocks:
            return self.matrices.write_part(node), ATOM
        if node in self.function.parts:
            return self.vector(self.elements(node)), ATOM
        return f"{self.write(node.value, ATOM)}{self.place(node)}", ATOM

    def place(self, node: ast.Subscript, index: str = "") -> str:
        """Return the C suffix that selects one element of a list or vector."""
        member = ".x" if isinstance(self.function.types[node.value], VectorType) else ""
        return f"{member}[{index or self.index(node)}]"

    def write_tuple(self, node: ast.Tuple) -> tuple[str, int]:
        """Return the C text of several return values."""
        kind = self.function.types[node]
        assert isinstance(kind, Several)
        return f"({c_type(kind)}){{{', '.join(self.write(part) for part in node.elts)}}}", ATOM

    def index(self, node: ast.Subscript) -> str:
        """Return the C text of an element's index, checked if it was not proven valid."""
        container = self.function.types[node.value]
        assert isinstance(container, List | VectorType)
        text = self.write(node.slice)
        if node in self.function.unproven:
            return self.write_checked(node, "py_index", text, str(container.size))[0]
        return text

    def write_binop(self, node: ast.BinOp) -> tuple[str, int]:
        if self.function.types[node] is INT:
            return self._int_operation(node)
        if isinstance(self.function.types[node], VectorType):
            return self._vector_operation(node)
        if isinstance(self.function.types[node], RecordType):
            return self._record_operation(node)
        operator, precedence = OPERATORS.get(type(node.op), ("", CONDITIONAL))
        fails = bool(own_outcome(self.function, node))
        if not operator:
            name = "float_modulo" if isinstance(node.op, ast.Mod) else "float_floor_divide"
        elif fails:
            name = "divide"
        else:
            left, right = self.write_as_float(node.left, precedence), self.write_as_float(node.right, precedence + 1)
            return f"{left} {operator} {right}", precedence
        operands = self.write_as_float(node.left, CONDITIONAL), self.write_as_float(node.right, CONDITIONAL)
        if fails:
            return self.write_checked(node, f"py_{name}", *operands)
        return self.call(name, *operands), ATOM

    def _vector_operation(self, node: ast.BinOp) -> tuple[str, int]:
        """Return the C text of an operator on two vectors of one size, or on a vector and a number."""
        operands = [node.left, node.right]
        both = all(isinstance(self.function.types[operand], VectorType) for operand in operands)
        if isinstance(node.op, ast.Mult) and not both:
            operands.sort(key=lambda operand: isinstance(self.function.types[operand], VectorType))  # the number first
            name = "scale"
        elif isinstance(node.op, ast.Div) and both:
            name = "quotient"
        else:
            name = VECTOR_NAMES[type(node.op)]
        kind = self.function.types[node]
        assert isinstance(kind, VectorType)
        texts = [self.write_as_float(operand, CONDITIONAL) for operand in operands]
        if own_outcome(self.function, node):
            return self.write_checked(node, f"py_{name}{kind.size}", *texts)
        return self.call(f"{name}{kind.size}", *texts), ATOM

    def _record_operation(self, node: ast.BinOp) -> tuple[str, int]:
        """Return the C text of an operator on two records, or on a record and a number."""
        operands = [node.left, node.right]
        kind = self.function.types[node]
        assert isinstance(kind, RecordType)
        name = VECTOR_NAMES[type(node.op)]
        if isinstance(node.op, ast.Mult):
            operands.sort(key=lambda operand: isinstance(self.function.types[operand], RecordType))  # the number first
            name = "scale"
        texts = [self.write_as_float(operand, CONDITIONAL) for operand in operands]
        if own_outcome(self.function, node):
            return self.write_checked(node, f"py_divide_{c_type(kind)}", *texts)
        return self.call(f"{name}_{c_type(kind)}", *texts), ATOM

    def _int_operation(self, node: ast.BinOp) -> tuple[str, int]:
        unproven = node in self.function.unproven
        if isinstance(node.op, ast.FloorDiv | ast.Mod):
            name = "int_modulo" if isinstance(node.op, ast.Mod) else "int_floor_divide"
            operands = self.write(node.left), self.write(node.right)
            return self.write_checked(node, f"py_{name}", *operands) if unproven else (self.call(name, *operands), ATOM)
        if unproven:
            return self.write_checked(node, CHECKED_INT[type(node.op)], self.write(node.left), self.write(node.right))
        operator, precedence = OPERATORS[type(node.op)]
        return f"{self.write(node.left, precedence)} {operator} {self.write(node.right, precedence + 1)}", precedence

    def write_unaryop(self, node: ast.UnaryOp) -> tuple[str, int]:
        if isinstance(node.op, ast.Not):
            return f"!{self.write(node.operand, UNARY)}", UNARY
        if isinstance(node.op, ast.UAdd):
            return self.write(node.operand, UNARY), UNARY
        if node in self.function.unproven:
            return self.write_checked(node, "py_negative", self.write(node.operand))
        kind = self.function.types[node]
        if isinstance(kind, VectorType):
            return self.call(f"negative{kind.size}", self.write(node.operand)), ATOM
        if isinstance(kind, RecordType):
            return self.call(f"negative_{c_type(kind)}", self.write(node.operand)), ATOM
        inner = self.write(node.operand, UNARY)
        return (f"-({inner})" if inner.startswith("-") else f"-{inner}"), UNARY

    def write_boolop(self, node: ast.BoolOp) -> tuple[str, int]:
        operator, precedence = ("&&", AND) if isinstance(node.op, ast.And) else ("||", OR)
        # parentheses between && and ||: compilers warn without them
        return f" {operator} ".join(self.write(value, EQUALITY) for value in node.values), precedence

    def write_compare(self, node: ast.Compare) -> tuple[str, int]:
        operator, precedence = OPERATORS[type(node.ops[0])]
        left, right = node.left, node.comparators[0]
        write = self.write_as_float if FLOAT in (self.function.types[left], self.function.types[right]) else self.write
        return f"{write(left, SUM)} {operator} {write(right, SUM)}", precedence

    def write_ifexp(self, node: ast.IfExp) -> tuple[str, int]:
        parts = self.write(node.test, OR), self.write(node.body, OR), self.write(node.orelse, CONDITIONAL)
        return "{} ? {} : {}".format(*parts), CONDITIONAL
