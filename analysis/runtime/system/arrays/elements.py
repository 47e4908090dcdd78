"""Expansion of array connectors and their connections into connectors and connections of elements."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from .....common.errors import InputError
from ...ssp.dimensions import Shape, element_name, element_names, indices, text_of
from ...ssp.system_description import Connection, Connector, Element, Point, SystemDescription, SystemElement
from .shapes import Shapes
from .sizes import Sizes, walk


def expand_arrays(description: SystemDescription, sizes: Sizes) -> SystemDescription:
    """Return the description with scalar connectors ``x[1]`` or ``x[2,1]`` for an array x, and their connections.

    ``sizes`` are the dimensions determined by structural parameters. A description without arrays is returned
    unchanged. Raises InputError.
    """
    if not any(_has_arrays(system) for _, system in walk(description.system)):
        return description
    shapes = Shapes(description, sizes)
    return replace(description, system=_expand(description, shapes, "", description.system))


def _has_arrays(system: SystemElement) -> bool:
    """Return True if a system, inner systems excluded, has an array or a connection to an array's element."""
    return (
        any(each.dimensions for owner in (system, *system.elements.values()) for each in owner.connectors.values())
        or any(each.dimensions for signals in system.dictionaries.values() for each in signals.values())
        or any(each.start_indices or each.end_indices for each in system.connections)
    )


def _expand(description: SystemDescription, shapes: Shapes, path: str, system: SystemElement) -> SystemElement:
    elements: dict[str, Element] = {}
    for name, element in system.elements.items():
        inner = f"{path}{name}."
        if isinstance(element, SystemElement):
            elements[name] = _expand(description, shapes, inner, element)
        else:
            elements[name] = replace(element, connectors=_connectors(shapes, inner, element.connectors))
    return replace(
        system,
        connectors=_connectors(shapes, path, system.connectors),
        elements=elements,
        dictionaries={
            name: _connectors(shapes, f"{path}{name}.", signals) for name, signals in system.dictionaries.items()
        },
        connections=[
            each for connection in system.connections for each in _connections(description, shapes, path, connection)
        ],
    )


def _connectors(shapes: Shapes, path: str, connectors: Mapping[str, Connector]) -> dict[str, Connector]:
    expanded: dict[str, Connector] = {}
    for connector in connectors.values():
        for name in element_names(connector.name, shapes.known.get(path + connector.name, ())):
            if name in expanded:
                raise shapes.refuse_second(path, name, connector, expanded[name])
            if connector.dimensions:
                expanded[name] = replace(connector, name=name, dimensions=(), array=connector.name)
            else:
                expanded[name] = connector
    return expanded


def _connections(description: SystemDescription, shapes: Shapes, path: str, connection: Connection) -> list[Connection]:
    """Return the connections of elements that a connection stands for, in the order of the indices at both ends."""
    starts, part = _part(description, shapes, path, connection, connection.start, connection.start_indices)
    ends, other = _part(description, shapes, path, connection, connection.end, connection.end_indices)
    if part != other:
        problem = f"connects {text_of(part)} with {text_of(other)}"
        remedy = "connect arrays of the same shape, or their elements by startIndices and endIndices"
        raise InputError(description.file, connection.where, problem, remedy)
    if starts == [connection.start] and ends == [connection.end]:
        return [connection]
    return [
        replace(connection, start=start, end=end, start_indices=(), end_indices=())
        for start, end in zip(starts, ends, strict=True)
    ]


def _part(
    description: SystemDescription, shapes: Shapes, path: str, connection: Connection, point: Point, chosen: Shape
) -> tuple[list[Point], Shape]:
    """Return the elements at one end of a connection, and the shape that they form."""
    element, connector = point
    shape = shapes.at(path, point)
    if len(chosen) > len(shape) or any(index > size for index, size in zip(chosen, shape, strict=False)):
        name = connector if element is None else f"{element}.{connector}"
        problem = f"no element {' '.join(map(str, chosen))} in {name}, {text_of(shape)}"
        raise InputError(description.file, connection.where, problem, "correct the indices")
    part = shape[len(chosen) :]
    return [(element, element_name(connector, chosen + index)) for index in indices(part)], part
