"""Connections of a `system.toml` between variables of its FMUs: expanded and checked, with all problems collected."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches

from ...common.errors import LEAST_SIMILARITY, InputError, SeveralProblemsError, suggestion
from ..runtime.fmi.variable import ScalarVariable
from ..runtime.ssp.conversions import Unit
from ..runtime.ssp.dimensions import array_shapes, text_of
from ..runtime.ssp.kinds import can_connect
from ..runtime.ssp.names import elements, split_name
from ..runtime.system.flattening import WIDENED
from ..runtime.system.fmu import Fmu
from .source import ListEntry, SystemSource

ARROW = "->"
ALL = ".*"  # after a component's name: all its unconnected inputs
TARGETS = re.compile(r",(?![^\[]*\])")  # separates names, but not indices
INDEX = re.compile(r"\[[\d,]+\]$")
CONNECTED = ("input", "output", "parameter", "structuralParameter", "calculatedParameter")

Point = tuple[str, str]  # component (empty for the system) and connector


@dataclass(frozen=True)
class End:
    """Side of a connection: component, variable as written, and the names of the variable's elements."""

    component: str
    variable: str
    names: tuple[str, ...]

    @property
    def name(self) -> str:
        """The full name as written."""
        return f"{self.component}.{self.variable}" if self.component else self.variable

    @property
    def indices(self) -> tuple[str, ...]:
        """The index suffixes of the elements; a single empty string for a scalar."""
        return tuple(name.removeprefix(self.variable) for name in self.names)


@dataclass(frozen=True)
class ConnectorSource:
    """A connector: kind, SSP 1.0 type and unit. An Enumeration becomes an Integer: systems define no enumerations."""

    kind: str
    type: str
    unit: Unit | None


@dataclass
class Wiring:
    """Connectors by (component, name), with an empty component for the system, and the source of each target."""

    connectors: dict[Point, ConnectorSource] = field(default_factory=dict)
    sources: dict[Point, Point] = field(default_factory=dict)


def wire(source: SystemSource, fmus: Mapping[str, Fmu]) -> Wiring:
    """Return the connectors and connections of a system. Raises SeveralProblemsError with a line for each problem."""
    wirer = _Wirer(source, fmus)
    for entry in source.connections:
        wirer.connect(entry)
    for entry in source.declare:
        wirer.declare(entry)
    for entry in source.unconnected:
        wirer.keep_starts(entry)
    wirer.check_inputs()
    wirer.check_connectors()
    if wirer.problems:
        raise SeveralProblemsError(*dict.fromkeys(problem.text for problem in wirer.problems))
    return wirer.wiring


