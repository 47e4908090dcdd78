"""Flattening of a description, with checks of its connectors and connections."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ....common.errors import suggestion
from ..ssp.conversions import IDENTITY, Unit, check_type
from ..ssp.kinds import PARAMETERS, can_connect
from ..ssp.system_description import (
    Component,
    Connection,
    Connector,
    DictionaryReference,
    Element,
    Point,
    SystemDescription,
    SystemElement,
)
from ..ssp.types import is_of_type, runtime_type
from .fmu import Fmu
from .network import Network, Node, NodeLink
from .passing.connection_units import convert_units

SUMMED = ("Real", "Integer")
# Different types of source and target that are compatible.
WIDENED = (("Integer", "Real"), ("Integer", "Enumeration"), ("Enumeration", "Integer"), ("Enumeration", "Real"))


def build_network(description: SystemDescription, load: Callable[[str, Component], Fmu]) -> Network:
    """Return the flat network of a description, with every connector and connection checked.

    ``load(name, component)`` returns the FMU of a component by the component's flat name. Raises InputError.
    """
    network = Network(description)
    _walk(network, description.system, "")
    for name, component in network.components():
        if name in network.fmus:
            raise network.refuse(f"{name} (line {component.line})", "two components have this name", "rename one")
        network.fmus[name] = load(name, component)
        for connector in component.connectors.values():
            _add(network, _component_node(network, name, connector))
    for path, system in network.systems.items():
        for connection in system.connections:
            _connect(network, path, system, connection)
    convert_units(network)
    _settle_types(network)
    for link in network.links():
        _check_link(network, link)
    return network


def _walk(network: Network, system: SystemElement, path: str) -> None:
    network.systems[path] = system
    for connector in system.connectors.values():
        _add(network, _plain_node(network, path + connector.name, connector))
    for dictionary, signals in system.dictionaries.items():
        for signal in signals.values():
            _add(network, _plain_node(network, f"{path}{dictionary}.{signal.name}", signal))
    for element in system.elements.values():
        if isinstance(element, SystemElement):
            _walk(network, element, f"{path}{element.name}.")


def _add(network: Network, node: Node) -> None:
    if node.name in network.nodes:
        raise network.refuse(node.where, "two connectors have this name", "rename one")
    network.nodes[node.name] = node


def _unit(network: Network, name: str, fmu: Fmu | None, connector: Connector) -> Unit | None:
    """Return the unit of a connector, by its flat name: the unit declared in the SSD, or else in its FMU."""
    unit = connector.unit
    if unit is None:
        return None
    known = network.description.units.get(unit) or (fmu.units.get(unit) if fmu is not None else None)
    if known is None:
        raise network.refuse(connector.at(name), f"unit {unit} is not defined", "define it under Units of the SSD")
    return known


def _plain_node(network: Network, name: str, connector: Connector) -> Node:
    unit = _unit(network, name, None, connector)
    items = network.description.enumerations.get(connector.enumeration or "", {})
    return Node(name, connector.kind, None, connector.name, connector.type_name, unit, connector.line, items)


def _component_node(network: Network, component: str, connector: Connector) -> Node:
    """Return the node of a component's connector, checked against the variable in its FMU."""
    fmu = network.fmus[component]
    name = f"{component}.{connector.name}"
    variable = fmu.variables.get(connector.name)
    if variable is None:
        if f"{connector.name}[1]" in fmu.variables or f"{connector.name}[1,1]" in fmu.variables:
            problem = f"is an array in {fmu.label}, but a scalar here"
            raise network.refuse(
                connector.at(name), problem, "give the connector its Dimensions (SSP 2.0), or name its elements"
            )
        remedy = f"correct the connector or use another FMU; {suggestion(connector.name, fmu.variables)}"
        raise network.refuse(connector.at(name), f"{fmu.label} has no variable of this name", remedy)
    kind = connector.kind or variable.causality
    if variable.causality != kind and not (kind == "constant" and variable.variability == "constant"):
        raise network.refuse(
            connector.at(name),
            f"is {variable.causality} in {fmu.label}, but {kind} here" + (f" ({fmu.flaws[0]})" if fmu.flaws else ""),
            "correct the connector's kind or use another FMU",
        )
    stored = variable.type if variable.type == "Enumeration" else variable.representation.name
    exact = connector.exact_type or connector.type_name
    if exact is not None and not is_of_type(stored, exact):
        actual = stored if runtime_type(exact) == variable.type else variable.type
        raise network.refuse(
            connector.at(name),
            f"is {actual} in {fmu.label}, {exact} here",
            "correct the connector's type or use another FMU",
        )
    own = fmu.unit_of(variable)
    declared = _unit(network, name, fmu, connector)
    if own and declared and not own.is_same(declared):
        raise network.refuse(
            connector.at(name),
            f"its unit is {own.differs_from(declared)} in {fmu.label}, but {declared.differs_from(own)} here",
            "correct the connector's unit or use another FMU",
        )
    unit, items = declared or own, dict(variable.items)
    unit = None if unit is None else replace(unit, is_relative=variable.is_relative)
    return Node(name, kind, component, connector.name, variable.type, unit, connector.line, items, connector.array)


