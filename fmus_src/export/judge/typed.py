"""Type inference of a block's kernel: the functions it reaches, with the types of all their expressions."""

from __future__ import annotations

import ast
from types import FunctionType
from typing import TypeVar

from ...block import Block
from ...kernel.records import Record
from ...kernel.vector_types import VECTORS
from .bundles import write_out_members
from .kernel import (
    BOOL,
    FLOAT,
    INT,
    BoundFunction,
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
    body_of,
)
from .source import Source, find_global, find_method, source_of, with_plain_arguments
from .statements import ANY_MATRIX, ANY_VECTOR, StatementTypes

LIST, FUNCTION, ANY = OTHERS = "list", "function", "any value"
ANNOTATIONS: dict[str, Value | str] = {"float": FLOAT, "int": INT, "bool": BOOL, "Vector": ANY_VECTOR}
ANNOTATIONS["Matrix"] = ANY_MATRIX
ANNOTATIONS |= {"list": LIST, "tuple": LIST, "Derivatives": FUNCTION, "Any": ANY}
ANNOTATIONS |= {kind.__name__: VectorType(size) for size, kind in VECTORS.items()}


def typecheck(block_class: type[Block]) -> Kernel:
    """Return the typed functions that `initialize` and `step` of a block reach; violations are collected."""
    kernel = Kernel(block_class)
    finder = _FunctionMaker(kernel)
    if not block_class.variables:
        kernel.report_block("no variables")
    for name, types in (("initialize", []), ("step", [FLOAT, FLOAT])):
        method = find_method(block_class, name)
        if method is None or (name, method[1]) == ("step", Block):
            kernel.report_block(f"no {name}")
        else:
            setattr(kernel, name, finder.find(*method, None, None, types))
    return kernel


class _FunctionMaker:
    """Registry of one Function per Python function and combination of list and vector types."""

    def __init__(self, kernel: Kernel) -> None:
        self.kernel = kernel
        self.known: dict[tuple, Function | None] = {}
        self.under_way: list[tuple] = []

    def find(
        self,
        function: FunctionType,
        owner: type | None,
        caller: Function | None,
        call: ast.Call | None,
        types: list,
    ) -> Function | None:
        """Return the Function for arguments of these types; None after a violation."""
        source = source_of(function, owner)
        if source is not None:
            source = with_plain_arguments(source, len(types))
        if source is None:
            if caller is not None and call is not None:
                self.kernel.report(caller.source, call, "no source", name=function.__name__)
            return None
        parameters = self._parameters(source, caller, call, types)
        if parameters is None:
            return None
        key = (function, owner, tuple(parameters.values()))
        if key in self.under_way:
            self.kernel.report(source, source.node, "recursion", name=source.name)
            return None
        if key not in self.known:
            self.under_way.append(key)
            self.known[key] = self._analyse(source, parameters)
            self.under_way.pop()
        return self.known[key]

    def _analyse(self, source: Source, parameters: dict[str, Type]) -> Function | None:
        plain = write_out_members(self.kernel, source)
        if plain is None:
            return None
        function = Function(plain, self.kernel.block_class, parameters, self._returns(source, parameters))

        def resolve(callee: FunctionType, owner: type | None, call: ast.Call, types: list[Type]) -> Function | None:
            return self.find(callee, owner, function, call, types)

        StatementTypes(self.kernel, function, resolve).block(body_of(function.source.node))
        self.kernel.functions.append(function)
        return function

    def _parameters(
        self, source: Source, caller: Function | None, call: ast.Call | None, types: list
    ) -> dict[str, Type] | None:
        """Return the declared arguments with their types; the types of lists come from the call."""
        node = source.node
        place: tuple[Source, ast.AST] = (source, node) if caller is None or call is None else (caller.source, call)
        if node.decorator_list:
            self.kernel.report(source, node, "decorator", name=source.name)
            return None
        arguments = node.args
        names = list(arguments.args)
        odd = arguments.vararg or arguments.kwarg or arguments.kwonlyargs or arguments.posonlyargs or arguments.defaults
        if odd or (source.owner is not None and (not names or names[0].arg != "self")):
            self.kernel.report(source, node, "signature", name=source.name, detail="its arguments are not plain names")
            return None
        if source.owner is not None:
            names = names[1:]
        if len(names) != len(types):
            self.kernel.report(*place, "argument count", name=source.name, expected=len(names), got=len(types))
            return None
        parameters: dict[str, Type] = {}
        for argument, actual in zip(names, types, strict=True):
            declared = _annotation(source, argument.annotation)
            if declared is None:
                known = "float, int, bool, Vector3 (or 2, 4), Matrix, list, tuple, record"
                detail = f"argument {argument.arg} is none of {known}"
                self.kernel.report(source, argument, "signature", name=source.name, detail=detail)
                return None
            if not _fits(actual, declared):
                mixed = {List, VectorType} == {type(actual), List if declared == "list" else type(declared)}
                self.kernel.report(
                    *place,
                    "list and vector" if mixed else "argument type",
                    name=source.name,
                    expected={ANY_VECTOR: "vector", ANY_MATRIX: "matrix"}.get(declared, declared),
                    argument=argument.arg,
                    got=actual,
                )
                return None
            parameters[argument.arg] = actual
        return parameters

    def _returns(self, source: Source, parameters: dict[str, Type]) -> Returned | None:
        annotation = source.node.returns
        for argument in source.node.args.args:
            if annotation is None or argument.annotation is None or argument.arg not in parameters:
                continue
            if _annotation(source, annotation) == ANY and ast.dump(annotation) == ast.dump(argument.annotation):
                return parameters[argument.arg]  # type: ignore[return-value]
        if isinstance(annotation, ast.Constant) and annotation.value is None:
            return None
        if isinstance(annotation, ast.Subscript) and ast.unparse(annotation.value) == "tuple":
            several = annotation.slice.elts if isinstance(annotation.slice, ast.Tuple) else [annotation.slice]
            parts = [_annotation(source, part) for part in several]
            if len(parts) > 1 and all(isinstance(part, Value) for part in parts):
                return Several(tuple(parts))  # type: ignore[arg-type]
            returned = None
        else:
            returned = _annotation(source, annotation)
        if not isinstance(returned, Value):
            self.kernel.report(source, source.node, "return type", name=source.name)
            return None
        return returned


def _fits(actual: Type, declared: Value | str) -> bool:
    """Return True if an argument is of the declared type."""
    if declared == "list":
        return isinstance(actual, List)
    if declared == FUNCTION:
        return isinstance(actual, BoundFunction)
    if declared == ANY:
        return isinstance(actual, Scalar | VectorType | RecordType)
    if declared == ANY_MATRIX:
        return isinstance(actual, MatrixType)
    return actual == declared or (declared == ANY_VECTOR and isinstance(actual, VectorType))


def _annotation(source: Source, node: ast.expr | None) -> Value | str | None:
    """Return the type of an annotation: Scalar for ``float``, Vector for ``Vector3``, RecordType for a record class.

    Other annotations are returned as one of the texts of `OTHERS`.
    """
    if isinstance(node, ast.Subscript):
        node = node.value
    if not isinstance(node, ast.Name):
        return None
    if node.id in ANNOTATIONS:
        return ANNOTATIONS[node.id]
    value = find_global(source.function, node.id)
    if isinstance(value, type) and issubclass(value, Record) and value.fields:
        return RecordType(value)
    return ANY if isinstance(value, TypeVar) else None
