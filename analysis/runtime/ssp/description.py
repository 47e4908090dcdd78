"""Content of a SystemStructureDescription, as plain values: elements, connectors, connections, bindings."""

from __future__ import annotations

from dataclasses import dataclass, field
from urllib.parse import urlsplit

from lxml import etree

from .conversions import Transformation, Unit
from .dimensions import Dimension, Shape


@dataclass(slots=True)
class Connector:
    """A declared connector; type and unit are None where the document does not state them, the kind is empty.

    ``exact_type`` is the type's name as the document has it, such as Float32; ``dimensions`` are those of an array,
    ``array`` is the name of the one that it is an element of.
    """

    name: str
    kind: str
    type_name: str | None
    unit: str | None
    enumeration: str | None
    line: int
    exact_type: str | None = None
    dimensions: tuple[Dimension, ...] = ()
    array: str = ""

    def at(self, name: str) -> str:
        """Return its name in the flat network, with the line of its declaration."""
        return f"{name} (line {self.line})" if self.line else name


Point = tuple[str | None, str]  # element, None for the system itself, and connector


@dataclass(slots=True)
class Connection:
    """``added`` are further sources, whose values are added to that of ``start``: outputs of components, as that is.

    ``start_indices`` and ``end_indices`` name one element of an array, or the sub-array that they begin; without any
    the whole is meant.
    """

    start: Point
    end: Point
    suppress_unit_conversion: bool
    transformation: Transformation
    line: int
    added: tuple[Point, ...] = ()
    start_indices: Shape = ()
    end_indices: Shape = ()

    def __str__(self) -> str:
        start, end = (".".join(part for part in point if part) for point in (self.start, self.end))
        return f"connection {start} -> {end}"

    @property
    def where(self) -> str:
        return f"{self} (line {self.line})"


@dataclass
class Binding:
    """A parameter binding: a source file, or the inline element; with mapping likewise."""

    prefix: str
    source: str | None
    inline: etree._Element | None
    mapping_source: str | None
    mapping_inline: etree._Element | None
    line: int


@dataclass
class Element:
    """Fields of all elements of a system."""

    name: str
    connectors: dict[str, Connector]
    bindings: list[Binding]
    line: int


@dataclass
class Component(Element):
    """``step`` (s) is that of the component where it is another than the system's.

    ``feedthrough``: whether its outputs depend directly on all inputs or on none; None: as its FMU declares it.
    """

    source: str
    step: float | None = None
    feedthrough: bool | None = None


@dataclass
class DictionaryReference(Element):
    dictionary: str


@dataclass
class System(Element):
    """``step`` (s) is that of an inner system whose components exchange values more or less often; ``about`` is what it
    says of itself."""

    step: float | None = None
    about: str = ""
    elements: dict[str, Element] = field(default_factory=dict)
    connections: list[Connection] = field(default_factory=list)
    dictionaries: dict[str, dict[str, Connector]] = field(default_factory=dict)


@dataclass
class Description:
    """One document. ``varies`` is the line of a master that varies its step."""

    file: str
    name: str
    system: System
    units: dict[str, Unit]
    enumerations: dict[str, dict[str, int]]
    start_time: float
    stop_time: float | None
    step: float | None
    algorithm: str | None = None
    varies: int | None = None
    annotations: dict[str, etree._Element] = field(default_factory=dict)  # of the whole document, by type
    notes: list[str] = field(default_factory=list)  # on what has no effect


PROXY = "proxyfmu://"
HERE = ("localhost", "127.0.0.1")


def source_file(source: str) -> str:
    """Return the file that a component's source names.

    libcosim, Ecos and Vico simulate ``proxyfmu://localhost?file=x.fmu`` in another process, which is x.fmu with the
    same values; on another machine it is none of the system's files, and stays as it is.
    """
    if source.startswith(PROXY):
        _, _, file = source.partition("?file=")
        if file and urlsplit(source.removesuffix(f"?file={file}")).hostname in HERE:
            return file
    return source


def is_elsewhere(source: str) -> bool:
    """Return True if a source is none of the system's files but an address, as of fmu-proxy://."""
    return "://" in source and not source.startswith("file://")
