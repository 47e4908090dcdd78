"""Assignment of values to parameters and inputs: bindings, parameter sets, single settings."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

from ....common.errors import InputError, suggestion
from ...options.option import SetValue
from ..fmi.representations import REPRESENTATIONS
from ..fmi.variable import ScalarVariable
from ..ssp.archive import SystemArchive
from ..ssp.conversions import Transformation
from ..ssp.dimensions import element_names, text_of
from ..ssp.kinds import PARAMETERS
from ..ssp.names import split_name
from ..ssp.parameter_sets import Assignment, Notes, read_binding
from ..ssp.parameter_values import ParameterValue, parse_value
from ..ssp.system_description import Binding, Component, SystemElement
from ..ssp.types import WHOLE
from .network import Network, Node
from .options import SystemOptions
from .passing.connection_units import check_offset
from .passing.parameters import pass_parameters
from .passing.settings import SystemSettings

SETTABLE = (*PARAMETERS, "input")
SINGLE = "`set`"  # origin of single values, unless a file sets them
TEXT = "Text"  # type of a single value, which is converted to the type of its target
ELEMENTS = ","  # separates the values of a vector
RANGE = ":"  # separates the numbers of a sweep, which is no single value
INDEX = re.compile(r"\[[\d,]+\]$")


def collect_settings(
    network: Network, archive: SystemArchive, assignments: Sequence[Assignment], options: SystemOptions
) -> SystemSettings:
    """Return all values of a system: the values of its bindings from the inside out, then ``assignments``.

    Later values override earlier ones. Raises InputError for a name without target (unless allowed), for a value that
    does not fit its variable, and for declared inputs without connection and value (unless they keep their start
    values).
    """
    settings, allow_unmatched = SystemSettings(), options.chosen["allow_unmatched"]
    notes = network.notes if allow_unmatched else None
    # Deeper systems first, since bindings of outer systems override theirs.
    for path, system in sorted(network.systems.items(), key=lambda item: -item[0].count(".")):
        for element in system.elements.values():
            if isinstance(element, Component):
                place = f"{path}{element.name}."
                for assignment in _bound(network, settings, archive, element.bindings, place, notes):
                    _apply(network, settings, path, f"{element.name}.", assignment, allow_unmatched)
        for assignment in _bound(network, settings, archive, system.bindings, path, notes):
            _apply(network, settings, path, "", assignment, allow_unmatched)
    settings.chosen = [part for each in assignments for part in _elements(network, each)]
    for assignment in settings.chosen:
        _check_driven(network, assignment)
        _apply(network, settings, "", "", assignment, allow_unmatched)
    pass_parameters(network, settings)
    return settings


def single_value(name: str, value: SetValue, place: tuple[str, int] | None = None) -> Assignment:
    """Return the assignment of a value to a scalar or to a vector's elements; ``place`` is file and line, if known."""
    file, line = place or (SINGLE, 0)
    return Assignment(name.strip(), ELEMENTS.join(_texts(value)), TEXT, None, file, line)


def _texts(value: object) -> list[str]:
    """Return the elements of a value as texts; the value may be a list, a text such as "1,2,3", or a number."""
    if isinstance(value, str):
        return [part.strip() for part in value.strip().removeprefix("[").removesuffix("]").split(ELEMENTS)]
    if isinstance(value, Iterable):
        return [text for item in value for text in _texts(item)]
    return [str(value).lower() if isinstance(value, bool) else str(value)]


def _elements(network: Network, assignment: Assignment) -> list[Assignment]:
    """Return one assignment for each element of a vector; other assignments stay unchanged. Raises InputError."""
    if assignment.type_name != TEXT:
        return [assignment]
    names = _element_names(network, "", assignment.name)
    if not names:
        return [assignment]
    values = str(assignment.value).split(ELEMENTS)
    if len(values) != len(names):
        problem = f"{len(values)} value{'s' if len(values) > 1 else ''} for the {len(names)} elements {names[0]} ..."
        remedy = f"give {len(names)} values separated by commas, or one element: {names[0]}"
        raise InputError(assignment.file, assignment.where, problem, remedy)
    return [replace(assignment, name=name, value=value) for name, value in zip(names, values, strict=True)]


def _element_names(network: Network, path: str, name: str) -> list[str]:
    """Return the flat names of an array's elements; an empty list for a scalar."""
    system = network.systems[path]
    owner, remainder = split_name(name, system.elements)
    element = system.elements.get(owner)
    if isinstance(element, SystemElement):
        return _element_names(network, f"{path}{owner}.", remainder)
    if isinstance(element, Component):
        prefix, known = f"{path}{owner}.", list(network.fmus[path + owner].variables)
    else:
        prefix, known, remainder = path, list(system.connectors), name
    return [] if remainder in known else [prefix + each for each in known if INDEX.sub("", each) == remainder]


