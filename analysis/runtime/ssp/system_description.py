"""Content of a SystemStructureDescription as plain values: elements, connectors, connections, bindings."""

from __future__ import annotations

from dataclasses import dataclass, field
from urllib.parse import urlsplit

from lxml import etree

from .conversions import Transformation, Unit
from .dimensions import Dimension, Shape


@dataclass(slots=True)
class Connector:
    """Declared connector. Type and unit are None, and the kind is empty, if the document does not state them.

    ``exact_type`` is the type's name in the document, such as Float32; ``dimensions`` are the dimensions of an array;
    ``array`` is the name of the array that contains this element.
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
        """Return the connector's flat ``name`` with the line of its declaration."""
        return f"{name} (line {self.line})" if self.line else name


Point = tuple[str | None, str]  # element (None for the system itself) and connector


@dataclass(slots=True)
class Connection:
    """Connection of two connectors.

    ``added`` lists further sources, outputs of components like ``start``, whose values are added to the value of
    ``start``. ``start_indices`` and ``end_indices`` are the indices of an array's element, or of the first element of a
    sub-array; if they are empty, the complete array is connected.
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
    """Parameter binding; its parameter set and its mapping are each in a source file or inline."""

    prefix: str
    source: str | None
    inline: etree._Element | None
    mapping_source: str | None
    mapping_inline: etree._Element | None
    line: int


@dataclass
class Element:
    """Fields common to all elements of a system."""

    name: str
    connectors: dict[str, Connector]
    bindings: list[Binding]
    line: int


@dataclass
class Component(Element):
    """Component of a system.

    ``step`` is the component's step (s) if it differs from the system's. ``feedthrough`` is True if the component's
    outputs depend directly on all inputs, False if they depend on no input, and None if its FMU declares the
    dependencies.
    """

    source: str
    step: float | None = None
    feedthrough: bool | None = None


@dataclass
class DictionaryReference(Element):
    dictionary: str


@dataclass
class SystemElement(Element):
    """System or inner system. An inner system may exchange values with a different ``step`` (s).

    ``about`` is the system's own description.
    """

    step: float | None = None
    about: str = ""
    elements: dict[str, Element] = field(default_factory=dict)
    connections: list[Connection] = field(default_factory=list)
    dictionaries: dict[str, dict[str, Connector]] = field(default_factory=dict)


@dataclass
class SystemDescription:
    """Content of a document. ``varies`` is the line of a master algorithm with variable step, if there is one."""

    file: str
    name: str
    system: SystemElement
    units: dict[str, Unit]
    enumerations: dict[str, dict[str, int]]
    start_time: float
    stop_time: float | None
    step: float | None
    algorithm: str | None = None
    varies: int | None = None
    annotations: dict[str, etree._Element] = field(default_factory=dict)  # annotations of the document itself, by type
    notes: list[str] = field(default_factory=list)  # notes on entries without effect


PROXY = "proxyfmu://"
HERE = ("localhost", "127.0.0.1")


def source_file(source: str) -> str:
    """Return the file to which a component's source refers.

    libcosim, Ecos and Vico simulate ``proxyfmu://localhost?file=x.fmu`` in another process, with the same results as
    x.fmu. A source on another machine is not a file of the system, and is returned unchanged.
    """
    if source.startswith(PROXY):
        _, _, file = source.partition("?file=")
        if file and urlsplit(source.removesuffix(f"?file={file}")).hostname in HERE:
            return file
    return source


def is_elsewhere(source: str) -> bool:
    """Return True if a source is an address, such as fmu-proxy://, instead of a file of the system."""
    return "://" in source and not source.startswith("file://")
