"""Graph of a prepared system, read from its description without loading FMUs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import PurePosixPath

from ....fmus_src.catalogue import block_kinds
from ...options.fault import Fault
from ...runtime.ssp.conversions import IDENTITY, Transformation
from ...runtime.ssp.kinds import PARAMETERS
from ...runtime.ssp.names import split_name
from ...runtime.ssp.system_description import (
    Component,
    Connection,
    Connector,
    DictionaryReference,
    Element,
    Point,
    SystemElement,
)
from ...runtime.system.flattening import find_direction
from ...runtime.system.network import Node
from ...runtime.system.prepared import PreparedSystem
from ..common.quantities import declared_unit
from .graph import DiagramBlock, DiagramPort, Edge, PortKey, Side

ELEMENT = re.compile(r"(.+)\[(\d+(?:,\d+)*)\]")
CUSTOM, FOREIGN, SYSTEM, DICTIONARY = "", "foreign FMU", "system", "signal dictionary"
MAX_RANGES = 3  # ranges of elements beyond which only their number is shown
SIDES = {"input": (Side.IN,), "output": (Side.OUT,), "inout": tuple(Side)}  # by the kind of a connector
Vectors = dict[str, list[str]]  # the indices of a vector's elements, in their order


def read_graph(prepared: PreparedSystem, faults: Sequence[Fault] = ()) -> DiagramBlock:
    """Return the whole system as a block that contains its components."""
    return _GraphReader(prepared, faults).system(prepared.network.description.system, "", prepared.archive.name)


class _GraphReader:
    def __init__(self, prepared: PreparedSystem, faults: Sequence[Fault]) -> None:
        self.prepared = prepared
        self.network = prepared.network
        self.faults = faults
        self.vectors: dict[str, Vectors] = {}

    def system(self, system: SystemElement, path: str, name: str) -> DiagramBlock:
        """Read a system; ``path`` ends with a dot, or is empty for the whole."""
        block = DiagramBlock(path.removesuffix("."), name, SYSTEM)
        self.add_ports(block, system, path)
        for element in system.elements.values():
            block.blocks.append(self.element(element, path))
        inner = {each.name: each for each in block.blocks}
        bundles: dict[tuple[PortKey, PortKey, str, bool], list[tuple[Node, Node]]] = {}
        for connection in system.connections:
            for start in (connection.start, *connection.added):
                single = replace(connection, start=start, added=())
                (source, source_node), (target, target_node) = find_direction(self.network, path, system, single)
                is_parameter = target_node.kind in PARAMETERS
                ends = (
                    self.key(block, inner, source, source_node, Side.OUT),
                    self.key(block, inner, target, target_node, Side.IN),
                )
                change = _change(single, source_node, target_node, is_sum=bool(connection.added))
                bundles.setdefault((*ends, change, is_parameter), []).append((source_node, target_node))
        entries: dict[PortKey, list[PortKey]] = {}  # entries of each port
        blocks = {block.path: block, **{each.path: each for each in block.blocks}}
        for (source_key, target_key, change, is_parameter), nodes in bundles.items():
            elements = self.elements(source_key, target_key, nodes)
            pairs = tuple((source_node.name, target_node.name) for source_node, target_node in nodes)
            edge = Edge(source_key, target_key, pairs, elements, change)
            if is_parameter:
                blocks[target_key.block].parameters.append(edge)
            else:
                sources = entries.setdefault(target_key, [])
                if source_key not in sources:
                    sources.append(source_key)
                entry = blocks[target_key.block].add_entry(target_key, sources.index(source_key))
                block.edges.append(replace(edge, target=entry))
                for key in (source_key, entry):
                    blocks[key.block].ports[key].is_connected = True
        return block

    def element(self, element: Element, path: str) -> DiagramBlock:
        name = path + element.name
        if isinstance(element, SystemElement):
            return self.system(element, f"{name}.", element.name)
        if isinstance(element, DictionaryReference):
            block = DiagramBlock(name, element.name, DICTIONARY, element.dictionary)
        else:
            assert isinstance(element, Component)
            fmu = self.network.fmus[name]
            kind = block_kinds().get(fmu.name, CUSTOM) if fmu.is_own else FOREIGN
            model = fmu.name
            if name in self.prepared.options.use:
                model += f", replaces {PurePosixPath(element.source).stem}"
            block = DiagramBlock(name, element.name, kind, model, fmu.description.description or "")
            block.faults = [str(fault) for fault in self.faults if self.owner(fault) == name]
        self.add_ports(block, element, f"{name}.")
        return block

    def owner(self, fault: Fault) -> str:
        return split_name(fault.name, self.network.fmus)[0]

    def add_ports(self, block: DiagramBlock, element: Element, path: str) -> None:
        """Add the connectors of an element (of a dictionary on both sides), and all other outputs of an FMU."""
        sizes = self.sizes(block, element)
        self.vectors[block.path] = sizes
        declared = {name: self.kind_and_unit(connector, path) for name, connector in element.connectors.items()}
        if isinstance(element, Component):
            fmu = self.network.fmus[block.path]
            outputs = (each for each in fmu.variables.values() if each.causality == "output")
            declared |= {each.name: ("output", each.unit) for each in outputs if each.name not in declared}
        for connector_name, (kind, unit) in declared.items():
            name, is_vector = base_name(connector_name)
            for side in SIDES.get(kind, ()):
                key = PortKey(block.path, side, f"{name}[]" if is_vector else name)
                size = size_text(sizes[name]) if is_vector else ""
                port = block.ports.setdefault(key, DiagramPort(name, size, unit, []))
                port.signals.append(path + connector_name)

    def kind_and_unit(self, connector: Connector, path: str) -> tuple[str, str | None]:
        node = self.network.nodes.get(path + connector.name)
        if node is None:
            return connector.kind, connector.unit
        return node.kind, node.unit.name if node.unit else connector.unit

    def sizes(self, block: DiagramBlock, element: Element) -> Vectors:
        """Return the vectors among an element's connectors, or among all variables of an FMU."""
        fmu = self.network.fmus.get(block.path) if isinstance(element, Component) else None
        return vectors_of(element.connectors if fmu is None else fmu.variables)

    def key(self, block: DiagramBlock, inner: dict[str, DiagramBlock], point: Point, node: Node, side: Side) -> PortKey:
        """Return the port at one end of a connection; inside a system its inputs are sources."""
        element, connector = point
        name, is_vector = base_name(connector)
        if element is None:
            side = Side.IN if side is Side.OUT else Side.OUT
        return PortKey(block.path if element is None else inner[element].path, side, f"{name}[]" if is_vector else name)

    def elements(self, source: PortKey, target: PortKey, nodes: Sequence[tuple[Node, Node]]) -> tuple[str, str]:
        """Return the connected elements of two ports; empty if all are connected in order."""
        texts, is_whole = [], True
        for key, variables in zip((source, target), zip(*nodes, strict=True), strict=True):
            indices = [match[2] for node in variables if (match := ELEMENT.fullmatch(node.variable))]
            texts.append(f"[{ranges(indices)}]" if indices else "")
            is_whole &= not indices or indices == self.vectors[key.block][key.name.removesuffix("[]")]
        return ("", "") if is_whole else (texts[0], texts[1])