def _check_shape(network: Network, path: str, prefix: str, assignment: Assignment) -> None:
    """Reject values if their number differs from the number of elements of their array."""
    if set(assignment.index) == {1}:  # one error, at the first element, for the entire array
        name = prefix + assignment.array
        known = _element_names(network, path, name)
        if known and set(known) != {path + each for each in element_names(name, assignment.shape)}:
            problem = f"{text_of(assignment.shape)} for the {len(known)} of {path}{name}"
            raise InputError(assignment.file, assignment.where, problem, f"give {known[0]} to {known[-1]}")


def _bound(
    network: Network,
    settings: SystemSettings,
    archive: SystemArchive,
    bindings: list[Binding],
    place: str,
    notes: Notes,
) -> list[Assignment]:
    """Return the assignments of parameter bindings in order, with ``place`` as prefix of their names."""
    assignments: list[Assignment] = []
    for binding in bindings:
        values, without = read_binding(archive, network.file, binding, network.description.units, notes, network.notes)
        assignments += values
        settings.left_out |= {place + value.name: f"{value.name} of {value.origin}" for value in without}
        if without:
            names = ", ".join(value.name for value in without)
            where = f"{place}ParameterBinding (line {binding.line})"
            network.notes.append(f"{where}: its mapping has no entry for {names}: not applied")
    return assignments


def _resolve(network: Network, path: str, name: str) -> Node | tuple[str, str] | None:
    """Return the target to which a name in a system refers: a system connector, or (component, variable)."""
    system: SystemElement = network.systems[path]
    if name in system.connectors:
        return network.nodes[path + name]
    owner, remainder = split_name(name, system.elements)
    element = system.elements.get(owner)
    if isinstance(element, Component):
        return path + owner, remainder
    if isinstance(element, SystemElement):
        return _resolve(network, f"{path}{owner}.", remainder)
    return None


def _apply(
    network: Network, settings: SystemSettings, path: str, prefix: str, assignment: Assignment, allow_unmatched: bool
) -> None:
    _check_shape(network, path, prefix, assignment)
    target = _resolve(network, path, prefix + assignment.name)
    problem = "matches no parameter"
    if isinstance(target, Node):
        if target.kind in SETTABLE:
            number = _fit(network, assignment, target.type_name or "Real", target)
            _check_bounds(assignment, None, number)
            settings.nodes[target.name] = number if isinstance(number, str) else float(number)
            settings.node_origins[target.name] = assignment.origin
            return
    elif target is not None:
        component, name = target
        fmu = network.fmus[component]
        variable = fmu.variables.get(name)
        is_constant = variable is not None and variable.variability == "constant"
        has_start = variable is not None and (variable.causality in SETTABLE or variable.initial in ("exact", "approx"))
        if variable is not None and has_start and not is_constant:
            unit, items = fmu.unit_of(variable), dict(variable.items)
            node = Node(f"{component}.{name}", variable.causality, component, name, variable.type, unit, 0, items)
            value = _fit(network, assignment, variable.type, node)
            _check_bounds(assignment, variable, value)
            settings.variables[component, name] = value
            settings.origins[component, name] = assignment.origin
            return
        if variable is not None:
            problem += ": it is a constant" if is_constant else f": it is of causality {variable.causality}"
    if not allow_unmatched:
        owners = list(network.fmus) if len(network.fmus) == 1 else [target[0]] if isinstance(target, tuple) else []
        known = [
            f"{owner}.{key}"
            for owner in owners
            for key, value in network.fmus[owner].variables.items()
            if value.causality in SETTABLE
        ]
        name = path + prefix + assignment.name
        remedy = suggestion(name, known) if known else suggestion(name.partition(".")[0], network.fmus)
        raise InputError(assignment.file, assignment.where, problem, f"{remedy}, or allow it with `allow_unmatched`")
    network.notes.append(f"{assignment.file}: {assignment.where}: {problem}: not applied")


def _check_driven(network: Network, assignment: Assignment) -> None:
    """Reject a single value for a connected input, since the value would be overwritten before the first step."""
    link = network.driver.get(assignment.name)
    if assignment.type_name == TEXT and assignment.name in network.driven:
        problem = f"is driven by column {network.driven[assignment.name]} of the inputs over time"
        raise InputError(assignment.file, assignment.where, problem, "leave out the column or the value")
    if assignment.type_name == TEXT and link is not None and link.target.kind == "input":
        problem = f"is connected to {link.source.name}, which would overwrite the value"
        remedy = f"set a parameter, or override it: `faults` {assignment.name}=override:{assignment.value}@0"
        raise InputError(assignment.file, assignment.where, problem, remedy)


