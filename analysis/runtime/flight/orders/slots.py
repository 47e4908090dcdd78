"""Slots of the loop's array of values, with their variables and initial values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from ...fmi.variable import ScalarVariable
from ...system.passing.settings import SystemSettings

BASE = " as set"  # suffix of slots for unchanged values of parameters that change during simulation


@dataclass
class Slots:
    """``numbers`` of slots by name, with their types and units; ``references`` and ``initial`` values by number.

    ``exact`` contains the initial values of 64-bit integers, by number. ``unfed`` contains unconnected elements of
    arrays that are set as a whole. ``bases`` contains the slots of the unchanged values of parameters that change
    during simulation, by (component, variable).
    """

    settings: SystemSettings
    numbers: dict[str, int] = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)
    units: dict[str, str | None] = field(default_factory=dict)
    references: list[int] = field(default_factory=list)
    initial: list[float] = field(default_factory=list)
    exact: dict[int, int] = field(default_factory=dict)
    unfed: set[str] = field(default_factory=set)
    bases: dict[tuple[str, str], int] = field(default_factory=dict)

    def add(self, name: str, reference: int, initial: float, type_name: str, unit: str | None) -> None:
        """Add a slot."""
        self.numbers[name] = len(self.references)
        self.types[name] = type_name
        self.units[name] = unit
        self.references.append(reference)
        self.initial.append(initial)

    def add_bases(self, component: str, variables: Sequence[ScalarVariable]) -> int:
        """Add contiguous slots for the parameters' unchanged values, and return the first. They are not recorded."""
        first = len(self.references)
        for variable in variables:
            name = f"{component}.{variable.name}{BASE}"
            self.bases[component, variable.name] = len(self.references)
            self.unfed.add(name)
            self.add(name, variable.reference, self.start(component, variable), variable.type, variable.unit)
        return first

    def start(self, component: str, variable: ScalarVariable) -> float:
        """Return an input's value before its source is known: the value set for it, else the start value in its FMU."""
        start = self.settings.variables.get((component, variable.name), variable.start or 0.0)
        return float({"true": 1, "false": 0}.get(str(start).lower(), start))
