"""Types of vector and record expressions: operators, components, fields, slices, construction."""

from __future__ import annotations

import ast
from abc import ABC, abstractmethod
from types import FunctionType
from typing import Any

from ...kernel.vector_types import VECTORS
from .kernel import (
    FLOAT,
    INT,
    Function,
    List,
    MakeRecord,
    MakeVector,
    RecordType,
    Several,
    Type,
    VectorType,
    is_self_attribute,
)
from .subset_table import SubsetRule

ON_VECTORS = (ast.Add, ast.Sub, ast.Mult, ast.Div)  # of two vectors, component by component
BY_NUMBERS = (ast.Mult, ast.Div)  # of a vector and a number


class VectorTypes(ABC):
    """Type inference of vector expressions."""

    function: Function

    @abstractmethod
    def report(self, node: ast.AST, rule: str | SubsetRule, **details: object) -> None:
        """Report a violation."""

    @abstractmethod
    def infer(self, node: ast.expr) -> Type | None:
        """Infer the type of an expression."""

    @abstractmethod
    def static_size(self, node: ast.expr) -> int | None:
        """Return the value of a constant int."""

    def operate_on_vectors(
        self, node: ast.AST, operator: ast.operator, left: Type | Several, right: Type | Several
    ) -> Type | None:
        """Infer the type of ``left operator right`` if at least one is a vector."""
        name = type(operator).__name__
        if isinstance(left, List) or isinstance(right, List):
            self.report(node, "list for vector", left=left, right=right)
        elif isinstance(left, VectorType) and isinstance(right, VectorType):
            if left.size != right.size:
                self.report(node, "vector sizes", left=left, right=right)
            elif isinstance(operator, ON_VECTORS):
                return left
            else:
                self.report(node, "vector operator", name=name, left=left, right=right)
        elif isinstance(left, VectorType) and right in (FLOAT, INT) and isinstance(operator, BY_NUMBERS):
            return left
        elif isinstance(right, VectorType) and left in (FLOAT, INT) and isinstance(operator, ast.Mult):
            return right
        else:
            self.report(node, "vector operator", name=name, left=left, right=right)
        return None

    def component(self, node: ast.Attribute, kind: VectorType) -> Type | None:
        """Infer the type of ``v.x``."""
        names = VECTORS[kind.size].names
        if node.attr not in names:
            self.report(node, "component", name=node.attr, kind=kind, names=", ".join(names))
            return None
        self.function.components[node] = names.index(node.attr)
        return FLOAT

    def part(self, node: ast.Subscript, container: Type | None) -> int | None:
        """Return the number of elements of a slice ``v[1:4]`` of a vector or list."""
        assert isinstance(node.slice, ast.Slice)
        if not isinstance(container, VectorType | List):
            if container is not None:
                self.report(node, "number", name="a part", got=container)
            return None
        if not is_variable(node.value):
            self.report(node, "part of an expression", name=ast.unparse(node.value))
            return None
        first = 0 if node.slice.lower is None else self.static_size(node.slice.lower)
        end = container.size if node.slice.upper is None else self.static_size(node.slice.upper)
        good = first is not None and end is not None and node.slice.step is None
        if not good or not 0 <= first < end <= container.size:  # type: ignore[operator]
            self.report(node, "part", part=ast.unparse(node), size=container.size)
            return None
        self.function.parts[node] = range(first, end)  # type: ignore[arg-type]
        return end - first  # type: ignore[operator]

    def part_of_vector(self, node: ast.Subscript, container: Type | None) -> Type | None:
        """Infer the type of ``v[1:4]`` as a value, which exists only for vectors."""
        if isinstance(container, List):
            self.report(node, "part of a list", part=ast.unparse(node))
            return None
        size = self.part(node, container)
        if size is None:
            return None
        if size not in VECTORS:
            self.report(node, "part", part=ast.unparse(node), size=len(self.function.parts.pop(node)))
            return None
        return VectorType(size)

    def make_vector(self, node: ast.Call) -> Type | None:
        """Infer the type of ``vector(x, y, z)`` or ``vector(*wrench[0:3])``."""
        if node.keywords:
            self.report(node, "keyword")
            return None
        if len(node.args) == 1 and isinstance(node.args[0], ast.Starred):
            size = self._unpack_starred(node.args[0].value)
        else:
            size = len(node.args)
            kinds = [self.infer(argument) for argument in node.args]
            for argument, kind in zip(node.args, kinds, strict=True):
                if kind not in (FLOAT, None):
                    self.report(
                        argument, "argument type", name="vector", expected=FLOAT, argument="a component", got=kind
                    )
            if None in kinds:
                return None
        if size is None:
            return None
        if size not in VECTORS:
            self.report(node, "vector size", got=size)
            return None
        self.function.calls[node] = MakeVector()
        return VectorType(size)

    def _unpack_starred(self, node: ast.expr) -> int | None:
        """Return the number of elements of ``*wrench[0:3]`` or ``*row``, and store its range."""
        holder = node.value if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Slice) else node
        container = self.infer(holder)
        if isinstance(container, List) and container.element is not FLOAT:
            self.report(node, "argument type", name="vector", expected="floats", argument="its list", got=container)
            return None
        if holder is not node:
            assert isinstance(node, ast.Subscript)
            return self.part(node, container)
        if not isinstance(container, List) or not is_variable(node):
            if container is not None:
                self.report(node, "argument type", name="vector", expected="a list", argument="*", got=container)
            return None
        self.function.parts[node] = range(container.size)
        return container.size


