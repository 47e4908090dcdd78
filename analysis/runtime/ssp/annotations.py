"""Perilune's annotations in an SSD: types, attributes and numbers of their elements, and direct feedthrough."""

from __future__ import annotations

import difflib
import math
from collections.abc import Collection

from lxml import etree

from ....common.errors import InputError, suggestion
from .documents import NAMESPACES, child, children, tag


class AnnotationReader:
    """Base class of the readers of annotations; ``file`` is the name of the SSD in error messages."""

    def __init__(self, file: str) -> None:
        self.file = file

    def refuse(self, element: etree._Element, problem: str, remedy: str) -> InputError:
        return InputError(self.file, f"{tag(element)} (line {element.sourceline})", problem, remedy)

    def content(self, annotation: etree._Element, name: str) -> etree._Element:
        """Return the single element of an annotation, which must have this ``name``."""
        elements = self.parts(annotation, (name,))[name]
        if len(elements) != 1:
            raise self.refuse(annotation, f"{len(elements)} elements {name}", "write only one")
        return elements[0]

    def parts(self, element: etree._Element, known: Collection[str]) -> dict[str, list[etree._Element]]:
        """Return the child elements by tag; reject unknown tags."""
        by_name: dict[str, list[etree._Element]] = {name: [] for name in known}
        for item in element:
            if not isinstance(item.tag, str):
                continue  # a comment
            if tag(item) not in known:
                raise self.refuse(item, "unknown element", suggestion(tag(item), known))
            by_name[tag(item)].append(item)
        return by_name

    def attributes(self, element: etree._Element, needed: Collection[str], more: Collection[str] = ()) -> dict:
        """Return the attributes of an element; reject missing and unknown attributes."""
        for name in needed:
            if not element.get(name, "").strip():
                raise self.refuse(element, f"no {name}", f'write {name}="..."')
        for name in element.attrib:
            if name not in needed and name not in more:
                raise self.refuse(element, f"unknown attribute {name}", suggestion(str(name), [*needed, *more]))
        return {str(name): str(value).strip() for name, value in element.attrib.items()}

    def number(self, element: etree._Element, name: str, positive: bool = False) -> float | None:
        """Return the value of a numeric attribute, or None if it is missing."""
        text = element.get(name)
        return None if text is None else self._number(element, name, text, positive)

    def numbers(self, element: etree._Element, name: str) -> tuple[float, ...]:
        """Return the space-separated numbers of an attribute; an empty list if it is missing."""
        return tuple(self._number(element, name, text) for text in element.get(name, "").split())

    def _number(self, element: etree._Element, name: str, text: str, positive: bool = False) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or (positive and value <= 0.0):
            raise self.refuse(
                element, f"{name} {text!r} is not a {'positive ' if positive else ''}number", "correct this number"
            )
        return value


FEEDTHROUGH = "org.perilune.feedthrough"
DIRECT = {"true": True, "false": False}


def feedthrough_of_component(component: etree._Element, file: str) -> bool | None:
    """Return True if all outputs depend on all inputs, False if no output depends on an input, None if not stated.

    Raises InputError.
    """
    reader = AnnotationReader(file)
    annotations = children(child(component, "ssd:Annotations"), "ssc:Annotation")
    matches = [annotation for annotation in annotations if annotation.get("type") == FEEDTHROUGH]
    if not matches:
        return None
    if len(matches) > 1:
        raise reader.refuse(matches[1], f"a second annotation of type {FEEDTHROUGH}", "write only one")
    element = reader.content(matches[0], "Feedthrough")
    text = reader.attributes(element, ("direct",))["direct"]
    if text not in DIRECT:
        raise reader.refuse(element, f"direct is {text!r}", 'write direct="true" or direct="false"')
    return DIRECT[text]


PREFIX = "org.perilune."
KINDS = ("bound", "feedthrough", "frames", "report", "stability", "step")
OWN_NAMESPACES = {f"{PREFIX}{name}": f"https://perilune.org/{name}" for name in KINDS}
NEARLY = 0.9  # least ratio of difflib


def check_annotations(root: etree._Element, file: str) -> None:
    """Raise InputError for an annotation that is meant for Perilune but would be ignored."""
    for annotation in root.iter(f"{{{NAMESPACES['ssc']}}}Annotation"):
        kind = annotation.get("type", "")
        place = f"Annotation (line {annotation.sourceline})"
        if kind in OWN_NAMESPACES:
            _check_content(annotation, kind, file)
            owner = annotation.getparent().getparent()
            if kind == FEEDTHROUGH and tag(owner) != "Component":
                raise InputError(
                    file,
                    place,
                    f"type {kind} is not permitted in a {tag(owner)}",
                    "move the annotation into a Component",
                )
        elif kind.startswith(PREFIX) or difflib.get_close_matches(kind, OWN_NAMESPACES, n=1, cutoff=NEARLY):
            raise InputError(file, place, f"no annotation has type {kind}", suggestion(kind, OWN_NAMESPACES))


def _check_content(annotation: etree._Element, kind: str, file: str) -> None:
    for item in annotation:
        if not isinstance(item.tag, str):
            continue  # a comment
        namespace = etree.QName(item).namespace
        if namespace != OWN_NAMESPACES[kind]:
            actual = f"in the namespace {namespace}" if namespace else "without a namespace"
            problem = f"{actual} in an annotation of type {kind}"
            raise InputError(
                file, f"{tag(item)} (line {item.sourceline})", problem, f'write xmlns="{OWN_NAMESPACES[kind]}"'
            )
