"""OspSystemStructure.xml, the system format of the Open Simulation Platform, read as a `SystemDescription`.

The ECCO algorithm is rejected by name. Kinds and types of variables are taken from the FMUs, since the file does not
repeat them. Sources: libcosim's schemas OspSystemStructure 0.1 and OspModelDescription 1.0.
"""

from __future__ import annotations

from pathlib import PurePosixPath

from lxml import etree

from .....common.errors import InputError
from .....common.paths import names_fmu
from ..archive import SystemArchive
from ..conversions import IDENTITY, Transformation
from ..documents import NAMESPACES, parse_xml, tag
from ..experiment import positive_seconds, step_hint
from ..system_description import (
    Binding,
    Component,
    Connection,
    Connector,
    SystemDescription,
    SystemElement,
    is_elsewhere,
    source_file,
)
from .functions import OUT, FunctionError, Point, TransformedSum, read_function
from .groups import read_groups

NAMESPACE = "http://opensimulationplatform.com/MSMI/OSPSystemStructure"
ECCO = "EccoConfiguration"
ELEMENTS = ("StartTime", "EndTime", "BaseStepSize", "Algorithm", "Simulators", "Functions", "Connections")
VARIABLES, SIGNALS = ("Variable", "VariableGroup"), ("Signal", "SignalGroup")


def read_osp(data: bytes, file: str, archive: SystemArchive) -> SystemDescription:
    """Return the description in the document, which is one of an archive's files. Raises InputError."""
    return _StructureReader(file, archive).read(parse_xml(data, file))


