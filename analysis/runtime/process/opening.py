"""Choice between this process and a child for a simulation; all verbs simulate through this module.

Perilune's FMUs are loaded into this process, foreign FMUs and FMUs with external state into a child.
"""

from __future__ import annotations

from typing import Unpack

from ..flight.base_simulation import BaseSimulation, Choices
from ..flight.simulation import Simulation
from ..fused.refusals import check_fused
from ..system.prepared import PreparedSystem
from .simulation import ProcessSimulation


def may_load_here(prepared: PreparedSystem) -> bool:
    """Return True if a system's FMUs may be loaded into this process."""
    return prepared.is_self_contained or prepared.options.trust["in_process"]


def open_simulation(prepared: PreparedSystem, *, in_child: bool = False, **choices: Unpack[Choices]) -> BaseSimulation:
    """Return a simulation with these `Choices`; it is in a child if the FMUs require it, or if ``in_child``.

    Raises InputError.
    """
    in_child = in_child or not may_load_here(prepared)
    check_fused(prepared, in_child=in_child)
    return ProcessSimulation(prepared, **choices) if in_child else Simulation(prepared, **choices)
