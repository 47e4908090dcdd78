"""Order in which FMUs are stepped, from the direct dependencies of their outputs."""

from __future__ import annotations

import contextlib
from collections.abc import Collection
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from ....common.errors import InputError
from .feedthrough import Dependencies, Feedthrough, cut_loops
from .network import Network, Node, NodeLink

Edge = tuple[Node, Node]  # an output, and another component's input to which it is connected


@dataclass
class Schedule:
    """Order of components: ``sources_first`` (S) have no direct feedthrough, ``followers`` (F) have.

    ``initial_order`` settles the initialisation, with followers repeated if necessary. ``late`` lists connections read
    one step late because two FMUs wait for each other, although no two of their variables do. ``feedthrough`` are the
    dependencies that determine the order, with the initial loops that are cut.
    """

    sources_first: list[str]
    followers: list[str]
    initial_order: list[str]
    feedthrough: Feedthrough
    late: list[str] = field(default_factory=list)


@dataclass
class _Order:
    """Order of components without direct feedthrough, then of the others, each after those that it reads.

    ``late`` are the connections against this order.
    """

    sources: list[str]
    followers: list[str]
    late: list[Edge]

    @property
    def initial(self) -> list[str]:
        """Order with followers repeated once for every late connection, so that all initial outputs settle."""
        return [*self.sources, *self.followers * (len(self.late) + 1)]


def make_schedule(network: Network, feedthrough: Feedthrough, algorithm: str = "sequential") -> Schedule:
    """Return the order of the components. Raises InputError for an algebraic loop, with its cycle.

    Jacobi's algorithm reads every connection a step late: its initial loops are cut as well, with values passed along
    them once and not solved for. Loops through undeclared dependencies are cut in any algorithm.
    """
    if algorithm == "sequential":
        _check_loops(network, feedthrough.stepping)
    order = initial = _arrange(network, feedthrough.stepping, cuts_any=algorithm == "jacobi")
    if feedthrough.undeclared:
        feedthrough, unsettled = cut_loops(network, feedthrough)
        initial = _arrange(network, feedthrough.initial, cuts_any=True, unsettled=unsettled)
    late = [f"{start.name} -> {end.name}" for start, end in order.late]
    return Schedule(order.sources, order.followers, initial.initial, feedthrough, late)


def _arrange(network: Network, direct: Dependencies, *, cuts_any: bool, unsettled: Collection[str] = ()) -> _Order:
    """Return the order that dependencies require; inputs in ``unsettled`` need not wait for their sources.

    ``cuts_any``: if FMUs wait for each other and every late connection would affect an output, one is late
    nevertheless.
    """
    followers = [name for name in network.fmus if any(direct[name].values())]
    follows = set(followers)
    sources = [name for name in network.fmus if name not in follows]
    edges = [
        (start, link.target)
        for link in network.links()
        if link.target.component in follows and not link.is_parameter and link.target.name not in unsettled
        for start in [origin(network, link)]
        if start.component in follows
    ]
    late: list[Edge] = []
    while True:
        try:
            order = _order(followers, edges)
            break
        except CycleError as error:
            broken = _breakable(error.args[1], edges, direct)
            if broken is None and cuts_any:
                broken = _first(error.args[1], edges)
            if broken is None:
                raise InputError(
                    network.file,
                    " -> ".join(error.args[1]),
                    "these FMUs wait for each other at a communication point",
                    "declare their output dependencies",
                ) from None
            edges.remove(broken)
            late.append(broken)
    for edge in list(late):  # a later one may have opened the same cycle
        with contextlib.suppress(CycleError):
            order = _order(followers, [*edges, edge])
            edges.append(edge)
            late.remove(edge)
    return _Order(sources, order, late)


def _order(followers: Collection[str], edges: Collection[Edge]) -> list[str]:
    """Return the followers, each after those that it reads. Raises CycleError."""
    graph: dict[str, set[str]] = {name: set() for name in followers}
    for start, end in edges:
        graph[end.component or ""].add(start.component or "")
    return list(TopologicalSorter(graph).static_order())


def origin(network: Network, link: NodeLink) -> Node:
    """Return the component's output, or the undriven connector, at which a link's value originates."""
    start = link.source
    while start.component is None and start.name in network.driver:
        start = network.driver[start.name].source
    return start


def _check_loops(network: Network, direct: Dependencies) -> None:
    graph: dict[str, set[str]] = {}
    # an input on which no output depends directly ends every path
    passed_on = {component: set().union(*outputs.values()) for component, outputs in direct.items()}
    for link in network.links():
        target = link.target
        if not link.is_parameter and (target.component is None or target.variable in passed_on[target.component]):
            graph.setdefault(link.target.name, set()).add(link.source.name)
    for node in network.nodes.values():
        if node.kind in ("output", "local") and node.component is not None:
            inputs = direct[node.component].get(node.variable)
            if inputs:
                graph.setdefault(node.name, set()).update(f"{node.component}.{name}" for name in inputs)
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        raise InputError(
            network.file,
            "algebraic loop",
            " -> ".join(error.args[1]),
            "break it with an FMU whose output does not depend directly on its input (or `no_feedthrough` COMPONENT), "
            "or delay it by a step with `algorithm` jacobi",
        ) from None


def _breakable(cycle: list[str], edges: Collection[Edge], direct: Dependencies) -> Edge | None:
    """Return a connection into a component of the cycle none of whose outputs along the cycle depends on it."""
    for position in range(len(cycle) - 1):
        before, here = cycle[position], cycle[position + 1]
        after = cycle[position + 2] if position + 2 < len(cycle) else cycle[1]
        sent = {start.variable for start, end in edges if start.component == here and end.component == after}
        for start, end in edges:
            enters = start.component == before and end.component == here
            if enters and not any(end.variable in direct[here].get(name, set()) for name in sent):
                return start, end
    return None


def _first(cycle: list[str], edges: Collection[Edge]) -> Edge:
    """Return a connection along a cycle."""
    return next((start, end) for start, end in edges if (start.component, end.component) == (cycle[0], cycle[1]))
