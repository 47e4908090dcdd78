"""Flight over a turning, spherical Earth, and attitude against the velocity. Kernel functions.

Velocity axes: x along the velocity, y up in the vertical plane through it, z = x x y. Attitude: bank, sideslip and
attack, turns about velocity x, then body -y and z as written in `body_axes`. Equations:
docs/systems/entry_attitude.md. Source: Lapin, thesis, chapter 1.2.
"""

from ...kernel.functions import cos, sin, tan
from ...kernel.records import Field, Record
from ..vectors import Vector3, dot, vector


class EntryState(Record):
    """Capsule over a turning, spherical Earth."""

    radius = Field(unit="m", frozen=True, description="distance from the Earth's centre")
    longitude = Field(unit="rad", frozen=True, description="longitude")
    latitude = Field(unit="rad", frozen=True, description="latitude")
    speed = Field(unit="m/s", frozen=True, description="over the turning Earth")
    flight_path_angle = Field(unit="rad", frozen=True, description="of the velocity over the horizon")
    heading = Field(unit="rad", frozen=True, description="of the velocity, from east, counter-clockwise from above")
    attitude = Field(Vector3, unit="rad", description="bank, sideslip, attack")
    angular_velocity = Field(Vector3, unit="rad/s", frame="body", description="absolute")


class BodyAxes(Record):
    """The body's axes in velocity axes, unit vectors."""

    x = Field(Vector3, unit="1")
    y = Field(Vector3, unit="1")
    z = Field(Vector3, unit="1")


class PathRate(Record):
    """How fast place and velocity change."""

    radius = Field(unit="m/s")
    longitude = Field(unit="rad/s")
    latitude = Field(unit="rad/s")
    speed = Field(unit="m/s2")
    flight_path_angle = Field(unit="rad/s")
    heading = Field(unit="rad/s")


def body_axes(attitude: Vector3) -> BodyAxes:
    """The body's axes."""
    sg = sin(attitude.x)
    cg = cos(attitude.x)
    sb = sin(attitude.y)
    cb = cos(attitude.y)
    sa = sin(attitude.z)
    ca = cos(attitude.z)
    x = vector(ca * cb, sa * cg + ca * sb * sg, sa * sg - ca * sb * cg)
    y = vector(-sa * cb, ca * cg - sa * sb * sg, ca * sg + sa * sb * cg)
    return BodyAxes(x=x, y=y, z=vector(sb, -cb * sg, cb * cg))


def in_body(axes: BodyAxes, v: Vector3) -> Vector3:
    """A vector of velocity axes in the body's."""
    return vector(dot(axes.x, v), dot(axes.y, v), dot(axes.z, v))


def earth_forces(s: EntryState, gravitational_parameter: float, earth_rate: float) -> Vector3:
    """Gravity and the terms of the Earth's rotation (m/s2, velocity axes)."""
    sin_path = sin(s.flight_path_angle)
    cos_path = cos(s.flight_path_angle)
    sin_heading = sin(s.heading)
    cos_heading = cos(s.heading)
    sin_latitude = sin(s.latitude)
    cos_latitude = cos(s.latitude)
    gravity = gravitational_parameter / (s.radius * s.radius)
    coriolis = 2.0 * s.speed * earth_rate
    transport = earth_rate * earth_rate * s.radius * cos_latitude
    return vector(
        -gravity * sin_path + transport * (cos_latitude * sin_path - sin_latitude * cos_path * sin_heading),
        -gravity * cos_path
        + coriolis * cos_latitude * cos_heading
        + transport * (cos_latitude * cos_path + sin_latitude * sin_path * sin_heading),
        coriolis * (cos_path * sin_latitude - sin_path * cos_latitude * sin_heading)
        + transport * sin_latitude * cos_heading,
    )


def path_rate(s: EntryState, acceleration: Vector3) -> PathRate:
    """How place and velocity change under an acceleration (m/s2, velocity axes)."""
    cos_path = cos(s.flight_path_angle)
    cos_heading = cos(s.heading)
    over = s.speed * cos_path / s.radius
    return PathRate(
        radius=s.speed * sin(s.flight_path_angle),
        longitude=over * cos_heading / cos(s.latitude),
        latitude=over * sin(s.heading),
        speed=acceleration.x,
        flight_path_angle=over + acceleration.y / s.speed,
        heading=-over * cos_heading * tan(s.latitude) - acceleration.z / (s.speed * cos_path),
    )


def velocity_axes_rate(s: EntryState, rate: PathRate, earth_rate: float) -> Vector3:
    """Absolute angular velocity (rad/s) of the velocity axes, in themselves."""
    sin_path = sin(s.flight_path_angle)
    cos_path = cos(s.flight_path_angle)
    sin_heading = sin(s.heading)
    cos_heading = cos(s.heading)
    sin_latitude = sin(s.latitude)
    cos_latitude = cos(s.latitude)
    over = s.speed * cos_path / s.radius
    u = rate.heading + over * cos_heading * tan(s.latitude)
    return vector(
        sin_path * u + earth_rate * (sin_path * sin_latitude + cos_path * cos_latitude * sin_heading),
        cos_path * u + earth_rate * (cos_path * sin_latitude - sin_path * cos_latitude * sin_heading),
        rate.flight_path_angle - over - earth_rate * cos_latitude * cos_heading,
    )


def attitude_rates(attitude: Vector3, n: Vector3) -> Vector3:
    """Rates (rad/s) of bank, sideslip and attack for an angular velocity n (rad/s, body) against the velocity axes."""
    sa = sin(attitude.z)
    ca = cos(attitude.z)
    along = n.x * ca - n.y * sa
    return vector(along / cos(attitude.y), n.x * sa + n.y * ca, n.z - tan(attitude.y) * along)
