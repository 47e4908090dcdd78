"""Where systems fly: Perilune's own FMUs in this process, those of others in a child. All verbs come through here."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ..flight.base_simulation import BaseSimulation
from ..flight.instance import Log
from ..system.fault import Fault
from ..system.prepared import PreparedSystem
from .simulation import ApartSimulation


def flies_here(prepared: PreparedSystem) -> bool:
    """Whether a system's FMUs may be loaded into this process."""
    return prepared.is_own or prepared.options.in_process


def open_simulation(
    prepared: PreparedSystem,
    *,
    apart: bool = False,
    varied: Collection[str] = (),
    wanted: Collection[str] | None = None,
    faults: Sequence[Fault] = (),
    excited: Sequence[str] = (),
    log: Log | None = None,
) -> BaseSimulation:
    """A simulation, in a child where it may not be here or is to be ``apart``; see `Simulation`. Raises InputError."""
    kind = ApartSimulation if apart or not flies_here(prepared) else _simulation_here()
    return kind(prepared, varied=varied, wanted=wanted, faults=faults, excited=excited, log=log)


def _simulation_here() -> type[BaseSimulation]:
    from ..flight.simulation import Simulation  # imports numba, a third of a second that flights elsewhere do without

    return Simulation
