"""Air drag and solar radiation pressure on flat plates and on a sphere. Kernel functions.

Frame: body, origin at the undeformed centre of mass. Plates do not shade each other.

Each plate is a row of a matrix: area (m2; 0: no plate), unit outward normal (three elements), centre (m, three
elements), drag coefficient, specular and diffuse reflectivity.

Source: Montenbruck and Gill 2000, sections 3.4 and 3.5.
"""

from ...kernel.matrices import Matrix
from ...kernel.records import Field, Record
from ..vectors import Vector3, cross, dot, norm, vector
from .ephemerides import ASTRONOMICAL_UNIT

PLATES = 12
AREA, DRAG, SPECULAR, DIFFUSE = 0, 7, 8, 9  # columns of plates; 1 to 3 the normal, 4 to 6 the centre
COLUMNS = 10
SOLAR_PRESSURE = 1361.0 / 299792458.0  # N/m2 at one astronomical unit: Kopp and Lean 2011


class SurfaceLoad(Record):
    """Force on all surfaces, and its torque about the origin."""

    force = Field(Vector3, unit="N", frame="body", description="force on all surfaces")
    torque = Field(Vector3, unit="N.m", frame="body", description="torque about the origin of the body frame")


def pressure_at(distance: float, illumination: float) -> float:
    """Return the solar radiation pressure (N/m2) at a distance (m) from the Sun, for a visible fraction of its disk."""
    ratio = ASTRONOMICAL_UNIT / distance
    return SOLAR_PRESSURE * ratio * ratio * illumination


def plate_drag(plates: Matrix, density: float, velocity: Vector3) -> SurfaceLoad:
    """Return the drag load on plates for an air density (kg/m3) and a velocity relative to the air (m/s, body)."""
    force = vector(0.0, 0.0, 0.0)
    torque = vector(0.0, 0.0, 0.0)
    for k in range(len(plates)):
        facing = plates[k, AREA] * dot(plates[k, 1:4], velocity)
        if facing > 0.0:
            plate_force = -(0.5 * density * plates[k, DRAG] * facing) * velocity
            force = force + plate_force
            torque = torque + cross(plates[k, 4:7], plate_force)
    return SurfaceLoad(force=force, torque=torque)


def plate_pressure(plates: Matrix, pressure: float, sun: Vector3) -> SurfaceLoad:
    """Return the load on the plates from solar pressure (N/m2), with the direction to the Sun (unit vector, body)."""
    force = vector(0.0, 0.0, 0.0)
    torque = vector(0.0, 0.0, 0.0)
    for k in range(len(plates)):
        normal = plates[k, 1:4]
        cosine = dot(normal, sun)
        if plates[k, AREA] > 0.0 and cosine > 0.0:
            specular = plates[k, SPECULAR]
            along = 2.0 * (plates[k, DIFFUSE] / 3.0 + specular * cosine)
            plate_force = -(pressure * plates[k, AREA] * cosine) * ((1.0 - specular) * sun + along * normal)
            force = force + plate_force
            torque = torque + cross(plates[k, 4:7], plate_force)
    return SurfaceLoad(force=force, torque=torque)


def sphere_drag(area: float, coefficient: float, density: float, velocity: Vector3) -> Vector3:
    """Return the drag force (N) on a sphere with a cross-section (m2), for a velocity (m/s) and a density (kg/m3)."""
    return -(0.5 * density * coefficient * area * norm(velocity)) * velocity


def sphere_pressure(area: float, coefficient: float, pressure: float, sun: Vector3) -> Vector3:
    """Return the force (N) on a sphere from solar pressure (N/m2), with the direction to the Sun (unit vector)."""
    return -(pressure * coefficient * area) * sun
