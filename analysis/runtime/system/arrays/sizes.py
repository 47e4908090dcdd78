"""The sizes of dimensions that a structural parameter or a constant gives, before a system is flattened."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from ....common.errors import InputError
from ...ssp.archive import SystemArchive
from ...ssp.description import Component, Connector, Description, Element, System
from ...ssp.dimensions import Dimension
from ...ssp.given_values import ParameterValue
from ...ssp.parameter_sets import Assignment, read_binding
from ..fmu import Fmu

SIZES = ("structuralParameter", "constant")  # kinds of connectors that give a size
Load = Callable[[str, Component], Fmu]


def walk(system: System, path: str = "") -> Iterator[tuple[str, System]]:
    """A system and those inside it, with their paths: empty for the outermost, else with a dot behind."""
    yield path, system
    for element in system.elements.values():
        if isinstance(element, System):
            yield from walk(element, f"{path}{element.name}.")


def given_values(
    description: Description, archive: SystemArchive, assignments: Sequence[Assignment]
) -> dict[str, ParameterValue]:
    """The values of parameter sets and options by hierarchical name, later ones over earlier, outer over inner ones.

    No FMU is needed for that: names are not looked up, nor values converted. Raises InputError.
    """
    values: dict[str, ParameterValue] = {}
    unmatched: list[str] = []  # flaws are for the reading that applies the values
    for path, system in sorted(walk(description.system), key=lambda pair: -pair[0].count(".")):
        for prefix, element in [(f"{path}{inner.name}.", inner) for inner in system.elements.values()] + [
            (path, system)
        ]:
            if isinstance(element, Component) or element is system:
                for binding in element.bindings:
                    given, _ = read_binding(archive, description.file, binding, description.units, unmatched)
                    values |= {prefix + each.name: each.value for each in given}
    return values | {each.name: each.value for each in assignments}


class Sizes:
    """Sizes of dimensions. ``given`` reads the values that are given, when they are first needed."""

    def __init__(self, description: Description, given: Callable[[], Mapping[str, ParameterValue]], load: Load) -> None:
        self.description = description
        self.given = given
        self.load = load
        self.sources = _structural_sources(description)
        self.components = {
            path + element.name: element
            for path, system in walk(description.system)
            for element in system.elements.values()
            if isinstance(element, Component)
        }

    def size(self, owner: Element, path: str, dimension: Dimension, array: str) -> int:
        """The size of a dimension of ``array`` that a connector gives, of the element ``owner`` at ``path``.

        Raises InputError.
        """
        name = dimension.connector or ""
        where = f"{path}{array}, Dimension (line {dimension.line})"
        connector = owner.connectors.get(name)
        if connector is None or connector.kind not in SIZES or connector.dimensions:
            problem = f"sizeConnector {name} is no structural parameter and no constant of {owner.name}"
            raise InputError(self.description.file, where, problem, "correct it, or write size")
        given = self._given(path, connector)
        try:
            size = int(str(given))
        except ValueError:
            size = -1
        if size < 0:
            problem = f"{path}{name} has no value" if given is None else f"{path}{name} is {given}, which is no size"
            raise InputError(self.description.file, where, problem, "give it one in a parameter set")
        return size

    def _given(self, path: str, connector: Connector) -> object:
        """What a connector gives: the outermost value of those that lead to it, else what its FMU declares."""
        chain = [path + connector.name]
        while self.sources.get(chain[-1], chain[-1]) not in chain:
            chain.append(self.sources[chain[-1]])
        given = self.given() if connector.kind == "structuralParameter" else {}
        for name in reversed(chain):
            if name in given:
                return given[name]
        for name in reversed(chain):  # a constant at the end of the chain, or the parameter itself
            component, _, variable = name.rpartition(".")
            if component in self.components:
                declared = self.load(component, self.components[component]).variables.get(variable)
                if declared is not None and declared.start is not None:
                    return declared.start
        return None


def _structural_sources(description: Description) -> dict[str, str]:
    """What leads to structural parameters, by hierarchical name."""
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
