"""Replacement of FMUs: search for FMUs with all connectors of a component and all of its parameters that are set."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache

from fmpy import read_model_description

from ...fmus_src.block import Block
from ...fmus_src.catalogue import catalogue
from ...fmus_src.export.available import fmu_flavours
from ..runtime.fmi.variable import variables_of

Demand = tuple[str, str, str]  # variable, causality, type


def connectors_of(block: type[Block]) -> set[Demand]:
    """Return all variables that may be connectors of a system."""
    return {
        (name, variable.causality, variable.fmi_type)
        for variable in block.variables.values()
        for name in variable.element_names()
    }


@cache
def _all_connectors() -> Mapping[str, set[Demand]]:
    demands = {name: connectors_of(block) for name, block in catalogue().items()}
    for name, flavours in fmu_flavours().items():
        path = next((path for path in flavours.values() if path is not None), None)
        if name not in demands and path is not None:
            variables = variables_of(read_model_description(str(path), validate=False))
            demands[name] = {(variable.name, variable.causality, variable.type) for variable in variables.values()}
    return demands


def find_fitting_fmus(demanded: Iterable[Demand]) -> list[str]:
    """Return the FMUs of this repository and of the working folder that have all required connectors, by name."""
    required = set(demanded)
    return [name for name, has in _all_connectors().items() if required <= has]


def slots() -> dict[str, type[Block]]:
    """Return the interfaces of interchangeable blocks by name in snake case, including intermediate base classes."""
    interfaces: dict[str, type[Block]] = {}
    for block in catalogue().values():
        for base in block.__mro__[1:]:
            if issubclass(base, Block) and base is not Block and base.is_interface:
                interfaces.setdefault(base.fmu_name, base)
    return interfaces


def blocks_of_slot(slot: type[Block]) -> list[type[Block]]:
    """Return the repository's blocks that implement an interface."""
    return [block for block in catalogue().values() if issubclass(block, slot)]
