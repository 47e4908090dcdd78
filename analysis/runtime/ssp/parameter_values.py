"""Values of a Parameter in a parameter set: a single value or, in SSP 2.0, the values of an array (row-major)."""

from __future__ import annotations

import math

from lxml import etree

from ....common.errors import InputError
from ...options.option import ParameterValue
from .dimensions import Shape, read_dimensions
from .documents import children, tag
from .types import integer_range, runtime_type

TRUTH = {"true": True, "1": True, "false": False, "0": False}


def parse_value(text: str, type_name: str, file: str, element: str) -> ParameterValue:
    """Return a value parsed from text according to its type in SSP 1.0 or 2.0. Raises InputError."""
    kind = runtime_type(type_name)
    try:
        if kind == "Real":
            return float(text)
        number = int(text) if kind == "Integer" else 0
    except ValueError:
        raise InputError(file, element, f"{text!r} is not of type {type_name}", "write a number") from None
    if kind == "Integer":
        low, high = integer_range(type_name)
        if (
            type_name not in ("Integer", "Int32") and not low <= number <= high
        ):  # bounds of other types are those of the target
            raise InputError(file, element, f"{number} is not of type {type_name}", f"give {low} to {high}")
        return number
    if kind == "Boolean":
        if text not in TRUTH:
            raise InputError(file, element, f"{text!r} is not a Boolean", "write true or false")
        return TRUTH[text]
    return text


def read_values(parameter: etree._Element, typed: etree._Element, file: str) -> tuple[Shape, list[ParameterValue]]:
    """Return the shape of a Parameter, () for a scalar, and its values; ``typed`` is the element of its type.

    Lists of numbers are space-separated in the attribute ``value``; Strings and Enumerations are listed in elements
    Value. Raises InputError.
    """
    where = f"{parameter.get('name', '')} (line {parameter.sourceline})"
    type_name = tag(typed)
    shape = tuple(each.size or 0 for each in read_dimensions(parameter, file, parameter.get("name", ""), fixed=True))
    inner = children(typed, "ssv:Value")
    single = typed.get("value")
    if single is not None and inner:
        raise InputError(file, where, "has both an attribute value and elements Value", "remove one")
    if runtime_type(type_name) in ("String", "Enumeration"):
        texts = [each.get("value", "") for each in inner] if inner or single is None else [single]
    else:
        texts = (single or "").split()
    if len(texts) != math.prod(shape):
        size = f"the {math.prod(shape)} elements of its dimensions" if shape else "a scalar"
        problem = f"{len(texts)} value{'' if len(texts) == 1 else 's'} for {size}"
        raise InputError(file, where, problem, "give one value for each element, or correct the Dimensions")
    return shape, [parse_value(text, type_name, file, where) for text in texts]
