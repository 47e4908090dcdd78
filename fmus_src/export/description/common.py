"""Common content of the documents of all FMI versions: units, log categories, attributes of variables, numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence

from lxml import etree

from ...block import Block
from ...kernel.enumerations import Enumeration
from ...roles import SAMPLE_PERIOD
from ...units import UnitDefinition, unit_definition
from ...variables import Output, Parameter, State, Variable
from ..judge.tunable import NEVER_READ, find_fixed

UNREAD = "not used by this block"  # for parameters that a slot's blocks share
STATE_ANNOTATION = "org.perilune.state"
LOG_CATEGORIES = {
    "logStatusError": "errors that ended a step, with traceback or source line",
    "logAll": "all messages",
}


def start_description(
    name: str, guid: str, description: str, origin: Mapping[str, str], convention: str = "structured"
) -> etree._Element:
    """Return the root of a modelDescription.xml of FMI 2.0, with the naming convention of its variables."""
    return etree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=name,
        guid=guid,
        description=description,
        variableNamingConvention=convention,
        **origin,
    )


def add_units(root: etree._Element, variables: Iterable[Variable]) -> None:
    """Add UnitDefinitions with the units of the variables, if any."""
    define_units(root, (unit for variable in variables for unit in variable.units() if unit))


def define_units(
    root: etree._Element, names: Iterable[str], others: Mapping[str, UnitDefinition] | None = None
) -> None:
    """Add UnitDefinitions; a unit that is neither a product of known units nor in ``others`` has only a name."""
    used = sorted(set(names))
    if used:
        definitions = etree.SubElement(root, "UnitDefinitions")
        for name in used:
            unit = etree.SubElement(definitions, "Unit", name=name)
            meaning = unit_definition(name) or (others or {}).get(name)
            if meaning is None:
                continue
            numbers = {base: str(power) for base, power in meaning.exponents.items()}
            if meaning.factor != 1.0:
                numbers["factor"] = repr(meaning.factor)
            if meaning.offset:
                numbers["offset"] = repr(meaning.offset)
            etree.SubElement(unit, "BaseUnit", numbers)


def enumerations_by_name(model: str, used: Iterable[type[Enumeration] | None]) -> dict[str, type[Enumeration]]:
    """Return the enumerations of a model's variables, sorted. Raises ValueError for two with the same name."""
    enumerations: dict[str, type[Enumeration]] = {}
    for each in filter(None, used):
        if enumerations.setdefault(each.__name__, each) is not each:
            raise ValueError(f"{model}: two enumerations are named {each.__name__}; rename one")
    return dict(sorted(enumerations.items()))


def about_enumeration(enumeration: type[Enumeration]) -> str:
    """Return the description of an enumeration's type."""
    return one_line((enumeration.__doc__ or "").strip())


def add_items(parent: etree._Element, enumeration: type[Enumeration]) -> None:
    """Add the members of an enumeration with their meanings."""
    for number, label in enumeration.names.items():
        etree.SubElement(parent, "Item", name=label, value=str(number), description=enumeration.meanings[number])


def add_log_categories(root: etree._Element) -> None:
    """Add the LogCategories of native and Python FMUs."""
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)


def role(block_class: type[Block], variable: Variable) -> dict[str, str]:
    """Return the attributes causality, variability and, if it differs from FMI's default, initial.

    Reals are continuous, as they may change between communication points, except those that a sampled block computes.
    """
    attributes = {"causality": variable.causality}
    if isinstance(variable, Parameter):
        tunable = find_fixed(block_class)[variable.name] is None
        return attributes | {"variability": "tunable" if tunable else "fixed", "initial": "exact"}
    sampled = SAMPLE_PERIOD in block_class.variables
    continuous = variable.type_name == "Real" and not (sampled and variable.causality != "input")
    attributes["variability"] = "continuous" if continuous else "discrete"
    return attributes | ({"initial": "calculated"} if isinstance(variable, Output | State) else {})


def describe(block_class: type[Block], variable: Variable, description: str) -> str:
    """Return the description of an element of a variable in one line, with a note if the block never reads it."""
    never = isinstance(variable, Parameter) and find_fixed(block_class)[variable.name] == NEVER_READ
    return one_line(f"{description}; {UNREAD}" if never else description)


def start_text(variable: Variable, elements: Sequence[float | int | bool]) -> str:
    """Return the attribute start. Raises ValueError for an int that does not fit 32 bits."""
    for number in elements:
        if isinstance(number, int) and not _is_32_bit(number):
            raise ValueError(
                f"{variable.name}: starts at {number}, beyond the 32-bit integers of FMI; give a smaller start"
            )
    return " ".join(map(literal, elements))


def limits(variable: Variable) -> dict[str, str]:
    """Return the attributes min, max and nominal as declared; an Integer without bounds has 32-bit bounds."""
    attributes = {}
    for key, bound, whole in (("min", variable.minimum, math.ceil), ("max", variable.maximum, math.floor)):
        if bound is not None and variable.type_name == "Real":
            attributes[key] = literal(bound)
        elif bound is not None and math.isfinite(bound) and _is_32_bit(whole(bound)):
            attributes[key] = literal(whole(bound))
    if variable.nominal is not None and variable.type_name == "Real":
        attributes["nominal"] = literal(variable.nominal)
    return attributes


def _is_32_bit(number: int) -> bool:
    return -(2**31) <= number < 2**31


def one_line(text: str) -> str:
    """Return a text without line breaks, as required for descriptions."""
    return re.sub(r"\s+", " ", text)


def boolean(flag: bool) -> str:
    """Return "true" or "false"."""
    return "true" if flag else "false"


def literal(number: float | int | bool) -> str:
    """Return a number as XML text that reads back to the same bits."""
    if isinstance(number, bool):
        return boolean(number)
    if math.isinf(number):
        return "INF" if number > 0 else "-INF"  # xs:double of XML Schema, which also has NaN
    return "NaN" if math.isnan(number) else repr(number)
