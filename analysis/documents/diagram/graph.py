"""A system as a graph: blocks with ports at their sides, and edges between them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import NamedTuple

MAX_OPEN = 30  # ports of a side that are drawn though nothing is connected to them


class Side(StrEnum):
    """Side of a block that has a port: values enter on the left and leave on the right."""

    IN = "in"
    OUT = "out"


class PortKey(NamedTuple):
    """A port of a block by the block's path; a vector ``x`` has the name ``x[]``, which no scalar has.

    What several other ports lead to, such as the elements of a vector or the terms of a sum, has an ``entry`` for each.
    """

    block: str
    side: Side
    name: str
    entry: int = 0


@dataclass
class DiagramPort:
    """A connector, or a vector's connectors. ``size`` is the vector's, ``3`` or ``2,3``; empty for a scalar.

    ``signals`` are the names of its elements as a run records them.
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
    """One or more connections from one port to another; ``pairs`` are source and target of each by flat names.

    ``elements`` are those of both ends that are connected, such as ``[1..2]``; both are empty where they are the whole
    vectors in order, and that of a scalar is. ``change`` is what happens to values on their way: a conversion of
    units, a transformation, a sum.
    """

    source: PortKey
    target: PortKey
    pairs: tuple[tuple[str, str], ...]
    elements: tuple[str, str]
    change: str

    @property
    def note(self) -> str:
        """The elements and the change in words; empty for whole vectors that arrive as they are."""
        source, target = self.elements
        elements = source if source == target else f"{source} → {target}".strip()
        return ", ".join(filter(None, (elements, self.change)))


@dataclass
class DiagramBlock:
    """A component, a system with ``blocks`` inside, or a reference to a signal dictionary.

    ``path`` is its flat name, empty for the whole system. ``kind`` is that of an FMU of the catalogue, or what the
    block is. ``parameters`` are connections of its parameters, which are listed and not drawn. ``edges`` are those
    between its inner blocks, and between these and its ports.
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
        """Return the key of a port's entry with this number, which is added if it is missing."""
        entry = key._replace(entry=number)
        self.ports.setdefault(entry, replace(self.ports[key]))
        return entry

    def all_blocks(self) -> Iterator[DiagramBlock]:
        """Yield the block, and those inside it."""
        yield self
        for block in self.blocks:
            yield from block.all_blocks()

    def all_edges(self) -> Iterator[Edge]:
        """Yield the edges of the system and of those inside it."""
        for block in self.all_blocks():
            yield from block.edges

    @property
    def kind_label(self) -> str:
        """The kind of one block: plant, sensor, guidance."""
        return self.kind.removesuffix("s")

    def visible_ports(self) -> dict[PortKey, DiagramPort]:
        """Return the ports that the diagram shows: those connected, and some inputs that are not.

        Of a block to which nothing is connected they are the first ones of both sides.
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
