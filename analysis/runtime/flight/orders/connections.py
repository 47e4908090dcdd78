"""Connections of a system as arrays of the loop, in the order in which values are transferred."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...loop import codes
from ...ssp.conversions import IDENTITY
from ...system.network import Network, NodeLink
from ...system.passing.parameters import numbers
from ...system.schedule import origin
from .exchanged import Exchanged
from .slots import Slots


class Term(NamedTuple):
    """Connection, or a further source added to a connection, as an operand of instructions.

    ``origins`` are the components in which the target's value originates (-1: an input of the system); ``source`` and
    ``target`` are slots.
    """

    code: int
    origins: tuple[int, ...]
    source: int
    target: int


class Connections:
    """Connections grouped by target component, upstream connections first; the last group is for system connectors."""

    def __init__(self, network: Network, exchanged: Exchanged, slots: Slots) -> None:
        self._network = network
        self._passed_parameters = exchanged.passed_parameters
        self._slots = slots.numbers
        self._components = {name: number for number, name in enumerate(network.fmus)}
        groups: dict[str | None, dict[str, NodeLink]] = {name: {} for name in (*network.fmus, None)}
        for name in self._slots:
            link = network.driver.get(name)
            if link is not None and link.target.component is not None and not link.is_parameter:
                self._chain(name, groups[link.target.component])
        for node in network.nodes.values():
            if node.name in self._slots and node.component is None:
                self._chain(node.name, groups[None])
        self._groups = [list(group.values()) for group in groups.values()]

    def _chain(self, name: str, group: dict[str, NodeLink]) -> None:
        """Add the links that lead to a node to ``group``, upstream links first and each only once."""
        link = self._network.driver.get(name)
        if link is None or name in group or name in self._passed_parameters:
            return
        if link.source.component is None:
            self._chain(link.source.name, group)
        group[name] = link

    def terms(self) -> list[list[Term]]:
        """Return the terms of each group, numbered as in `arrays`."""
        return [[term for link in group for term in self._terms(link)] for group in self._groups]

    def arrays(self) -> dict[str, np.ndarray]:
        """Return slots, transformations and mapping tables of all connections, as fields of the loop's program."""
        links = [term for group in self._groups for link in group for term in (link, *link.added)]
        tables = [numbers(self._network, link) + _remainder(link) for link in links]
        firsts = np.cumsum([0, *(len(table) for table in tables)])
        flat = [entry for table in tables for entry in table]
        ranges = [(first, len(table)) for first, table in zip(firsts, tables, strict=False)]
        return {
            "source": np.array([self._slots[link.source.name] for link in links], dtype=np.int64),
            "target": np.array([self._slots[link.target.name] for link in links], dtype=np.int64),
            "factor": np.array([link.transformation.factor for link in links], dtype=np.float64),
            "offset": np.array([link.transformation.offset for link in links], dtype=np.float64),
            "table": np.array(ranges, dtype=np.int64).reshape(-1, 2),
            "table_from": np.array([entry[0] for entry in flat], dtype=np.float64),
            "table_to": np.array([entry[1] for entry in flat], dtype=np.float64),
        }

    def _terms(self, link: NodeLink) -> Sequence[Term]:
        origins = tuple(self._number(term) for term in (link, *link.added))
        slots, target = self._slots, self._slots[link.target.name]
        first = Term(self._code(link), origins, slots[link.source.name], target)
        return [first, *(Term(codes.ADD, origins, slots[term.source.name], target) for term in link.added)]

    def _number(self, link: NodeLink) -> int:
        """Return the number of the component at which a link's value originates, -1 for an input of the system."""
        component = origin(self._network, link).component
        return -1 if component is None else self._components[component]

    def _code(self, link: NodeLink) -> int:
        """Return the code of the instruction that transfers a connection's value."""
        if link.transformation.table:
            return codes.MAP
        if link.transformation != IDENTITY:
            return codes.TRANSFORM
        start = origin(self._network, link)
        fmu = self._network.fmus.get(start.component or "")
        is_wide = fmu is not None and fmu.variables[start.variable].representation.is_wide
        return codes.COPY_EXACT if is_wide else codes.COPY


def _remainder(link: NodeLink) -> list[tuple[float, float]]:
    """Return the NaN entry that ends a partial table, with which the loop leaves unlisted values unchanged."""
    return [(math.nan, math.nan)] if link.transformation.is_partial else []
