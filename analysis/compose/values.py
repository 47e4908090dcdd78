"""Values of [set]: checked against the types of their parameters, and written as an inline parameter set of the SSD."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ...common.errors import InputError, SeveralProblemsError, suggestion
from ...fmus_src.evidence.parameter_set import write_parameter_set
from ..runtime.ssp.dimensions import Shape, array_shapes, element_names
from ..runtime.ssp.names import elements, split_name
from ..runtime.ssp.parameter_sets import Assignment
from ..runtime.ssp.parameter_values import ParameterValue
from ..runtime.system.fmu import Fmu
from .source import SetValue, SystemSource
from .wiring import INDEX, Wiring, collapse

NAME = "set"  # of the parameter set
ACCEPTED: Mapping[str, tuple[type, ...]] = {
    "Real": (float, int),
    "Integer": (int,),
    "Enumeration": (int,),
    "Boolean": (bool,),
}


def write_values(source: SystemSource, fmus: Mapping[str, Fmu], wiring: Wiring) -> list[str]:
    """Return the lines of the parameter set; empty if there are no values.

    Raises SeveralProblemsError with a line for each unknown parameter and each value of a wrong type or size.
    """
    values: dict[str, float | int | bool] = {}
    problems: list[str] = []
    for name, setting in source.set.items():
        try:
            values |= _convert(source, name, setting, _types(source, name, fmus, wiring))
        except InputError as error:
            problems.append(error.text)
    if problems:
        raise SeveralProblemsError(*problems)
    return write_parameter_set(NAME, values).decode().splitlines()[1:] if values else []


def _types(source: SystemSource, name: str, fmus: Mapping[str, Fmu], wiring: Wiring) -> dict[str, str]:
    """Return the types of the elements of a parameter or input, by name."""
    component, variable = split_name(name, fmus)
    if component:
        known = {
            each.name: each.type
            for each in fmus[component].variables.values()
            if each.causality in ("parameter", "structuralParameter", "input")
        }
    else:
        known = {name: each.type for (owner, name), each in wiring.connectors.items() if not owner}
    names = elements(variable, known)
    if not names:
        if not component and "." in name:
            first = name.partition(".")[0]
            raise source.problem(f"set.{name}", f"no component {first}", suggestion(first, fmus))
        raise source.problem(f"set.{name}", "no parameter has this name", suggestion(variable, collapse(known)))
    prefix = f"{component}." if component else ""
    return {prefix + each: known[each] for each in names}


def _convert(
    source: SystemSource, name: str, setting: SetValue, types: Mapping[str, str]
) -> Iterator[tuple[str, float | int | bool]]:
    values = _flatten(source, name, setting, array_shapes(types))
    if len(values) != len(types):
        problem = f"{len(values)} value{'s' if len(values) > 1 else ''} for {len(types)} elements"
        raise source.problem(f"set.{name}", problem, "give one value for each element")
    for (element, type_name), each in zip(types.items(), values, strict=True):
        is_truth = type_name == "Boolean"
        if not isinstance(each, ACCEPTED.get(type_name, ())) or isinstance(each, bool) is not is_truth:
            problem = f"{each!r} is not of type {type_name}"
            raise source.problem(f"set.{name}", problem, "give a value of this type, or use a parameter set (.ssv)")
        yield element, ACCEPTED[type_name][0](each)


def _flatten(
    source: SystemSource, name: str, setting: SetValue, shapes: Mapping[str, Shape]
) -> Sequence[ParameterValue]:
    """Return the elements of a value, a matrix in row-major order; its rows must match the parameter's shape."""
    if isinstance(setting, str) or not isinstance(setting, Sequence):
        return (setting,)
    rows = [each for each in setting if isinstance(each, Sequence) and not isinstance(each, str)]
    if not rows:
        return setting  # type: ignore[return-value]
    shape = next(iter(shapes.values()), ())
    if len(shape) != 2 or [len(row) for row in rows] != [shape[1]] * shape[0] or len(rows) != len(setting):
        problem = (
            f"not {shape[0]} rows of {shape[1]} values"
            if len(shape) == 2
            else "contains rows, but the parameter is not a matrix"
        )
        raise source.problem(f"set.{name}", problem, "give one value for each element, row by row")
    return [each for row in rows for each in row]


def read_values(assignments: Sequence[Assignment]) -> dict[str, SetValue]:
    """Return the values of a parameter set in the form of [set], with vectors as lists."""
    values: dict[str, ParameterValue] = {each.name: each.value for each in assignments}
    shapes = array_shapes(values)
    merged: dict[str, SetValue] = {}
    for name, number in values.items():
        array = INDEX.sub("", name)
        if array in shapes:
            merged[array] = [values[each] for each in element_names(array, shapes[array])]
        else:
            merged[name] = number
    return merged
