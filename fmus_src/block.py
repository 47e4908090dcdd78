"""How a component is declared: one class, its variables as class attributes.

Everything else about a component (modelDescription.xml, connectors, C struct, tables in the
docs) is derived from these declarations. Values live on the instance under the same names: floats, ints
and bools; vectors (`kernel.vector_types`) for two to four Reals; lists for everything else.
"""

from __future__ import annotations

import copy
import inspect
import operator
import re
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar

from .data_files import DataFiles, data_problem
from .kernel.records import Field, Record, count_numbers, flat_fields, replace
from .kernel.vector_types import VECTORS, vector
from .units import unit_definition

Value = float | int | bool | list
TYPE_NAMES = {float: "Real", int: "Integer", bool: "Boolean"}
CONVERSIONS: dict[type, Callable[[Any], Any]] = {
    float: float,
    int: operator.index,
    bool: bool,
}  # of elements that are stored


class DeclarationError(TypeError):
    """A block's declaration is inconsistent; the message names block, variable and remedy."""


class Variable:
    """One declared variable: start value, unit, description, bounds.

    ``start`` fixes type and size: a float, int or bool, or a list of equal ones. ``unit`` is a
    name that `fmus_src.units` understands; ``minimum``, ``maximum`` and ``nominal`` hold per element;
    ``frame`` names the frame that a vector's components refer to. ``columns`` makes the list a
    matrix in row order, whose elements are named by row and column.

    Two to four Reals are a vector: a value that is stored as a whole, ``self.velocity = self.velocity + gained``.
    More of them, Integers, Booleans, what has ``columns`` and what says ``vector=False`` are a list, whose
    elements are assigned. Either takes any sequence of its size, and copies it.
    """

    causality: ClassVar[str]

    def __init__(
        self,
        start: Any,
        *,
        unit: str | None = None,
        description: str = "",
        frame: str | None = None,
        minimum: float | None = None,
        maximum: float | None = None,
        nominal: float | None = None,
        columns: int | None = None,
        vector: bool = True,
    ) -> None:
        self.record: type[Record] | None = type(start) if isinstance(start, Record) else None
        self.start: Value = list(start.elements() if self.record else start) if is_several(start) else start
        self.unit = unit
        self.description = description
        self.frame = frame
        self.minimum = minimum
        self.maximum = maximum
        self.nominal = nominal
        self.columns = columns
        self.is_vector = (
            vector
            and columns is None
            and self.record is None
            and isinstance(self.start, list)
            and self.size in VECTORS
            and self.all_reals
        )
        self.name = ""
        if self.is_array:
            storing = _StoresRecord if self.record else _StoresVector if self.is_vector else _StoresList
            self.__class__ = _that_stores(type(self), storing)  # type: ignore[arg-type]

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name
        where = f"{owner.__name__}.{name}"
        kinds = {type(value) for value in self.elements}
        if len(kinds) != 1 or not kinds <= set(TYPE_NAMES):
            raise DeclarationError(f"{where}: start must be one float, int or bool, or a list of one of these")
        if self.columns is not None and (not self.is_array or self.columns < 1 or self.size % self.columns):
            raise DeclarationError(f"{where}: {self.size} elements do not make rows of {self.columns}")
        for unit in filter(None, self.units()):
            if unit_definition(unit) is not None:
                continue
            remedy = "write it of m, kg, s, rad, N, deg and the like, as N.m/rad or 1/s2"
            raise DeclarationError(f"{where}: unit {unit!r} is not understood; {remedy}")
        if not self.description:
            raise DeclarationError(f"{where}: give a description")
        for value in self.elements:
            if self.minimum is not None and value < self.minimum:
                problem = f"starts at {value}, below its minimum {self.minimum}"
                raise DeclarationError(f"{where}: {problem}; give a larger start, or a smaller minimum")
            if self.maximum is not None and value > self.maximum:
                problem = f"starts at {value}, above its maximum {self.maximum}"
                raise DeclarationError(f"{where}: {problem}; give a smaller start, or a larger maximum")

    if TYPE_CHECKING:  # instances hold plain values under the same name

        def __get__(self, instance: object, owner: type | None = None) -> Any: ...

        def __set__(self, instance: object, value: Any) -> None: ...

    @property
    def is_array(self) -> bool:
        """Whether there are several elements, as a vector or as a list."""
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
        """FMI type: Real, Integer or Boolean."""
        return TYPE_NAMES[type(self.elements[0])]

    def element_names(self) -> list[str]:
        """FMI names of the elements: ``name``; ``name[1]``, ``name[2]``, ...; or ``name[1,1]``, ``name[1,2]``, ..."""
        if not self.is_array:
            return [self.name]
        if self.record is not None:
            return [f"{self.name}.{name}" for name, _ in flat_fields(self.record)]
        if self.columns is not None:
            places = [divmod(index, self.columns) for index in range(self.size)]
            return [f"{self.name}[{row + 1},{column + 1}]" for row, column in places]
        return [f"{self.name}[{index + 1}]" for index in range(self.size)]

    def units(self) -> list[str | None]:
        """The unit of each element."""
        if self.record is not None:
            return [field.unit for _, field in flat_fields(self.record)]
        return [self.unit] * self.size

    def descriptions(self) -> list[str]:
        """What each element is, with the frame of a vector's components."""
        if self.record is not None:
            return [f"{self.description}: {_about(field)}" for _, field in flat_fields(self.record)]
        return [_about(self)] * self.size

    def with_start(self, start: Any) -> Any:
        """The same variable with another start value, for thin variants of a block."""
        other = copy.copy(self)
        other.start = list(start) if isinstance(start, list | tuple) else start
        return other

    def check_start(self, block: Block, values: Any) -> list:
        """The values of any sequence as elements; raises TypeError where their number or type does not fit."""
        where = f"{block.fmu_name}.{self.name}"
        try:
            elements = list(values)
        except TypeError:
            elements = []
        if len(elements) != self.size:
            raise TypeError(f"{where}: give a list of {self.size}, or another sequence; got {values!r}")
        try:
            return [CONVERSIONS[type(self.elements[0])](value) for value in elements]
        except (TypeError, ValueError) as error:
            raise TypeError(f"{where}: its elements are of type {self.type_name}; got {values!r}") from error