class RecordTypes(VectorTypes):
    """Type inference of record expressions."""

    def operate_on_records(
        self, node: ast.AST, operator: ast.operator, left: Type | Several, right: Type | Several
    ) -> Type | None:
        """Infer the type of ``left operator right`` if at least one is a record."""
        kind = left if isinstance(left, RecordType) else right
        assert isinstance(kind, RecordType)
        both = left == right and isinstance(operator, ast.Add | ast.Sub)
        scaled = isinstance(operator, ast.Mult) and (left in (FLOAT, INT) or right in (FLOAT, INT))
        divided = isinstance(operator, ast.Div) and right in (FLOAT, INT)
        if kind.is_space and (both or scaled or divided):
            return kind
        self.report(node, "record operator", name=type(operator).__name__, left=left, right=right)
        return None

    def field(self, node: ast.Attribute, kind: RecordType) -> Type | None:
        """Infer the type of ``s.speed``."""
        if node.attr not in kind.record.fields:
            self.report(node, "field", name=node.attr, kind=kind, names=", ".join(kind.record.fields))
            return None
        self.function.fields.add(node)
        return kind.field(node.attr)

    def make_record(self, node: ast.Call, record: Any) -> Type | None:
        """Infer the type of ``Motion(position=p, speed=v)`` or ``replace(s, speed=v)``."""
        if isinstance(record, FunctionType):
            kind = self.infer(node.args[0]) if len(node.args) == 1 and is_variable(node.args[0]) else None
            if not isinstance(kind, RecordType):
                self.report(node, "replace")
                return None
        else:
            kind = RecordType(record)
            if node.args or [keyword.arg for keyword in node.keywords] != list(record.fields):
                self.report(node, "record", name=kind, names=", ".join(f"{name}=..." for name in record.fields))
                return None
        for keyword in node.keywords:
            got = self.infer(keyword.value)
            if keyword.arg not in kind.record.fields:
                self.report(node, "field", name=keyword.arg, kind=kind, names=", ".join(kind.record.fields))
            elif got is not None and got != kind.field(keyword.arg):
                self.report(
                    keyword.value, "argument type", name=kind, expected=kind.field(keyword.arg), argument=keyword.arg,
                    got=got,
                )  # fmt: skip
        self.function.calls[node] = MakeRecord(kind)
        return kind


def is_variable(node: ast.expr) -> bool:
    """Return True if an expression is a name or ``self.name``, which can be repeated in C."""
    return isinstance(node, ast.Name) or is_self_attribute(node)
