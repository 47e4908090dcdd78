"""Surfaces of a spacecraft exposed to air and sunlight."""

from ..block import Parameter, State
from ..kernel.matrices import zeros
from ..mathlib.attitude.quaternion import to_body
from ..mathlib.space.surfaces import (
    AREA,
    COLUMNS,
    PLATES,
    SurfaceLoad,
    plate_drag,
    plate_pressure,
    pressure_at,
    sphere_drag,
    sphere_pressure,
)
from ..mathlib.vectors import Vector3, Vector4, norm, vector
from .space_model import SpaceModel


class ExposedSurfaces(SpaceModel, interface=True):
    """Up to twelve flat plates and a sphere, subject to drag and solar radiation pressure.

    For a plate of area A and outward normal n, with velocity v relative to the air, direction e to the Sun, visible
    fraction ν of the Sun, specular and diffuse reflectivity s and d, speed of light c and the Sun's distance D:

        F = -(ρ/2) C_D A (n · v) v    if n · v > 0
        F = -P ν A (n · e) ((1 - s) e + 2 (d/3 + s (n · e)) n)    if n · e > 0
        P = (1361/c) (AU/D)^2

    The air rotates with the planet.

    Frame: body.

    Assumes plates that do not shade one another, and no albedo.

    Source: Montenbruck and Gill 2000, sections 3.4 and 3.5.
    """

    plates = Parameter(
        [0.0] * (PLATES * COLUMNS),
        frame="body",
        columns=COLUMNS,
        description=(
            "flat plates, one per row, in SI units: area (0: none), normal, centre, coefficients of drag, "
            "specular and diffuse reflection"
        ),
    )
    sphere_area = Parameter(
        0.0, unit="m2", minimum=0.0, description="cross-sectional area of the additional sphere; 0: no sphere"
    )
    sphere_drag = Parameter(2.2, unit="1", minimum=0.0, description="drag coefficient of the sphere")
    sphere_reflectivity = Parameter(
        1.3,
        unit="1",
        minimum=0.0,
        description="radiation pressure coefficient of the sphere: 1 for full absorption, 2 for full reflection",
    )
    surfaces = State(
        zeros(PLATES, COLUMNS),
        frozen=True,
        description=(
            "flat plates with unit normals, one per row, columns as in plates; area 0 for a plate without a normal "
            "(body frame)"
        ),
    )
    has_surfaces = State(False, description="true: at least one plate, or the sphere, has an area")
    lacks_normal = State(False, description="true: a plate with an area has no normal and is ignored")

    def start_surfaces(self) -> None:
        """Set the matrix of plates from the parameters, with unit normals."""
        self.surfaces = self.plates
        self.has_surfaces = self.sphere_area > 0.0
        self.lacks_normal = False
        for k in range(PLATES):
            length = norm(self.plates[k, 1:4])
            if length > 0.0:
                self.surfaces[k, 1:4] = self.plates[k, 1:4] / length
            elif self.plates[k, AREA] > 0.0:
                self.surfaces[k, AREA] = 0.0
                self.lacks_normal = True
            if self.surfaces[k, AREA] > 0.0:
                self.has_surfaces = True

    def surface_load(self, t: float, r: Vector3, v: Vector3, q: Vector4) -> SurfaceLoad:
        """Return the force (N, body) and torque (N m, body) of air drag and solar radiation pressure.

        t: simulation time (s); r, v: position (m) and velocity (m/s), inertial; q: attitude, from body to inertial.
        """
        force = vector(0.0, 0.0, 0.0)
        torque = vector(0.0, 0.0, 0.0)
        if not self.has_surfaces:
            return SurfaceLoad(force=force, torque=torque)
        density = self.air_density(t, r)
        if density > 0.0:
            wind_body = to_body(q, v - self.air_velocity(r))
            drag = plate_drag(self.surfaces, density, wind_body)
            force = drag.force + sphere_drag(self.sphere_area, self.sphere_drag, density, wind_body)
            torque = drag.torque
        light = self.light(r)
        if light > 0.0:
            sun_inertial = self.sun - r
            pressure = pressure_at(norm(sun_inertial), light)
            sun_body = to_body(q, sun_inertial / norm(sun_inertial))
            solar = plate_pressure(self.surfaces, pressure, sun_body)
            force = (
                force + solar.force + sphere_pressure(self.sphere_area, self.sphere_reflectivity, pressure, sun_body)
            )
            torque = torque + solar.torque
        return SurfaceLoad(force=force, torque=torque)
