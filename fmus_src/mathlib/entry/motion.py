"""Motion over a rotating, spherical Earth, and attitude relative to the velocity. Kernel functions.

Velocity axes: x along the velocity, y up in the vertical plane through it, z = x x y. The attitude consists of bank,
sideslip and angle of attack, which are rotations about velocity x and then about body -y and z, as in `body_axes`.
Equations: docs/systems/entry_attitude.md.

Source: Lapin, thesis, chapter 1.2.
"""

from ...kernel.functions import cos, sin, tan
from ...kernel.records import Field, Record
from ..vectors import Vector3, dot, vector


class EntryState(Record):
    """Motion of a capsule over a rotating, spherical Earth."""

    radius = Field(unit="m", frozen=True, description="distance from the Earth's centre")
    longitude = Field(unit="rad", frozen=True, description="longitude of the capsule")
    latitude = Field(unit="rad", frozen=True, description="latitude of the capsule")
    speed = Field(unit="m/s", frozen=True, description="speed relative to the rotating Earth")
    flight_path_angle = Field(unit="rad", frozen=True, description="flight path angle, positive above the horizon")
    heading = Field(
        unit="rad",
        frozen=True,
        description="direction of the velocity, from east, counter-clockwise as seen from above",
    )
    attitude = Field(Vector3, unit="rad", description="bank angle, sideslip angle and angle of attack")
    angular_velocity = Field(
        Vector3, unit="rad/s", frame="body", description="angular velocity of the body relative to the inertial frame"
    )


class BodyAxes(Record):
    """Unit vectors of the body axes in velocity axes."""

    x = Field(Vector3, unit="1")
    y = Field(Vector3, unit="1")
    z = Field(Vector3, unit="1")


class PathRate(Record):
    """Time derivatives of position and velocity."""

    radius = Field(unit="m/s")
    longitude = Field(unit="rad/s")
    latitude = Field(unit="rad/s")
    speed = Field(unit="m/s2")
    flight_path_angle = Field(unit="rad/s")
    heading = Field(unit="rad/s")


class PathFunctions(Record):
    """Sines, cosines and tangents of flight path angle, heading and latitude."""

    sin_path = Field(unit="1")
    cos_path = Field(unit="1")
    sin_heading = Field(unit="1")
    cos_heading = Field(unit="1")
    sin_latitude = Field(unit="1")
    cos_latitude = Field(unit="1")
    tan_latitude = Field(unit="1")


def body_axes(attitude: Vector3) -> BodyAxes:
    """Return the body axes in velocity axes for bank, sideslip and angle of attack (rad)."""
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
    """Return a vector in velocity axes transformed to body axes."""
    return vector(dot(axes.x, v), dot(axes.y, v), dot(axes.z, v))


def evaluate_path(s: EntryState) -> PathFunctions:
    """Return the sines, cosines and tangents of a state's angles, which the functions below share."""
    return PathFunctions(
        sin_path=sin(s.flight_path_angle),
        cos_path=cos(s.flight_path_angle),
        sin_heading=sin(s.heading),
        cos_heading=cos(s.heading),
        sin_latitude=sin(s.latitude),
        cos_latitude=cos(s.latitude),
        tan_latitude=tan(s.latitude),
    )


def earth_forces(s: EntryState, a: PathFunctions, gravitational_parameter: float, earth_rate: float) -> Vector3:
    """Return gravity and the accelerations due to the Earth's rotation (m/s2, velocity axes)."""
    gravity = gravitational_parameter / (s.radius * s.radius)
    coriolis = 2.0 * s.speed * earth_rate
    transport = earth_rate * earth_rate * s.radius * a.cos_latitude
    return vector(
        -gravity * a.sin_path + transport * (a.cos_latitude * a.sin_path - a.sin_latitude * a.cos_path * a.sin_heading),
        -gravity * a.cos_path
        + coriolis * a.cos_latitude * a.cos_heading
        + transport * (a.cos_latitude * a.cos_path + a.sin_latitude * a.sin_path * a.sin_heading),
        coriolis * (a.cos_path * a.sin_latitude - a.sin_path * a.cos_latitude * a.sin_heading)
        + transport * a.sin_latitude * a.cos_heading,
    )


def path_rate(s: EntryState, a: PathFunctions, acceleration: Vector3) -> PathRate:
    """Return the time derivatives of position and velocity under an acceleration (m/s2, velocity axes)."""
    over = s.speed * a.cos_path / s.radius
    return PathRate(
        radius=s.speed * a.sin_path,
        longitude=over * a.cos_heading / a.cos_latitude,
        latitude=over * a.sin_heading,
        speed=acceleration.x,
        flight_path_angle=over + acceleration.y / s.speed,
        heading=-over * a.cos_heading * a.tan_latitude - acceleration.z / (s.speed * a.cos_path),
    )


def velocity_axes_rate(s: EntryState, a: PathFunctions, rate: PathRate, earth_rate: float) -> Vector3:
    """Return the angular velocity (rad/s, velocity axes) of the velocity axes relative to the inertial frame."""
    over = s.speed * a.cos_path / s.radius
    u = rate.heading + over * a.cos_heading * a.tan_latitude
    return vector(
        a.sin_path * u + earth_rate * (a.sin_path * a.sin_latitude + a.cos_path * a.cos_latitude * a.sin_heading),
        a.cos_path * u + earth_rate * (a.cos_path * a.sin_latitude - a.sin_path * a.cos_latitude * a.sin_heading),
        rate.flight_path_angle - over - earth_rate * a.cos_latitude * a.cos_heading,
    )


def attitude_rates(attitude: Vector3, n: Vector3) -> Vector3:
    """Return the time derivatives (rad/s) of bank, sideslip and angle of attack.

    n (rad/s, body) is the angular velocity of the body relative to the velocity axes.
    """
    sa = sin(attitude.z)
    ca = cos(attitude.z)
    along = n.x * ca - n.y * sa
    return vector(along / cos(attitude.y), n.x * sa + n.y * ca, n.z - tan(attitude.y) * along)