class _Wirer:
    def __init__(self, source: SystemSource, fmus: Mapping[str, Fmu]) -> None:
        self.source = source
        self.fmus = fmus
        self.wiring = Wiring()
        self.problems: list[InputError] = []
        self.written: set[Point] = set()  # targets of faulty connections, which are not reported as unconnected, too
        self.left: set[Point] = set()
        self.signals = {
            component: collapse(name for name, each in fmu.variables.items() if each.causality in CONNECTED)
            for component, fmu in fmus.items()
        }

    def refuse(self, entry: ListEntry, problem: str, remedy: str) -> None:
        where = f"{entry.where}: {entry.text}"
        self.problems.append(self.source.problem(where, problem, remedy))

    def end(self, name: str, entry: ListEntry) -> End | None:
        """Return one side of a connection, or None after recording a problem."""
        component, variable = split_name(name, self.fmus)
        if component:
            known = tuple(elements(variable, self.fmus[component].variables))
            if known:
                return End(component, variable, known)
            problem = f"{component} ({self.fmus[component].name}) has no {variable}"
            self.refuse(entry, problem, suggestion(variable, self.signals[component]))
        elif INDEX.sub("", name) in self.source.connectors or name in self.source.connectors:
            return End("", name, (name,))
        elif "." in name:
            first = name.partition(".")[0]
            self.refuse(entry, f"no component {first}", suggestion(first, self.fmus))
        else:
            problem = f"the system has no connector {name}: [system] does not declare it"
            self.refuse(entry, problem, suggestion(name, [*self.source.connectors, *self.fmus]))
        return None

    def connect(self, entry: ListEntry) -> None:
        """Add the connections of one entry, from one source to one or more targets."""
        start, arrow, targets = entry.text.partition(ARROW)
        texts = [each.strip() for each in TARGETS.split(targets)]
        if not (arrow and start.strip() and all(texts)) or ARROW in targets:
            self.refuse(entry, "not a connection", 'write "COMPONENT.OUTPUT -> COMPONENT.INPUT"')
            return
        source = self.end(start.strip(), entry)
        for each in texts:
            target = self.end(each, entry)
            if source is None or target is None or not self.join(source, target, entry):
                for end in (source, target):
                    self.written |= {(end.component, name) for name in end.names} if end is not None else set()

    def join(self, source: End, target: End, entry: ListEntry) -> bool:
        """Connect two sides element by element; return False after recording a problem."""
        if not source.component and not target.component:
            self.refuse(entry, "both ends are connectors of the system", "connect one end to a component")
            return False
        if not source.component:
            source = self.make_connector(source, target)
        if not target.component:
            target = self.make_connector(target, source)
        if source.indices != target.indices and (len(source.names) > 1 or len(target.names) > 1):
            sizes = [f"{end.name} is {text_of(_shape(end))}" for end in (source, target)]
            self.refuse(entry, f"sizes differ: {', '.join(sizes)}", "connect elements, NAME[1] -> NAME[1]")
            return False
        pairs = zip(source.names, target.names, strict=True)
        return all(self.join_one((source.component, a), (target.component, b), entry) for a, b in pairs)

    def make_connector(self, end: End, other: End) -> End:
        """Return a system connector with the elements of the variable to which it is connected."""
        if end.variable not in self.source.connectors or other.indices == ("",):
            return end
        return End("", end.variable, tuple(end.variable + index for index in other.indices))

    def join_one(self, source: Point, target: Point, entry: ListEntry) -> bool:
        """Connect two elements; return False after recording a problem."""
        ends = [self.connector(point, other) for point, other in ((source, target), (target, source))]
        start, end = ends
        names = [".".join(filter(None, point)) for point in (source, target)]
        if not can_connect(start.kind, not source[0], end.kind, not target[0]):
            if can_connect(end.kind, not target[0], start.kind, not source[0]):
                texts = [INDEX.sub("", name) for name in names]
                remedy = f"the ends are swapped: write {texts[1]} {ARROW} {texts[0]}"
            else:
                remedy = "connect an output with an input, or a parameter of the system with a parameter"
            self.refuse(entry, f"{names[0]} is {start.kind} and {names[1]} is {end.kind}", remedy)
            return False
        if start.type != end.type and (start.type, end.type) not in WIDENED:
            problem = f"types differ: {names[0]} is {start.type}, but {names[1]} is {end.type}"
            self.refuse(entry, problem, "connect variables of the same type")
            return False
        if start.unit and end.unit and not start.unit.is_convertible(end.unit):
            problem = (
                f"units are not convertible: {names[0]} is in {start.unit.name}, but {names[1]} is in {end.unit.name}"
            )
            self.refuse(entry, problem, "connect variables of the same quantity")
            return False
        if target in self.wiring.sources:
            first = ".".join(filter(None, self.wiring.sources[target]))
            self.refuse(entry, f"{names[1]} is driven twice, first by {first}", "remove one of the two")
            return False
        self.wiring.sources[target] = source
        self.wiring.connectors |= {source: start, target: end}
        return True

    def connector(self, point: Point, other: Point) -> ConnectorSource:
        """Return the connector of a point; a connector of the system takes type and unit from its first connection."""
        component, name = point
        if component:
            return self.of_variable(component, self.fmus[component].variables[name])
        if point in self.wiring.connectors:
            return self.wiring.connectors[point]
        like = self.of_variable(other[0], self.fmus[other[0]].variables[other[1]])
        kind = self.source.connectors.get(name) or self.source.connectors[INDEX.sub("", name)]
        return ConnectorSource(kind, like.type, like.unit)

    def of_variable(self, component: str, variable: ScalarVariable) -> ConnectorSource:
        """Return the connector for a variable of a component's FMU."""
        kind = "Integer" if variable.type == "Enumeration" else variable.type
        return ConnectorSource(variable.causality, kind, self.fmus[component].unit_of(variable))

    def unused(self, entry: ListEntry) -> list[Point]:
        """Return the unconnected elements of a component's variable; empty after recording a problem."""
        end = self.end(entry.text, entry)
        if end is None:
            return []
        if not end.component:
            self.refuse(entry, "is a connector of the system", "name a component's connector, COMPONENT.NAME")
            return []
        points = [(end.component, name) for name in end.names]
        remaining = [each for each in points if each not in self.wiring.connectors]
        if not remaining:
            self.refuse(entry, "is already connected", "remove it from this list")
        return remaining

    def declare(self, entry: ListEntry) -> None:
        """Add the unconnected connectors of an entry."""
        for component, name in self.unused(entry):
            variable = self.fmus[component].variables[name]
            self.wiring.connectors[component, name] = self.of_variable(component, variable)

    def keep_starts(self, entry: ListEntry) -> None:
        """Record inputs that keep their start values: a named input, or all unconnected inputs for ``component.*``."""
        if entry.text.endswith(ALL):
            self.leave_all(entry.text.removesuffix(ALL), entry)
            return
        for component, name in self.unused(entry):
            causality = self.fmus[component].variables[name].causality
            if causality != "input":
                self.refuse(entry, f"is {causality}", "name inputs here")
                return
            self.left.add((component, name))

    def leave_all(self, component: str, entry: ListEntry) -> None:
        """Record all unconnected inputs of a component."""
        if component not in self.fmus:
            self.refuse(entry, f"no component {component}", suggestion(component, self.fmus))
            return
        inputs = set(self.open_inputs(component))
        if not inputs:
            self.refuse(entry, f"all inputs of {component} are connected or listed already", "remove this entry")
        self.left |= {(component, name) for name in inputs}

    def open_inputs(self, component: str) -> list[str]:
        """Return the inputs of a component that are neither connected nor listed as unconnected."""
        return [
            name
            for name, each in self.fmus[component].variables.items()
            if each.causality == "input"
            and (component, name) not in self.wiring.connectors
            and (component, name) not in self.left | self.written
        ]

    def check_inputs(self) -> None:
        """Report inputs that are neither connected nor listed as unconnected."""
        outputs = [
            f"{component}.{name}"
            for component, fmu in self.fmus.items()
            for name in collapse(name for name, each in fmu.variables.items() if each.causality == "output")
        ]
        for component in self.fmus:
            where = self.source.components[component].where
            for name in dict.fromkeys(INDEX.sub("", name) for name in self.open_inputs(component)):
                similar = get_close_matches(name, {output.partition(".")[2] for output in outputs}, 1, LEAST_SIMILARITY)
                sources = [output for output in outputs if output.partition(".")[2] in similar]
                nearest = f"connect it ({', '.join(sources)}?)" if sources else "connect it"
                remedy = f"{nearest}, or list it under unconnected"
                problem = f"input {component}.{name} is not connected"
                self.problems.append(self.source.problem(where, problem, remedy))

    def check_connectors(self) -> None:
        """Report connectors of the system without a connection."""
        present = {INDEX.sub("", name) for component, name in self.wiring.connectors if not component}
        written = {INDEX.sub("", name) for component, name in self.written if not component}
        for name, kind in self.source.connectors.items():
            if INDEX.sub("", name) not in present | written:
                problem = "nothing is connected to it, so its type and unit are unknown"
                self.problems.append(self.source.problem(f"system.{kind}: {name}", problem, "connect it, or remove it"))


def collapse(names: Iterable[str]) -> list[str]:
    """Return the names without indices, so that all elements of a vector or matrix share a single name."""
    return list(dict.fromkeys(INDEX.sub("", name) for name in names))


def _shape(end: End) -> tuple[int, ...]:
    return next(iter(array_shapes(end.names).values()), ())
