"""What the documents of all versions of FMI share: units, log categories, numbers as text."""

from __future__ import annotations

from collections.abc import Iterable

from lxml import etree

from ...block import Block
from ...units import unit_definition
from ...variables import Variable

STATE_ANNOTATION = "org.perilune.state"
LOG_CATEGORIES = {
    "logStatusError": "what ended a step, with the traceback or source line",
    "logAll": "everything",
}


def add_units(root: etree._Element, variables: Iterable[Variable]) -> None:
    """UnitDefinitions with the units of the variables, none where these have no units."""
    used = sorted({unit for variable in variables for unit in variable.units() if unit})
    if used:
        definitions = etree.SubElement(root, "UnitDefinitions")
        for name in used:
            unit = etree.SubElement(definitions, "Unit", name=name)
            meaning = unit_definition(name)
            assert meaning is not None  # the declaration refuses what has none
            numbers = {base: str(power) for base, power in meaning.exponents.items()}
            if meaning.factor != 1.0:
                numbers["factor"] = repr(meaning.factor)
            if meaning.offset:
                numbers["offset"] = repr(meaning.offset)
            etree.SubElement(unit, "BaseUnit", numbers)


def add_log_categories(root: etree._Element) -> None:
    """LogCategories of native and Python FMUs."""
    categories = etree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        etree.SubElement(categories, "Category", name=name, description=description)


def is_continuous(block_class: type[Block], variable: Variable) -> bool:
    """Whether a variable changes between communication points as well: Reals, but not what a sampled block computes."""
    sampled = "sample_period" in block_class.variables
    return variable.type_name == "Real" and not (sampled and variable.causality != "input")


def boolean(flag: bool) -> str:
    """true or false."""
    return "true" if flag else "false"


def literal(number: float | int | bool) -> str:
    """A start value as XML text that reads back to the same bits."""
    return boolean(number) if isinstance(number, bool) else repr(number)
