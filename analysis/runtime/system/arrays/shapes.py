"""Shapes of array connectors: as declared, as in the FMU, or as in a connected array."""

from __future__ import annotations

import math
from collections.abc import Iterator

from .....common.bounds import ARRAY_ELEMENTS
from .....common.errors import InputError
from ...ssp.dimensions import Shape, array_shapes, text_of
from ...ssp.system_description import Component, Connection, Connector, Element, Point, SystemDescription, SystemElement
from .sizes import Sizes, walk

Open = tuple[int | None, ...]  # a shape with sizes that may be unknown


class Shapes:
    """Shapes of all array connectors by hierarchical name. Raises InputError if a shape cannot be determined."""

    def __init__(self, description: SystemDescription, sizes: Sizes) -> None:
        self.description = description
        self.load = sizes.load
        self.of_fmus: dict[str, dict[str, Shape]] = {}
        self.without_arrays: list[str] = []  # components of FMI 2.0, which has only scalars
        shapes: dict[str, Open] = {}
        declared: dict[str, Connector] = {}
        for path, element in _elements(description.system):
            for connector in element.connectors.values():
                if connector.dimensions:
                    name = path + connector.name
                    declared[name] = connector
                    shapes[name] = tuple(
                        sizes.size(element, path, each, connector.name) if each.connector else each.size
                        for each in connector.dimensions
                    )
                    if isinstance(element, Component):
                        shapes[name] = self._as_in_fmu(path.removesuffix("."), element, connector, shapes[name])
        for path, system in walk(description.system):
            for dictionary, signals in system.dictionaries.items():
                for signal in signals.values():
                    if signal.dimensions:
                        name = f"{path}{dictionary}.{signal.name}"
                        declared[name] = signal
                        shapes[name] = tuple(each.size for each in signal.dimensions)
        if self.without_arrays:
            names = ", ".join(self.without_arrays)
            note = f"array connectors of FMI 2.0 FMUs ({names}), which need one connector per element"
            description.notes.append(note)
        self._infer_sizes(shapes)
        for name, shape in shapes.items():
            if None in shape:
                problem = f"dimension {shape.index(None) + 1} has no size, neither here nor at a connected end"
                raise InputError(description.file, declared[name].at(name), problem, "write size or sizeConnector")
        self.known: dict[str, Shape] = {name: tuple(each or 0 for each in shape) for name, shape in shapes.items()}
        ARRAY_ELEMENTS.check(sum(math.prod(shape) for shape in self.known.values()), description.file, "Dimension")

    def at(self, path: str, point: Point) -> Shape:
        """Return the shape of the connector at an end of a connection; () for scalars and unknown connectors."""
        return self.known.get(name_of(path, point), ())

    def refuse_second(self, path: str, name: str, second: Connector, first: Connector) -> InputError:
        """Return the error for an array's element that is declared as a connector, too."""
        where = second.at(path + name)
        return InputError(self.description.file, where, f"is also declared in line {first.line}", "remove one")

    def _as_in_fmu(self, name: str, component: Component, connector: Connector, shape: Open) -> Open:
        """Return the shape of an array in its component's FMU. Raises InputError if a different shape is declared."""
        fmu = self.load(name, component)
        if name not in self.of_fmus:
            self.of_fmus[name] = array_shapes(fmu.variables)
            if fmu.description.fmiVersion == "2.0":
                self.without_arrays.append(name)
        actual = self.of_fmus[name].get(connector.name)
        where = connector.at(f"{name}.{connector.name}")
        if actual is None:
            if math.prod(each or 0 for each in shape) == 0 and None not in shape:
                return shape  # an array without elements, for which an FMU has no names
            known = "is a scalar in" if connector.name in fmu.variables else "is not an array of"
            raise InputError(
                self.description.file, where, f"{known} {fmu.label}", "correct its Dimensions or use another FMU"
            )
        if len(actual) != len(shape) or any(
            stated not in (None, size) for stated, size in zip(shape, actual, strict=True)
        ):
            size = " x ".join("?" if each is None else str(each) for each in shape)
            problem = f"has {text_of(actual)} in {fmu.label}, but {size} here"
            raise InputError(self.description.file, where, problem, "correct its Dimensions or use another FMU")
        return actual

    def _infer_sizes(self, shapes: dict[str, Open]) -> None:
        """Infer unknown sizes from the other ends of connections between complete arrays."""
        ends = [
            (name_of(path, connection.start), name_of(path, connection.end))
            for path, connection in _connections(self.description)
            if not connection.start_indices and not connection.end_indices
        ]
        changed = True
        while changed:
            changed = False
            for pair in (*ends, *((end, start) for start, end in ends)):
                here, there = (shapes.get(name, ()) for name in pair)
                if None in here and len(here) == len(there):
                    filled = tuple(
                        second if first is None else first for first, second in zip(here, there, strict=True)
                    )
                    changed = changed or filled != here
                    shapes[pair[0]] = filled


def name_of(path: str, point: Point) -> str:
    """Return the hierarchical name of the connector at an end of a connection in the system at ``path``."""
    element, connector = point
    return path + connector if element is None else f"{path}{element}.{connector}"


def _elements(system: SystemElement, path: str = "") -> Iterator[tuple[str, Element]]:
    """Yield all elements, each after the prefix of its connectors' hierarchical names."""
    for outer, inner in walk(system, path):
        yield outer, inner
        for element in inner.elements.values():
            if not isinstance(element, SystemElement):
                yield f"{outer}{element.name}.", element


def _connections(description: SystemDescription) -> Iterator[tuple[str, Connection]]:
    for path, system in walk(description.system):
        for connection in system.connections:
            yield path, connection
