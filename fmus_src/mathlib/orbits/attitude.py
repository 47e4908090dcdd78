"""Attitude against the orbital frame, on a circular orbit. Kernel functions.

Orbital frame: y radially up, x along the velocity, z = x x y; it turns with (0, 0, -w0). Angles are
(roll, yaw, pitch), numbered as the axes they turn about; the turns are yaw, pitch, roll in this order. Angular
velocities are absolute, in body axes. Pitch within 90 deg. Equations: docs/systems/orbital_attitude.md.
Source: Lapin, thesis, chapter 1.1.
"""

from ...kernel.functions import cos, sin, tan
from ...kernel.matrices import Matrix, block, identity, matrix, zeros
from ...kernel.records import Field, Record
from ..vectors import Vector3, cross, vector

# Rows and columns of (angles, angular velocity) where it is one vector, and of single angles.
ANGLES = block(0, 3)
RATES = block(3, 3)
ROLL = 0
YAW = 1
PITCH = 2


class AttitudeState(Record):
    """Attitude against the orbital frame, and angular velocity."""

    angles = Field(Vector3, unit="rad", description="roll, yaw, pitch")
    angular_velocity = Field(Vector3, unit="rad/s", frame="body", description="absolute")


def index_of_measured(j: int) -> int:
    """Which of (roll, yaw, pitch, rates) is the j-th that is measured: all but yaw."""
    if j == 0:
        return 0
    return j + 1


def radial_direction(angles: Vector3) -> Vector3:
    """The orbital frame's y axis, radially up, in body axes; angles in rad."""
    cos_pitch = cos(angles.z)
    return vector(sin(angles.z), cos(angles.x) * cos_pitch, -sin(angles.x) * cos_pitch)


def angle_rates(angles: Vector3, w: Vector3, w0: float) -> Vector3:
    """Rates (rad/s) of angles (rad) at the angular velocity w (rad/s, body) and the orbital rate w0 (rad/s)."""
    sin_roll = sin(angles.x)
    cos_roll = cos(angles.x)
    sin_yaw = sin(angles.y)
    cos_pitch = cos(angles.z)
    tan_pitch = tan(angles.z)
    q = w.y * cos_roll - w.z * sin_roll
    r = w.y * sin_roll + w.z * cos_roll
    return vector(
        w.x - tan_pitch * q - w0 * sin_yaw / cos_pitch,
        q / cos_pitch + w0 * sin_yaw * tan_pitch,
        r + w0 * cos(angles.y),
    )


def angle_rate_derivatives(angles: Vector3, w: Vector3, w0: float) -> tuple[Matrix, Matrix]:
    """Derivatives of angle_rates by the angles and by w, 3 x 3."""
    sin_roll = sin(angles.x)
    cos_roll = cos(angles.x)
    sin_yaw = sin(angles.y)
    cos_yaw = cos(angles.y)
    sin_pitch = sin(angles.z)
    cos_pitch = cos(angles.z)
    tan_pitch = tan(angles.z)
    q = w.y * cos_roll - w.z * sin_roll
    r = w.y * sin_roll + w.z * cos_roll
    square = cos_pitch * cos_pitch
    by_angles = matrix(
        [tan_pitch * r, -w0 * cos_yaw / cos_pitch, -(q + w0 * sin_yaw * sin_pitch) / square],
        [-r / cos_pitch, w0 * cos_yaw * tan_pitch, (q * sin_pitch + w0 * sin_yaw) / square],
        [q, -w0 * sin_yaw, 0.0],
    )
    by_rates = matrix(
        [1.0, -tan_pitch * cos_roll, tan_pitch * sin_roll],
        [0.0, cos_roll / cos_pitch, -sin_roll / cos_pitch],
        [0.0, sin_roll, cos_roll],
    )
    return by_angles, by_rates


def angular_acceleration(
    angles: Vector3, w: Vector3, torque: Vector3, inertia: Matrix, inverse_inertia: Matrix, w0: float
) -> Vector3:
    """w' (rad/s2, body) of a rigid body under the gravity gradient and a torque (N m, body).

    J w' = 3 w0^2 j x (J j) + (J w) x w + torque, j radially up; inertia J (kg m2) and its inverse.
    """
    j = radial_direction(angles)
    return inverse_inertia @ (3.0 * w0 * w0 * cross(j, inertia @ j) + cross(inertia @ w, w) + torque)


def cross_matrix(v: Vector3) -> Matrix:
    """The 3 x 3 matrix of u -> v x u."""
    return matrix([0.0, -v.z, v.y], [v.z, 0.0, -v.x], [-v.y, v.x, 0.0])


def gyric_matrix(inertia: Matrix, inverse_inertia: Matrix, v: Vector3) -> Matrix:
    """J^-1 ([J v] - [v] J): the derivative of J^-1 ((J w) x w) by w at w = v."""
    return inverse_inertia @ (cross_matrix(inertia @ v) - cross_matrix(v) @ inertia)


def linear_model(inertia: Matrix, inverse_inertia: Matrix, w0: float) -> Matrix:
    """The 6 x 6 matrix of (angles, w - wp)' about the wanted state: angles 0, wp = (0, 0, -w0)."""
    by_radial = gyric_matrix(inertia, inverse_inertia, vector(0.0, 1.0, 0.0))
    a = zeros(6, 6)
    a[ROLL, YAW] = -w0
    a[YAW, ROLL] = w0
    a[ANGLES, RATES] = identity(3)
    # j moves by (pitch, 0, -roll), and J^-1 (j x (J j)) is minus the above
    a[RATES, ROLL] = 3.0 * w0 * w0 * by_radial[:, 2]
    a[RATES, PITCH] = -3.0 * w0 * w0 * by_radial[:, 0]
    a[RATES, RATES] = gyric_matrix(inertia, inverse_inertia, vector(0.0, 0.0, -w0))
    return a
