"""Variables of a block in FMI 3.0: one for each scalar, vector, matrix and field of a record."""

from __future__ import annotations

from dataclasses import dataclass

from ...block import Block
from ...kernel.enumerations import Enumeration
from ...variables import State, Variable

TIME = "time"  # FMI 3.0's independent variable
TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}


@dataclass(frozen=True)
class ArrayVariable:
    """Variable of FMI 3.0; ``first`` is the number of its first element among all elements, as counted in FMI 2.0.

    ``dimensions`` is empty for a scalar, the length of a vector, or rows and columns of a matrix, whose ``starts`` are
    row-major.
    """

    name: str
    reference: int
    first: int
    dimensions: tuple[int, ...]
    starts: tuple[float | int | bool, ...]
    unit: str | None
    description: str
    frozen: bool
    declared: Variable

    @property
    def size(self) -> int:
        """Number of elements."""
        return len(self.starts)

    @property
    def enumeration(self) -> type[Enumeration] | None:
        """Enumeration of the values, or None."""
        return self.declared.enumeration

    @property
    def type_name(self) -> str:
        """FMI 3.0 type: Float64, Int32, Boolean or Enumeration."""
        return "Enumeration" if self.enumeration else TYPES[self.declared.type_name]


def list_variables(block_class: type[Block]) -> list[ArrayVariable]:
    """Return a block's variables in order of value references, which count from 0.

    Raises ValueError for a block with a variable ``time``.
    """
    if TIME in block_class.variables:
        problem = "is reserved for FMI 3.0's independent variable"
        raise ValueError(f"{block_class.__name__}.{TIME}: {problem}; rename this one")
    variables: list[ArrayVariable] = []
    first = 0
    for declared in block_class.variables.values():
        names = [_whole_name(declared, name) for name in declared.element_names()]
        frozen = declared.frozen_elements() if isinstance(declared, State) else [False] * declared.size
        for name in dict.fromkeys(names):
            begin, size = names.index(name), names.count(name)
            is_array = declared.is_array if declared.record is None else declared.element_names()[begin] != name
            variables.append(
                ArrayVariable(
                    name,
                    len(variables),
                    first + begin,
                    declared.shape or ((size,) if is_array else ()),
                    tuple(declared.elements[begin : begin + size]),
                    declared.units()[begin],
                    declared.descriptions()[begin],
                    frozen[begin],
                    declared,
                )
            )
        first += declared.size
    return variables


def _whole_name(declared: Variable, element: str) -> str:
    """Return ``motion.attitude`` for ``motion.attitude[1]`` of a record; otherwise the variable's name."""
    return declared.name if declared.record is None else element.partition("[")[0]
