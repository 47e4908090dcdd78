"""Declarations of a block: inputs, parameters, states and outputs, each with start, unit, description and bounds.

A block's attributes hold the values under the same names: floats, ints and bools; vectors (`kernel.vector_types`) of
two to four Reals; matrices (`kernel.matrix_types`); records; lists for everything else.
"""

from __future__ import annotations

import copy
import operator
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar

from .kernel.enumerations import Enumeration
from .kernel.matrix_types import Matrix
from .kernel.records import Field, Record, count_numbers, flat_fields, replace
from .kernel.vector_types import VECTORS, vector
from .units import unit_definition

Value = float | int | bool | list
TYPE_NAMES = {float: "Real", int: "Integer", bool: "Boolean"}
CONVERSIONS: dict[type, Callable[[Any], Any]] = {
    float: float,
    int: operator.index,
    bool: bool,
}  # types of the elements that are stored


class DeclarationError(TypeError):
    """Error raised for an inconsistent declaration; the message names block, variable and remedy."""


class Variable:
    """Declared variable: start value, unit, description, bounds.

    ``declared`` is the start value and fixes type and size: a float, int or bool, a list of values of one such type, or
    a `Matrix` of floats. It may also be an `Enumeration`, which defines the bounds and is listed in the description;
    ``start`` is then its first member or another. ``unit`` is a name known to `fmus_src.units`; ``minimum``,
    ``maximum`` and ``nominal`` apply to each element; ``frame`` names the frame of a vector's components. A list with
    ``columns`` is a matrix in row-major order, with elements named by row and column; the elements of a `Matrix` are
    numbered consecutively.

    Two to four Reals form a vector, a value that is assigned as a whole: ``self.velocity = self.velocity + change``.
    More Reals, Integers, Booleans and variables with ``vector=False`` form a list, whose elements are assigned.
    Assignment to a vector or list copies any sequence of the same size; a matrix also accepts a sequence of rows.
    """

    causality: ClassVar[str]

    def __init__(
        self,
        declared: Any,
        /,
        *,
        start: int | None = None,
        unit: str | None = None,
        description: str = "",
        frame: str | None = None,
        minimum: float | None = None,
        maximum: float | None = None,
        nominal: float | None = None,
        columns: int | None = None,
        vector: bool = True,
    ) -> None:
        self.enumeration: type[Enumeration] | None = None
        if isinstance(declared, type) and issubclass(declared, Enumeration):
            self.enumeration = declared
            minimum, maximum = min(declared.meanings), max(declared.meanings)
            description = declared.describe(description)
            declared = minimum if start is None else start
        self.record: type[Record] | None = type(declared) if isinstance(declared, Record) else None
        self.start: Value = _flatten(declared) if is_several(declared) else declared
        self.unit = unit
        self.description = description
        self.is_described = True  # False if the description is the record class's
        self.frame = frame
        self.minimum = minimum
        self.maximum = maximum
        self.nominal = nominal
        self.columns = columns
        width = declared.shape[1] if isinstance(declared, Matrix) else columns
        self.shape = (
            (self.size // width, width) if width and self.is_array else None
        )  # numbers of rows and columns of a matrix
        self.is_vector = (
            vector
            and self.shape is None
            and self.record is None
            and isinstance(self.start, list)
            and self.size in VECTORS
            and self.all_reals
        )
        self.name = ""
        if self.is_array:
            how = (
                _StoresRecord if self.record else _StoresMatrix if self.shape else _StoresVector if self.is_vector
                else _StoresList
            )  # fmt: skip
            self.__class__ = _that_stores(type(self), how)  # type: ignore[arg-type]

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name
        where = f"{owner.__name__}.{name}"
        kinds = {type(value) for value in self.elements}
        if len(kinds) != 1 or not kinds <= set(TYPE_NAMES):
            raise DeclarationError(f"{where}: start must be one float, int or bool, or a list of one of these")
        whole = next((name for name, field in self.numbers_of_record() if field.kind in (int, bool)), None)
        if whole is not None:
            problem = (
                f"the field {whole} of its record is not a float, but all numbers of a record variable must be floats"
            )
            raise DeclarationError(f"{where}: {problem}; declare that field as a separate variable")
        if self.columns is not None and (not self.is_array or self.columns < 1 or self.size % self.columns):
            raise DeclarationError(f"{where}: {self.size} elements do not form rows of {self.columns}")
        for unit in filter(None, self.units()):
            if unit_definition(unit) is not None:
                continue
            remedy = "write the unit in m, kg, s, rad, N, deg and the like, such as N.m/rad or 1/s2"
            raise DeclarationError(f"{where}: unit {unit!r} is unknown; {remedy}")
        if not self.description:
            raise DeclarationError(f"{where}: give a description")
        for value in self.elements:
            if self.minimum is not None and value < self.minimum:
                problem = f"starts at {value}, below its minimum {self.minimum}"
                raise DeclarationError(f"{where}: {problem}; give a larger start, or a smaller minimum")
            if self.maximum is not None and value > self.maximum:
                problem = f"starts at {value}, above its maximum {self.maximum}"
                raise DeclarationError(f"{where}: {problem}; give a smaller start, or a larger maximum")

    def numbers_of_record(self) -> list[tuple[str, Field]]:
        """Return the name and field of each number of a record; empty for other variables."""
        return [] if self.record is None else flat_fields(self.record)

    if TYPE_CHECKING:  # instances hold plain values under the same name

        def __get__(self, instance: object, owner: type | None = None) -> Any: ...

        def __set__(self, instance: object, value: Any) -> None: ...

    @property
    def is_array(self) -> bool:
        """True if the variable has several elements, as a vector, matrix, record or list."""
        return isinstance(self.start, list)

    @property
    def all_reals(self) -> bool:
        return all(type(value) is float for value in self.elements)

    @property
    def elements(self) -> list:
        """Start values, one per element."""
        return self.start if isinstance(self.start, list) else [self.start]

    @property
    def size(self) -> int:
        return len(self.elements)

    @property
    def type_name(self) -> str:
        """Type of the values: Real, Integer or Boolean."""
        return TYPE_NAMES[type(self.elements[0])]

    @property
    def fmi_type(self) -> str:
        """FMI 2.0 type: Enumeration for a variable with an enumeration, otherwise the type of the values."""
        return "Enumeration" if self.enumeration is not None else self.type_name

    def element_names(self) -> list[str]:
        """Return the FMI names of the elements: ``name``; ``name[1]``, ``name[2]``, ...; or ``name[1,1]``,
        ``name[1,2]``, ...
        """
        if not self.is_array:
            return [self.name]
        if self.record is not None:
            return [f"{self.name}.{name}" for name, _ in flat_fields(self.record)]
        if self.columns is not None:
            places = [divmod(index, self.columns) for index in range(self.size)]
            return [f"{self.name}[{row + 1},{column + 1}]" for row, column in places]
        return [f"{self.name}[{index + 1}]" for index in range(self.size)]

    def units(self) -> list[str | None]:
        """Return the unit of each element."""
        if self.record is not None:
            return [field.unit for _, field in flat_fields(self.record)]
        return [self.unit] * self.size

    def descriptions(self) -> list[str]:
        """Return the description of each element, with the frame of a vector's components."""
        if self.record is not None:
            return [self._describe(field) for _, field in flat_fields(self.record)]
        return [_about(self)] * self.size

    def _describe(self, field: Field) -> str:
        """Return the description of a record's field in this variable."""
        if not field.description:
            return self.description
        return f"{self.description}: {_about(field)}" if self.is_described else _about(field)

    def with_start(self, start: Any) -> Any:
        """Return a copy of the variable with another start value, for variants of a block."""
        other = copy.copy(self)
        other.start = _flatten(start) if is_several(start) else start
        return other

    def check_start(self, block: Any, values: Any) -> list:
        """Return the values of a sequence as a list of elements. Raises TypeError for a wrong number or type of
        values.
        """
        where = f"{block.fmu_name}.{self.name}"
        try:
            elements = _flatten(values)
        except TypeError:
            elements = []
        if len(elements) != self.size:
            raise TypeError(f"{where}: give a list of {self.size}, or another sequence; got {values!r}")
        try:
            return [CONVERSIONS[type(self.elements[0])](value) for value in elements]
        except (TypeError, ValueError) as error:
            raise TypeError(f"{where}: its elements are of type {self.type_name}; got {values!r}") from error


class _StoresVector(Variable):
    """Variable that stores an assigned sequence as a vector; without ``__get__``, reads use the instance dictionary."""

    def __set__(self, instance: Any, value: Any) -> None:
        if value.__class__ is not VECTORS[self.size]:
            value = vector(*self.check_start(instance, value))
        instance.__dict__[self.name] = value


class _StoresRecord(Variable):
    """Variable that stores an assigned value as a record."""

    def __set__(self, instance: Any, value: Any) -> None:
        if value.__class__ is not self.record:
            assert self.record is not None
            value = self.record.of_elements(self.check_start(instance, value))
        instance.__dict__[self.name] = value


class _StoresMatrix(Variable):
    """Variable that keeps one matrix object; assignment copies the elements."""

    def __set__(self, instance: Any, new: Any) -> None:
        assert self.shape is not None
        if new.__class__ is Matrix and new.shape == self.shape:
            new = new.copy()
        else:
            new = Matrix.of_elements(self.check_start(instance, new), self.shape[1])
        instance.__dict__.setdefault(self.name, new).rows = new.rows


class _StoresList(Variable):
    """Variable that keeps one list object; assignment copies the elements."""

    def __set__(self, instance: Any, value: Any) -> None:
        instance.__dict__.setdefault(self.name, [])[:] = self.check_start(instance, value)


@cache
def _that_stores(kind: Any, how: Any) -> Any:
    """Return a subclass of a kind of variable (Input, Output, ...) that stores values as the mixin ``how`` does."""
    return type(kind.__name__, (how, kind), {})


class Input(Variable):
    """Variable set by the importer at every communication point."""

    causality = "input"


class Parameter(Variable):
    """Variable set before the start, and between steps if the block's kernels allow it.

    `export.judge.tunable` determines this; ``fixed`` is the reason why an otherwise tunable parameter must not change.
    """

    causality = "parameter"

    def __init__(self, declared: Any, /, *, fixed: str = "", **declaration: Any) -> None:
        super().__init__(declared, **declaration)
        self.fixed = fixed


class State(Variable):
    """Internal variable that keeps its value from step to step; the importer can read it but never set it.

    ``declared`` may be a record class, with start values of fields by name (others 0): a variable ``motion`` declared
    as ``State(Motion, speed=7620.0)`` has the FMI variables ``motion.speed``, ``motion.attitude[1]`` and so on. They
    have the descriptions of the fields, preceded by the description of the state if it has one.

    ``frozen`` states keep their values along the trajectory when a system is linearised: states of random number
    generators, and covariances, whose small changes act on estimates only through innovations.
    """

    causality = "local"

    def __init__(self, declared: Any, /, *, frozen: bool = False, **declaration: Any) -> None:
        is_described = "description" in declaration
        if isinstance(declared, type) and issubclass(declared, Record):
            starts = {name: declaration.pop(name) for name in declared.fields if name in declaration}
            declaration.setdefault("description", (declared.__doc__ or "").partition("\n")[0].rstrip("."))
            declared = replace(declared.of_elements([0.0] * count_numbers(declared)), **starts)
        super().__init__(declared, **declaration)
        self.is_described = is_described
        self.frozen = frozen

    def frozen_elements(self) -> list[bool]:
        """Return, for each element, True if it is frozen."""
        if self.record is not None:
            return [self.frozen or field.frozen for _, field in flat_fields(self.record)]
        return [self.frozen] * self.size


class Output(Variable):
    """Variable read by the importer at every communication point.

    ``direct`` declares the inputs of the same communication point on which the value depends: True for all, False for
    none (as for a plant), or their names.
    """

    causality = "output"

    def __init__(self, declared: Any, /, *, direct: bool | tuple[str, ...] = False, **declaration: Any) -> None:
        super().__init__(declared, **declaration)
        self.direct = direct


def is_several(start: Any) -> bool:
    """Return True if a start value has several elements."""
    return isinstance(start, list | tuple | Record | Matrix)


def _flatten(values: Any) -> list:
    """Return the elements of a sequence, record or matrix as a list; a matrix may also be a sequence of rows."""
    if isinstance(values, Record | Matrix):
        return list(values.elements())
    elements = list(values)
    has_rows = bool(elements) and hasattr(elements[0], "__len__") and not isinstance(elements[0], str)
    return [each for row in elements for each in row] if has_rows else elements


def _about(declared: Variable | Field) -> str:
    frame = f" ({declared.frame} frame)" if declared.frame else ""
    return f"{declared.description}{frame}"
