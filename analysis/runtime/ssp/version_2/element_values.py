"""Conversion of values of an array's elements to one list of values."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

from ..dimensions import Shape, indices
from ..documents import NAMESPACES, child, children, tag
from ..types import RUNTIME_TYPES, runtime_type
from .trees import add_dimensions, content, group_elements, remove


def merge_values(parameter_set: etree._Element, arrays: Mapping[str, Shape]) -> None:
    """Replace values of ``arrays`` in a parameter set by lists, in place; incomplete arrays stay unchanged."""
    parameters = children(child(parameter_set, "ssv:Parameters"), "ssv:Parameter")
    for array, elements in group_elements(parameters, arrays).items():
        shape = arrays[array]
        if set(elements) != set(indices(shape)) or len({_but_number(parameter) for parameter in elements.values()}) > 1:
            continue
        in_order = [elements[index] for index in indices(shape)]
        types = [next(inner for inner in parameter if tag(inner) in RUNTIME_TYPES) for parameter in in_order]
        texts = [inner.get("value", "") for inner in types]
        first = next(iter(elements.values()))
        holder = types[in_order.index(first)]
        if runtime_type(tag(holder)) in ("String", "Enumeration"):
            holder.attrib.pop("value")
            for text in texts:
                etree.SubElement(holder, f"{{{NAMESPACES['ssv']}}}Value", value=text)
        else:
            holder.set("value", " ".join(texts))
        first.set("name", array)
        add_dimensions(first, shape, RUNTIME_TYPES)
        for parameter in elements.values():
            if parameter is not first:
                remove(parameter)


def _but_number(parameter: etree._Element) -> bytes:
    """Return the content of a Parameter without its name and number, for comparison."""
    contents = [content(inner, ("value",)) for inner in parameter]
    return b"".join([repr(sorted(each for each in parameter.attrib.items() if each[0] != "name")).encode(), *contents])
