"""Conversion of an SSD to a `system.toml`; rejected if the file would not compose to an equivalent SSD."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from ...common.errors import InputError
from ..runtime.ssp.archive import OSP_SUFFIX, SystemArchive
from ..runtime.ssp.dimensions import Shape, array_shapes, element_names
from ..runtime.ssp.parameter_sets import Assignment, read_binding
from ..runtime.ssp.ssd_reader import read_description
from ..runtime.ssp.system_description import Binding, Component, Element, SystemDescription
from ..runtime.system.fmu import Fmu
from .assembly import load_fmus
from .document import RESOURCES, fmu_source, set_source, write_document
from .likeness import find_difference
from .source import ComponentSource, ListEntry, SystemSource
from .units import underived_units
from .values import read_values
from .wiring import ARROW, INDEX, Point, wire

ANNOTATIONS = re.compile(rb"<ssd:Annotations>(.*)</ssd:Annotations>\s*</ssd:SystemStructureDescription>\s*$", re.DOTALL)
KEEP = "keep the SSD, which can be simulated as it is"


def source_of(archive: SystemArchive, variant: str | None = None) -> SystemSource:
    """Return the content of a `system.toml` that composes to the SSD of a system.

    Raises InputError, with the element and its line, if the SSD contains something that a `system.toml` cannot express.
    """
    name = archive.description_name(variant)
    ssd = archive.read(name, "SSD")
    description = read_description(archive, variant)
    if name.endswith(OSP_SUFFIX):
        raise InputError(description.file, "", "is not an SSD", KEEP.replace("SSD", "file"))
    components = dict(_components(description))
    bindings, values = list(description.system.bindings), list[Assignment]()
    if bindings and bindings[-1].inline is not None and not _is_adapted(bindings[-1]):
        values, _ = read_binding(archive, description.file, bindings.pop(), description.units)
    source = SystemSource(
        name=description.name,
        components=components,
        description=description.system.about,
        start_time=description.start_time,
        stop_time=description.stop_time,
        step=description.step,
        parameters=_parameters(description, replace(description.system, bindings=bindings)),
        set=read_values(values),
        annotations=_annotations(ssd, description),
        file=description.file,
    )
    fmus = load_fmus(source, archive)
    connections = [(each.start, each.end) for each in description.system.connections]
    pairs = [(_point(start), _point(end)) for start, end in connections]
    declared = {
        (component, connector): each.kind
        for component, element in (("", description.system), *description.system.elements.items())
        for connector, each in element.connectors.items()
    }
    source = replace(source, **_wiring(pairs, declared, fmus))
    wiring = wire(source, fmus)
    source = replace(source, units=underived_units(source, wiring, description.units))
    difference = find_difference(ssd, write_document(source, fmus, wiring))
    if difference is not None:
        raise InputError(description.file, difference, "cannot be expressed in a system.toml", KEEP)
    return source


def _point(point: tuple[str | None, str]) -> Point:
    return point[0] or "", point[1]


def _components(description: SystemDescription) -> Iterator[tuple[str, ComponentSource]]:
    for name, element in description.system.elements.items():
        if not isinstance(element, Component):
            where = f"{name} (line {element.line})"
            raise InputError(
                description.file, where, "is not a component and cannot be expressed in a system.toml", KEEP
            )
        stem = element.source.removeprefix(RESOURCES).removesuffix(".fmu")
        fmu = stem if fmu_source(stem) == element.source and "/" not in stem else element.source
        yield name, ComponentSource(fmu, _parameters(description, element), element.step)


def _parameters(description: SystemDescription, element: Element) -> tuple[str, ...]:
    """Return the names, as in a `system.toml`, of the parameter sets bound to an element."""
    names = []
    for binding in element.bindings:
        if binding.source is None or _is_adapted(binding):
            where = f"ParameterBinding (line {binding.line})"
            problem = "inline values, a prefix or a mapping cannot be expressed in a system.toml"
            raise InputError(description.file, where, problem, KEEP)
        name = binding.source.removeprefix(RESOURCES)
        names.append(name if set_source(name) == binding.source else binding.source)
    return tuple(names)


def _is_adapted(binding: Binding) -> bool:
    return bool(binding.prefix or binding.mapping_source) or binding.mapping_inline is not None


def _annotations(ssd: bytes, description: SystemDescription) -> bytes:
    """Return the exact bytes inside the annotations of the SSD."""
    if not description.annotations:
        return b""
    start = ssd.rfind(b"</ssd:DefaultExperiment>")
    match = ANNOTATIONS.search(ssd, max(start, 0))
    if match is None:
        raise InputError(description.file, "Annotations", "not found under the namespace prefix ssd", KEEP)
    return match[1]


def _wiring(pairs: list[tuple[Point, Point]], declared: Mapping[Point, str], fmus: Mapping[str, Fmu]) -> dict[str, Any]:
    """Return the connections, system connectors and open connectors; a complete array is a single entry."""
    shapes = {
        (component, array): shape
        for component, fmu in fmus.items()
        for array, shape in array_shapes(fmu.variables).items()
    }
    system_names = [name for component, name in declared if not component]
    shapes |= {("", array): shape for array, shape in array_shapes(system_names).items()}
    kinds = {name: declared["", name] for name in system_names}
    connected = {point for pair in pairs for point in pair}
    idle = [point for point in declared if point[0] and point not in connected]
    inputs = [
        (component, name)
        for component, fmu in fmus.items()
        for name, each in fmu.variables.items()
        if each.causality == "input" and (component, name) not in declared
    ]
    return {
        "connections": tuple(_connections(pairs, shapes)),
        "connectors": {_base(name, shapes): kind for name, kind in kinds.items()},
        "declare": tuple(ListEntry(name, "declare") for name in _combine_arrays(idle, shapes)),
        "unconnected": tuple(ListEntry(name, "unconnected") for name in _combine_arrays(inputs, shapes)),
    }


def _base(name: str, shapes: Mapping[Point, Shape]) -> str:
    base = INDEX.sub("", name)
    return base if ("", base) in shapes else name


def _combine_arrays(points: list[Point], shapes: Mapping[Point, Shape]) -> list[str]:
    """Return the names of points, with complete arrays replaced by the name of the array."""
    present, names = set(points), []
    for component, name in points:
        array = INDEX.sub("", name)
        shape = shapes.get((component, array))
        complete = shape is not None and present >= {(component, each) for each in element_names(array, shape)}
        names.append(".".join(filter(None, (component, array if complete else name))))
    return list(dict.fromkeys(names))


def _connections(pairs: list[tuple[Point, Point]], shapes: Mapping[Point, Shape]) -> Iterator[ListEntry]:
    """Yield connections by source, in the order of the SSD; arrays connected element by element become one entry."""
    present = set(pairs)
    targets: dict[str, dict[str, None]] = {}
    for start, end in pairs:
        arrays = [(component, INDEX.sub("", name)) for component, name in (start, end)]
        shape = shapes.get(arrays[0])
        ends = [[(component, each) for each in element_names(array, shape or ())] for component, array in arrays]
        alike = shape is not None and shape == shapes.get(arrays[1]) and present >= set(zip(*ends, strict=True))
        source, target = (".".join(filter(None, point)) for point in (arrays if alike else (start, end)))
        targets.setdefault(source, {})[target] = None
    for source, names in targets.items():
        yield ListEntry(f"{source} {ARROW} {', '.join(names)}", "connections")
