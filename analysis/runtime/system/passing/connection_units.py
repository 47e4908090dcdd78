"""Units of connections: conversions, and system connectors that pass on differences."""

from __future__ import annotations

from dataclasses import replace

from .....common.errors import InputError
from ...ssp.conversions import Unit
from ..network import Network, Node


def convert_units(network: Network) -> None:
    """Prepend the conversion of units to the transformation of each connection. Raises InputError."""
    _settle_differences(network)
    noted: set[object] = set()
    for link in network.links():
        source, target = link.source, link.target
        if link.keeps_number or source.unit is None or target.unit is None:
            continue
        if not source.unit.is_convertible(target.unit):
            problem = f"units are not convertible: {source.unit.name} and {target.unit.name}"
            raise network.refuse(link.where, problem, "correct the unit of one end")
        for node in (source, target):
            check_offset(network, node, source.unit, target.unit, network.file, link.where)
        connection = link.line or link.where  # elements of an array share a line
        if _disagree(source.unit, target.unit) and connection not in noted:
            noted.add(connection)
            relative, other = (source, target) if source.unit.is_relative else (target, source)
            problem = f"{relative.name} is a difference (relativeQuantity), but {other.name} is not"
            network.notes.append(f"{link.where}: {problem}; values are converted without the offsets of the units")
        link.transformation = link.transformation.after_units(source.unit.conversion_to(target.unit))


def check_offset(network: Network, node: Node, source: Unit, target: Unit, file: str, where: str) -> None:
    """Reject a conversion between units with different offsets at a connector for both values and differences.

    Raises InputError.
    """
    if node.name in network.mixed and source.offset != target.offset:
        problem = f"{node.name} is connected both with values and with differences (relativeQuantity)"
        problem += f", so that the offset between {source.name} and {target.name} applies to only one of them"
        raise InputError(file, where, problem, "use a connector for each, or the unit of the components")


def _disagree(source: Unit, target: Unit) -> bool:
    return source.is_relative != target.is_relative and source.offset != target.offset


def _settle_differences(network: Network) -> None:
    """Set relativeQuantity of connectors without an FMU from the variables connected to them.

    Connectors with variables of both kinds are added to ``network.mixed``.
    """
    if not any(node.unit is not None and node.unit.is_relative for node in network.nodes.values()):
        return
    neighbours: dict[str, list[Node]] = {}
    for link in network.links():
        for here, there in ((link.source, link.target), (link.target, link.source)):
            if here.component is None:
                neighbours.setdefault(here.name, []).append(there)
    settled: set[str] = set()
    for first in neighbours:
        if first not in settled:
            group, kinds = _group(neighbours, first)
            settled |= group
            if len(kinds) > 1:
                network.mixed |= group
            for node in (network.nodes[name] for name in group if kinds == {True}):
                node.unit = None if node.unit is None else replace(node.unit, is_relative=True)


def _group(neighbours: dict[str, list[Node]], first: str) -> tuple[set[str], set[bool]]:
    """Return the connectors without an FMU connected to ``first``, and the relativeQuantity of adjacent variables."""
    group, kinds, pending = {first}, set[bool](), [first]
    while pending:
        for node in neighbours[pending.pop()]:
            if node.component is None and node.name not in group:
                group.add(node.name)
                pending.append(node.name)
            elif node.component is not None and node.unit is not None:
                kinds.add(node.unit.is_relative)
    return group, kinds
