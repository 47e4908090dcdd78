"""Sizes of dimensions determined by a structural parameter or a constant, before a system is flattened."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

from .....common.errors import InputError
from ...ssp.archive import SystemArchive
from ...ssp.dimensions import Dimension
from ...ssp.parameter_sets import Assignment, read_binding
from ...ssp.parameter_values import ParameterValue
from ...ssp.system_description import Component, Element, SystemDescription, SystemElement
from ..fmu import Fmu

SIZES = ("structuralParameter", "constant")  # kinds of connectors that determine a size
Load = Callable[[str, Component], Fmu]


def walk(system: SystemElement, path: str = "") -> Iterator[tuple[str, SystemElement]]:
    """Yield each system after its path, which is "" for the outermost system and ends with a dot for inner systems."""
    yield path, system
    for element in system.elements.values():
        if isinstance(element, SystemElement):
            yield from walk(element, f"{path}{element.name}.")


def assigned_values(
    description: SystemDescription, archive: SystemArchive, assignments: Sequence[Assignment]
) -> dict[str, ParameterValue]:
    """Return values of parameter sets and options by hierarchical name.

    Later values override earlier ones, and outer values override inner ones. No FMU is needed: names are not checked,
    and values are not converted. Raises InputError.
    """
    values: dict[str, ParameterValue] = {}
    unmatched: list[str] = []  # flaws are reported later, when the values are applied
    for path, system in sorted(walk(description.system), key=lambda pair: -pair[0].count(".")):
        for prefix, element in [(f"{path}{inner.name}.", inner) for inner in system.elements.values()] + [
            (path, system)
        ]:
            if isinstance(element, Component) or element is system:
                for binding in element.bindings:
                    assignments_read, _ = read_binding(archive, description.file, binding, description.units, unmatched)
                    values |= {prefix + each.name: each.value for each in assignments_read}
    return values | {each.name: each.value for each in assignments}


class Sizes:
    """Sizes of dimensions. ``assigned`` returns the assigned values; it is called when they are first needed."""

    def __init__(
        self, description: SystemDescription, assigned: Callable[[], Mapping[str, ParameterValue]], load: Load
    ) -> None:
        self.description = description
        self.assigned = assigned
        self.load = load
        self.sources = _structural_sources(description)
        self.components = {
            path + element.name: element
            for path, system in walk(description.system)
            for element in system.elements.values()
            if isinstance(element, Component)
        }

    def size(self, owner: Element, path: str, dimension: Dimension, array: str) -> int:
        """Return the size of a dimension of ``array`` that is determined by a connector of the element ``owner``.

        ``path`` is the prefix of the names of the owner's connectors. Raises InputError.
        """
        name = dimension.connector or ""
        where = f"{path}{array}, Dimension (line {dimension.line})"
        connector = owner.connectors.get(name)
        if connector is None or connector.kind not in SIZES or connector.dimensions:
            problem = f"sizeConnector {name} is neither a structural parameter nor a constant of {owner.name}"
            raise InputError(self.description.file, where, problem, "correct sizeConnector, or write size")
        full = path + name
        chain = self._chain(full)
        assigned = self._find_assigned(chain) if connector.kind == "structuralParameter" else None
        return self._check(self._find_start(full) if assigned is None else assigned, full, where)

    def connected(self, component: str, names: Collection[str]) -> dict[str, int]:
        """Return the values of those structural parameters ``names`` of a component that are set by connections.

        Raises InputError.
        """
        sizes = {}
        for name in names:
            full = f"{component}.{name}"
            chain = self._chain(full)[1:]
            assigned = self._find_assigned(chain)
            if assigned is not None:
                sizes[name] = self._check(assigned, chain[-1], full)
        return sizes

    def _chain(self, name: str) -> list[str]:
        """Return a structural parameter and its chain of sources, the outermost last."""
        chain = [name]
        while self.sources.get(chain[-1], chain[-1]) not in chain:
            chain.append(self.sources[chain[-1]])
        return chain

    def _find_assigned(self, chain: Sequence[str]) -> object:
        """Return the outermost value assigned along a chain, or the value of the constant at its end."""
        if not chain:
            return None
        assigned = self.assigned()
        return next((assigned[name] for name in reversed(chain) if name in assigned), self._constant(chain[-1]))

    def _constant(self, name: str) -> object:
        component, _, short = name.rpartition(".")
        owner = self.components.get(component)
        declared = owner.connectors.get(short) if owner is not None else None
        return self._find_start(name) if declared is not None and declared.kind == "constant" else None

    def _find_start(self, name: str) -> object:
        """Return the start value of a variable, as declared by a component's FMU."""
        component, _, short = name.rpartition(".")
        if component not in self.components:
            return None
        variable = self.load(component, self.components[component]).variables.get(short)
        return None if variable is None else variable.start

    def _check(self, value: object, name: str, where: str) -> int:
        try:
            size = int(str(value))
        except ValueError:
            size = -1
        if size < 0:
            problem = f"{name} has no value" if value is None else f"{name} is {value}, which is not a valid size"
            raise InputError(self.description.file, where, problem, "give this parameter a value in a parameter set")
        return size


def _structural_sources(description: SystemDescription) -> dict[str, str]:
    """Return the sources of structural parameters, by hierarchical name."""
    sources: dict[str, str] = {}
    for path, system in walk(description.system):
        for connection in system.connections:
            ends = []
            for element, connector in (connection.start, connection.end):
                owner = system if element is None else system.elements.get(element)
                declared = owner.connectors.get(connector) if owner is not None else None
                name = path + connector if element is None else f"{path}{element}.{connector}"
                ends.append((element, name, declared.kind if declared is not None else ""))
            for (outer, source, kind), (inner, target, target_kind) in (ends, ends[::-1]):
                leads = (kind == "constant" and outer is not None) or (kind in SIZES and outer is None)
                if leads and inner is not None and target_kind == "structuralParameter":
                    sources[target] = source
    return sources