class _StructureReader:
    def __init__(self, file: str, archive: SystemArchive) -> None:
        self.file = file
        self.archive = archive
        self.system = SystemElement("root", {}, [], 0)
        self.functions: dict[str, TransformedSum] = {}
        self.groups: dict[str, dict[str, list[str]]] = {}  # by simulator, then by name of the group
        self.notes: list[str] = []

    def refuse(self, element: etree._Element, problem: str, remedy: str) -> InputError:
        return InputError(self.file, f"{tag(element)} (line {element.sourceline})", problem, remedy)

    def read(self, root: etree._Element) -> SystemDescription:
        if root.tag != f"{{{NAMESPACE}}}OspSystemStructure":
            problem = f"{root.tag} is not an OspSystemStructure of {NAMESPACE}"
            raise InputError(self.file, f"line {root.sourceline}", problem, "give an OspSystemStructure.xml")
        algorithm = root.find("{*}Algorithm")
        if algorithm is not None and (algorithm.text or "").strip() != "fixedStep":
            raise self.refuse(algorithm, f"{(algorithm.text or '').strip()} is not supported", "write fixedStep")
        for element in root.iterchildren(etree.Element):
            if tag(element) == ECCO:
                self.notes.append(f"{ECCO} (line {element.sourceline}): without effect in the algorithm fixedStep")
            elif tag(element) not in ELEMENTS:  # from drafts before 0.1, or later versions
                raise self.refuse(element, "is not part of an OspSystemStructure 0.1", f"use {', '.join(ELEMENTS)}")
        for simulator in root.findall("{*}Simulators/{*}Simulator"):
            self.simulator(simulator)
        for function in root.findall("{*}Functions/*"):
            self.function(function)
        self.connections(root.findall("{*}Connections/*"))
        start, end, step = (root.find(f"{{*}}{name}") for name in ("StartTime", "EndTime", "BaseStepSize"))
        return SystemDescription(
            file=self.file,
            name=PurePosixPath(self.file).parent.name,
            system=self.system,
            units={},
            enumerations={},
            start_time=0.0 if start is None else self.number(start),
            stop_time=None if end is None else self.number(end),
            step=None if step is None else self.base_step(step),
            algorithm="jacobi",
            notes=self.notes,
        )

    def number(self, element: etree._Element) -> float:
        text = element.text or ""
        try:
            return float(text)
        except ValueError:
            raise self.refuse(element, f"content {text!r} is not a number", "write a number") from None

    def base_step(self, element: etree._Element) -> float:
        where, remedy = f"{tag(element)} (line {element.sourceline})", "write a number such as 0.1"
        return positive_seconds((element.text or "").strip(), "content", where, self.file, remedy)

    def simulator(self, element: etree._Element) -> None:
        name, source = element.get("name", ""), source_file(element.get("source", ""))
        if is_elsewhere(source):
            problem = f"source {source} of {name} is in another process or machine"
            raise self.refuse(element, problem, "name a file of this system")
        if not names_fmu(source):
            raise self.refuse(element, f"source {source} of {name} is not an .fmu", "name the file of an FMU")
        if name in self.system.elements:
            raise self.refuse(element, f"a second simulator named {name}", "rename one")
        values = element.findall("{*}InitialValues/{*}InitialValue")
        self.system.elements[name] = Component(
            name=name,
            connectors={},
            bindings=[self.binding(values, element.sourceline)] if values else [],
            line=element.sourceline,
            source=source,
            step=step_hint(element, "stepSize", f"Simulator {name} (line {element.sourceline})", self.file),
        )

    def binding(self, values: list[etree._Element], line: int) -> Binding:
        """Return initial values as a parameter set, as an SSD would contain it."""
        ssv = f"{{{NAMESPACES['ssv']}}}"
        parameters = etree.Element(f"{ssv}ParameterSet", version="1.0", name="InitialValues")
        inside = etree.SubElement(parameters, f"{ssv}Parameters")
        for value in values:
            if len(value) != 1:
                raise self.refuse(value, f"{len(value)} values", "give one value")
            parameter = etree.SubElement(inside, f"{ssv}Parameter", name=value.get("variable", ""))
            etree.SubElement(parameter, f"{ssv}{tag(value[0])}", value=value[0].get("value", ""))
            for element in parameter.iter():
                element.sourceline = value.sourceline
        return Binding("", None, parameters, None, None, line)

    def function(self, element: etree._Element) -> None:
        try:
            function = read_function(element)
        except FunctionError as error:
            raise self.refuse(element, error.problem, error.remedy) from error
        if function.name in self.functions:
            raise self.refuse(element, f"a second function named {function.name}", "rename one")
        self.functions[function.name] = function

    def connections(self, elements: list[etree._Element]) -> None:
        outputs: list[tuple[TransformedSum, list[Point], etree._Element]] = []
        for element in elements:
            if bond := element.get("powerBond"):  # as in libcosim, a bond only joins the variables
                self.notes.append(f"powerBond {bond} (line {element.sourceline}): without effect in fixedStep")
            ends = list(element.iterchildren(etree.Element))
            kinds = [tag(end) for end in ends]
            if kinds in ([each, each] for each in VARIABLES):
                self.connect_variables(ends, element)
            elif sorted(kinds) in (sorted(each) for each in zip(SIGNALS, VARIABLES, strict=True)):
                signal, variables = sorted(ends, key=lambda end: tag(end) in VARIABLES)
                function = self.functions.get(signal.get("function", ""))
                if function is None:
                    problem = f"no function {signal.get('function', '')}"
                    raise self.refuse(signal, problem, f"name one of {', '.join(self.functions) or 'Functions'}")
                points = self.points(variables)
                if signal.get("name") == OUT:
                    outputs.append((function, points, element))
                else:
                    self.connect_input(function, signal, points)
            else:
                raise self.refuse(
                    element, f"connects {' and '.join(kinds)}, which is not supported", "connect variables"
                )
        for function, points, element in outputs:
            self.connect_output(function, points, element)

    def connect_input(self, function: TransformedSum, signal: etree._Element, points: list[Point]) -> None:
        try:
            function.connect_input(signal.get("name", ""), points)
        except FunctionError as error:
            raise self.refuse(signal, error.problem, error.remedy) from error

    def connect_output(self, function: TransformedSum, points: list[Point], element: etree._Element) -> None:
        try:
            sums = function.connect_output(points)
        except FunctionError as error:
            raise self.refuse(element, error.problem, error.remedy) from error
        for point, sources in sums:
            self.connect(sources, point, function.transformation, element.sourceline)

    def variable(self, element: etree._Element) -> Point:
        simulator = element.get("simulator", "")
        if simulator not in self.system.elements:
            raise self.refuse(element, f"no simulator {simulator}", f"name one of {', '.join(self.system.elements)}")
        return simulator, element.get("name", "")

    def connect(self, sources: list[Point], end: Point, transformation: Transformation, line: int) -> None:
        for simulator, name in (*sources, end):
            owner = self.system.elements[simulator]
            owner.connectors.setdefault(name, Connector(name, "", None, None, None, line))
        start, *added = sources
        self.system.connections.append(Connection(start, end, False, transformation, line, tuple(added)))

    def connect_variables(self, ends: list[etree._Element], connection: etree._Element) -> None:
        """Connect two variables, or the variables of two groups pairwise in the order of their model descriptions."""
        sides = [self.points(end) for end in ends]
        if len(sides[0]) != len(sides[1]):
            problem = f"connects groups of {len(sides[0])} and {len(sides[1])} variables"
            raise self.refuse(connection, problem, "connect groups of the same kind")
        for start, stop in zip(*sides, strict=True):
            self.connect([start], stop, IDENTITY, connection.sourceline)

    def points(self, end: etree._Element) -> list[Point]:
        """Return a variable, or all variables of a group."""
        simulator, name = self.variable(end)
        if tag(end) == "Variable":
            return [(simulator, name)]
        component = self.system.elements[simulator]
        assert isinstance(component, Component)
        if simulator not in self.groups:
            where = f"{tag(end)} (line {end.sourceline})"
            self.groups[simulator] = read_groups(self.archive, component.source, where)
        if name not in self.groups[simulator]:
            raise self.refuse(end, f"{simulator} has no group {name}", "name a group of its OspModelDescription.xml")
        return [(simulator, variable) for variable in self.groups[simulator][name]]
