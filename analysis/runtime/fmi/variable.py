"""Variable of an FMU as the runtime uses it: a single number or text, in any version of FMI.

An array of FMI 3.0 becomes one variable for each element, named ``x[1]`` or ``x[2,1]`` in row-major order, like the
elements of a vector in FMI 2.0.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from fmpy.model_description import ModelDescription, ModelVariable

from .representations import OF_FMI2, REPRESENTATIONS, Representation


@dataclass(frozen=True, slots=True)
class ScalarVariable:
    """Scalar variable, or one element of an array.

    ``type`` is Real, Integer, Boolean, Enumeration, String or Binary. Bounds and ``start`` are text, as declared.
    ``start`` is None if no value is declared, as for elements beyond the sizes in the description.
    """

    name: str
    type: str
    representation: Representation
    reference: int  # value reference of the variable, or of the array that contains the element
    causality: str
    variability: str
    initial: str | None = None
    start: str | None = None
    minimum: str | None = None
    maximum: str | None = None
    unit: str | None = None
    is_relative: bool = False  # a difference of values in the unit, to which its offset does not apply
    description: str | None = None
    items: Mapping[str, int] = field(default_factory=dict)  # items of an Enumeration
    meanings: Mapping[str, str] = field(default_factory=dict)  # descriptions by item, for items that have one
    array: str = ""  # name of the array that contains it
    index: int = 0  # position in the array, row-major

    @property
    def is_tunable(self) -> bool:
        """True if the variable is a parameter that may be set between steps."""
        return self.causality == "parameter" and self.variability == "tunable"

    @property
    def start_text(self) -> str:
        """Declared start value, or "nan" if there is none."""
        return "nan" if self.start is None else self.start


def variables_of(description: ModelDescription) -> dict[str, ScalarVariable]:
    """Return the variables of an FMU by name, with declared array sizes."""
    declared = description.modelVariables
    return elements_of(declared, {}) if description.fmiMajorVersion == 3 else scalars(declared)


def scalars(declared: Sequence[ModelVariable]) -> dict[str, ScalarVariable]:
    """Return the variables of an FMU of FMI 2.0 by name."""
    return {each.name: _scalar(each, each.type, OF_FMI2[each.type]) for each in declared}


def elements_of(declared: Sequence[ModelVariable], sizes: Mapping[int, int]) -> dict[str, ScalarVariable]:
    """Return the variables of an FMU of FMI 3.0 by name, with arrays as their elements.

    ``sizes`` maps value references of structural parameters to their values.
    """
    variables: dict[str, ScalarVariable] = {}
    for each in declared:
        type_name = "Enumeration" if each.type == "Enumeration" else REPRESENTATIONS[each.type].type
        whole = _scalar(each, type_name, "Int64" if each.type == "Enumeration" else each.type)
        variables |= {element.name: element for element in _elements(whole, each, sizes)}
    return variables


def shape(declared: ModelVariable, sizes: Mapping[int, int] | None = None) -> tuple[int, ...]:
    """Return the dimensions of a variable, () for a scalar, with declared sizes or with ``sizes``."""
    return tuple(
        int(each.start) if each.start is not None else (sizes or {}).get(each.valueReference, int(each.variable.start))
        for each in declared.dimensions
    )


def _elements(whole: ScalarVariable, declared: ModelVariable, sizes: Mapping[int, int]) -> Iterator[ScalarVariable]:
    if not declared.dimensions:
        yield whole
        return
    starts = _starts(declared)
    for index, position in enumerate(itertools.product(*(range(1, size + 1) for size in shape(declared, sizes)))):
        name = f"{whole.name}[{','.join(map(str, position))}]"
        yield replace(whole, name=name, start=starts.get(position), array=whole.name, index=index)


def _starts(declared: ModelVariable) -> dict[tuple[int, ...], str]:
    """Return the declared start values by position, counted from 1. A single value applies to all elements."""
    if declared.start is None:
        return {}
    positions = list(itertools.product(*(range(1, size + 1) for size in shape(declared))))
    texts = declared.start if isinstance(declared.start, list) else str(declared.start).split()
    return dict(zip(positions, texts * len(positions) if len(texts) == 1 else texts, strict=False))


def _scalar(declared: ModelVariable, type_name: str, representation: str) -> ScalarVariable:
    kind, stated = declared.declaredType, declared.relativeQuantity
    members = [] if kind is None or type_name != "Enumeration" else kind.items
    return ScalarVariable(
        name=declared.name,
        type=type_name,
        representation=REPRESENTATIONS[representation],
        reference=declared.valueReference,
        causality=declared.causality,
        variability=declared.variability,
        initial=declared.initial,
        start=declared.start,
        minimum=declared.min,
        maximum=declared.max,
        unit=declared.unit or (kind.unit if kind is not None else None),
        is_relative=kind is not None and kind.relativeQuantity if stated is None else stated,
        description=declared.description,
        items={each.name: int(each.value) for each in members},
        meanings={each.name: each.description for each in members if each.description},
    )
