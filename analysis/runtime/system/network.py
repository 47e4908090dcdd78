"""Flat system: components with their FMUs, connectors as nodes, connections as links; built by `flattening`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ....common.errors import InputError
from ..ssp.conversions import Transformation, Unit
from ..ssp.kinds import PARAMETERS
from ..ssp.names import split_name
from ..ssp.system_description import Component, SystemDescription, SystemElement
from .fmu import Fmu


@dataclass(slots=True)
class Node:
    """Connector of the flat network: of a component or a system, or a dictionary's signal.

    ``kind`` is the connector's kind (inout for dictionary signals); ``component`` is None for connectors without an
    FMU. ``array`` is the array connector that contains the node.
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
class NodeLink:
    """Connection between nodes, with unit conversion and transformation combined.

    ``keeps_number`` is True if units are not converted (SSP's suppressUnitConversion). ``added`` lists further links to
    the same target, an input of a component, whose values are added.
    """

    source: Node
    target: Node
    transformation: Transformation
    line: int
    keeps_number: bool = False
    added: list[NodeLink] = field(default_factory=list)

    @property
    def where(self) -> str:
        return f"connection {self.source.name} -> {self.target.name} (line {self.line})"

    @property
    def is_parameter(self) -> bool:
        """True if the value is passed on before the simulation."""
        return self.target.kind in PARAMETERS


@dataclass
class Network:
    """Flat system. ``notes`` are remarks for `perilune validate`.

    ``mixed`` contains connectors without an FMU that are connected both to values and to differences of values
    (relativeQuantity). ``frames`` maps the frames declared by the SSD to the names of their axes, and ``axes`` maps
    signals to the names of their axes.
    """

    description: SystemDescription
    fmus: dict[str, Fmu] = field(default_factory=dict)
    nodes: dict[str, Node] = field(default_factory=dict)
    driver: dict[str, NodeLink] = field(default_factory=dict)  # by name of the target node
    systems: dict[str, SystemElement] = field(default_factory=dict)  # by path with trailing dot, "" for the root
    notes: list[str] = field(default_factory=list)
    driven: dict[str, str] = field(default_factory=dict)  # columns of a series, by the inputs that they drive
    mixed: set[str] = field(default_factory=set)
    frames: dict[str, tuple[str, ...]] = field(default_factory=dict)
    axes: dict[str, str] = field(default_factory=dict)

    @property
    def file(self) -> str:
        return self.description.file

    def refuse(self, where: str, problem: str, remedy: str) -> InputError:
        """Return an error in an element of the description."""
        return InputError(self.file, where, problem, remedy)

    def unit_of(self, signal: str) -> Unit | None:
        """Return the unit of a recorded signal, from its connector or else from the FMU's variable."""
        if signal in self.nodes:
            return self.nodes[signal].unit
        component, variable = split_name(signal, self.fmus)
        return self.fmus[component].unit_of(self.fmus[component].variables[variable])

    def links(self) -> Iterator[NodeLink]:
        """Yield all links, each followed by the links added to it."""
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
