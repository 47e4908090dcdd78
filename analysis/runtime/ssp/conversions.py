"""Conversions of values: between units, as FMI and SSP define them, and by SSP's transformations."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from fmpy.model_description import ModelDescription
from lxml import etree

from ....common.errors import InputError
from ....fmus_src.units import BASE_UNITS, unit_definition
from .documents import child, children, tag


@dataclass(frozen=True)
class Unit:
    """Unit: value in base units = factor * value + offset.

    ``exponents`` contains the exponents of the base units, and is None for an undefined unit, which only has a name.
    ``is_relative`` is True for the unit of a difference, to which offsets do not apply (FMI's relativeQuantity).
    """

    name: str
    exponents: tuple[int, ...] | None
    factor: float = 1.0
    offset: float = 0.0
    is_relative: bool = False

    def differs_from(self, other: Unit) -> str:
        """Return the unit's name, with base units if the other unit has the same name, such as ``N.m (kg m2 s-2)``."""
        if self.name != other.name:
            return self.name
        if self.exponents is None:
            return f"{self.name} (without base units)"
        sizes = zip(BASE_UNITS, self.exponents, strict=True)
        parts = [name if size == 1 else f"{name}{size}" for name, size in sizes if size]
        factor = [] if self.factor == 1.0 and parts else [f"{self.factor:g}"]
        offset = f" + {self.offset:g}" if self.offset else ""
        return f"{self.name} ({' '.join([*factor, *parts])}{offset})"

    def is_convertible(self, other: Unit) -> bool:
        """Return True if values can be converted; rad counts as dimensionless (FMI 2.0)."""
        if self.exponents is None or other.exponents is None:
            return self.name == other.name
        return self.exponents[:-1] == other.exponents[:-1]

    def is_same(self, other: Unit) -> bool:
        """Return True if both are the same unit, judged by base units or, if these are unknown, by name."""
        if self.exponents is None or other.exponents is None:
            return self.name == other.name
        return self.exponents == other.exponents and self.conversion_to(other) == (1.0, 0.0)

    def conversion_to(self, other: Unit) -> tuple[float, float]:
        """Return factor and offset of the conversion to another unit; the offset is 0 if either unit is relative."""
        factor = 1.0 if self.factor == other.factor else self.factor / other.factor
        if self.is_relative or other.is_relative or self.offset == other.offset:
            return factor, 0.0
        return factor, (self.offset - other.offset) / other.factor


def unit_by_name(name: str) -> Unit:
    """Return the unit with a well-known name; for any other name, return a unit without base units."""
    definition = unit_definition(name)
    if definition is None:
        return Unit(name, None)
    exponents = tuple(definition.exponents.get(each, 0) for each in BASE_UNITS)
    return Unit(name, exponents, definition.factor, definition.offset)


def units_of_fmu(description: ModelDescription, label: str) -> dict[str, Unit]:
    """Return the units that an FMU defines, by name, from FMPy's description. Raises InputError with the ``label``."""
    units = {}
    for definition in description.unitDefinitions:
        name, base = definition.name, definition.baseUnit
        attributes = {each: getattr(base, each, 0) for each in (*BASE_UNITS, "factor", "offset")}
        units[name] = Unit(name, None) if base is None else _unit(name, attributes, label)
    return units


def units_of_document(root: etree._Element, prefix: str, file: str) -> dict[str, Unit]:
    """Return the units that an SSP document defines; ``prefix`` is the document's namespace prefix: ssd, ssv or ssb.

    Raises InputError with the ``file``.
    """
    units = {}
    for element in children(child(root, f"{prefix}:Units"), "ssc:Unit"):
        base = child(element, "ssc:BaseUnit")
        assert base is not None  # the schema requires it
        name = element.get("name", "")
        units[name] = _unit(name, base.attrib, file)
    return units


def _unit(name: str, base: Mapping[str, object], file: str) -> Unit:
    """Return a unit from the attributes of its BaseUnit, already validated as numbers by the schema or FMPy."""
    exponents = tuple(int(str(base.get(each, 0))) for each in BASE_UNITS)
    factor, offset = float(str(base.get("factor", 1.0))), float(str(base.get("offset", 0.0)))
    if not factor or not math.isfinite(factor) or not math.isfinite(offset):
        problem = f"no value can be converted with factor {factor:g} and offset {offset:g}"
        raise InputError(file, f"Unit {name}", problem, "give finite numbers, and a factor other than 0")
    return Unit(name, exponents, factor, offset)


@dataclass(frozen=True)
class Transformation:
    """Linear transformation, factor * value + offset, or a table from source to target values.

    With a table that ``is_partial``, unlisted values stay unchanged, as in SSP 2.0.
    """

    factor: float = 1.0
    offset: float = 0.0
    table: tuple[tuple[str, str], ...] = ()
    kind: str = "LinearTransformation"
    is_partial: bool = False

    def after_units(self, conversion: tuple[float, float]) -> Transformation:
        """Return the transformation preceded by a unit conversion, which is SSP's order."""
        factor, offset = conversion
        return replace(self, factor=self.factor * factor, offset=self.factor * offset + self.offset)


IDENTITY = Transformation()
VALUE_TYPES = {
    "LinearTransformation": ("Real",),
    "BooleanMappingTransformation": ("Boolean",),
    "IntegerMappingTransformation": ("Integer", "Enumeration"),
    "EnumerationMappingTransformation": ("Enumeration",),
}


def read_transformation(element: etree._Element) -> Transformation:
    """Return the transformation in a Connection or MappingEntry, or the identity."""
    for item in element:
        name = tag(item)
        if name == "LinearTransformation":
            return Transformation(float(item.get("factor", "1")), float(item.get("offset", "0")))
        if name in VALUE_TYPES:
            entries = [(entry.get("source", ""), entry.get("target", "")) for entry in children(item, "ssc:MapEntry")]
            version = next((outer.get("version") for outer in item.iterancestors() if outer.get("version")), "")
            return Transformation(table=tuple(entries), kind=name, is_partial=version == "2.0")
    return IDENTITY


def check_type(transformation: Transformation, type_name: str, file: str, element: str) -> None:
    """Reject a transformation that cannot be applied to values of the type."""
    if transformation != IDENTITY and type_name not in VALUE_TYPES[transformation.kind]:
        required = VALUE_TYPES[transformation.kind][0]
        raise InputError(
            file,
            element,
            f"{transformation.kind} cannot be applied to a value of type {type_name}",
            f"use it between {required} connectors",
        )
