"""The flat system: components with their FMUs, connectors as nodes, connections as links; `flattening` makes it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ....common.errors import InputError
from ..ssp.conversions import Transformation, Unit
from ..ssp.description import Component, Description, System
from ..ssp.kinds import PARAMETERS
from ..ssp.names import split_name
from .fmu import Fmu


@dataclass(slots=True)
class Node:
    """A connector of the flat network: of a component, of a system, or a dictionary's signal.

    ``kind`` is the connector's (inout for dictionary signals); ``component`` is None where no FMU stands behind it.
    ``array`` is the array connector that it is an element of.
    """

    name: str
    kind: str
    component: str | None
    variable: str
    type_name: str | None
    unit: Unit | None
    line: int
    enumeration: dict[str, int] = field(default_factory=dict)
    array: str = ""

    @property
    def where(self) -> str:
        return f"{self.name} (line {self.line})" if self.line else self.name


@dataclass(slots=True)
class Link:
    """A connection between nodes, with unit conversion and transformation in one.

    ``keeps_number``: units are not converted (SSP's suppressUnitConversion).
    ``added`` are links with the same target, from components to a component, whose values are added to its own.
    """

    source: Node
    target: Node
    transformation: Transformation
    line: int
    keeps_number: bool = False
    added: list[Link] = field(default_factory=list)

    @property
    def where(self) -> str:
        return f"connection {self.source.name} -> {self.target.name} (line {self.line})"

    @property
    def is_parameter(self) -> bool:
        """True if its value is passed on before the flight."""
        return self.target.kind in PARAMETERS


@dataclass
class Network:
    """The flat system. ``notes`` are remarks for `perilune validate`.

    ``mixed`` are connectors without an FMU that values and differences of values (relativeQuantity) are connected with.
    ``frames`` are the names of the axes of frames that the SSD declares, ``axes`` those of the signals along them.
    """

    description: Description
    fmus: dict[str, Fmu] = field(default_factory=dict)
    nodes: dict[str, Node] = field(default_factory=dict)
    driver: dict[str, Link] = field(default_factory=dict)  # by name of the target node
    systems: dict[str, System] = field(default_factory=dict)  # by path with trailing dot, "" for the root
    notes: list[str] = field(default_factory=list)
    driven: dict[str, str] = field(default_factory=dict)  # inputs that a series drives, with its columns
    mixed: set[str] = field(default_factory=set)
    frames: dict[str, tuple[str, ...]] = field(default_factory=dict)
    axes: dict[str, str] = field(default_factory=dict)

    @property
    def file(self) -> str:
        return self.description.file

    def refuse(self, where: str, problem: str, remedy: str) -> InputError:
        """Return the error of an element of the description."""
        return InputError(self.file, where, problem, remedy)

    def unit_of(self, signal: str) -> Unit | None:
        """Return the unit of a recorded signal: of its connector, else of the FMU's variable."""
        if signal in self.nodes:
            return self.nodes[signal].unit
        component, variable = split_name(signal, self.fmus)
        return self.fmus[component].unit_of(self.fmus[component].variables[variable])

    def links(self) -> Iterator[Link]:
        """Yield all links, those that are added to others after them."""
        for link in self.driver.values():
            yield link
            yield from link.added

    def components(self) -> list[tuple[str, Component]]:
        """Return components with their flat names."""
        return [
            (path + element.name, element)
            for path, system in self.systems.items()
            for element in system.elements.values()
            if isinstance(element, Component)
        ]
