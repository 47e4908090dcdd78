"""Attitude against the orbital frame, on a circular orbit. Kernel functions.

Orbital frame: y radially up, x along the velocity, z = x x y; it turns with (0, 0, -w0). Angles are
(roll, yaw, pitch), numbered as the axes they turn about; the turns are yaw, pitch, roll in this order. Angular
velocities are absolute, in body axes. Pitch within 90 deg. Equations: docs/systems/orbital_attitude.md.
Source: Lapin, thesis, chapter 1.1.
"""

from ...kernel.functions import cos, sin, tan
from ...kernel.matrices import column, multiply, row, set_column, set_element, set_isotropic, set_row
from ...kernel.records import Field, Record
from ..vectors import Vector3, cross, vector

# Rows and columns of (angles, angular velocity) where it is one vector: the first of three, and single angles.
ANGLES = 0
RATES = 3
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


def angle_rate_derivatives(angles: Vector3, w: Vector3, w0: float, by_angles: list, by_rates: list) -> None:
    """by_angles = d(angle_rates)/d(angles), by_rates = d(angle_rates)/dw; 3 x 3 in row order."""
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
    by_angles[0] = tan_pitch * r
    by_angles[1] = -w0 * cos_yaw / cos_pitch
    by_angles[2] = -(q + w0 * sin_yaw * sin_pitch) / square
    by_angles[3] = -r / cos_pitch
    by_angles[4] = w0 * cos_yaw * tan_pitch
    by_angles[5] = (q * sin_pitch + w0 * sin_yaw) / square
    by_angles[6] = q
    by_angles[7] = -w0 * sin_yaw
    by_angles[8] = 0.0
    by_rates[0] = 1.0
    by_rates[1] = -tan_pitch * cos_roll
    by_rates[2] = tan_pitch * sin_roll
    by_rates[3] = 0.0
    by_rates[4] = cos_roll / cos_pitch
    by_rates[5] = -sin_roll / cos_pitch
    by_rates[6] = 0.0
    by_rates[7] = sin_roll
    by_rates[8] = cos_roll


def apply_matrix(a: list, v: Vector3) -> Vector3:
    """The 3 x 3 matrix a, in row order, times v."""
    return vector(
        a[0] * v.x + a[1] * v.y + a[2] * v.z,
        a[3] * v.x + a[4] * v.y + a[5] * v.z,
        a[6] * v.x + a[7] * v.y + a[8] * v.z,
    )


def angular_acceleration(
    angles: Vector3, w: Vector3, torque: Vector3, inertia: list, inverse_inertia: list, w0: float
) -> Vector3:
    """w' (rad/s2, body) of a rigid body under the gravity gradient and a torque (N m, body).

    J w' = 3 w0^2 j x (J j) + (J w) x w + torque, j radially up; inertia J (kg m2) and its inverse by rows.
    """
    j = radial_direction(angles)
    gravity_gradient = 3.0 * w0 * w0 * cross(j, apply_matrix(inertia, j))
    return apply_matrix(inverse_inertia, gravity_gradient + cross(apply_matrix(inertia, w), w) + torque)


def cross_matrix(v: Vector3, a: list) -> None:
    """a = the 3 x 3 matrix of u -> v x u, in row order."""
    a[0] = 0.0
    a[1] = -v.z
    a[2] = v.y
    a[3] = v.z
    a[4] = 0.0
    a[5] = -v.x
    a[6] = -v.y
    a[7] = v.x
    a[8] = 0.0


def gyric_matrix(inertia: list, inverse_inertia: list, v: Vector3, a: list) -> None:
    """a = J^-1 ([J v] - [v] J) by rows: the derivative of J^-1 ((J w) x w) by w at w = v."""
    of_momentum = [0.0] * 9
    of_rate = [0.0] * 9
    turned = [0.0] * 9
    cross_matrix(apply_matrix(inertia, v), of_momentum)
    cross_matrix(v, of_rate)
    multiply(of_rate, inertia, turned, 3)
    for i in range(9):
        of_momentum[i] = of_momentum[i] - turned[i]
    multiply(inverse_inertia, of_momentum, a, 3)


def linear_model(inertia: list, inverse_inertia: list, w0: float, a: list) -> None:
    """a = the 6 x 6 matrix, by rows, of (angles, w - wp)' about the wanted state: angles 0, wp = (0, 0, -w0)."""
    by_rates = [0.0] * 9
    by_radial = [0.0] * 9
    gyric_matrix(inertia, inverse_inertia, vector(0.0, 0.0, -w0), by_rates)
    gyric_matrix(inertia, inverse_inertia, vector(0.0, 1.0, 0.0), by_radial)
    for i in range(36):
        a[i] = 0.0
    set_element(a, 6, ROLL, YAW, -w0)
    set_element(a, 6, YAW, ROLL, w0)
    set_isotropic(a, 6, ANGLES, RATES, 1.0)
    # j moves by (pitch, 0, -roll), and J^-1 (j x (J j)) is minus the above
    set_column(a, 6, RATES, ROLL, 3.0 * w0 * w0 * column(by_radial, 3, 0, 2))
    set_column(a, 6, RATES, PITCH, -3.0 * w0 * w0 * column(by_radial, 3, 0, 0))
    for i in range(3):
        set_row(a, 6, RATES + i, RATES, row(by_rates, 3, i, 0))
