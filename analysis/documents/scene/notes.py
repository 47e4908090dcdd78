"""Sentences on the scales of a scene, and on unknown attitudes and positions."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ...runtime.flight.results import FlightResult
from ..common.quantities import display_unit, number
from ..figures.scene.scene_elements import Arrow, Body, SceneFigure, Thrust, ThrustAxis


def scene_notes(scene: SceneFigure, result: FlightResult) -> list[str]:
    """Return the sentences below a view, and sentences on what it omits."""
    return [
        frame_note(scene),
        size_note(scene.bodies),
        *(f"Dashed line: {line.name}." for line in scene.lines),
        *(_arrow_note(arrow) for arrow in scene.arrows),
        *(note for body in scene.bodies for note in _body_notes(body, result)),
        "Marks, lines and paths have a constant width on the screen; the light is not the Sun's.",
        *scene.notes,
    ]


def frame_note(scene: SceneFigure) -> str:
    """Return a sentence on the axes of the scene."""
    axes = ", ".join(f"{axis} {name}" if axis != name else axis for axis, name in zip("xyz", scene.axes, strict=True))
    return f"Frame: {scene.frame or 'of the signals'}; {axes}."


def size_note(bodies: Iterable[Body]) -> str:
    """Return a sentence on the extents of bodies."""
    sizes = "; ".join(f"{body.name} {' x '.join(number(extent) for extent in body.size)} m" for body in bodies)
    return f"To scale, along the body's axes: {sizes}."


def _arrow_note(arrow: Arrow) -> str:
    axes = f" in axes of {arrow.frame}" if arrow.frame is not None else ""
    length = f"{number(arrow.length)} m long" if arrow.length is not None else "of constant length on the screen"
    return f"Arrow: {arrow.name}, the direction of {arrow.signal.label}{axes}, {length}."


def _body_notes(body: Body, result: FlightResult) -> list[str]:
    notes = []
    if isinstance(body.attitude, ThrustAxis):
        notes.append(f"{body.name}: roll about {body.attitude.signal.label} is unknown and not shown.")
    notes += [_plume(body, thrust, result) for thrust in body.thrusts]
    forces = " or ".join(jets.signal.label for jets in body.jets if not jets.pulses)
    pulses = " or ".join(jets.signal.label for jets in body.jets if jets.pulses)
    if forces:
        notes.append(f"Jets: their length is proportional to {forces}, not to scale.")
    if pulses:
        notes.append(f"Jets: shown while a pulse of {pulses} lasts, not to scale.")
    return notes


def _plume(body: Body, thrust: Thrust, result: FlightResult) -> str:
    largest = number(largest_magnitude(thrust.signal.values(result)))
    unit = display_unit(thrust.signal.unit_name)
    length = f"{number(plume_length(body))} m at {largest} {unit}".rstrip()
    return f"Plume: its length is proportional to {thrust.signal.label}, {length}."


def plume_length(body: Body) -> float:
    """Return the drawn length (m) of the plume at a run's largest thrust."""
    return 2.0 * max(body.size)


def largest_magnitude(values: np.ndarray) -> float:
    """Return the largest magnitude of finite values; 0 if no value is finite."""
    return float(np.max(np.abs(values), where=np.isfinite(values), initial=0.0))