def base_name(variable: str) -> tuple[str, bool]:
    """Return the name without indices, and True if it had indices."""
    match = ELEMENT.fullmatch(variable)
    return (match[1], True) if match else (variable, False)


def vectors_of(names: Iterable[str]) -> Vectors:
    """Return the indices of each vector's elements."""
    vectors: Vectors = {}
    for name in names:
        if match := ELEMENT.fullmatch(name):
            vectors.setdefault(match[1], []).append(match[2])
    return vectors


def size_text(indices: Sequence[str]) -> str:
    """Return the size of a vector as text: ``3``, ``2,3``; ``0..2`` if indices do not start at 1."""
    if "," in indices[0]:
        rows = [tuple(map(int, index.split(","))) for index in indices]
        return ",".join(str(max(column)) for column in zip(*rows, strict=False))
    numbers = [int(index) for index in indices]
    return str(len(numbers)) if numbers == list(range(1, len(numbers) + 1)) else ranges(indices)


def ranges(indices: Sequence[str]) -> str:
    """Return indices as text with consecutive ones joined: ``1..3, 5``, or only their number if there are many."""
    joined: list[tuple[int, int] | str] = []
    for index in indices:
        if "," in index:
            joined.append(index)
            continue
        number = int(index)
        if joined and isinstance(joined[-1], tuple) and joined[-1][1] == number - 1:
            joined[-1] = (joined[-1][0], number)
        else:
            joined.append((number, number))
    if len(joined) > MAX_RANGES:
        return f"{len(indices)} elements"
    return ", ".join(
        each if isinstance(each, str) else str(each[0]) if each[0] == each[1] else f"{each[0]}..{each[1]}"
        for each in joined
    )


def _change(connection: Connection, source: Node, target: Node, *, is_sum: bool) -> str:
    """Describe the conversion of a value in a connection; empty if there is no conversion."""
    units = ""
    if source.unit and target.unit and not source.unit.is_same(target.unit):
        units = f"{declared_unit(source.unit.name)} → {declared_unit(target.unit.name)}"
        if connection.suppress_unit_conversion:
            units += ", not converted"
    return ", ".join(filter(None, (units, _transformation(connection.transformation), "added" if is_sum else "")))


def _transformation(transformation: Transformation) -> str:
    if transformation == IDENTITY:
        return ""
    if transformation.table:
        return "mapped"
    factor = "" if transformation.factor == 1.0 else f"· {transformation.factor:g}"
    sign = "+" if transformation.offset > 0.0 else "\u2212"
    offset = f"{sign} {abs(transformation.offset):g}" if transformation.offset else ""
    return " ".join(filter(None, (factor, offset)))
