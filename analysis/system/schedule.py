"""In which order FMUs are stepped, from the direct dependencies of their outputs."""

from __future__ import annotations

import contextlib
from collections.abc import Collection
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter

from ..errors import InputError
from .network import Link, Network, Node

Edge = tuple[Node, Node]  # an output, and the input of another component that its value reaches


@dataclass
class Schedule:
    """Components by class: ``sources_first`` (S) have no direct output, ``followers`` (F) have.

    ``initial_order`` settles initialisation, followers again where need be. ``late`` lists
    connections that are read one step late because two FMUs, though no two variables, wait for
    each other.
    """

    sources_first: list[str]
    followers: list[str]
    initial_order: list[str]
    late: list[str] = field(default_factory=list)


def make_schedule(network: Network, no_feedthrough: Collection[str] = (), algorithm: str = "sequential") -> Schedule:
    """Order the components; raises InputError for an algebraic loop, printing the cycle.

    ``no_feedthrough`` names components whose outputs are taken not to depend directly on inputs. Jacobi's algorithm
    reads every connection a step late anyway: there a loop is cut at the start, too, where its values are passed on
    along it once and not solved for.
    """
    for name in no_feedthrough:
        if name not in network.fmus:
            raise InputError(
                "--no-feedthrough", name, "no such component", f"use one of {', '.join(sorted(network.fmus))}"
            )
    direct: dict[str, dict[str, set[str]]] = {
        name: {} if name in no_feedthrough else fmu.direct_dependencies() for name, fmu in network.fmus.items()
    }
    if algorithm == "sequential":
        _check_loops(network, direct)
    followers = [name for name in network.fmus if any(direct[name].values())]
    follows = set(followers)
    sources = [name for name in network.fmus if name not in follows]
    edges = [
        (start, link.target)
        for link in network.driver.values()
        if link.target.component in follows and not link.is_parameter
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
            if broken is None and algorithm == "jacobi":
                broken = _first(error.args[1], edges)
            if broken is None:
                raise InputError(
                    network.file,
                    " -> ".join(error.args[1]),
                    "these FMUs wait for each other in one communication point",
                    "declare their output dependencies",
                ) from None
            edges.remove(broken)
            late.append(broken)
    for edge in list(late):  # a later one may have opened the same cycle
        with contextlib.suppress(CycleError):
            order = _order(followers, [*edges, edge])
            edges.append(edge)
            late.remove(edge)
    # Once more for every late connection: at the start all outputs settle, which the variables' order allows.
    return Schedule(
        sources, order, [*sources, *order * (len(late) + 1)], [f"{start.name} -> {end.name}" for start, end in late]
    )


def _order(followers: Collection[str], edges: Collection[Edge]) -> list[str]:
    """The followers, each behind those it reads; raises CycleError."""
    graph: dict[str, set[str]] = {name: set() for name in followers}
    for start, end in edges:
        graph[end.component or ""].add(start.component or "")
    return list(TopologicalSorter(graph).static_order())


def origin(network: Network, link: Link) -> Node:
    """The component's output, or the undriven connector, that a link's value comes from."""
    start = link.source
    while start.component is None and start.name in network.driver:
        start = network.driver[start.name].source
    return start


def _check_loops(network: Network, direct: dict[str, dict[str, set[str]]]) -> None:
    graph: dict[str, set[str]] = {}
    # an input on which no output depends directly ends every path
    passed_on = {component: set().union(*outputs.values()) for component, outputs in direct.items()}
    for link in network.driver.values():
        target = link.target
        if not link.is_parameter and (target.component is None or target.variable in passed_on[target.component]):
            graph.setdefault(link.target.name, set()).add(link.source.name)
    for node in network.nodes.values():
        if node.kind == "output" and node.component is not None:
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
            "break it with an FMU whose output does not depend directly on its input (or --no-feedthrough COMPONENT), "
            "or fly it a step late, --algorithm jacobi",
        ) from None


def _breakable(cycle: list[str], edges: Collection[Edge], direct: dict[str, dict[str, set[str]]]) -> Edge | None:
    """A connection into a component of the cycle on which nothing it sends along the cycle depends."""
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
    """A connection along a cycle."""
    return next((start, end) for start, end in edges if (start.component, end.component) == (cycle[0], cycle[1]))
