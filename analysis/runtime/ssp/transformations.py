"""What SSP lets happen to a value on its way: LinearTransformation and the mappings."""

from __future__ import annotations

from dataclasses import dataclass

from lxml import etree

from ...common.errors import InputError
from .documents import children, tag


@dataclass(frozen=True)
class Transformation:
    """factor * value + offset, or a table from source to target values."""

    factor: float = 1.0
    offset: float = 0.0
    table: tuple[tuple[str, str], ...] = ()
    kind: str = "LinearTransformation"

    def after_units(self, conversion: tuple[float, float]) -> Transformation:
        """The same with a unit conversion before it, as SSP orders them."""
        factor, offset = conversion
        return Transformation(self.factor * factor, self.factor * offset + self.offset, self.table, self.kind)


IDENTITY = Transformation()
VALUE_TYPES = {
    "LinearTransformation": ("Real",),
    "BooleanMappingTransformation": ("Boolean",),
    "IntegerMappingTransformation": ("Integer",),
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
            return Transformation(table=tuple(entries), kind=name)
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
