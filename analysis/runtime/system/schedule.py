"""Order in which FMUs are stepped, derived from the direct dependencies of their outputs."""

from __future__ import annotations

import contextlib
from collections.abc import Collection
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from ....common.errors import InputError
from .feedthrough import Dependencies, Feedthrough, cut_loops
from .network import Network, Node, NodeLink

Edge = tuple[Node, Node]  # an output, and the input of another component to which it is connected


@dataclass
class Schedule:
    """Order of components: ``sources_first`` have no direct feedthrough, ``followers`` have direct feedthrough.

    In ``initial_order`` followers are repeated as often as necessary to settle the initialisation. ``late`` lists
    connections that are read one step late because two FMUs wait for each other, although no two of their variables do.
    ``feedthrough`` contains the dependencies that determine the order, and the initial loops that are cut.
    """

    sources_first: list[str]
    followers: list[str]
    initial_order: list[str]
    feedthrough: Feedthrough
    late: list[str] = field(default_factory=list)


@dataclass
class _Order:
    """Order of components: first those without direct feedthrough, then the followers, each after all that it reads.

    ``late`` lists the connections against this order.
    """

    sources: list[str]
    followers: list[str]
    late: list[Edge]

    @property
    def initial(self) -> list[str]:
        """Order with followers repeated once for every late connection, so that all initial outputs settle."""
        return [*self.sources, *self.followers * (len(self.late) + 1)]


def make_schedule(network: Network, feedthrough: Feedthrough, algorithm: str = "sequential") -> Schedule:
    """Return the order of the components. Raises InputError for an algebraic loop, and names its cycle.

    Jacobi's algorithm reads every connection a step late: its initial loops are cut, too, and values are passed along
    them once instead of being solved for. Loops through undeclared dependencies are cut in every algorithm.
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
    """Return the order required by dependencies; inputs in ``unsettled`` need not wait for their sources.

    If FMUs wait for each other and every late connection would affect an output, the order is rejected, unless
    ``cuts_any`` permits such a late connection. Raises InputError.
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
    for edge in list(late):  # a connection found later may already break the same cycle
        with contextlib.suppress(CycleError):
            order = _order(followers, [*edges, edge])
            edges.append(edge)
            late.remove(edge)
    return _Order(sources, order, late)


def _order(followers: Collection[str], edges: Collection[Edge]) -> list[str]:
    """Return the followers, each after the followers that it reads. Raises CycleError."""
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
    # paths end at inputs on which no output depends directly
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
    """Return a connection to a component of the cycle that affects none of the component's outputs along the cycle."""
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
