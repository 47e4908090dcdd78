"""Direct dependence of a system's outputs on its inputs within a step, caused by feedthrough of components."""

from __future__ import annotations

from collections.abc import Sequence

from ...runtime.ssp.names import split_name
from ...runtime.system.prepared import PreparedSystem
from .choices import system_connectors


def find_dependencies(
    systems: Sequence[PreparedSystem], inputs: Sequence[str], faulty: Sequence[str]
) -> dict[str, list[str]]:
    """Return the inputs on which each output depends directly in at least one of the systems (one system per choice).

    Fault inputs of a connector are included if the connector's value affects the output in the same step. With Jacobi's
    algorithm no dependence passes through a component, because all components step with values from the start of the
    step.
    """
    sources = {**{name: [name] for name in inputs}, **{name: fault_inputs(name) for name in faulty}}
    direct: dict[str, list[str]] = {}
    for prepared in systems:
        for start, names in sources.items():
            for output in _find_outputs(prepared, start):
                direct[output] = list(dict.fromkeys([*direct.get(output, ()), *names]))
    return direct


def fault_inputs(connector: str) -> list[str]:
    """Return the names of the FMU's inputs for the faults of a connector: the fault's kind, and its value."""
    return [f"fault.{connector}.kind", f"fault.{connector}.value"]


def _follow(prepared: PreparedSystem, start: str) -> list[str]:
    """Return the signals that propagate the value at ``start``: itself, or all outputs of a parameter's component.

    There are none for a parameter if its component steps before its inputs are updated.
    """
    component, variable = split_name(start, prepared.network.fmus)
    known = prepared.network.fmus[component].variables if component else {}
    if variable not in known or known[variable].causality != "parameter":
        return [start]
    if prepared.algorithm == "jacobi" or component not in prepared.schedule.followers:
        return []
    return [f"{component}.{name}" for name, each in known.items() if each.causality == "output"]


def _find_outputs(prepared: PreparedSystem, start: str) -> list[str]:
    """Return the system outputs that the value at ``start`` affects at the same communication point."""
    network = prepared.network
    stepping = {} if prepared.algorithm == "jacobi" else prepared.schedule.feedthrough.stepping
    readers: dict[str, list[str]] = {}
    for link in network.links():
        if not link.is_parameter:
            readers.setdefault(link.source.name, []).append(link.target.name)
    queue = _follow(prepared, start)
    visited = set(queue)
    while queue:
        name = queue.pop()
        node = network.nodes.get(name)
        successors = list(readers.get(name, ()))
        if node is not None and node.component is not None and node.kind == "input":
            outputs = stepping.get(node.component, {}).items()
            successors += [
                f"{node.component}.{output}" for output, dependencies in outputs if node.variable in dependencies
            ]
        queue += [each for each in successors if each not in visited]
        visited.update(successors)
    return [name for name in system_connectors(network, "output") if name in visited]
