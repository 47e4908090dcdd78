"""Flight over a turning, spherical Earth, and attitude against the velocity. Kernel functions.

place: distance r from the centre (m), longitude, latitude (rad). path: speed over the Earth (m/s), path angle up,
course from east, counter-clockwise from above (rad). Velocity axes: x along the velocity, y up in the vertical plane
through it, z = x x y. attitude: bank, sideslip, attack (rad), turns about velocity x, then body -y and z as written in
`body_axes`. Equations: docs/systems/entry_attitude.md. Source: Lapin, thesis, chapter 1.2.
"""

from ..kernel.functions import cos, sin, tan
from .vectors import Vector3, vector


def body_axes(attitude: Vector3) -> tuple[Vector3, Vector3, Vector3]:
    """The body's axes x, y, z in velocity axes."""
    sg = sin(attitude.x)
    cg = cos(attitude.x)
    sb = sin(attitude.y)
    cb = cos(attitude.y)
    sa = sin(attitude.z)
    ca = cos(attitude.z)
    x = vector(ca * cb, sa * cg + ca * sb * sg, sa * sg - ca * sb * cg)
    y = vector(-sa * cb, ca * cg - sa * sb * sg, ca * sg + sa * sb * cg)
    return x, y, vector(sb, -cb * sg, cb * cg)


def earth_forces(place: Vector3, path: Vector3, gravitational_parameter: float, earth_rate: float) -> Vector3:
    """Gravity and what the Earth's turn adds to it (m/s2, velocity axes)."""
    sin_path = sin(path.y)
    cos_path = cos(path.y)
    sin_course = sin(path.z)
    cos_course = cos(path.z)
    sin_latitude = sin(place.z)
    cos_latitude = cos(place.z)
    gravity = gravitational_parameter / (place.x * place.x)
    coriolis = 2.0 * path.x * earth_rate
    transport = earth_rate * earth_rate * place.x * cos_latitude
    return vector(
        -gravity * sin_path + transport * (cos_latitude * sin_path - sin_latitude * cos_path * sin_course),
        -gravity * cos_path
        + coriolis * cos_latitude * cos_course
        + transport * (cos_latitude * cos_path + sin_latitude * sin_path * sin_course),
        coriolis * (cos_path * sin_latitude - sin_path * cos_latitude * sin_course)
        + transport * sin_latitude * cos_course,
    )


def path_rates(place: Vector3, path: Vector3, push: Vector3) -> tuple[Vector3, Vector3]:
    """Rates of place and path under an acceleration (m/s2, velocity axes)."""
    cos_path = cos(path.y)
    cos_course = cos(path.z)
    over = path.x * cos_path / place.x
    moved = vector(path.x * sin(path.y), over * cos_course / cos(place.z), over * sin(path.z))
    turned = vector(
        push.x,
        over + push.y / path.x,
        -over * cos_course * tan(place.z) - push.z / (path.x * cos_path),
    )
    return moved, turned


def velocity_axes_rate(place: Vector3, path: Vector3, turned: Vector3, earth_rate: float) -> Vector3:
    """Absolute angular velocity (rad/s) of the velocity axes, in themselves, at the rates ``turned`` of the path."""
    sin_path = sin(path.y)
    cos_path = cos(path.y)
    sin_course = sin(path.z)
    cos_course = cos(path.z)
    sin_latitude = sin(place.z)
    cos_latitude = cos(place.z)
    over = path.x * cos_path / place.x
    u = turned.z + over * cos_course * tan(place.z)
    return vector(
        sin_path * u + earth_rate * (sin_path * sin_latitude + cos_path * cos_latitude * sin_course),
        cos_path * u + earth_rate * (cos_path * sin_latitude - sin_path * cos_latitude * sin_course),
        turned.y - over - earth_rate * cos_latitude * cos_course,
    )


def attitude_rates(attitude: Vector3, n: Vector3) -> Vector3:
    """Rates of bank, sideslip and attack for an angular velocity n (rad/s, body) against the velocity axes."""
    sa = sin(attitude.z)
    ca = cos(attitude.z)
    along = n.x * ca - n.y * sa
    return vector(along / cos(attitude.y), n.x * sa + n.y * ca, n.z - tan(attitude.y) * along)
