"""C text of the calls in a kernel function."""

from __future__ import annotations

import ast
from abc import ABC, abstractmethod

from ..judge.effects import own_outcome
from ..judge.kernel import (
    FLOAT,
    INT,
    BoundFunction,
    BuiltinCall,
    Function,
    KernelCall,
    MakeRecord,
    MakeVector,
    MathCall,
    MatrixType,
    RecordType,
    Scalar,
    VectorType,
    length_of,
)
from .names import C_TYPES, c_type, identifier, literal
from .operators import ATOM, CONDITIONAL, UNARY
from .writer import FunctionWriter

EXACT = {"ldexp": "exact_ldexp", "frexp": "exact_frexp"}
WHOLE = {"floor": "whole_floor", "ceil": "whole_ceil", "int": "whole_trunc"}


class CallWriter(ABC):
    """Writer of calls in expressions; hoisted operands become preceding statements of ``out``."""

    def __init__(self, out: FunctionWriter) -> None:
        self.function = out.function
        self.names = out.names
        self.hoist = out.hoist

    @abstractmethod
    def write(self, node: ast.expr, outer: int = CONDITIONAL) -> str:
        """Return the C text of an expression, in parentheses if the surrounding operator has higher precedence."""

    def write_as_float(self, node: ast.expr, outer: int) -> str:
        """Return the C text of an operand that Python widens to float."""
        if self.function.types[node] is not INT:
            return self.write(node, outer)
        if isinstance(node, ast.Constant):
            return literal(float(node.value))  # type: ignore[arg-type]
        text = f"(double){self.write(node, UNARY)}"
        return f"({text})" if outer > UNARY else text

    def call(self, name: str, *arguments: str) -> str:
        return f"{name}({', '.join(arguments)})"

    def write_checked(self, node: ast.expr, name: str, *arguments: str) -> tuple[str, int]:
        """Return the call of a function of kernel_math.h that can record a fault at the node's line."""
        return self.call(name, f"AT({node.lineno})", *arguments), ATOM

    def elements(self, node: ast.expr) -> list[str]:
        """Return the C texts of the elements of a slice, ``wrench[0:3]``, or of a whole list."""
        holder = node.value if isinstance(node, ast.Subscript) else node
        member = ".x" if isinstance(self.function.types[holder], VectorType) else ""
        return [f"{self.write(holder, ATOM)}{member}[{k}]" for k in self.function.parts[node]]

    def vector(self, elements: list[str]) -> str:
        """Return a vector of components, in parentheses because its commas would separate arguments of macros."""
        return f"(({c_type(VectorType(len(elements)))}){{{{{', '.join(elements)}}}}})"

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
        passed = [each for each in node.args if not isinstance(self.function.types[each], BoundFunction)]
        return self.call(self.names.functions[callee], *arguments, *[self._argument(argument) for argument in passed])

    def _argument(self, node: ast.expr) -> str:
        """Return the C text of an argument; a matrix is passed by its address."""
        text = self.write(node)
        if not isinstance(self.function.types[node], MatrixType):
            return text
        if isinstance(self.function.calls.get(node), KernelCall) and not text.isidentifier():  # type: ignore[call-overload]
            text = self.hoist(node, text)
        return text[2:-1] if text.startswith("(*") else f"&{text}"

    def _make_record(self, node: ast.Call, kind: RecordType) -> str:
        """Return the C text of a record with all its fields, or of a copy with some fields replaced."""
        keywords = {keyword.arg: self.write(keyword.value) for keyword in node.keywords}
        holder = self.write(node.args[0], ATOM) if node.args else ""
        values = [keywords.get(name, f"{holder}.{identifier(name)}") for name in kind.record.fields]
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
        """Return the C text of math.floor, math.ceil or int of a float, as int or as float."""
        if self.function.is_total:
            cast = "(int64_t)" if checked == "py_whole_int" else ""
            return f"{cast}{self.call(WHOLE[name], self.write(node.args[0]))}", UNARY
        return self.write_checked(node, checked, self.call(WHOLE[name], self.write(node.args[0])))
