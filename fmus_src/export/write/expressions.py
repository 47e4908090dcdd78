"""Expressions of a kernel function as C text."""

from __future__ import annotations

import ast
from typing import Protocol

from ..judge.effects import makes_matrix, own_outcome
from ..judge.kernel import (
    FLOAT,
    INT,
    Bound,
    BuiltinCall,
    Function,
    KernelCall,
    List,
    MakeRecord,
    MakeVector,
    MathCall,
    Matrix,
    RecordType,
    Scalar,
    Several,
    Vector,
    is_self_attribute,
    length_of,
)
from .names import C_TYPES, c_type, identifier, literal
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
from .writer import FunctionWriter

EXACT = {"ldexp": "exact_ldexp", "frexp": "exact_frexp"}
WHOLE = {"floor": "whole_floor", "ceil": "whole_ceil", "int": "whole_trunc"}


class MatrixText(Protocol):
    """The writer of matrices, as the writer of expressions sees it."""

    def write(self, node: ast.expr) -> tuple[str, int]:
        """Return a matrix that is no variable, or a vector made by one, with its precedence."""

    def write_part(self, node: ast.Subscript) -> str:
        """Return ``p[i, j]`` or ``p[i, 0:3]``."""


class ExpressionWriter:
    """Writes one function's expressions; hoisted parts are statements of ``out`` before.

    Whoever makes one sets ``matrices``, whose elements are expressions again.
    """

    matrices: MatrixText

    def __init__(self, out: FunctionWriter) -> None:
        self.function = out.function
        self.names = out.names
        self.hoist = out.hoist

    def write(self, node: ast.expr, outer: int = CONDITIONAL) -> str:
        """C text of an expression, in parentheses where the operator around it binds tighter."""
        if makes_matrix(self.function, node) and not isinstance(self.function.calls.get(node), KernelCall):  # type: ignore[call-overload]
            return parenthesise(self.matrices.write(node), outer)
        text, precedence = getattr(self, f"write_{type(node).__name__.lower()}")(node)
        if node in self.function.hoisted:
            return self.hoist(node, text)
        return parenthesise((text, precedence), outer)

    def write_as_float(self, node: ast.expr, outer: int) -> str:
        """An operand that Python widens to float."""
        if self.function.types[node] is not INT:
            return self.write(node, outer)
        if isinstance(node, ast.Constant):
            return literal(float(node.value))  # type: ignore[arg-type]
        text = f"(double){self.write(node, UNARY)}"
        return f"({text})" if outer > UNARY else text

    def call(self, name: str, *arguments: str) -> str:
        return f"{name}({', '.join(arguments)})"

    def write_checked(self, node: ast.expr, name: str, *arguments: str) -> tuple[str, int]:
        """A call of a function of kernel_math.h that can record a fault at the node's line."""
        return self.call(name, f"AT({node.lineno})", *arguments), ATOM

    def write_constant(self, node: ast.Constant) -> tuple[str, int]:
        return literal(node.value), ATOM  # type: ignore[arg-type]

    def write_name(self, node: ast.Name) -> tuple[str, int]:
        if isinstance(self.function.types.get(node), Matrix) and node.id in self.function.parameters:
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
        """What follows a list or vector to mean one element."""
        member = ".x" if isinstance(self.function.types[node.value], Vector) else ""
        return f"{member}[{index or self.index(node)}]"

    def elements(self, node: ast.expr) -> list[str]:
        """The elements of a part, ``wrench[0:3]``, or of a whole list."""
        holder = node.value if isinstance(node, ast.Subscript) else node
        member = ".x" if isinstance(self.function.types[holder], Vector) else ""
        return [f"{self.write(holder, ATOM)}{member}[{k}]" for k in self.function.parts[node]]

    def vector(self, elements: list[str]) -> str:
        """A vector of components; in parentheses for its commas, since isfinite and fabs are macros."""
        return f"(({c_type(Vector(len(elements)))}){{{{{', '.join(elements)}}}}})"

    def write_tuple(self, node: ast.Tuple) -> tuple[str, int]:
        """Several return values."""
        kind = self.function.types[node]
        assert isinstance(kind, Several)
        return f"({c_type(kind)}){{{', '.join(self.write(part) for part in node.elts)}}}", ATOM

    def index(self, node: ast.Subscript) -> str:
        """The index of an element; checked where it was not proven right."""
        container = self.function.types[node.value]
        assert isinstance(container, List | Vector)
        text = self.write(node.slice)
        if node in self.function.unproven:
            return self.write_checked(node, "py_index", text, str(container.size))[0]
        return text

    def write_binop(self, node: ast.BinOp) -> tuple[str, int]:
        if self.function.types[node] is INT:
            return self._int_operation(node)
        if isinstance(self.function.types[node], Vector):
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
        """An operator on vectors of one size, or on a vector and a number."""
        operands = [node.left, node.right]
        both = all(isinstance(self.function.types[operand], Vector) for operand in operands)
        if isinstance(node.op, ast.Mult) and not both:
            operands.sort(key=lambda operand: isinstance(self.function.types[operand], Vector))  # the number first
            name = "scale"
        elif isinstance(node.op, ast.Div) and both:
            name = "quotient"
        else:
            name = VECTOR_NAMES[type(node.op)]
        kind = self.function.types[node]
        assert isinstance(kind, Vector)
        texts = [self.write_as_float(operand, CONDITIONAL) for operand in operands]
        if own_outcome(self.function, node):
            return self.write_checked(node, f"py_{name}{kind.size}", *texts)
        return self.call(f"{name}{kind.size}", *texts), ATOM

    def _record_operation(self, node: ast.BinOp) -> tuple[str, int]:
        """An operator on two records, or on a record and a number."""
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
        if isinstance(kind, Vector):
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

    def write_call(self, node: ast.Call) -> tuple[str, int]:
        call = self.function.calls[node]
        if isinstance(call, KernelCall):
            return self._kernel_call(node, call.callee), ATOM
        if isinstance(call, MakeVector):
            starred = node.args[0].value if isinstance(node.args[0], ast.Starred) else None
            return self.vector(self.elements(starred) if starred else [self.write(part) for part in node.args]), ATOM
        if isinstance(call, MakeRecord):
            return self._make_record(node, call.kind), ATOM
        if isinstance(call, MathCall):
            if call.name in WHOLE:
                return self._whole(node, call.name, "py_whole_int")
            arguments = [
                self.write_as_float(argument, CONDITIONAL) if takes == "float" else self.write(argument)
                for argument, takes in zip(node.args, call.function.takes, strict=True)
            ]
            if own_outcome(self.function, node):
                return self.write_checked(node, f"py_{call.name}", *arguments)
            return self.call(EXACT.get(call.name, call.name), *arguments), ATOM
        assert isinstance(call, BuiltinCall)
        return self._builtin(node, call)

    def _kernel_call(self, node: ast.Call, callee: Function) -> str:
        arguments = ["self"] if callee.takes_block else []
        if callee.can_fault:
            arguments.append("fault")
        passed = [each for each in node.args if not isinstance(self.function.types[each], Bound)]
        return self.call(self.names.functions[callee], *arguments, *[self._argument(argument) for argument in passed])

    def _argument(self, node: ast.expr) -> str:
        """An argument; a matrix by its address."""
        text = self.write(node)
        if not isinstance(self.function.types[node], Matrix):
            return text
        if isinstance(self.function.calls.get(node), KernelCall) and not text.isidentifier():  # type: ignore[call-overload]
            text = self.hoist(node, text)
        return text[2:-1] if text.startswith("(*") else f"&{text}"

    def _make_record(self, node: ast.Call, kind: RecordType) -> str:
        """A record of all its fields, or one with some of another's."""
        given = {keyword.arg: self.write(keyword.value) for keyword in node.keywords}
        holder = self.write(node.args[0], ATOM) if node.args else ""
        values = [given.get(name, f"{holder}.{identifier(name)}") for name in kind.record.fields]
        return f"(({c_type(kind)}){{{', '.join(values)}}})"

    def _builtin(self, node: ast.Call, call: BuiltinCall) -> tuple[str, int]:
        argument = node.args[0]
        kind = self.function.types[argument]
        if call.name == "len":
            return str(length_of(kind)), ATOM  # type: ignore[arg-type]
        if call.name == "abs":
            if kind is FLOAT:
                return self.call("fabs", self.write(argument)), ATOM
            if node in self.function.unproven:
                return self.write_checked(node, "py_int_abs", self.write(argument))
            return self.call("int_abs", self.write(argument)), ATOM
        if call.name == "int" and kind is FLOAT:
            return self._whole(node, "int", "py_whole_int")
        if call.name == "float" and isinstance(argument, ast.Call) and argument not in self.function.hoisted:
            inner = self.function.calls[argument]
            whole = isinstance(inner, MathCall | BuiltinCall) and inner.name in WHOLE
            if whole and self.function.types[argument.args[0]] is FLOAT:
                return self._whole(argument, inner.name, "py_whole_float")  # type: ignore[union-attr]
        target = Scalar(call.name)
        if kind is target:
            return self.write(argument, ATOM), ATOM
        return f"({C_TYPES[target]}){self.write(argument, UNARY)}", UNARY

    def _whole(self, node: ast.Call, name: str, checked: str) -> tuple[str, int]:
        """math.floor, math.ceil or int of a float, as int or as float."""
        if self.function.is_total:
            cast = "(int64_t)" if checked == "py_whole_int" else ""
            return f"{cast}{self.call(WHOLE[name], self.write(node.args[0]))}", UNARY
        return self.write_checked(node, checked, self.call(WHOLE[name], self.write(node.args[0])))
