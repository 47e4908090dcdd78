"""Recorded signals of a batch that a page plots over time, recognised by names and units only, for any system."""

from __future__ import annotations

from collections.abc import Iterable

from ....campaigns.folder.provenance import CampaignProvenance
from ....runtime.ssp.names import split_name
from ...common.signals import INDEXED, vector_of

COMMANDS = ("thrust_acceleration", "thrust", "delivered_thrust", "thrust_angle", "throttle")
DIRECTIONS = ("thrust_direction", "attitude")
MOTION = ("altitude", "speed", "path_angle", "mass")
CONSISTENCY = ("normalised_error_square",)
RATIO = "_error_ratio"
AxisNames = tuple[str, str, str]
LETTERS: AxisNames = ("x", "y", "z")
KNOWN = (*COMMANDS, *DIRECTIONS, *MOTION, *CONSISTENCY, "position", "velocity", "central_angle")


def names_of_record(provenance: CampaignProvenance) -> list[str]:
    """Return the recorded signals to plot: all that the campaign lists, or in full traces all with known names.

    If several components record a variable of the same name, since inputs repeat outputs, the first component is
    chosen.
    """
    record = provenance["record"]
    if record["every"] is not None:
        return list(record["signals"])
    if record["traces"] == "none":
        return []
    owners: dict[str, str] = {}
    retained = []
    for name in provenance["signals"]:
        owner, variable = owner_of(provenance, name), variable_of(provenance, name)
        known = variable in KNOWN or variable.endswith(RATIO)
        if known and owners.setdefault(variable, owner) == owner:
            retained.append(name)
    return retained


def owner_of(provenance: CampaignProvenance, name: str) -> str:
    """Return the component of a signal; empty for a connector of the system."""
    return split_name(name, _components(provenance))[0]


def variable_of(provenance: CampaignProvenance, name: str) -> str:
    """Return the variable of a signal: ``position`` for ``plant.position[1]`` and ``plant.position``."""
    return vector_of(split_name(name, _components(provenance))[1])


def unit_of(provenance: CampaignProvenance, name: str) -> str | None:
    """Return the unit of a recorded signal, or None if undeclared."""
    return provenance["signals"].get(name, {}).get("unit")


def axis_of(provenance: CampaignProvenance, name: str) -> str:
    """Return the name of the axis of a recorded element; empty if there is no name."""
    return provenance["signals"].get(name, {}).get("axis", "")


def axes_of(provenance: CampaignProvenance, vector: tuple[str, str, str]) -> AxisNames:
    """Return the names of the axes of a vector's elements; x, y and z unless all have a name."""
    x, y, z = (axis_of(provenance, name) for name in vector)
    return (x, y, z) if x and y and z else LETTERS


def is_real(provenance: CampaignProvenance, name: str) -> bool:
    """Return True if a recorded signal is a Real; signals of other types are constant between samples."""
    return provenance["signals"].get(name, {}).get("type", "Real") == "Real"


def vectors(names: Iterable[str]) -> dict[str, tuple[str, str, str]]:
    """Return the names of elements 1 to 3 by vector, for all vectors with exactly these elements."""
    elements: dict[str, dict[str, str]] = {}
    for name in names:
        indexed = INDEXED.fullmatch(name)
        if indexed:
            elements.setdefault(indexed[1], {})[indexed[2]] = name
    return {base: (parts["1"], parts["2"], parts["3"]) for base, parts in elements.items() if set(parts) == set("123")}


def find_vector(
    provenance: CampaignProvenance, names: Iterable[str], variable: str, unit: str, owner: str = ""
) -> tuple[str, str, str] | None:
    """Return the first vector named ``variable`` with this unit, preferably of the component ``owner``."""
    candidates = {
        base: elements
        for base, elements in vectors(names).items()
        if variable_of(provenance, base) == variable and unit_of(provenance, elements[0]) == unit
    }
    return candidates.get(f"{owner}.{variable}") or next(iter(candidates.values()), None)


def _components(provenance: CampaignProvenance) -> set[str]:
    return {component for fmus in provenance["fmus"].values() for component in fmus}
