"""Our own annotations of an SSD read: attributes, parts and numbers of their elements, each refused with its line."""

from __future__ import annotations

import math
from collections.abc import Collection

from lxml import etree

from ...common.errors import InputError, suggestion
from .documents import tag


class AnnotationReader:
    """What the readers of all annotations share; ``file`` is the SSD that refusals name."""

    def __init__(self, file: str) -> None:
        self.file = file

    def refuse(self, element: etree._Element, problem: str, remedy: str) -> InputError:
        return InputError(self.file, f"{tag(element)} (line {element.sourceline})", problem, remedy)

    def content(self, annotation: etree._Element, name: str) -> etree._Element:
        """The one element, ``name``, that an annotation holds."""
        elements = self.parts(annotation, (name,))[name]
        if len(elements) != 1:
            raise self.refuse(annotation, f"{len(elements)} elements {name}", "write one")
        return elements[0]

    def parts(self, element: etree._Element, known: Collection[str]) -> dict[str, list[etree._Element]]:
        """The children by tag; refuses unknown ones."""
        by_name: dict[str, list[etree._Element]] = {name: [] for name in known}
        for item in element:
            if not isinstance(item.tag, str):
                continue  # a comment
            if tag(item) not in known:
                raise self.refuse(item, "unknown element", suggestion(tag(item), known))
            by_name[tag(item)].append(item)
        return by_name

    def attributes(self, element: etree._Element, needed: Collection[str], more: Collection[str] = ()) -> dict:
        """The attributes of an element; refuses missing and unknown ones."""
        for name in needed:
            if not element.get(name, "").strip():
                raise self.refuse(element, f"no {name}", f'write {name}="..."')
        for name in element.attrib:
            if name not in needed and name not in more:
                raise self.refuse(element, f"unknown attribute {name}", suggestion(str(name), [*needed, *more]))
        return {str(name): str(value).strip() for name, value in element.attrib.items()}

    def number(self, element: etree._Element, name: str, positive: bool = False) -> float | None:
        """The number that an attribute is; None where it is not there."""
        text = element.get(name)
        return None if text is None else self._number(element, name, text, positive)

    def numbers(self, element: etree._Element, name: str) -> tuple[float, ...]:
        """The numbers of an attribute, with spaces between; none where it is not there."""
        return tuple(self._number(element, name, text) for text in element.get(name, "").split())

    def _number(self, element: etree._Element, name: str, text: str, positive: bool = False) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or (positive and value <= 0.0):
            raise self.refuse(element, f"{name} {text!r} is not a {'positive ' if positive else ''}number", "fix it")
        return value