class _StoresVector(Variable):
    """A variable whose assignment stores a vector. Without __get__, reads go to the instance as they do for scalars."""

    def __set__(self, instance: Any, value: Any) -> None:
        if value.__class__ is not VECTORS[self.size]:
            value = vector(*self.check_start(instance, value))
        instance.__dict__[self.name] = value


class _StoresRecord(Variable):
    """A variable whose assignment stores a record."""

    def __set__(self, instance: Any, value: Any) -> None:
        if value.__class__ is not self.record:
            assert self.record is not None
            value = self.record.of_elements(self.check_start(instance, value))
        instance.__dict__[self.name] = value


class _StoresList(Variable):
    """A variable whose list is never another: assignment copies the elements."""

    def __set__(self, instance: Any, value: Any) -> None:
        instance.__dict__.setdefault(self.name, [])[:] = self.check_start(instance, value)


@cache
def _that_stores(kind: Any, how: Any) -> Any:
    """The kind of variable (Input, Output, ...) with a way of storing."""
    return type(kind.__name__, (how, kind), {})


class Input(Variable):
    """Set from outside at every communication point."""

    causality = "input"


class Parameter(Variable):
    """Fixed after initialisation."""

    causality = "parameter"


class State(Variable):
    """Internal, kept from step to step; readable from outside, never set.

    ``start`` may be a record's class, with the starts of fields by name (others 0): ``State(Motion, speed=7620.0)`` has
    the FMI variables ``NAME.speed``, ``NAME.attitude[1]`` and so on, NAME the variable's.

    ``frozen``: left as it is along the flight where a system is linearised: the memory of random number generators,
    and covariances, whose small changes act on estimates only through innovations.
    """

    causality = "local"

    def __init__(self, start: Any, *, frozen: bool = False, **declaration: Any) -> None:
        if isinstance(start, type) and issubclass(start, Record):
            starts = {name: declaration.pop(name) for name in start.fields if name in declaration}
            declaration.setdefault("description", (start.__doc__ or "").partition("\n")[0].rstrip("."))
            start = replace(start.of_elements([0.0] * count_numbers(start)), **starts)
        super().__init__(start, **declaration)
        self.frozen = frozen

    def frozen_elements(self) -> list[bool]:
        """Which elements are frozen."""
        if self.record is not None:
            return [self.frozen or field.frozen for _, field in flat_fields(self.record)]
        return [self.frozen] * self.size


class Output(Variable):
    """Read from outside at every communication point.

    ``direct`` says which inputs of the same communication point the value depends on: True for
    all, False for none (a plant's states), or their names.
    """

    causality = "output"

    def __init__(self, start: Any, *, direct: bool | tuple[str, ...] = False, **declaration: Any) -> None:
        super().__init__(start, **declaration)
        self.direct = direct


def is_several(start: Any) -> bool:
    """Whether a start value has several elements."""
    return isinstance(start, list | tuple | Record)


def _about(declared: Variable | Field) -> str:
    frame = f" ({declared.frame} frame)" if declared.frame else ""
    return f"{declared.description}{frame}"


