"""Where systems fly: Perilune's own FMUs in this process, those of others, and those with external state, in a child.

All verbs come through here.
"""

from __future__ import annotations

from typing import Unpack

from ..flight.base_simulation import BaseSimulation, Choices
from ..flight.simulation import Simulation
from ..fused.refusals import check_fused
from ..system.prepared import PreparedSystem
from .simulation import ApartSimulation


def flies_here(prepared: PreparedSystem) -> bool:
    """Whether a system's FMUs may be loaded into this process."""
    return prepared.is_self_contained or prepared.options.in_process


def open_simulation(prepared: PreparedSystem, *, apart: bool = False, **choices: Unpack[Choices]) -> BaseSimulation:
    """A simulation, in a child where it may not be here or is to be ``apart``; see `Choices`. Raises InputError."""
    apart = apart or not flies_here(prepared)
    check_fused(prepared, apart=apart)
    kind = ApartSimulation if apart else Simulation
    return kind(prepared, **choices)
