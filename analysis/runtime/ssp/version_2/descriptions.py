"""Conversion of a System Structure Description of SSP 1.0 to SSP 2.0."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass

from lxml import etree

from ..dimensions import Shape
from ..documents import NAMESPACES, child, children, tag
from .connections import merge_connections
from .connectors import merge_connectors
from .element_values import merge_values
from .trees import remove, to_version_2

ArraysOf = Callable[[str], Mapping[str, Shape]]  # returns the arrays of the FMU of a source
EnumerationsOf = Callable[[str], Collection[str]]


@dataclass(frozen=True)
class BoundSet:
    """Parameter set file bound by a description, with the arrays to which its names may refer.

    There are no arrays if the set is mapped.
    """

    source: str
    arrays: Mapping[str, Shape]


def convert_description(
    description: etree._Element, arrays_of: ArraysOf, enumerations_of: EnumerationsOf = lambda source: ()
) -> tuple[etree._Element, list[BoundSet]]:
    """Convert a system to SSP 2.0; return it with its bound parameter set files.

    The first entry, with an empty source, contains the arrays of the system itself. ``arrays_of`` returns the arrays of
    the FMU of a source (FMI 3.0); an FMU of FMI 2.0 has a variable for each element, and SSP requires a connector for
    each variable. ``enumerations_of`` returns the FMU's enumerations.
    """
    root = deepcopy(description)
    to_version_2(root)
    _leave_types_to_fmus(root, enumerations_of)
    system = child(root, "ssd:System")
    bound: list[BoundSet] = []
    whole = _convert_system(system, arrays_of, bound) if system is not None else {}
    return root, [BoundSet("", whole), *bound]


def _leave_types_to_fmus(root: etree._Element, enumerations_of: EnumerationsOf) -> None:
    """Remove the type Integer from connectors of variables that are enumerations in the FMU, in place."""
    for component in root.iter(f"{{{NAMESPACES['ssd']}}}Component"):
        names = enumerations_of(component.get("source", ""))
        for connector in children(child(component, "ssd:Connectors"), "ssd:Connector"):
            declared = child(connector, "ssc:Int32")
            if declared is not None and connector.get("name") in names:
                remove(declared)


def _convert_system(system: etree._Element, arrays_of: ArraysOf, bound: list[BoundSet]) -> dict[str, Shape]:
    """Convert a system and its inner systems in place; return its arrays by hierarchical name."""
    outer = merge_connectors(system, None)
    connected: dict[tuple[str, str], Shape] = {("", name): shape for name, shape in outer.items()}
    known = dict(outer)
    for element in _elements(system):
        name = element.get("name", "")
        if tag(element) == "System":
            inner = _convert_system(element, arrays_of, bound)
            merged = {array: inner[array] for array in inner if _declares(element, array)}
        else:
            inner = dict(arrays_of(element.get("source", "")))
            merged = merge_connectors(element, inner)
            bound += _convert_bindings(element, inner)
        connected |= {(name, array): shape for array, shape in merged.items()}
        known |= {f"{name}.{array}": shape for array, shape in inner.items()}
    merge_connections(system, connected)
    bound += _convert_bindings(system, known)
    return known


def _elements(system: etree._Element) -> Iterator[etree._Element]:
    """Yield components and systems inside a system."""
    elements = child(system, "ssd:Elements")
    for element in elements if elements is not None else ():
        if tag(element) in ("Component", "System"):
            yield element


def _declares(element: etree._Element, name: str) -> bool:
    return any(
        connector.get("name") == name for connector in children(child(element, "ssd:Connectors"), "ssd:Connector")
    )


def _convert_bindings(owner: etree._Element, known: Mapping[str, Shape]) -> Iterator[BoundSet]:
    """Yield the files that an element binds; convert parameter sets inside the description in place."""
    for binding in children(child(owner, "ssd:ParameterBindings"), "ssd:ParameterBinding"):
        prefix = binding.get("prefix", "")
        arrays = {name.removeprefix(prefix): shape for name, shape in known.items() if name.startswith(prefix)}
        if child(binding, "ssd:ParameterMapping") is not None:
            arrays = {}  # the entries of a mapping name elements
        values = child(binding, "ssd:ParameterValues")
        if binding.get("source") is not None:
            yield BoundSet(binding.get("source", ""), arrays)
        elif values is not None:
            for parameter_set in children(values, "ssv:ParameterSet"):
                merge_values(parameter_set, arrays)
