"""OspSystemStructure.xml, the Open Simulation Platform's own way of writing a system, read as a `Description`.

What has no counterpart in SSP (sums of signals, bonds of the ECCO algorithm) is refused by name. Kinds and types of
variables are those of the FMUs, which the file does not repeat. Sources: libcosim's schemas OspSystemStructure 0.1 and
OspModelDescription 1.0.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePosixPath

from lxml import etree

from ...common.errors import InputError
from .conversions import IDENTITY, Transformation
from .description import Binding, Component, Connection, Connector, Description, System, is_elsewhere, source_file
from .documents import NAMESPACES, parse_xml, tag
from .experiment import positive_seconds

Load = Callable[[str, str], bytes]  # content of a file by name, and the element that names it
Point = tuple[str, str]  # simulator and variable
NAMESPACE = "http://opensimulationplatform.com/MSMI/OSPSystemStructure"
GROUPS = "_OspModelDescription.xml"  # file of an FMU's groups of variables, behind the FMU's name


def read_osp(data: bytes, file: str, load: Load) -> Description:
    """The document; ``load(name, element)`` returns the bytes of a file beside it. Raises InputError."""
    return _Reader(file, load).read(parse_xml(data, file))


class _Reader:
    def __init__(self, file: str, load: Load) -> None:
        self.file = file
        self.load = load
        self.system = System("root", {}, [], 0)
        self.groups: dict[str, etree._Element] = {}  # OspModelDescription.xml by simulator

    def refuse(self, element: etree._Element, problem: str, remedy: str) -> InputError:
        return InputError(self.file, f"{tag(element)} (line {element.sourceline})", problem, remedy)

    def read(self, root: etree._Element) -> Description:
        if root.tag != f"{{{NAMESPACE}}}OspSystemStructure":
            problem = f"{root.tag} is not an OspSystemStructure of {NAMESPACE}"
            raise InputError(self.file, f"line {root.sourceline}", problem, "give an OspSystemStructure.xml")
        algorithm = root.find("{*}Algorithm")
        if algorithm is not None and (algorithm.text or "").strip() != "fixedStep":
            raise self.refuse(algorithm, f"{(algorithm.text or '').strip()} is not flown here", "write fixedStep")
        for simulator in root.findall("{*}Simulators/{*}Simulator"):
            self.simulator(simulator)
        gains = {item.get("name", ""): self.function(item) for item in root.findall("{*}Functions/*")}
        self.connections(root.findall("{*}Connections/*"), gains)
        start, end, step = (root.find(f"{{*}}{name}") for name in ("StartTime", "EndTime", "BaseStepSize"))
        return Description(
            file=self.file,
            name=PurePosixPath(self.file).parent.name,
            system=self.system,
            units={},
            enumerations={},
            start_time=0.0 if start is None else self.number(start),
            stop_time=None if end is None else self.number(end),
            step=None if step is None else self.step(step, step.text or ""),
            algorithm="jacobi",
        )

    def number(self, element: etree._Element, attribute: str = "", default: str = "") -> float:
        text = element.get(attribute, default) if attribute else (element.text or "")
        try:
            return float(text)
        except ValueError:
            raise self.refuse(element, f"{attribute or 'content'} {text!r} is not a number", "write one") from None

    def step(self, element: etree._Element, text: str) -> float:
        return positive_seconds(text, tag(element), f"{tag(element)} (line {element.sourceline})", self.file)

    def simulator(self, element: etree._Element) -> None:
        name, source = element.get("name", ""), source_file(element.get("source", ""))
        if not source.endswith(".fmu"):
            raise self.refuse(element, f"source {source} of {name} is not an .fmu", "name an FMU beside the file")
        if is_elsewhere(source):
            raise self.refuse(element, f"source {source} of {name} is on another machine", "name a file beside this")
        if name in self.system.elements:
            raise self.refuse(element, f"a second one of the name {name}", "rename one")
        values = element.findall("{*}InitialValues/{*}InitialValue")
        text = element.get("stepSize")
        self.system.elements[name] = Component(
            name=name,
            connectors={},
            bindings=[self.binding(values, element.sourceline)] if values else [],
            line=element.sourceline,
            source=source,
            step=None if text is None else self.step(element, text),
        )

    def binding(self, values: list[etree._Element], line: int) -> Binding:
        """Initial values as the parameter set that an SSD would hold."""
        ssv = f"{{{NAMESPACES['ssv']}}}"
        parameters = etree.Element(f"{ssv}ParameterSet", version="1.0", name="InitialValues")
        inside = etree.SubElement(parameters, f"{ssv}Parameters")
        for value in values:
            if len(value) != 1:
                raise self.refuse(value, f"{len(value)} values", "give one")
            parameter = etree.SubElement(inside, f"{ssv}Parameter", name=value.get("variable", ""))
            etree.SubElement(parameter, f"{ssv}{tag(value[0])}", value=value[0].get("value", ""))
            for element in parameter.iter():
                element.sourceline = value.sourceline
        return Binding("", None, parameters, None, None, line)

    def function(self, element: etree._Element) -> Transformation:
        if tag(element) != "LinearTransformation":
            raise self.refuse(element, "functions of this kind are not supported", "use an FMU that does it")
        return Transformation(self.number(element, "factor", "1"), self.number(element, "offset", "0"))

    def connections(self, elements: list[etree._Element], gains: dict[str, Transformation]) -> None:
        into: dict[str, Point] = {}
        out_of: list[tuple[str, Point, etree._Element]] = []
        for element in elements:
            if element.get("powerBond"):
                raise self.refuse(element, "bonds of the ECCO algorithm are not supported", "remove powerBond")
            ends = list(element.iterchildren(etree.Element))
            kinds = [tag(end) for end in ends]
            if kinds == ["Variable", "Variable"]:
                self.connect(self.variable(ends[0]), self.variable(ends[1]), IDENTITY, element.sourceline)
            elif kinds == ["VariableGroup", "VariableGroup"]:
                self.connect_groups(ends, element)
            elif sorted(kinds) == ["Signal", "Variable"]:
                point = self.variable(ends[kinds.index("Variable")])
                signal = ends[kinds.index("Signal")]
                function = signal.get("function", "")
                if function not in gains or signal.get("name") not in ("in", "out"):
                    problem = f"no signal {signal.get('name')} of a function {function}"
                    raise self.refuse(signal, problem, "name in or out of a LinearTransformation")
                if signal.get("name") == "in":
                    into[function] = point
                else:
                    out_of.append((function, point, element))
            else:
                raise self.refuse(element, f"joins {' and '.join(kinds)}, which is not supported", "join variables")
        for function, point, element in out_of:
            if function not in into:
                raise self.refuse(element, f"nothing is connected to in of {function}", "connect a variable to it")
            self.connect(into[function], point, gains[function], element.sourceline)

    def variable(self, element: etree._Element) -> Point:
        simulator = element.get("simulator", "")
        if simulator not in self.system.elements:
            raise self.refuse(element, f"no simulator {simulator}", f"name one of {', '.join(self.system.elements)}")
        return simulator, element.get("name", "")

    def connect(self, start: Point, end: Point, transformation: Transformation, line: int) -> None:
        for simulator, name in (start, end):
            owner = self.system.elements[simulator]
            owner.connectors.setdefault(name, Connector(name, "", None, None, None, line))
        self.system.connections.append(Connection(start, end, False, transformation, line))

    def connect_groups(self, ends: list[etree._Element], connection: etree._Element) -> None:
        """The variables of two groups, pair by pair in the order of their model descriptions."""
        sides = [[(self.variable(end)[0], name) for name in self.group(end)] for end in ends]
        if len(sides[0]) != len(sides[1]):
            problem = f"groups of {len(sides[0])} and {len(sides[1])} variables"
            raise self.refuse(connection, problem, "join groups of one kind")
        for start, stop in zip(*sides, strict=True):
            self.connect(start, stop, IDENTITY, connection.sourceline)

    def group(self, end: etree._Element) -> list[str]:
        """Names of the variables of a group."""
        simulator, name = self.variable(end)
        if simulator not in self.groups:
            component = self.system.elements[simulator]
            assert isinstance(component, Component)
            source = component.source.removesuffix(".fmu") + GROUPS
            self.groups[simulator] = parse_xml(self.load(source, f"{tag(end)} (line {end.sourceline})"), source)
        for group in self.groups[simulator].findall("{*}VariableGroups//*"):
            if group.get("name") == name:
                return [variable.get("ref", "") for variable in group.iter("{*}Variable")]
        raise self.refuse(end, f"{simulator} has no group {name}", "name a group of its OspModelDescription.xml")
