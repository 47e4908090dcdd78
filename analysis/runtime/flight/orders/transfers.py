"""Transfers of FMI 3.0 variables as rows of the loop's table; each transfer is one call of a setter or getter."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...fmi.representations import REPRESENTATIONS
from ...fmi.variable import ScalarVariable
from ...instances.fmu_library import FUNCTION_NAMES
from ...loop import codes
from ...system.network import Network

KINDS = {name: number for number, name in enumerate(REPRESENTATIONS)}
NUMBERS = {
    "SetFloat64": codes.SETTERS,
    "GetFloat64": codes.GETTERS,
    "DoStep": codes.DO_STEP,
    "EnterEventMode": codes.ENTER_EVENT_MODE,
    "UpdateDiscreteStates": codes.UPDATE_DISCRETE_STATES,
    "EnterStepMode": codes.ENTER_STEP_MODE,
}  # numbers of the loop's functions, without importing the modules that load it
assert all(FUNCTION_NAMES[number] == f"fmi3{name}" for name, number in NUMBERS.items())


@dataclass
class ComponentTransfers:
    """Transfers of a component of FMI 3.0 by use, as row numbers of the table.

    If the component ``uses_events``, inputs in ``discrete`` are set in event mode. ``before`` lists parameters set
    before initialisation mode, ``repeated`` those set again in it, ``back`` those read back after it, and
    ``structural`` those set in configuration mode. Parameters that change during simulation are in ``discrete`` if
    events are used, otherwise in ``inputs``; ``bases`` lists (first slot, count, first slot of the unchanged values)
    for them.
    """

    uses_events: bool = False
    inputs: list[int] = field(default_factory=list)
    discrete: list[int] = field(default_factory=list)
    outputs: list[int] = field(default_factory=list)
    recorded: list[int] = field(default_factory=list)
    structural: list[int] = field(default_factory=list)
    before: list[int] = field(default_factory=list)
    repeated: list[int] = field(default_factory=list)
    back: list[int] = field(default_factory=list)
    bases: list[tuple[int, int, int]] = field(default_factory=list)


class TransferTable:
    """Collector of transfers: ``rows`` with the columns of `codes`, and the ``references`` of their variables."""

    def __init__(self) -> None:
        self.rows: list[tuple[int, int, int, int, int]] = []
        self.references: list[int] = []

    def add(self, variables: Sequence[ScalarVariable], first: int) -> int:
        """Add a transfer of variables of one representation, with elements from ``first`` on; return its row."""
        references = [
            reference for _, reference in dict.fromkeys((each.array or each.name, each.reference) for each in variables)
        ]
        kind = KINDS[variables[0].representation.name]
        self.rows.append((len(self.references), len(references), first, len(variables), kind))
        self.references += references
        return len(self.rows) - 1

    def kind(self, transfer: int) -> int:
        return self.rows[transfer][codes.KIND]

    def slots(self, transfer: int) -> tuple[int, int]:
        """Return the first slot and the number of slots of a transfer; (0, 0) for texts, which have no slots."""
        row = self.rows[transfer]
        return (row[codes.FIRST_VALUE], row[codes.VALUES]) if row[codes.KIND] < codes.STRING else (0, 0)

    def array(self) -> np.ndarray:
        return np.array(self.rows, dtype=np.int64).reshape(-1, codes.TRANSFER_COLUMNS)


def needs_events(network: Network, component: str) -> bool:
    """Return True if a component supports event mode and has a discrete input that is connected or driven over time.

    Event mode is not requested for other components, which handle events within their steps.
    """
    fmu = network.fmus[component]
    return (
        fmu.version == 3
        and bool(fmu.description.coSimulation.hasEventMode)
        and any(
            variable.causality == "input"
            and variable.variability == "discrete"
            and _is_set_once(network, component, variable)
            for variable in fmu.variables.values()
        )
    )


def select_arrays(variables: Iterable[ScalarVariable], selected: Collection[str]) -> list[ScalarVariable]:
    """Return all elements of the variables that are selected by name, or by the name of any of their elements."""
    variables = list(variables)
    arrays = {each.array or each.name for each in variables if each.name in selected}
    return [each for each in variables if (each.array or each.name) in arrays]


def group_by_representation(variables: Iterable[ScalarVariable]) -> list[list[ScalarVariable]]:
    """Return the variables grouped by representation."""
    parted: dict[str, list[ScalarVariable]] = {}
    for each in variables:
        parted.setdefault(each.representation.name, []).append(each)
    return list(parted.values())


def _is_set_once(network: Network, component: str, variable: ScalarVariable) -> bool:
    name = f"{component}.{variable.name}"
    return name in network.driver or name in network.driven
