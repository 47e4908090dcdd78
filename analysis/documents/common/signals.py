"""Signals of a run grouped into vectors and components, from names, units and types only."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...runtime.flight.results import FlightResult
from ...runtime.ssp.names import split_name

STATES = (
    "position", "relative_position", "altitude", "height", "central_angle", "longitude", "latitude", "velocity",
    "speed", "path_angle", "course", "mass", "attitude", "quaternion", "angles", "attack", "sideslip", "bank", "tilt",
    "angular_velocity", "angular_rate", "gimbal_angles",
)  # fmt: skip
COMMANDS = (
    "thrust", "throttle", "thrust_angle", "thrust_direction", "thrust_acceleration", "force_command", "torque_command",
    "jet_thrust", "gimbal_rates", "pulse_lengths",
)  # fmt: skip
INDEXED = re.compile(r"(.+)\[(\d+(?:,\d+)*)\]")


def vector_of(name: str) -> str:
    """Return the vector that contains a signal: ``plant.position`` for ``plant.position[1]``; else the signal."""
    indexed = INDEXED.fullmatch(name)
    return indexed[1] if indexed else name


def axes_of(result: FlightResult) -> Mapping[str, str]:
    """Return the names of axes by signal, as declared by the system of a run."""
    return result.provenance.get("axes", {})


def displayed_name(name: str, axes: Mapping[str, str]) -> str:
    """Return a signal's name on pages: ``plant.position north`` for an element along a named axis, else unchanged."""
    return f"{vector_of(name)} {axes[name]}" if name in axes else name


def names_of_elements(names: Sequence[str], axes: Mapping[str, str]) -> tuple[str, ...]:
    """Return the names of the axes of these elements; no names unless all axes have one."""
    return tuple(axes[name] for name in names) if all(name in axes for name in names) else ()


@dataclass(frozen=True)
class SignalGroup:
    """A scalar, or the elements of a vector that share name, unit and type.

    ``component`` is empty for a connector of the system. ``indices`` are as written, ``1`` or ``2,3``; empty for a
    scalar. ``labels`` are names of axes if all elements have one, else ``[1]`` ...
    """

    component: str
    variable: str
    unit: str | None
    type: str
    names: tuple[str, ...]
    indices: tuple[str, ...]
    labels: tuple[str, ...]

    @property
    def label(self) -> str:
        return f"{self.component}.{self.variable}" if self.component else self.variable

    @property
    def is_named(self) -> bool:
        """True if the elements are along named axes."""
        return bool(self.labels) and not self.labels[0].startswith("[")

    @property
    def axes(self) -> str:
        """The axes of the elements in words, empty if there are no names."""
        return ", ".join(self.labels) if self.is_named else ""

    @property
    def heading(self) -> str:
        return f"{self.label} ({self.axes})" if self.is_named else self.label

    @property
    def is_real(self) -> bool:
        return self.type == "Real"

    def values(self, result: FlightResult) -> np.ndarray:
        """Return the values in SI, [elements, samples]."""
        return np.stack([result[name] for name in self.names])


def signal_groups(result: FlightResult) -> list[SignalGroup]:
    """Return all signals in their order, with elements of vectors grouped."""
    components, axes = result.provenance["fmus"], axes_of(result)
    by_key: dict[tuple[str, str, str | None, str, bool], list[tuple[str, str]]] = {}
    for name in result.signals:
        component, variable = split_name(name, components)
        indexed = INDEXED.fullmatch(variable)
        base, index = indexed.groups() if indexed else (variable, "")
        key = (component, base, result.units[name], result.types[name], bool(indexed))
        by_key.setdefault(key, []).append((name, index))
    groups = []
    for (component, variable, unit, kind, _), elements in by_key.items():
        names = tuple(name for name, _ in elements)
        indices = tuple(index for _, index in elements if index)
        labels = names_of_elements(names, axes) or tuple(f"[{index}]" for index in indices)
        groups.append(SignalGroup(component, variable, unit, kind, names, indices, labels))
    return groups


def distinct(groups: Iterable[SignalGroup], result: FlightResult) -> dict[SignalGroup, SignalGroup]:
    """Map each group to the first group with the same unit and values, possibly itself.

    A connected input repeats the output that drives it and needs no separate plot.
    """
    first: dict[tuple, SignalGroup] = {}
    return {
        group: first.setdefault((group.unit, group.type, group.values(result).tobytes()), group) for group in groups
    }


def states_and_commands(groups: Iterable[SignalGroup], result: FlightResult) -> list[SignalGroup]:
    """Return states and commands, recognised by their names: for each variable the first signal that changes."""
    first: dict[str, SignalGroup] = {}
    for group in groups:
        if group.component and group.is_real and group.variable in STATES + COMMANDS:
            values = group.values(result)
            if np.any(values != values[:, :1]):
                first.setdefault(group.variable, group)
    return list(first.values())


def position_groups(result: FlightResult) -> list[SignalGroup]:
    """Return distinct signals COMPONENT.position[1..3] in m, the paths of a trajectory plot."""
    groups = [
        group
        for group in signal_groups(result)
        if group.variable == "position" and group.indices == ("1", "2", "3") and group.unit == "m"
    ]
    return list(dict.fromkeys(distinct(groups, result).values()))
