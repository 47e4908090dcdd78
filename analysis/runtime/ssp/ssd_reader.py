"""Reader of a SystemStructureDescription: from the XML of an SSD to a `SystemDescription`."""

from __future__ import annotations

from collections.abc import Callable

from lxml import etree

from ....common.errors import InputError
from ....common.paths import names_fmu
from .annotations import check_annotations, feedthrough_of_component
from .archive import OSP_SUFFIX, SystemArchive
from .conversions import Unit, read_transformation, units_of_document
from .dimensions import read_dimensions
from .documents import check_schema, child, children, read_document, signatures, tag
from .experiment import StepSettings, pace_of_experiment, pace_of_system, step_of_component
from .osp.structure import read_osp
from .system_description import (
    Binding,
    Component,
    Connection,
    Connector,
    DictionaryReference,
    SystemDescription,
    SystemElement,
    is_elsewhere,
    source_file,
)
from .types import RUNTIME_TYPES, runtime_type

Load = Callable[[str, str], bytes]  # returns the content of a file, from its name and the element that refers to it
FMU_TYPE = "application/x-fmu-sharedlibrary"


def read_description(archive: SystemArchive, variant: str | None = None) -> SystemDescription:
    """Return the content of an archive's SSD, which is the default SSD or a variant's. Raises InputError."""
    name = archive.description_name(variant)
    data, file = archive.read(name, "SSD"), f"{archive.label}/{name}"
    return read_osp(data, file, archive) if name.endswith(OSP_SUFFIX) else read_ssd(data, file, archive.read)


def read_ssd(data: bytes, file: str, load: Load) -> SystemDescription:
    """Return the content of an SSD; ``load(name, element)`` returns a file to which it refers. Raises InputError."""
    return Reader(file, load).read(data)


