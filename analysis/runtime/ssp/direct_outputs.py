"""Whether a component's outputs depend directly on its inputs: our annotation, for FMUs that do not declare it."""

from __future__ import annotations

from lxml import etree

from .annotations import AnnotationReader
from .documents import child, children

ANNOTATION = "org.perilune.feedthrough"
ELEMENT = "Feedthrough"
VALUES = {"true": True, "false": False}


def feedthrough_of_component(component: etree._Element, file: str) -> bool | None:
    """True: all its outputs on all its inputs, False: none on any, None: not stated. Raises InputError."""
    reader = AnnotationReader(file)
    annotations = children(child(component, "ssd:Annotations"), "ssc:Annotation")
    matches = [annotation for annotation in annotations if annotation.get("type") == ANNOTATION]
    if not matches:
        return None
    if len(matches) > 1:
        raise reader.refuse(matches[1], f"the second of type {ANNOTATION}", "write one")
    element = reader.content(matches[0], ELEMENT)
    text = reader.attributes(element, ("direct",))["direct"]
    if text not in VALUES:
        raise reader.refuse(element, f"direct is {text!r}", 'write direct="true" or direct="false"')
    return VALUES[text]
