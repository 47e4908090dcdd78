"""What happens to a value on its way: conversion between units, as FMI and SSP define them; SSP's transformations."""

from __future__ import annotations

from dataclasses import dataclass, replace

from fmpy.model_description import ModelDescription
from lxml import etree

from ....fmus_src.units import BASE_UNITS
from ...common.errors import InputError
from .documents import child, children, tag


@dataclass(frozen=True)
class Unit:
    """value in base units = factor * value + offset. One that nobody defines has no ``exponents``: it is its name."""

    name: str
    exponents: tuple[int, ...] | None
    factor: float = 1.0
    offset: float = 0.0

    def differs_from(self, other: Unit) -> str:
        """The name, and what the unit is made of where the other has the same: ``N.m (kg m2 s-2)``."""
        if self.name != other.name:
            return self.name
        if self.exponents is None:
            return f"{self.name} (of no base units)"
        sizes = zip(BASE_UNITS, self.exponents, strict=True)
        parts = [name if size == 1 else f"{name}{size}" for name, size in sizes if size]
        factor = [] if self.factor == 1.0 and parts else [f"{self.factor:g}"]
        offset = f" + {self.offset:g}" if self.offset else ""
        return f"{self.name} ({' '.join([*factor, *parts])}{offset})"

    def fits(self, other: Unit) -> bool:
        """Whether values can be converted; rad counts as dimensionless where the other has none (FMI 2.0)."""
        if self.exponents is None or other.exponents is None:
            return self.name == other.name
        return self.exponents[:-1] == other.exponents[:-1]

    def is_same(self, other: Unit) -> bool:
        """Whether both mean one unit, by what they are made of; by their names where nobody says that of one."""
        if self.exponents is None or other.exponents is None:
            return self.name == other.name
        return (self.exponents, self.factor, self.offset) == (other.exponents, other.factor, other.offset)

    def conversion_to(self, other: Unit) -> tuple[float, float]:
        """Factor and offset that turn a value in this unit into one in the other."""
        if (self.factor, self.offset) == (other.factor, other.offset):
            return 1.0, 0.0
        return self.factor / other.factor, (self.offset - other.offset) / other.factor


def units_of_fmu(description: ModelDescription) -> dict[str, Unit]:
    """Units that an FMU defines, by name (fmpy ModelDescription)."""
    units: dict[str, Unit] = {}
    for definition in description.unitDefinitions:
        base = definition.baseUnit
        if base is None:
            units[definition.name] = Unit(definition.name, None)
        else:
            exponents = tuple(int(getattr(base, name, 0) or 0) for name in BASE_UNITS)
            units[definition.name] = Unit(definition.name, exponents, float(base.factor), float(base.offset))
    return units


def units_of_document(root: etree._Element, prefix: str) -> dict[str, Unit]:
    """Units defined in an SSP document; ``prefix`` is its namespace prefix (ssd, ssv, ssb)."""
    units = {}
    for element in children(child(root, f"{prefix}:Units"), "ssc:Unit"):
        base = child(element, "ssc:BaseUnit")
        assert base is not None  # the schema requires it
        exponents = tuple(int(base.get(name, "0")) for name in BASE_UNITS)
        name = element.get("name", "")
        units[name] = Unit(name, exponents, float(base.get("factor", "1")), float(base.get("offset", "0")))
    return units


@dataclass(frozen=True)
class Transformation:
    """factor * value + offset, or a table from source to target values.

    ``is_partial``: values that the table does not have stay as they are, as in SSP 2.0.
    """

    factor: float = 1.0
    offset: float = 0.0
    table: tuple[tuple[str, str], ...] = ()
    kind: str = "LinearTransformation"
    is_partial: bool = False

    def after_units(self, conversion: tuple[float, float]) -> Transformation:
        """The same with a unit conversion before it, as SSP orders them."""
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
    """The transformation inside a Connection or MappingEntry; the identity if there is none."""
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
    """Refuse a transformation that does not apply to values of the type."""
    if transformation != IDENTITY and type_name not in VALUE_TYPES[transformation.kind]:
        wanted = VALUE_TYPES[transformation.kind][0]
        raise InputError(
            file,
            element,
            f"{transformation.kind} on a value of type {type_name}",
            f"use it between {wanted} connectors",
        )
