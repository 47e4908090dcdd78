"""Kernel of a block after analysis: its functions with the types of all their expressions.

A function is analysed once per combination of list sizes with which it is called, so every list has a known size and
most indices are proven valid before anything runs.
"""

from __future__ import annotations

import ast
import inspect
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from types import FunctionType
from typing import Any

from ...block import Block
from ...kernel import elementary, vector_types
from ...kernel.records import Record, is_space
from .source import Source
from .subset_table import RULES, MathFunction, SubsetRule


class Scalar(Enum):
    """Type of a number; an int has 64 bits in C."""

    FLOAT = "float"
    INT = "int"
    BOOL = "bool"

    def __str__(self) -> str:
        return self.value


FLOAT, INT, BOOL = Scalar.FLOAT, Scalar.INT, Scalar.BOOL


@dataclass(frozen=True)
class List:
    """Type of a list that is never rebound."""

    element: Scalar
    size: int

    def __str__(self) -> str:
        return f"list of {self.size} {self.element}s"


@dataclass(frozen=True)
class VectorType:
    """Type of a vector of two to four floats."""

    size: int

    def __str__(self) -> str:
        return f"vector of {self.size}"


@dataclass(frozen=True)
class MatrixType:
    """Type of a matrix with fixed numbers of rows and columns, passed by reference."""

    rows: int
    columns: int
    element: Scalar = FLOAT

    def __str__(self) -> str:
        of = "" if self.element is FLOAT else f" of {self.element}s"
        return f"matrix of {self.rows} x {self.columns}{of}"


@dataclass(frozen=True)
class RecordType:
    """Type of a record with named fields."""

    record: type[Record]

    def __str__(self) -> str:
        return self.record.__name__

    @property
    def is_space(self) -> bool:
        """True if values can be added and scaled."""
        return is_space(self.record)

    def field(self, name: str) -> Scalar | VectorType | RecordType:
        """Return the type of a field."""
        return field_type(self.record.fields[name].kind)


def field_type(kind: Any) -> Scalar | VectorType | RecordType:
    """Return the kernel type for the Python type of a field."""
    if kind in (float, int, bool):
        return Scalar(kind.__name__)
    return VectorType(len(kind.names)) if issubclass(kind, vector_types.Vector) else RecordType(kind)


@dataclass(frozen=True)
class BoundFunction:
    """Type of a function or method of the block that is passed as an argument; it has no value in C."""

    function: FunctionType
    owner: type | None

    def __str__(self) -> str:
        return f"the function {self.function.__name__}"


@dataclass(frozen=True)
class Several:
    """Types of several return values of a function, which can only be assigned to as many targets."""

    parts: tuple[Scalar | VectorType | MatrixType | RecordType, ...]

    def __str__(self) -> str:
        return f"{len(self.parts)} values ({', '.join(map(str, self.parts))})"


Value = Scalar | VectorType | MatrixType | RecordType
Type = Value | List | BoundFunction
Returned = Value | Several


@dataclass(frozen=True)
class Constant:
    """Module constant: float, int, bool, vector or tuple of numbers.

    Constants are compared as text, since NaN is not equal to itself.
    """

    module: str
    name: str
    value: Any = field(compare=False)
    text: str = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", repr(self.value))


@dataclass(frozen=True)
class MathCall:
    """Call of a `math` function, or of the kernel function ``computed_by`` that replaces it."""

    name: str
    function: MathFunction
    computed_by: Function | None = None


@dataclass(frozen=True)
class BuiltinCall:
    """Call of abs, float, int or len."""

    name: str


@dataclass(frozen=True)
class MakeVector:
    """Call of `vector` with components or with a starred list."""


@dataclass(frozen=True)
class MakeMatrix:
    """Call of `matrix`, `zeros`, `identity`, `add_product` or a matrix's `copy`, by the name of the function."""

    name: str


@dataclass(frozen=True)
class MakeRecord:
    """Call of a record class with all its fields, or of `replace` with a record and some fields."""

    kind: RecordType


@dataclass(frozen=True)
class KernelCall:
    """Call of another function of the kernel."""

    callee: Function


@dataclass(frozen=True)
class IntegerRange:
    """Smallest and largest possible value of an int."""

    low: int
    high: int

    def join(self, other: IntegerRange) -> IntegerRange:
        return IntegerRange(min(self.low, other.low), max(self.high, other.high))

    def within(self, other: IntegerRange) -> bool:
        return other.low <= self.low and self.high <= other.high


@dataclass(frozen=True)
class Violation:
    """Construct of a kernel that is not in the subset."""

    file: Path
    line: int
    what: str
    remedy: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.what}; {self.remedy}"


