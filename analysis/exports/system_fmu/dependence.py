"""Direct dependence of a system's outputs on its inputs: within one step, through components that have it."""

from __future__ import annotations

from collections.abc import Sequence

from ...runtime.ssp.names import split_name
from ...runtime.system.prepared import PreparedSystem
from .choices import system_connectors


def find_dependencies(
    systems: Sequence[PreparedSystem], inputs: Sequence[str], faulty: Sequence[str]
) -> dict[str, list[str]]:
    """Return the inputs that each output depends on directly in one of the systems, which differ in their candidates.

    Those of the faults of a connector are among them where its value reaches the output in the same step.

    With Jacobi's algorithm no component does: all step with the values of the step's start.
    """
    sources = {**{name: [name] for name in inputs}, **{name: fault_inputs(name) for name in faulty}}
    direct: dict[str, list[str]] = {}
    for prepared in systems:
        for start, names in sources.items():
            for output in _find_outputs(prepared, start):
                direct[output] = list(dict.fromkeys([*direct.get(output, ()), *names]))
    return direct


def fault_inputs(connector: str) -> list[str]:
    """Return the FMU's inputs for the faults of a connector: the kind of fault, and its value."""
    return [f"fault.{connector}.kind", f"fault.{connector}.value"]


def _follow(prepared: PreparedSystem, start: str) -> list[str]:
    """Return what carries a value at ``start`` on: of a parameter the outputs of a component that steps behind it."""
    component, variable = split_name(start, prepared.network.fmus)
    known = prepared.network.fmus[component].variables if component else {}
    if variable not in known or known[variable].causality != "parameter":
        return [start]
    if prepared.algorithm == "jacobi" or component not in prepared.schedule.followers:
        return []
    return [f"{component}.{name}" for name, each in known.items() if each.causality == "output"]


def _find_outputs(prepared: PreparedSystem, start: str) -> list[str]:
    """Return the system's outputs that a value at ``start`` reaches in the same communication point."""
    network = prepared.network
    stepping = {} if prepared.algorithm == "jacobi" else prepared.schedule.feedthrough.stepping
    readers: dict[str, list[str]] = {}
    for link in network.links():
        if not link.is_parameter:
            readers.setdefault(link.source.name, []).append(link.target.name)
    queue = _follow(prepared, start)
    seen = set(queue)
    while queue:
        name = queue.pop()
        node = network.nodes.get(name)
        successors = list(readers.get(name, ()))
        if node is not None and node.component is not None and node.kind == "input":
            outputs = stepping.get(node.component, {}).items()
            successors += [f"{node.component}.{output}" for output, given in outputs if node.variable in given]
        queue += [each for each in successors if each not in seen]
        seen.update(successors)
    return [name for name in system_connectors(network, "output") if name in seen]
