"""Conversion of connections between elements of arrays to connections between arrays."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

from ..dimensions import ELEMENT, Shape, indices
from ..documents import child, children
from .trees import content, remove

Arrays = Mapping[tuple[str, str], Shape]  # by element ("" for the system itself) and connector
SIDES = ("start", "end")


def merge_connections(system: etree._Element, arrays: Arrays) -> None:
    """Replace connections of elements of ``arrays`` by connections of the arrays, in place.

    A single connection is sufficient if all elements of an array are connected with all elements of an array of the
    same shape, in order and with equal attributes. Other connections refer to elements by index.
    """
    groups: dict[tuple[bytes, Shape, Shape], list[tuple[etree._Element, Shape, Shape]]] = {}
    for connection in children(child(system, "ssd:Connections"), "ssd:Connection"):
        ends = [_end(connection, side, arrays) for side in SIDES]
        for side, (_, array, index) in zip(SIDES, ends, strict=True):
            if index:
                connection.set(f"{side}Connector", array)
                connection.set(f"{side}Indices", " ".join(map(str, index)))
        if all(index for _, _, index in ends):
            shape, other = (arrays[element, array] for element, array, _ in ends)
            alike = content(connection, ("startIndices", "endIndices"))
            groups.setdefault((alike, shape, other), []).append((connection, ends[0][2], ends[1][2]))
    for (_, shape, other), members in groups.items():
        pairs = {(start, end) for _, start, end in members}
        if shape == other and pairs == {(index, index) for index in indices(shape)}:
            first, *others = [connection for connection, _, _ in members]
            for side in SIDES:
                first.attrib.pop(f"{side}Indices")
            for connection in others:
                remove(connection)


def _end(connection: etree._Element, side: str, arrays: Arrays) -> tuple[str, str, Shape]:
    """Return element, connector and index at an end of a connection; the index is () for a scalar."""
    element, name = connection.get(f"{side}Element", ""), connection.get(f"{side}Connector", "")
    match = ELEMENT.fullmatch(name)
    if match and (element, match["array"]) in arrays:
        return element, match["array"], tuple(map(int, match["index"].split(",")))
    return element, name, ()