@dataclass(eq=False)
class Function:
    """Function of the kernel for particular list sizes, with the results of its analyses."""

    source: Source
    block_class: type[Block]
    parameters: dict[str, Type]
    returns: Returned | None
    locals: dict[str, Type] = field(default_factory=dict)
    types: dict[ast.expr, Type | Several | None] = field(default_factory=dict)
    calls: dict[ast.Call, MathCall | BuiltinCall | MakeVector | MakeMatrix | MakeRecord | KernelCall] = field(
        default_factory=dict
    )
    fields: set[ast.expr] = field(default_factory=set)  # s.speed of a record s
    components: dict[ast.expr, int] = field(default_factory=dict)  # v.y, by number
    parts: dict[ast.expr, range] = field(default_factory=dict)  # v[1:4], by number
    blocks: dict[ast.expr, tuple[range | None, range | None]] = field(default_factory=dict)  # p[i, 3:6]: None, range
    constants: dict[ast.expr, Constant] = field(default_factory=dict)
    # results of ranges.py
    ranges: dict[str, IntegerRange] = field(default_factory=dict)
    parameter_ranges: dict[str, IntegerRange] = field(default_factory=dict)
    unproven: set[ast.AST] = field(default_factory=set)
    unproven_indices: set[ast.expr] = field(default_factory=set)  # of a matrix, in subscripts that are unproven
    # results of effects.py
    changed_lists: set[str] = field(default_factory=set)
    changes_block: bool = False
    can_fault: bool = False
    hoisted: set[ast.expr] = field(default_factory=set)

    @property
    def is_method(self) -> bool:
        return self.source.owner is not None

    @property
    def takes_block(self) -> bool:
        """True if the block is an argument in C: for a method, or a function that calls one."""
        return self.is_method or any(
            isinstance(kind, BoundFunction) and kind.owner is not None for kind in self.parameters.values()
        )

    @property
    def is_total(self) -> bool:
        """True if the function has a result for every argument and needs no checks, like elementary functions."""
        return self.source.module.startswith(f"{elementary.__name__}.")

    @property
    def name(self) -> str:
        return self.source.qualified_name

    @property
    def changes_anything(self) -> bool:
        return self.changes_block or bool(self.changed_lists)

    def callees(self) -> list[Function]:
        """Return the kernel functions that this one calls."""
        actual = [call.callee for call in self.calls.values() if isinstance(call, KernelCall)]
        checked = [call.computed_by for call in self.calls.values() if isinstance(call, MathCall)]
        return [*actual, *(function for function in checked if function is not None)]


@dataclass
class Kernel:
    """All functions of a block's kernel, callees before callers, and their violations."""

    block_class: type[Block]
    functions: list[Function] = field(default_factory=list)
    initialize: Function | None = None
    step: Function | None = None
    violations: list[Violation] = field(default_factory=list)

    def report(self, source: Source, node: ast.AST, rule: str | SubsetRule, **details: object) -> None:
        """Add a violation of a rule of the table at a position in the source, once."""
        self.report_at(source.path, getattr(node, "lineno", source.node.lineno), rule, **details)

    def report_block(self, rule: str, **details: object) -> None:
        """Add a violation at the block's class statement."""
        line = inspect.getsourcelines(self.block_class)[1]
        self.report_at(Path(inspect.getfile(self.block_class)), line, rule, name=self.block_class.__name__, **details)

    def report_at(self, path: Path, line: int, rule: str | SubsetRule, **details: object) -> None:
        """Add a violation at a line of a file, once."""
        text = RULES[rule] if isinstance(rule, str) else rule
        violation = Violation(path, line, text.what.format(**details), text.remedy.format(**details))
        if violation not in self.violations:
            self.violations.append(violation)


def length_of(kind: Type | Several | None) -> int | None:
    """Return `len` of a value of a type."""
    if isinstance(kind, MatrixType):
        return kind.rows
    return kind.size if isinstance(kind, List | VectorType) else None


def is_self_attribute(node: ast.AST) -> bool:
    """Return True if a node reads or writes ``self.name``."""
    return isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "self"


def body_of(node: ast.FunctionDef) -> list[ast.stmt]:
    """Return a function's statements without its docstring."""
    first = node.body[0]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str):
        return node.body[1:]
    return node.body


def targets_of(node: ast.Assign | ast.AnnAssign) -> list[ast.expr]:
    """Return the targets of an assignment: one, or the elements of a tuple."""
    target = node.targets[0] if isinstance(node, ast.Assign) else node.target
    return list(target.elts) if isinstance(target, ast.Tuple) else [target]
