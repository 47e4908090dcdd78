"""What the verbs of plans share: overriding numbers of a plan's case, the burns, whether the propellant is on board."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import Any

from ...design.trajectories.vehicle import Vehicle
from ..options.design import VehicleOptions
from ..options.option import options_of

OF_VEHICLE = frozenset(options_of(VehicleOptions))


def format_numbers(options: Mapping[str, Any], names: Collection[str]) -> dict[str, float]:
    """The numbers among the options that are given, by name."""
    return {name: options[name] for name in names if options[name] is not None}


def propellant_problems(vehicle: Vehicle, propellant: float, what: str) -> list[str]:
    """A line for a plan that takes more propellant (kg) than is on board."""
    carried = vehicle.mass - vehicle.dry_mass
    if propellant <= carried:
        return []
    return [f"{what} takes {propellant:.2f} kg of propellant; {carried:g} kg are on board"]


def burns_text(burns: Iterable[tuple[float, float]]) -> str:
    """``full thrust 0.0 to 65.6 s, 112.3 to 292.7 s``."""
    return "full thrust " + ", ".join(f"{begin:.1f} to {end:.1f} s" for begin, end in burns)
