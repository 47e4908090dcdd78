"""Slots of a component of FMI 2.0: one call transfers contiguous slots of variables of one type and direction."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...fmi.variable import ScalarVariable
from ...instances.fmu_library import FUNCTION_NAMES
from ...system.network import Network
from ..parameters import TYPE_KIND
from .exchanged import Exchanged
from .instruction_rows import Stretch
from .slots import Slots

EXCHANGES = FUNCTION_NAMES[:6]  # set and get of Real, Integer (and Enumeration), Boolean
CAUSALITIES = ("input", "output")  # set and get
SETTERS = (0, 2, 4)  # indices in EXCHANGES
GETTERS = (1, 3, 5)  # indices in EXCHANGES


class ComponentSlots(NamedTuple):
    """Slots of a component's variables.

    ``ranges`` [function of EXCHANGES] are the first slot and the number of slots. ``recorded`` lists (function, first
    slot, count) of variables that are only recorded. ``tuned`` lists (function, first slot, count, first slot of the
    unchanged values) of parameters that change during simulation.
    """

    ranges: list[Stretch]
    recorded: list[tuple[int, int, int]]
    tuned: list[tuple[int, int, int, int]]


def place_component(network: Network, component: str, exchanged: Exchanged, slots: Slots) -> ComponentSlots:
    """Add the slots of a component of FMI 2.0 to ``slots``."""
    ranges: list[Stretch] = []
    for function, variables in enumerate(_by_function(network, component, exchanged)):
        first = len(slots.references)
        for variable in variables:
            name = f"{component}.{variable.name}"
            if CAUSALITIES[function % 2] == "input":
                if exchanged.is_set(name):
                    start = slots.start(component, variable)
                    slots.add(name, variable.reference, start, variable.type, variable.unit)
            elif exchanged.is_fetched(name):
                slots.add(name, variable.reference, np.nan, variable.type, variable.unit)
        ranges.append((first, len(slots.references) - first))
    tuned = _locate_tuned(network, component, exchanged, slots)
    return ComponentSlots(ranges, _place_recorded(network, component, exchanged, slots), tuned)


def _by_function(network: Network, component: str, exchanged: Exchanged) -> list[list[ScalarVariable]]:
    """Return the variables grouped by the function of EXCHANGES that sets or gets them."""
    variables: list[list[ScalarVariable]] = [[] for _ in EXCHANGES]
    for variable in network.fmus[component].variables.values():
        kind = TYPE_KIND.get(variable.type, len(EXCHANGES))
        causality = variable.causality
        if f"{component}.{variable.name}" in exchanged.other_sources:
            causality = "output"
        if causality in CAUSALITIES and 2 * kind < len(EXCHANGES):
            variables[2 * kind + CAUSALITIES.index(causality)].append(variable)
    return variables


def _locate_tuned(
    network: Network, component: str, exchanged: Exchanged, slots: Slots
) -> list[tuple[int, int, int, int]]:
    """Add slots of parameters that change during simulation, and of their unchanged values."""
    sets = []
    for kind, function in enumerate(SETTERS):
        variables = [
            variable
            for variable in network.fmus[component].variables.values()
            if exchanged.is_tuned(component, variable) and TYPE_KIND.get(variable.type) == kind
        ]
        first = len(slots.references)
        for variable in variables:
            start = slots.start(component, variable)
            slots.add(f"{component}.{variable.name}", variable.reference, start, variable.type, variable.unit)
        if variables:
            sets.append((function, first, len(variables), slots.add_bases(component, variables)))
    return sets


def _place_recorded(network: Network, component: str, exchanged: Exchanged, slots: Slots) -> list[tuple[int, int, int]]:
    """Add the slots of variables that are recorded but not exchanged, and return their ranges."""
    if not exchanged.named:
        return []
    fmu = network.fmus[component]
    reads = []
    for kind, function in enumerate(GETTERS):
        first = len(slots.references)
        for variable in fmu.variables.values():
            name = f"{component}.{variable.name}"
            if name in exchanged.named and name not in slots.numbers and TYPE_KIND.get(variable.type) == kind:
                slots.add(name, variable.reference, np.nan, variable.type, variable.unit)
        if len(slots.references) > first:
            reads.append((function, first, len(slots.references) - first))
    return reads