class Reader:
    """Reader of one SSD; see `read_ssd`."""

    def __init__(self, file: str, load: Load) -> None:
        self.file = file
        self.load = load
        self.units: dict[str, Unit] = {}
        self.notes: list[str] = []

    def refuse(self, element: etree._Element, what: str, problem: str, remedy: str) -> InputError:
        return InputError(self.file, f"{what} (line {element.sourceline})", problem, remedy)

    def read(self, data: bytes) -> SystemDescription:
        """Return the content of the whole document. Raises InputError."""
        root = read_document(data, "ssd", self.file)
        check_annotations(root, self.file)
        self.notes += signatures(root)
        self.units = units_of_document(root, "ssd", self.file)
        system = child(root, "ssd:System")
        assert system is not None  # the schema requires it
        experiment = child(root, "ssd:DefaultExperiment")
        start = stop = None
        if experiment is not None:
            start, stop = experiment.get("startTime"), experiment.get("stopTime")
        pace = pace_of_experiment(experiment, self.file)
        if pace == StepSettings():
            pace = pace_of_system(system, self.file)
        return SystemDescription(
            file=self.file,
            name=root.get("name", ""),
            system=self.system(system),
            units=self.units,
            enumerations={
                enumeration.get("name", ""): {
                    item.get("name", ""): int(item.get("value", "0")) for item in children(enumeration, "ssc:Item")
                }
                for enumeration in children(child(root, "ssd:Enumerations"), "ssc:Enumeration")
            },
            start_time=float(start) if start is not None else 0.0,
            stop_time=float(stop) if stop is not None else None,
            step=pace.step,
            algorithm=pace.algorithm,
            varies=pace.varies,
            annotations={
                annotation.get("type", ""): annotation
                for annotation in children(child(root, "ssd:Annotations"), "ssc:Annotation")
            },
            notes=self.notes,
        )

    def system(self, element: etree._Element) -> SystemElement:
        about = element.get("description", "")
        system = SystemElement(**self.common(element), step=pace_of_system(element, self.file).step, about=about)
        for dictionary in children(child(element, "ssd:SignalDictionaries"), "ssd:SignalDictionary"):
            system.dictionaries[dictionary.get("name", "")] = self.dictionary(dictionary)
        elements = child(element, "ssd:Elements")
        for item in elements if elements is not None else ():
            read = {"Component": self.component, "System": self.system, "SignalDictionaryReference": self.reference}
            if tag(item) in read:
                inner = read[tag(item)](item)
                if inner.name in system.elements:
                    raise self.refuse(item, inner.name, "two elements of the system have this name", "rename one")
                system.elements[inner.name] = inner
        for item in children(child(element, "ssd:Connections"), "ssd:Connection"):
            system.connections.append(
                Connection(
                    (item.get("startElement") or None, item.get("startConnector", "")),  # "": the system itself
                    (item.get("endElement") or None, item.get("endConnector", "")),
                    item.get("suppressUnitConversion") in ("true", "1"),
                    read_transformation(item),
                    item.sourceline,
                    start_indices=self.indices(item, "startIndices"),
                    end_indices=self.indices(item, "endIndices"),
                )
            )
        return system

    def indices(self, element: etree._Element, name: str) -> tuple[int, ...]:
        indices = tuple(map(int, element.get(name, "").split()))
        if 0 in indices:
            raise self.refuse(element, f"Connection, {name}", "0 is not an index", "count from 1")
        return indices

    def component(self, element: etree._Element) -> Component:
        name = element.get("name", "")
        kind = element.get("type", FMU_TYPE)
        if kind != FMU_TYPE:
            raise self.refuse(element, name, f"components of type {kind} are not supported", "use an FMU")
        implementation = element.get("implementation", "any")
        if implementation not in ("any", "CoSimulation"):
            problem = f'implementation="{implementation}" is not supported'
            raise self.refuse(element, name, problem, 'use a co-simulation FMU and write implementation="CoSimulation"')
        if element.get("source") is None:
            raise self.refuse(element, name, "no source", 'write source="resources/x.fmu"')
        source = source_file(element.get("source", ""))
        if is_elsewhere(source):
            problem = f"source {source} is in another process or machine"
            raise self.refuse(element, name, problem, "name a file of the system")
        if not names_fmu(source):
            raise self.refuse(element, name, f"source {source} is not an .fmu", "use an FMU as the component's source")
        return Component(
            **self.common(element),
            source=source,
            step=step_of_component(element, self.file),
            feedthrough=feedthrough_of_component(element, self.file),
        )

    def reference(self, element: etree._Element) -> DictionaryReference:
        return DictionaryReference(**self.common(element, signals=True), dictionary=element.get("dictionary", ""))

    def common(self, element: etree._Element, *, signals: bool = False) -> dict:
        """Return the fields common to all elements.

        With ``signals``, the connectors are signals of a dictionary, which have both directions.
        """
        connectors: dict[str, Connector] = {}
        for item in children(child(element, "ssd:Connectors"), "ssd:Connector"):
            connector = self.connector(item, signals)
            if connector.name in connectors:
                raise self.refuse(item, connector.name, "declared twice", "remove one")
            connectors[connector.name] = connector
        bindings = children(child(element, "ssd:ParameterBindings"), "ssd:ParameterBinding")
        return {
            "name": element.get("name", ""),
            "connectors": connectors,
            "bindings": [self.binding(item) for item in bindings],
            "line": element.sourceline,
        }

    def connector(self, element: etree._Element, signal: bool) -> Connector:
        name, kind = element.get("name", ""), element.get("kind", "")
        if kind == "inout" and not signal:
            raise self.refuse(element, name, "inout connectors are not supported", "declare it input or output")
        if kind == "unspecified":
            problem = 'kind="unspecified" does not state the direction of the signal'
            raise self.refuse(element, name, problem, "declare it input or output")
        return self.read_type(element, name, kind)

    def read_type(self, element: etree._Element, name: str, kind: str) -> Connector:
        type_name = unit = enumeration = None
        for inner in element:
            if tag(inner) == "Clock":
                raise self.refuse(element, name, "clocks are not supported", "remove the clock, or the connector")
            if tag(inner) in RUNTIME_TYPES:
                type_name, unit, enumeration = tag(inner), inner.get("unit") or None, inner.get("name")
        runtime = None if type_name is None else runtime_type(type_name)
        dimensions = read_dimensions(element, self.file, name, fixed=kind == "inout")
        return Connector(name, kind, runtime, unit, enumeration, element.sourceline, type_name, dimensions)

    def dictionary(self, element: etree._Element) -> dict[str, Connector]:
        name, source = element.get("name", ""), element.get("source")
        file = source or self.file
        if source is not None:
            root = read_document(self.load(source, f"signal dictionary {name}"), "ssb", source)
            self.notes += [f"{source}: {note}" for note in signatures(root)]
        else:
            inline = element.find("{*}SignalDictionary")
            if inline is None:
                raise self.refuse(
                    element, name, "the signal dictionary has neither source nor content", "give source or content"
                )
            check_schema(inline, "ssb", self.file)
            root = inline
        for unit in units_of_document(root, "ssb", file).values():
            known = self.units.setdefault(unit.name, unit)
            if not unit.is_same(known):
                problem = f"is {unit.differs_from(known)} here, {known.differs_from(unit)} in {self.file}"
                raise InputError(file, f"Unit {unit.name}", problem, "use a different name for each unit")
        return {
            entry.get("name", ""): self.read_type(entry, entry.get("name", ""), "inout")
            for entry in children(root, "ssb:DictionaryEntry")
        }

    def binding(self, element: etree._Element) -> Binding:
        mapping = child(element, "ssd:ParameterMapping")
        for part, kind in ((element, "set"), (mapping, "mapping")):
            expected = f"application/x-ssp-parameter-{kind}"
            if part is not None and part.get("sourceBase", "SSD") != "SSD":
                raise self.refuse(
                    part, "ParameterBinding", 'sourceBase="component" is not supported', 'write sourceBase="SSD"'
                )
            if part is not None and part.get("type", expected) != expected:
                raise self.refuse(
                    part, "ParameterBinding", f"type {part.get('type')} is not supported", f"use {expected}"
                )
        values = child(element, "ssd:ParameterValues")
        source = element.get("source")
        inline = values.find("{*}ParameterSet") if values is not None else None
        if source is None and inline is None:
            raise self.refuse(
                element, "ParameterBinding", "has neither source nor inline values", "give a source or values"
            )
        return Binding(
            prefix=element.get("prefix", ""),
            source=source,
            inline=inline,
            mapping_source=mapping.get("source") if mapping is not None else None,
            mapping_inline=mapping.find("{*}ParameterMapping") if mapping is not None else None,
            line=element.sourceline,
        )
