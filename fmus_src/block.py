"""Declaration of a component: a class whose attributes are its variables (`variables`).

Everything else about a component (modelDescription.xml, connectors, C struct, tables in the docs) is derived from these
declarations.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from typing import Any, ClassVar

from .bundles import Connectors, Inputs, Outputs
from .external_state import DataFiles, ExternalState, HasExternalState, data_problem
from .roles import LIFE_CYCLE
from .variables import DeclarationError, Input, Output, Parameter, State, Variable

# Names imported by the file of a block.
__all__ = ["Block", "ExternalState", "Input", "Inputs", "Output", "Outputs", "Parameter", "State"]


def snake_case(name: str) -> str:
    """Return a class name in snake case: ``AstarGuidance`` becomes ``astar_guidance``."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


class Block(DataFiles, HasExternalState):
    """Component: declared variables, `initialize` and `step`.

    Subclasses declare variables and define two kernels, methods in the subset of Python of
    `fmus_src.export.judge.subset`: `initialize` computes states and outputs at the start from parameters and inputs and
    must succeed with the declared start values; `step` computes states and outputs at t + h.

    An output is ``direct`` if its value at t + h depends on inputs at t + h. A plant has no direct outputs and receives
    the inputs at t. Variables with a meaning in the life cycle, such as a parameter ``sample_period``, are listed in
    `roles.ROLES`.

    ``class Name(Block, interface=True)`` declares connectors and builds no FMU; ``to_write`` names the methods that its
    blocks must define. ``python_only = True`` with ``requires`` allows a block to use libraries; it then has no C form.
    ``data`` names files next to its source, which it reads by `data_path` and which its FMU contains. Library objects
    with internal state are declared as `ExternalState`.
    """

    variables: ClassVar[dict[str, Variable]] = {}
    bundles: ClassVar[dict[str, Connectors]] = {}
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
        cls.bundles = {}
        for name, bundle in _bundles_of(cls).items():
            bundle.declare(cls, name)
        for base in reversed(cls.__mro__):
            cls.bundles |= _bundles_of(base)
            for name, variable in _variables_of(base):
                cls._check_redeclared(name, variable)
                cls._check_role(name, variable)
                cls.variables[name] = variable
        for name, bundle in cls.bundles.items():
            if inspect.getattr_static(cls, name) is not bundle:
                kind = f"is a {bundle.bundle.__name__} in a base class of {cls.__name__}"
                raise DeclarationError(f"{cls.__name__}.{name}: {kind}; give the variable another name")
        if not (cls.__doc__ or "").strip():
            raise DeclarationError(f"{cls.__name__}: write a docstring: purpose, assumptions, source")
        problem = data_problem(cls.data, cls.python_only)
        if problem is not None:
            raise DeclarationError(f"{cls.__name__}: {problem}")
        cls.collect_external()
        cls._check_dependencies()
        if not interface:
            cls._check_written()

    @classmethod
    def _check_redeclared(cls, name: str, value: Variable) -> None:
        """Check that a redeclared variable keeps its causality, since other blocks connect to it.

        Start and bounds may change.
        """
        before = cls.variables.get(name)
        if before is not None and before.causality != value.causality:
            kinds = f"has causality {value.causality} here, but {before.causality} in a base class of {cls.__name__}"
            raise DeclarationError(f"{cls.__name__}.{name}: {kinds}; give the variable another name")

    @classmethod
    def _check_role(cls, name: str, variable: Variable) -> None:
        """Reject a variable that has a role in the life cycle but is not a single number."""
        role = LIFE_CYCLE.get(name)
        if role is not None and (variable.size != 1 or variable.record or variable.type_name == "Boolean"):
            problem = f"is no number ({role.declared}: {role.effect})"
            raise DeclarationError(f"{cls.__name__}.{name}: {problem}; declare one number, or choose another name")

    @classmethod
    def _check_written(cls) -> None:
        for base in cls.__mro__:
            own_step = cls.step is not getattr(base, "step", None)  # need not call the methods of ``to_write``
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
        self.drop_external()
        for name, value in parameters.items():
            if not isinstance(self.variables.get(name), Parameter | Input):
                raise TypeError(f"{self.fmu_name} has no parameter or input {name!r}")
            if not self.variables[name].is_array and hasattr(value, "__len__"):
                raise TypeError(f"{self.fmu_name}.{name}: give a single value")
            setattr(self, name, value)

    def initialize(self) -> None:
        """Compute states and outputs at the start time."""

    def step(self, t: float, h: float) -> None:
        """Advance states and outputs from t to t + h (s)."""

    @classmethod
    def direct_inputs(cls, output: Output) -> list[str]:
        """Return the names of the inputs on which ``output`` depends at the same communication point."""
        if isinstance(output.direct, tuple):
            return list(output.direct)
        if not output.direct:
            return []
        return [name for name, variable in cls.variables.items() if isinstance(variable, Input)]

    @classmethod
    def summary(cls) -> str:
        """Return the first line of the docstring."""
        return (cls.__doc__ or "").strip().splitlines()[0]


def _bundles_of(owner: type) -> dict[str, Connectors]:
    """Return the bundles that the class itself declares, by name."""
    return {name: bundle for name, bundle in vars(owner).items() if isinstance(bundle, Connectors)}


def _variables_of(owner: type) -> Iterator[tuple[str, Variable]]:
    """Yield the name and variable of each declaration in the body of the class, in order; a bundle yields all its
    variables.
    """
    bundles = _bundles_of(owner)
    for name in vars(owner):
        for each in bundles[name].names.values() if name in bundles else [name]:
            if isinstance(vars(owner)[each], Variable):
                yield each, vars(owner)[each]
