"""Conversion of connectors of an array's elements to one connector of the array."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

from ..dimensions import Shape, array_shapes
from ..documents import child, children
from ..types import RUNTIME_TYPES
from .trees import add_dimensions, group_elements, is_whole, remove


def merge_connectors(owner: etree._Element, arrays: Mapping[str, Shape] | None) -> dict[str, Shape]:
    """Replace connectors of elements by one connector for each array, in place; return the shapes of these arrays.

    ``arrays`` are the arrays of a component's FMU, of which one element is sufficient, since the FMU has no variable
    named like an element. It is None for a system; all elements of its arrays must be present and have equal
    attributes.
    """
    connectors = children(child(owner, "ssd:Connectors"), "ssd:Connector")
    shapes = array_shapes(connector.get("name", "") for connector in connectors) if arrays is None else arrays
    merged: dict[str, Shape] = {}
    for array, elements in group_elements(connectors, shapes).items():
        if arrays is None and not is_whole(elements, shapes[array], ("name",)):
            continue
        first, *others = elements.values()
        first.set("name", array)
        add_dimensions(first, shapes[array], RUNTIME_TYPES)
        for other in others:
            remove(other)
        merged[array] = shapes[array]
    return merged
