"""Documents with something moved, removed, replaced or flipped in them."""

from __future__ import annotations

import copy
from typing import Any

from hypothesis import strategies as st
from lxml import etree

JUNK = st.sampled_from(
    [
        *("", " ", "0", "-1", "1e400", "-1.7e308", "nan", "NaN", "inf", "INF", "true", "x", "ramp", "ramp.y", "a.b[1]"),
        *("9" * 40, "9" * 5000, "2147483648", "0x1", "1_0", "\u202e", "é", "%00", "..", "/etc/passwd"),
        *("[]", "[1, 2]", "{}", "{a = 1}", '""', '"x"', '"1/0"', '"9**9**9"', "[[1]]", "[nan]", "1979-05-27"),
    ]
)


@st.composite
def changed_xml(draw: Any, text: str) -> bytes:
    """Draw a document with one to three changes to its elements, or to its characters."""
    root = etree.fromstring(text.encode())
    for _ in range(draw(st.integers(1, 3))):
        elements = list(root.iter(etree.Element))
        element = draw(st.sampled_from(elements))
        other = draw(st.sampled_from(elements))
        change = draw(st.sampled_from(["value", "remove", "name", "delete", "twice", "move", "tag", "text"]))
        names = sorted(element.attrib)
        if change in ("value", "remove", "name") and names:
            name = draw(st.sampled_from(names))
            value = element.attrib.pop(name)
            if change == "value":
                element.set(name, draw(st.one_of(JUNK, st.sampled_from(sorted(root.xpath("//@*"))))))
            if change == "name":
                element.set(draw(st.sampled_from(["name", "value", "kind", "source", "unit", "x"])), value)
        elif change == "text":
            element.text = draw(JUNK)
        elif change == "tag":
            element.tag = other.tag
        elif element is not root and other not in list(element.iter()):
            if change == "delete":
                element.getparent().remove(element)
            elif change == "move":
                other.append(element)
            else:
                other.append(copy.deepcopy(element))
    return etree.tostring(root)


@st.composite
def changed_text(draw: Any, text: str) -> bytes:
    """Draw a document of lines with one to three changes to these, or to its bytes."""
    lines = text.splitlines()
    for _ in range(draw(st.integers(1, 3))):
        index = draw(st.integers(0, len(lines) - 1))
        change = draw(st.sampled_from(["value", "value", "delete", "twice", "swap", "key"]))
        key, equals, _ = lines[index].partition(" = ")
        if change == "value" and equals:
            lines[index] = f"{key} = {draw(JUNK)}"
        elif change == "key":
            lines[index] = lines[index].replace(key, draw(JUNK), 1)
        elif change == "delete":
            lines[index] = ""
        else:
            other = draw(st.integers(0, len(lines) - 1))
            if change == "swap":
                lines[index], lines[other] = lines[other], lines[index]
            else:
                lines.insert(other, lines[index])
    return "\n".join(lines).encode()


def flipped(text: str) -> st.SearchStrategy[bytes]:
    """Draw a document with a few bits changed."""
    return flipped_bytes(text.encode())


@st.composite
def flipped_bytes(draw: Any, content: bytes) -> bytes:
    """Draw a file with a few bits changed."""
    changed = bytearray(content)
    for position in draw(st.lists(st.integers(0, 8 * len(changed) - 1), min_size=1, max_size=3)):
        changed[position // 8] ^= 1 << position % 8
    return bytes(changed)
