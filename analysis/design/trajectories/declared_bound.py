"""Inputs of a landing's bound: the annotation `org.perilune.bound` of an SSD, and the values it refers to."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from lxml import etree

from ....common.errors import InputError
from ...runtime.ssp.annotations import AnnotationReader
from ...runtime.ssp.names import split_name
from ...runtime.system.prepared import PreparedSystem, prepare_system
from .point_mass import PointMassProblem, landing_problem, transfer_problem
from .vehicle import Landing, Transfer, Vehicle

ANNOTATION = "org.perilune.bound"
VECTORS = ("position", "velocity")
SCALARS = (
    "mass",
    "dry_mass",
    "specific_impulse",
    "maximum_thrust",
    "moon_radius",
    "gravitational_parameter",
    "target_altitude",
)  # attributes of the annotation, each a parameter or a number
STOP = ("altitude",)  # a piece from the same start to rest higher above the site
HOVER = ("mass", "minimum_thrust", "start_altitude", "end_altitude")  # a piece from hover to hover
ASIDE = "aside"  # the vector from site to site
NUMBER = re.compile(r"-?\d+(\.\d+)?([eE][+-]?\d+)?")
START = "start"  # the parameter set that braking starts from
ACROSS = 1e-3  # m/s; more, and the flight leaves the plane of the bound

Inputs = Mapping[str, float | tuple[float, ...]]


def read_inputs(prepared: PreparedSystem) -> Inputs | None:
    """Return the inputs of the bound of a system's landing, in SI units; None if its SSD declares no bound.

    They are the values of the prepared system, overridden by the parameter set from which braking starts. Raises
    InputError.
    """
    annotation = prepared.network.description.annotations.get(ANNOTATION)
    return None if annotation is None else _BoundReader(prepared).inputs(annotation)


class _BoundReader(AnnotationReader):
    def __init__(self, prepared: PreparedSystem) -> None:
        super().__init__(prepared.network.file)
        self.prepared = prepared

    def inputs(self, annotation: etree._Element) -> Inputs:
        element = self.content(annotation, "Bound")
        pieces = self.parts(element, ("Stop", "Hover"))
        names = self.attributes(element, (*VECTORS, *SCALARS), (START,))
        prepared = self.prepared
        if START in names:
            loaded = {fmu.label: fmu for fmu in prepared.network.fmus.values()}
            options = prepared.options
            options = options.replace(parameters=(*options.parameters, names[START]))
            prepared = prepare_system(prepared.archive, options, loaded)
        inputs: dict[str, float | tuple[float, ...]] = {}
        for role in VECTORS:
            inputs[role] = tuple(self.value(element, prepared, f"{names[role]}[{index}]") for index in (1, 2, 3))
        inputs |= {role: self.value(element, prepared, names[role]) for role in SCALARS}
        for child in (*pieces["Stop"], *pieces["Hover"]):
            is_hover = child in pieces["Hover"]
            roles = self.attributes(child, ("name", *((*HOVER, ASIDE) if is_hover else STOP)))
            name = roles["name"]
            if not name.isidentifier():
                raise self.refuse(child, f"name {name!r} is not an identifier", "use letters, digits and _")
            if any(key.startswith(f"{name}.") for key in inputs):
                raise self.refuse(child, f"name {name!r} is used twice", "give each element a different name")
            for role in HOVER if is_hover else STOP:
                inputs[f"{name}.{role}"] = self.value(child, prepared, roles[role])
            if is_hover:
                moved = (self.value(child, prepared, f"{roles[ASIDE]}[{index}]") for index in (1, 2))
                inputs[f"{name}.{ASIDE}"] = tuple(moved)
        return inputs

    def value(self, element: etree._Element, prepared: PreparedSystem, name: str) -> float:
        """Return the set value of a parameter, or the start value in its FMU; a number is returned unchanged."""
        if NUMBER.fullmatch(name):
            return float(name)
        component, variable = split_name(name, prepared.network.fmus)
        if not component or variable not in prepared.network.fmus[component].variables:
            raise self.refuse(element, f"{name}: no such parameter", "name a parameter as COMPONENT.VARIABLE")
        start = prepared.network.fmus[component].variables[variable].start_text
        value = prepared.settings.variables.get((component, variable), start)
        try:
            return float(value)
        except (TypeError, ValueError):
            raise self.refuse(element, f"{name} is {value}, not a number", "name a Real parameter") from None


def landing_of(inputs: Inputs, file: str) -> tuple[Vehicle, Landing]:
    """Return the vehicle and the landing of the bound, in the plane of start and site; ``file`` is named in errors.

    The bound assumes an engine that can be switched off: the least thrust is 0.
    """
    values = _numbers(inputs)
    arm = np.add(inputs["position"], (0.0, 0.0, values["moon_radius"]))
    away, distance = math.hypot(arm[0], arm[1]), float(np.linalg.norm(arm))
    if not away > 0.0:
        raise InputError(
            file, "bound", "braking starts vertically above the site", "start at a horizontal distance from the site"
        )
    up, aside = arm / distance, np.array([-arm[1], arm[0], 0.0]) / away
    velocity = np.array(inputs["velocity"])
    towards = float(velocity @ np.cross(up, aside))
    if not (abs(velocity @ aside) <= ACROSS and towards > 0.0):
        problem = "the velocity at the start of braking does not point towards the site"
        raise InputError(file, "bound", problem, "give a velocity in the plane of start and site")
    vehicle = Vehicle(
        mass=values["mass"],
        dry_mass=values["dry_mass"],
        specific_impulse=values["specific_impulse"],
        maximum_thrust=values["maximum_thrust"],
        minimum_thrust=0.0,
        angular_acceleration=math.inf,
    )
    landing = Landing(
        range=values["moon_radius"] * math.atan2(away, arm[2]),
        altitude=distance - values["moon_radius"],
        speed=float(np.linalg.norm(velocity)),
        climb=math.atan2(float(velocity @ up), towards),
        target_altitude=values["target_altitude"],
        radius=values["moon_radius"],
        gravitational_parameter=values["gravitational_parameter"],
    )
    return vehicle, landing


def pieces_of(inputs: Inputs, file: str) -> dict[str, tuple[PointMassProblem, float]]:
    """Return the problem and the initial mass (kg) of each piece into which a landing is divided, by name."""
    values = _numbers(inputs)
    vehicle, landing = landing_of(inputs, file)
    pieces = {}
    for name in dict.fromkeys(key.partition(".")[0] for key in inputs if "." in key):
        if f"{name}.altitude" in values:
            stop = replace(landing, target_altitude=values[f"{name}.altitude"])
            pieces[name] = landing_problem(vehicle, stop), vehicle.mass
            continue
        mass, minimum, start, end = (values[f"{name}.{role}"] for role in HOVER)
        if not (start > end and mass > 0.0):
            raise InputError(
                file, name, f"from {start:g} m to {end:g} m with {mass:g} kg is not a descent", "fix the annotation"
            )
        radii = np.array([start, end]) + landing.radius
        gravity = float(np.mean(landing.gravitational_parameter / radii**2))
        lander = replace(vehicle, mass=mass, minimum_thrust=minimum)
        transfer = Transfer(math.hypot(*np.ravel(inputs[f"{name}.{ASIDE}"])), start - end, gravity)
        pieces[name] = transfer_problem(lander, transfer), mass
    return pieces


def _numbers(inputs: Inputs) -> dict[str, float]:
    return {name: value for name, value in inputs.items() if not isinstance(value, tuple)}
