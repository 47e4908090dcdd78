"""Values of parameters and constants that connections pass on before a simulation."""

from __future__ import annotations

from .....common.errors import InputError, suggestion
from ...ssp.conversions import VALUE_TYPES
from ...ssp.kinds import PARAMETERS
from ...ssp.parameter_values import ParameterValue
from ..network import Network, Node, NodeLink
from .settings import SystemSettings


def pass_parameters(network: Network, settings: SystemSettings) -> None:
    """Pass the values of system parameters and constants along their connections."""
    for node in network.nodes.values():
        if node.kind in PARAMETERS and node.component is not None and node.name in network.driver:
            brought = _find_passed_value(network, settings, node)
            if brought is not None:
                outermost, passed = brought
                kind: type[ParameterValue] = {"Real": float, "Boolean": bool, "String": str}.get(
                    node.type_name or "", int
                )
                target = node.component or "", node.variable
                before = settings.variables.get(target)
                settings.variables[target] = kind(passed)
                if before is not None and before != settings.variables[target]:
                    settings.replaced[target] = outermost, before
                settings.origins[target] = f"{outermost} of {settings.node_origins.get(outermost, 'its FMU')}"
    for link in network.links():  # connected to an input or out of the system, a parameter is a constant signal
        source = link.source
        if source.kind in PARAMETERS and source.component is None and not link.is_parameter:
            brought = _find_passed_value(network, settings, source)
            if brought is not None:
                settings.nodes[source.name] = brought[1]
            elif source.name not in settings.nodes:
                remedy = f"give {source.name} a value in a parameter set, or `set` {source.name}=VALUE"
                raise network.refuse(link.where, f"{source.name} has no value", remedy)


def _find_passed_value(network: Network, settings: SystemSettings, node: Node) -> tuple[str, float | str] | None:
    """Return the outermost value that connections pass to a parameter, with its source, or None."""
    chain = [network.driver[node.name]] if node.name in network.driver else []
    while chain and chain[-1].source.name in network.driver:
        chain.append(network.driver[chain[-1].source.name])
    for position in range(len(chain) - 1, -1, -1):
        source = chain[position].source
        passed = settings.nodes.get(source.name)
        if source.kind == "constant" and source.component is not None:
            start = network.fmus[source.component].variables[source.variable].start
            passed = _number(str(start), source)
        if passed is not None:
            for link in reversed(chain[: position + 1]):
                passed = _pass_on(network, link, passed)
            return source.name, passed
    return None


def _number(text: str, node: Node) -> float | str:
    """Return a constant's value as in `SystemSettings.nodes`."""
    return text if node.type_name == "String" else float({"true": "1", "false": "0"}.get(text.lower(), text))


def _pass_on(network: Network, link: NodeLink, value: float | str) -> float | str:
    """Return a parameter's value after its transfer over a connection."""
    if isinstance(value, str):
        return value
    if not link.transformation.table:
        return value * link.transformation.factor + link.transformation.offset
    table = dict(numbers(network, link))
    if value not in table:
        if link.transformation.is_partial:
            return value
        raise InputError(
            network.file, link.where, f"the mapping has no entry for {value:g}", "add an entry for this value"
        )
    return table[value]


def numbers(network: Network, link: NodeLink) -> list[tuple[float, float]]:
    """Return a connection's mapping as numbers: Booleans as 0 and 1, enumeration items as their values.

    The list is empty if there is no mapping.
    """
    transformation = link.transformation
    kind = VALUE_TYPES[transformation.kind][0]

    def number(text: str, node: Node) -> float:
        if kind == "Boolean":
            return float(text in ("true", "1"))
        if kind == "Integer":
            return float(text)
        if text not in node.enumeration:
            problem = f"{node.name} has no enumeration item {text}"
            raise InputError(network.file, link.where, problem, suggestion(text, node.enumeration))
        return float(node.enumeration[text])

    return [(number(source, link.source), number(target, link.target)) for source, target in transformation.table]
