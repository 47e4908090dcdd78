"""Types of what records are written with: operators, fields, making one and changing fields."""

from __future__ import annotations

import ast
from types import FunctionType
from typing import Any

from .kernel import FLOAT, INT, MakeRecord, RecordType, Several, Type
from .vectors import VectorTypes, is_variable


class RecordTypes(VectorTypes):
    """The part of type inference that is about records."""

    def operate_on_records(
        self, node: ast.AST, operator: ast.operator, left: Type | Several, right: Type | Several
    ) -> Type | None:
        """Type of ``left operator right``, at least one of which is a record."""
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
        """Type of ``s.speed``."""
        if node.attr not in kind.record.fields:
            self.report(node, "field", name=node.attr, kind=kind, names=", ".join(kind.record.fields))
            return None
        self.function.fields.add(node)
        return kind.field(node.attr)

    def make_record(self, node: ast.Call, made: Any) -> Type | None:
        """Type of ``Motion(position=p, speed=v)`` or ``replace(s, speed=v)``."""
        if isinstance(made, FunctionType):
            kind = self.infer(node.args[0]) if len(node.args) == 1 and is_variable(node.args[0]) else None
            if not isinstance(kind, RecordType):
                self.report(node, "replace")
                return None
        else:
            kind = RecordType(made)
            if node.args or [keyword.arg for keyword in node.keywords] != list(made.fields):
                self.report(node, "record", name=kind, names=", ".join(f"{name}=..." for name in made.fields))
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