def snake_case(name: str) -> str:
    """``AstarGuidance`` -> ``astar_guidance``."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


class Block(DataFiles):
    """A component: declared variables, `initialize` and `step`.

    Subclasses declare variables and write `initialize` (states and outputs at the start, from
    parameters and inputs; total: the declared starts alone must not fail) and `step` (outputs
    valid at t + h). Both are kernels: the subset of Python in `fmus_src.export.judge.subset`.

    A parameter ``sample_period`` makes the block sampled: `step` is called at start + k *
    sample_period only; 0 means at every communication point. An output is ``direct`` where it
    answers for t + h from inputs of t + h; a plant has none and is given inputs of t. A state
    ``start_time`` is set to the time of the start (s) before `initialize` runs.

    ``class Name(Block, interface=True)`` declares connectors only and builds no FMU; ``to_write`` names the methods
    that its blocks write, without which a class is refused.
    ``python_only = True`` with ``requires`` lets a block use libraries; it then has no C form. ``data`` names files
    next to its source, which it reads by `data_path` and which travel in its FMU.
    """

    variables: ClassVar[dict[str, Variable]] = {}
    is_interface: ClassVar[bool] = True
    fmu_name: ClassVar[str] = "block"
    python_only: ClassVar[bool] = False
    requires: ClassVar[tuple[str, ...]] = ()
    default_step: ClassVar[float] = 0.1
    to_write: ClassVar[tuple[str, ...]] = ("step",)

    def __init_subclass__(cls, interface: bool = False, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        cls.is_interface = interface
        cls.fmu_name = snake_case(cls.__name__)
        cls.variables = {}
        for base in reversed(cls.__mro__):
            for name, value in vars(base).items():
                if isinstance(value, Variable):
                    cls._check_redeclared(name, value)
                    cls.variables[name] = value
        if not (cls.__doc__ or "").strip():
            raise DeclarationError(f"{cls.__name__}: write a docstring: purpose, assumptions, source")
        problem = data_problem(cls.data, cls.python_only)
        if problem is not None:
            raise DeclarationError(f"{cls.__name__}: {problem}")
        cls._check_dependencies()
        if not interface:
            cls._check_written()

    @classmethod
    def _check_redeclared(cls, name: str, value: Variable) -> None:
        """Starts and bounds may be declared again, what a variable is may not: others connect to it."""
        before = cls.variables.get(name)
        if before is not None and before.causality != value.causality:
            kinds = f"a {value.causality} here, of causality {before.causality} in what {cls.__name__} derives from"
            raise DeclarationError(f"{cls.__name__}.{name}: {kinds}; give it another name")

    @classmethod
    def _check_written(cls) -> None:
        for base in cls.__mro__:
            own_step = cls.step is not getattr(base, "step", None)  # and what it calls is its own affair
            for name in () if own_step else vars(base).get("to_write", ()):
                if getattr(cls, name) is vars(base)[name]:
                    arguments = ", ".join(inspect.signature(vars(base)[name]).parameters)
                    raise DeclarationError(
                        f"{cls.__name__}: has no {name}, which every {base.__name__} has; "
                        f"write def {name}({arguments}) in it"
                    )

    @classmethod
    def _check_dependencies(cls) -> None:
        inputs = {name for name, variable in cls.variables.items() if isinstance(variable, Input)}
        for name, variable in cls.variables.items():
            if isinstance(variable, Output) and isinstance(variable.direct, tuple):
                for unknown in sorted(set(variable.direct) - inputs):
                    raise DeclarationError(f"{cls.__name__}.{name}: direct names {unknown!r}, which is not an input")

    def __init__(self, **parameters: Any) -> None:
        for name, variable in self.variables.items():
            setattr(self, name, variable.start)
        for name, value in parameters.items():
            if not isinstance(self.variables.get(name), Parameter | Input):
                raise TypeError(f"{self.fmu_name} has no parameter or input {name!r}")
            if not self.variables[name].is_array and hasattr(value, "__len__"):
                raise TypeError(f"{self.fmu_name}.{name}: give a single value")
            setattr(self, name, value)

    def initialize(self) -> None:
        """Compute states and outputs at the start time."""

    def step(self, t: float, h: float) -> None:
        """Make the outputs valid at t + h (s)."""

    @classmethod
    def direct_inputs(cls, output: Output) -> list[str]:
        """Names of the inputs that ``output`` depends on within one communication point."""
        if isinstance(output.direct, tuple):
            return list(output.direct)
        if not output.direct:
            return []
        return [name for name, variable in cls.variables.items() if isinstance(variable, Input)]

    @classmethod
    def summary(cls) -> str:
        """First line of the docstring."""
        return (cls.__doc__ or "").strip().splitlines()[0]
