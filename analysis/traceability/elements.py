"""Elements of SSP Traceability 1.0.0 (Modelica Association 2024): steps of a task, resources with digests, keywords."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import quote

from lxml import etree

NAMESPACES = {
    "stmd": "http://ssp-standard.org/SSPTraceability1/SimulationTaskMetaData",
    "stc": "http://ssp-standard.org/SSPTraceability1/SSPTraceabilityCommon",
    "srmd": "http://ssp-standard.org/SSPTraceability1/SimulationResourceMetaData",
    "xlink": "http://www.w3.org/1999/xlink",
}
VERSION = "1.0.0"
SRMD_TYPE = "application/x-srmd-meta-data"
PARTICLES = ("Input", "Procedure", "Output", "Rationale")  # of a step, in the order of the schema


def tag(prefix: str, name: str) -> str:
    """Return a namespaced tag in the notation of lxml."""
    return f"{{{NAMESPACES[prefix]}}}{name}"


class Task:
    """A simulation task for the file ``path``: steps by phase.

    Each file is described once, with its SHA3-256 in an SRMD document; further uses refer to this description.
    """

    def __init__(self, name: str, tool: str, path: Path) -> None:
        attributes = {"version": VERSION, "name": name, "generationTool": tool}
        self.root = etree.Element(tag("stmd", "SimulationTaskMetaData"), attributes, nsmap=NAMESPACES)
        self._home = path.absolute().parent
        self._phases: dict[str, etree._Element] = {}
        self._known: dict[Path, str] = {}

    def step(self, phase: str, name: str) -> Step:
        """Add a step to a phase and return it; phases are in the order of their first steps."""
        if phase not in self._phases:
            self._phases[phase] = etree.SubElement(self.root, tag("stmd", phase))
        return Step(self, etree.SubElement(self._phases[phase], tag("stmd", name)))

    def add_file(self, parent: etree._Element, path: Path, kind: str, mime: str, description: str) -> None:
        """Describe a file in a child of an element, or refer to its earlier description. Raises OSError."""
        if path in self._known:
            etree.SubElement(parent, tag("stc", "ResourceReference"), {tag("xlink", "href"): f"#{self._known[path]}"})
            return
        number = self._known[path] = f"resource{len(self._known) + 1}"
        source = quote(Path(os.path.relpath(path.absolute(), self._home)).as_posix())
        attributes = {"kind": kind, "type": mime, "source": source, "id": number, "description": description}
        resource = etree.SubElement(parent, tag("stc", "Resource"), attributes)
        metadata = etree.SubElement(resource, tag("stc", "MetaData"), kind="general", type=SRMD_TYPE)
        content = etree.SubElement(metadata, tag("stc", "Content"))
        digest = {"checksum": _digest(path), "checksumType": "SHA3-256"}
        document = {"version": VERSION, "name": description, "data": source}
        etree.SubElement(content, tag("srmd", "SimulationResourceMetaData"), document | digest)

    def write(self) -> bytes:
        """Return the document as XML."""
        return etree.tostring(self.root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


class Step:
    """A step of a task: inputs, procedure, outputs and rationale."""

    def __init__(self, task: Task, element: etree._Element) -> None:
        self._task = task
        self._element = element

    def add_file(self, particle: str, path: Path, kind: str, mime: str, description: str) -> None:
        """Add a file to ``Input``, ``Procedure``, ``Output`` or ``Rationale``. Raises OSError."""
        self._task.add_file(self._particle(particle), path, kind, mime, description)

    def add_text(self, particle: str, text: str, kind: str, description: str) -> None:
        """Add a text as an inline resource."""
        attributes = {"kind": kind, "type": "text/plain", "description": description}
        resource = etree.SubElement(self._particle(particle), tag("stc", "Resource"), attributes)
        etree.SubElement(resource, tag("stc", "Content")).text = text

    def classify(self, name: str, entries: Mapping[str, str]) -> None:
        """Add a classification of keywords with their texts; do nothing if there are no keywords."""
        if not entries:
            return
        classification = etree.SubElement(self._element, tag("stc", "Classification"), type=name)
        for keyword, text in entries.items():
            etree.SubElement(classification, tag("stc", "ClassificationEntry"), keyword=keyword).text = text

    def _particle(self, name: str) -> etree._Element:
        existing = self._element.find(tag("stc", name))
        if existing is not None:
            return existing
        earlier = [tag("stc", each) for each in PARTICLES[: PARTICLES.index(name)]]
        particle = etree.Element(tag("stc", name))
        self._element.insert(sum(child.tag in earlier for child in self._element), particle)
        return particle


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha3_256").hexdigest()
