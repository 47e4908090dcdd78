"""Comparison of two SSDs as canonical XML, regardless of the order of connectors, connections and units."""

from __future__ import annotations

from collections import Counter

from lxml import etree

from ..runtime.ssp.documents import parse_xml, tag

UNORDERED = ("Connectors", "Connections", "Units")
BYTES = "Annotations"  # element whose comments and white space are significant


def canonical(element: etree._Element) -> bytes:
    """Return an element in canonical form: UNORDERED children sorted, comments and spaces removed except in BYTES."""
    return etree.tostring(_sort(element), method="c14n", with_comments=True)


def find_difference(first: bytes, second: bytes) -> str | None:
    """Return the element of the first SSD, with its line, that the second lacks; None if both are equal."""
    one, other = parse_xml(first, "SSD"), parse_xml(second, "SSD")
    return None if canonical(one) == canonical(other) else _difference(one, other)


def _sort(element: etree._Element) -> etree._Element:
    copy = etree.Element(element.tag, dict(element.attrib), element.nsmap)
    if tag(element) == BYTES:
        return etree.fromstring(etree.tostring(element, with_tail=False))
    children = [_sort(each) for each in element if isinstance(each.tag, str)]
    if tag(element) in UNORDERED:
        children.sort(key=lambda each: etree.tostring(each, method="c14n"))
    copy.extend(children)
    if not children and element.text and element.text.strip():
        copy.text = element.text
    return copy


def _difference(one: etree._Element, other: etree._Element) -> str:
    """Return the innermost element of ``one`` that has no counterpart in ``other``."""
    counterparts = Counter(canonical(each) for each in other if isinstance(each.tag, str))
    for each in one:
        if isinstance(each.tag, str) and not counterparts[canonical(each)]:
            named = [
                item for item in other.iterchildren(each.tag) if item.get("name") == each.get("name") and len(each)
            ]
            return _difference(each, named[0]) if named and dict(named[0].attrib) == dict(each.attrib) else _name(each)
    return _name(one)


def _name(element: etree._Element) -> str:
    name = element.get("name")
    return f"{tag(element)}{f' {name}' if name else ''} (line {element.sourceline})"
