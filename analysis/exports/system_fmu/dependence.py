"""Which outputs of a system depend directly on its inputs: within one step, through components that do."""

from __future__ import annotations

from collections.abc import Sequence

from ...runtime.system.prepared import PreparedSystem
from .choices import system_connectors


def find_dependencies(systems: Sequence[PreparedSystem], inputs: Sequence[str]) -> dict[str, list[str]]:
    """The inputs that each output depends on directly in one of the systems, which differ in their candidates.

    With Jacobi's algorithm no component does: all step with the values of the step's start.
    """
    direct: dict[str, list[str]] = {}
    for prepared in systems:
        for name in inputs:
            for output in _reached(prepared, name):
                if name not in direct.setdefault(output, []):
                    direct[output].append(name)
    return direct


def _reached(prepared: PreparedSystem, start: str) -> list[str]:
    """The system's outputs that a value at ``start`` reaches in the same communication point."""
    network = prepared.network
    stepping = {} if prepared.algorithm == "jacobi" else prepared.schedule.feedthrough.stepping
    readers: dict[str, list[str]] = {}
    for link in network.links():
        if not link.is_parameter:
            readers.setdefault(link.source.name, []).append(link.target.name)
    seen, queue = {start}, [start]
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
