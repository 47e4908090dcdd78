"""A system as a graph: blocks with ports at their sides, and edges between them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import NamedTuple

MAX_OPEN = 30  # unconnected ports drawn per side


class Side(StrEnum):
    """Side of a block with ports: values enter on the left and leave on the right."""

    IN = "in"
    OUT = "out"


class PortKey(NamedTuple):
    """A port, identified by the path of its block, its side and its name, which is ``x[]`` for a vector ``x``.

    If several ports lead to the same port, such as elements of a vector or terms of a sum, each has a separate
    ``entry``.
    """

    block: str
    side: Side
    name: str
    entry: int = 0


@dataclass
class DiagramPort:
    """A connector, or all connectors of a vector of this ``size``: ``3`` or ``2,3``; empty for a scalar.

    ``signals`` are the names of its elements as recorded by a run.
    """

    name: str
    size: str
    unit: str | None
    signals: list[str]
    is_connected: bool = False

    @property
    def label(self) -> str:
        return f"{self.name}[{self.size}]" if self.size else self.name


@dataclass(frozen=True)
class Edge:
    """One or more connections from one port to another; ``pairs`` are their sources and targets by flat name.

    ``elements`` are the connected elements of both ends, such as ``[1..2]``, or empty for whole vectors in order and
    for scalars. ``change`` describes a conversion of the values: a change of units, a transformation, or a sum.
    """

    source: PortKey
    target: PortKey
    pairs: tuple[tuple[str, str], ...]
    elements: tuple[str, str]
    change: str

    @property
    def note(self) -> str:
        """The elements and the conversion in words; empty for whole vectors without conversion."""
        source, target = self.elements
        elements = source if source == target else f"{source} → {target}".strip()
        return ", ".join(filter(None, (elements, self.change)))


@dataclass
class DiagramBlock:
    """A component, a system with inner ``blocks``, or a reference to a signal dictionary.

    ``path`` is its flat name, empty for the whole system. ``kind`` is the kind of its FMU in the catalogue, or of the
    block. ``parameters`` are connections of parameters, which are listed and not drawn. ``edges`` connect its inner
    blocks with each other and with its ports.
    """

    path: str
    name: str
    kind: str
    model: str = ""
    description: str = ""
    ports: dict[PortKey, DiagramPort] = field(default_factory=dict)
    parameters: list[Edge] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    blocks: list[DiagramBlock] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)

    def add_entry(self, key: PortKey, number: int) -> PortKey:
        """Return the key of a port's entry with this number, after adding it if necessary."""
        entry = key._replace(entry=number)
        self.ports.setdefault(entry, replace(self.ports[key]))
        return entry

    def all_blocks(self) -> Iterator[DiagramBlock]:
        """Yield the block and all blocks inside it."""
        yield self
        for block in self.blocks:
            yield from block.all_blocks()

    def all_edges(self) -> Iterator[Edge]:
        """Yield the edges of the system and of all systems inside it."""
        for block in self.all_blocks():
            yield from block.edges

    @property
    def kind_label(self) -> str:
        """The kind of the block: plant, sensor, guidance."""
        return self.kind.removesuffix("s")

    def visible_ports(self) -> dict[PortKey, DiagramPort]:
        """Return the ports to draw: connected ones, and some unconnected inputs.

        For a block without connections these are the first ports of both sides.
        """
        is_alone = not any(port.is_connected for port in self.ports.values())
        chosen, room = {}, dict.fromkeys(Side, MAX_OPEN)
        for key, port in self.ports.items():
            if not port.is_connected and (is_alone or key.side is Side.IN):
                room[key.side] -= 1
                if room[key.side] < 0:
                    continue
            if port.is_connected or is_alone or key.side is Side.IN:
                chosen[key] = port
        return chosen