def _end(network: Network, path: str, system: SystemElement, point: Point, connection: Connection) -> Node:
    """Return the node at one end of a connection."""
    element_name, connector_name = point
    owner: Element = system
    prefix = path
    if element_name is not None:
        if element_name not in system.elements:
            raise network.refuse(
                connection.where, f"no element {element_name}", suggestion(element_name, system.elements)
            )
        owner = system.elements[element_name]
        prefix = f"{path}{element_name}."
    if connector_name not in owner.connectors:
        raise network.refuse(
            connection.where,
            f"{owner.name} declares no connector {connector_name}",
            suggestion(connector_name, owner.connectors),
        )
    if isinstance(owner, DictionaryReference):
        return _signal(network, path, owner, connector_name, connection.where)
    return network.nodes[prefix + connector_name]


def _signal(network: Network, path: str, reference: DictionaryReference, signal: str, where: str) -> Node:
    """Return the node of a dictionary's signal; the dictionary is the nearest of its name in surrounding systems."""
    level = path
    while True:
        system = network.systems[level]
        if reference.dictionary in system.dictionaries:
            if signal not in system.dictionaries[reference.dictionary]:
                raise network.refuse(
                    where,
                    f"dictionary {reference.dictionary} has no signal {signal}",
                    suggestion(signal, system.dictionaries[reference.dictionary]),
                )
            return network.nodes[f"{level}{reference.dictionary}.{signal}"]
        if not level:
            raise network.refuse(where, f"no signal dictionary {reference.dictionary}", "declare it")
        level = level[: level.rstrip(".").rfind(".") + 1]


def _connect(network: Network, path: str, system: SystemElement, connection: Connection) -> None:
    link = _link(network, path, system, connection)
    if link.target.name in network.driver:
        first = network.driver[link.target.name]
        raise network.refuse(
            connection.where,
            f"{link.target.name} is driven twice, first by {first.source.name} (line {first.line})",
            "remove one of the two connections",
        )
    link.added += [_link(network, path, system, replace(connection, start=start)) for start in connection.added]
    end = _end(network, path, system, connection.end, connection)
    backwards = next((term for term in (link, *link.added) if term.target is not end), None)
    if link.added and backwards is not None:
        problem = f"{backwards.target.name} is an {backwards.target.kind} and cannot be a term of a sum"
        raise network.refuse(connection.where, problem, "sum outputs, and connect the result to an input")
    network.driver[link.target.name] = link


def find_direction(
    network: Network, path: str, system: SystemElement, connection: Connection
) -> tuple[tuple[Point, Node], tuple[Point, Node]]:
    """Return source and target of a connection with their nodes, since SSP does not define its direction.

    ``path`` is the path of the ``system`` that contains the connection. Raises InputError.
    """
    start = _end(network, path, system, connection.start, connection)
    end = _end(network, path, system, connection.end, connection)
    start_is_own, end_is_own = (point[0] is None for point in (connection.start, connection.end))
    forwards = (connection.start, start), (connection.end, end)
    if can_connect(start.kind, start_is_own, end.kind, end_is_own):
        return forwards
    if not can_connect(end.kind, end_is_own, start.kind, start_is_own):
        problem = f"{start.name} is {start.kind} and {end.name} is {end.kind}, which cannot be connected"
        remedy = "connect an output with an input"
        if (start.kind in PARAMETERS) != (end.kind in PARAMETERS):
            problem = f"connects {start.kind} {start.name} with {end.kind} {end.name}"
            remedy = "connect parameters with parameters, and signals with signals"
        raise network.refuse(connection.where, problem, remedy)
    return forwards[1], forwards[0]


def _link(network: Network, path: str, system: SystemElement, connection: Connection) -> NodeLink:
    """Return the link of a connection, from the connection's start or, if values flow backwards, from its end."""
    (_, start), (_, end) = find_direction(network, path, system, connection)
    if start.kind == "calculatedParameter" and end.kind == "parameter":
        raise network.refuse(
            connection.where,
            "calculated parameters cannot be connected with parameters",
            "remove the connection and give the value in a parameter set",
        )
    return NodeLink(start, end, connection.transformation, connection.line, connection.suppress_unit_conversion)


def _settle_types(network: Network) -> None:
    """Set undeclared types of system connectors to the types of their sources or targets."""
    changed = True
    while changed:
        changed = False
        for link in network.links():
            for here, there in ((link.source, link.target), (link.target, link.source)):
                if here.type_name is None and there.type_name is not None:
                    here.type_name, here.enumeration, changed = there.type_name, there.enumeration, True


def _check_link(network: Network, link: NodeLink) -> None:
    source, target = link.source, link.target
    if source.type_name != target.type_name and (source.type_name, target.type_name) not in WIDENED:
        raise network.refuse(
            link.where, f"types differ: {source.type_name} and {target.type_name}", "connect variables of the same type"
        )
    if link.added and target.type_name not in SUMMED:
        raise network.refuse(link.where, f"values of type {target.type_name} cannot be added", "add Reals or Integers")
    if link.transformation != IDENTITY:
        check_type(link.transformation, target.type_name or "", network.file, link.where)
