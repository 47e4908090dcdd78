"""Operations on XML trees for the conversion: comparison and removal of elements, addition of dimensions."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from copy import deepcopy

from lxml import etree

from ..dimensions import ELEMENT, Shape, indices
from ..documents import NAMESPACES, tag

Groups = dict[str, dict[Shape, etree._Element]]  # elements by index, by array
RENAMED = {"Real": "Float64", "Integer": "Int32"}


def content(element: etree._Element, without: Collection[str]) -> bytes:
    """Return the canonical content of an element for comparison, ``without`` these attributes."""
    copy = deepcopy(element)
    copy.tail = None
    for name in without:
        copy.attrib.pop(name, None)
    for inner in copy.iter():
        inner.text, inner.tail = (inner.text or "").strip(), (inner.tail or "").strip()
    return etree.tostring(copy, method="c14n")


def remove(element: etree._Element) -> None:
    """Remove an element and the white space before it."""
    parent, before = element.getparent(), element.getprevious()
    if element.getnext() is None:  # the white space before the parent's end stays
        if before is not None:
            before.tail = element.tail
        else:
            parent.text = element.tail
    parent.remove(element)


def group_elements(elements: Iterable[etree._Element], shapes: Mapping[str, Shape]) -> Groups:
    """Return connectors or parameters that are elements of the arrays in ``shapes``, grouped by array."""
    groups: Groups = {}
    for element in elements:
        match = ELEMENT.fullmatch(element.get("name", ""))
        if match and match["array"] in shapes:
            index = tuple(map(int, match["index"].split(",")))
            if index in set(indices(shapes[match["array"]])):
                groups.setdefault(match["array"], {})[index] = element
    return groups


def is_whole(elements: Mapping[Shape, etree._Element], shape: Shape, without: Collection[str]) -> bool:
    """Return True if all elements of an array are present and, ``without`` these attributes, equal."""
    alike = len({content(element, without) for element in elements.values()}) == 1
    return alike and set(elements) == set(indices(shape))


def add_dimensions(element: etree._Element, shape: Shape, types: Collection[str]) -> None:
    """Insert an array's dimensions into a connector or a parameter, after its type, which is one of ``types``."""
    position = next((number + 1 for number, inner in enumerate(element) if tag(inner) in types), 0)
    for offset, size in enumerate(shape):
        dimension = etree.Element(f"{{{NAMESPACES['ssc']}}}Dimension", size=str(size))
        element.insert(position + offset, dimension)


def to_version_2(root: etree._Element) -> None:
    """Set version 2.0 and its type names in a document and its nested documents, in place."""
    spaces = set(NAMESPACES.values())
    for element in root.iter(etree.Element):
        name = etree.QName(element)
        if name.namespace not in spaces:
            continue
        if element.get("version") == "1.0":
            element.set("version", "2.0")
        if name.localname in RENAMED:
            element.tag = f"{{{name.namespace}}}{RENAMED[name.localname]}"
