"""Which annotations of an SSD are ours: what is nearly one is refused, those of other tools are passed over."""

from __future__ import annotations

import difflib

from lxml import etree

from ...common.errors import InputError, suggestion
from .direct_outputs import ANNOTATION as FEEDTHROUGH
from .documents import NAMESPACES, tag

PREFIX = "org.perilune."
KINDS = ("bound", "feedthrough", "report", "stability", "step")
OURS = {f"{PREFIX}{name}": f"https://perilune.org/{name}" for name in KINDS}
NEARLY = 0.9  # of difflib's ratio


def check_annotations(root: etree._Element, file: str) -> None:
    """Raises InputError for an annotation that would be passed over though it is meant for us."""
    for annotation in root.iter(f"{{{NAMESPACES['ssc']}}}Annotation"):
        kind = annotation.get("type", "")
        place = f"Annotation (line {annotation.sourceline})"
        if kind in OURS:
            _check_content(annotation, kind, file)
            owner = annotation.getparent().getparent()
            if kind == FEEDTHROUGH and tag(owner) != "Component":
                raise InputError(file, place, f"type {kind} in a {tag(owner)}", "write it into a Component")
        elif kind.startswith(PREFIX) or difflib.get_close_matches(kind, OURS, n=1, cutoff=NEARLY):
            raise InputError(file, place, f"no annotation is of type {kind}", suggestion(kind, OURS))


def _check_content(annotation: etree._Element, kind: str, file: str) -> None:
    for item in annotation:
        if not isinstance(item.tag, str):
            continue  # a comment
        namespace = etree.QName(item).namespace
        if namespace != OURS[kind]:
            actual = f"of the namespace {namespace}" if namespace else "of no namespace"
            problem = f"{actual} in an annotation of type {kind}"
            raise InputError(file, f"{tag(item)} (line {item.sourceline})", problem, f'write xmlns="{OURS[kind]}"')
