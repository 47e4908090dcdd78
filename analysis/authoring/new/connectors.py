"""The connectors and units of an SSD, from the declarations of blocks."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from ....fmus_src.block import Block, Input, Output
from ....fmus_src.units import UnitDefinition, unit_definition


@dataclass(frozen=True)
class Connector:
    """One element of an input or output, as an SSD has it."""

    name: str
    kind: str
    type: str
    unit: str | None


@dataclass(frozen=True)
class Part:
    """What an SSD says of a component made by a block."""

    fmu: str
    connectors: Sequence[Connector]


@dataclass(frozen=True)
class NamedUnit:
    """A unit as an SSD defines it."""

    name: str
    definition: UnitDefinition


def part_of(block: type[Block]) -> Part:
    """All inputs and outputs of a block, element by element."""
    connectors = [
        Connector(name, variable.causality, variable.type_name, variable.unit)
        for variable in block.variables.values()
        if isinstance(variable, Input | Output)
        for name in variable.element_names()
    ]
    return Part(block.fmu_name, connectors)


def units_of(parts: Collection[Part], more: Collection[str] = ()) -> list[NamedUnit]:
    """The units of all connectors and ``more``, by name."""
    names = {connector.unit for part in parts for connector in part.connectors} | set(more)
    units = [(name, unit_definition(name)) for name in sorted(name for name in names if name is not None)]
    return [NamedUnit(name, definition) for name, definition in units if definition is not None]