def _fit(network: Network, assignment: Assignment, type_name: str, node: Node) -> ParameterValue:
    """Return the assignment's value converted to its target's type and unit, and transformed."""
    value, type_of_value = assignment.value, assignment.type_name
    if type_name == "Binary":
        raise InputError(
            assignment.file, assignment.where, "a value of type Binary cannot be set", "connect it with a Binary output"
        )
    if type_of_value == TEXT:
        type_of_value = type_name
        value = _parse(assignment, type_name, node)
    if type_of_value == "Integer" and type_name == "Real" and not isinstance(value, bool):
        type_of_value, value = "Real", float(value)
    if type_of_value in ("String", "Integer") and type_name == "Enumeration":
        type_of_value = "Enumeration"
    if type_of_value != type_name:
        remedy = f"give {'an' if type_name in ('Enumeration', 'Integer') else 'a'} {type_name}"
        raise InputError(
            assignment.file,
            assignment.where,
            f"the value is of type {type_of_value}, but the variable is of type {type_name}",
            remedy,
        )
    transformation = assignment.transformation or Transformation()
    if type_name == "Real":
        if assignment.unit and node.unit and not assignment.suppress_unit_conversion:
            if not assignment.unit.is_convertible(node.unit):
                raise InputError(
                    assignment.file,
                    assignment.where,
                    f"unit {assignment.unit.name} cannot be converted to {node.unit.name}",
                    f"give the value in a unit convertible to {node.unit.name}",
                )
            check_offset(network, node, assignment.unit, node.unit, assignment.file, assignment.where)
            transformation = transformation.after_units(assignment.unit.conversion_to(node.unit))
        return float(value) * transformation.factor + transformation.offset
    if transformation.table:
        value = _map_value(assignment, transformation, type_name, node)
    if type_name == "Enumeration":
        by_value = {str(number): number for number in node.enumeration.values()}  # OMSimulator writes items as numbers
        items = by_value | node.enumeration
        if str(value) in items:
            return items[str(value)]
        raise InputError(
            assignment.file,
            assignment.where,
            f"the enumeration has no item {value}",
            suggestion(str(value), node.enumeration),
        )
    return value


def _map_value(assignment: Assignment, transformation: Transformation, type_name: str, node: Node) -> ParameterValue:
    """Return the assignment's value after its mapping, which may refer to the items of an enumeration by number."""
    value, where = assignment.value, (assignment.file, assignment.where)
    if transformation.kind == "IntegerMappingTransformation" and type_name == "Enumeration":
        type_name, value = "Integer", node.enumeration.get(str(value), value)
    table = [[parse_value(text, type_name, *where) for text in entry] for entry in transformation.table]
    targets = [target for source, target in table if source == value]
    if not targets and not transformation.is_partial:
        raise InputError(*where, f"the mapping has no entry for {value}", "add an entry for this value")
    return targets[-1] if targets else value


def _parse(assignment: Assignment, type_name: str, node: Node) -> ParameterValue:
    """Return a single value parsed from text; a bare number is in the variable's unit."""
    if type_name in ("Real", "Boolean", *WHOLE) and RANGE in str(assignment.value):
        unit = f", in {node.unit.name}" if node.unit is not None else ""
        remedy = f"give one value{unit}; sweeps low:high:step are for perilune batch"
        raise InputError(assignment.file, assignment.where, f"{assignment.value!r} is not a single value", remedy)
    try:
        return parse_value(str(assignment.value), type_name, assignment.file, assignment.where)
    except InputError as error:
        if type_name != "Real" or node.unit is None:
            raise
        raise InputError(error.file, error.element, error.problem, f"write a number, in {node.unit.name}") from None


def _check_bounds(assignment: Assignment, variable: ScalarVariable | None, value: ParameterValue) -> None:
    """Reject a number that is not finite, or outside the bounds of the FMU or of the type."""
    if isinstance(value, str | bool):
        return
    low, high = (None, None) if variable is None else (variable.minimum, variable.maximum)
    if not abs(value) < float("inf"):
        raise InputError(assignment.file, assignment.where, f"{value} is not finite", "give a finite number")
    stored = REPRESENTATIONS["Float64" if isinstance(value, float) else "Int32"]
    stored = stored if variable is None else variable.representation
    if not stored.limits[0] <= value <= stored.limits[1]:
        problem = f"{value} {stored.describe_problem()}"
        raise InputError(assignment.file, assignment.where, problem, "give a smaller number")
    if low is not None and value < float(low):
        raise InputError(
            assignment.file, assignment.where, f"{value} is below the minimum {low}", "give a larger value"
        )
    if high is not None and value > float(high):
        raise InputError(
            assignment.file, assignment.where, f"{value} is above the maximum {high}", "give a smaller value"
        )
