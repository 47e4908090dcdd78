"""Attitude relative to the orbital frame, on a circular orbit. Kernel functions.

Orbital frame: y radially up, x along the velocity, z = x x y; its angular velocity is (0, 0, -w0). Angles are (roll,
yaw, pitch), in the order of the axes x, y, z about which they turn; the rotations are performed in the order yaw,
pitch, roll. Angular velocities are relative to the inertial frame, in body axes. Pitch is between -90 and 90 deg.
Equations: docs/systems/orbital_attitude.md.

Source: Lapin, thesis, chapter 1.1.
"""

from ...kernel.functions import cos, sin, tan
from ...kernel.matrices import Matrix, block, cross_matrix, identity, matrix, zeros
from ...kernel.records import Field, Record
from ..vectors import Vector3, cross, vector

# Rows and columns of the vector (angles, angular velocity), and of single angles.
ANGLES = block(0, 3)
RATES = block(3, 3)
ROLL = 0
YAW = 1
PITCH = 2


class AttitudeState(Record):
    """Attitude relative to the orbital frame, and angular velocity."""

    angles = Field(Vector3, unit="rad", description="roll, yaw and pitch of the body relative to the orbital frame")
    angular_velocity = Field(
        Vector3, unit="rad/s", frame="body", description="angular velocity of the body relative to the inertial frame"
    )


def index_of_measured(j: int) -> int:
    """Return the index in (roll, yaw, pitch, rates) of the j-th measured state; all states except yaw are measured."""
    if j == 0:
        return 0
    return j + 1


class AngleFunctions(Record):
    """Sines, cosines and tangents of roll, yaw and pitch."""

    sin_roll = Field(unit="1")
    cos_roll = Field(unit="1")
    sin_yaw = Field(unit="1")
    cos_yaw = Field(unit="1")
    sin_pitch = Field(unit="1")
    cos_pitch = Field(unit="1")
    tan_pitch = Field(unit="1")


def evaluate_angles(angles: Vector3) -> AngleFunctions:
    """Return the sines, cosines and tangents of the angles (rad), which the functions below share."""
    return AngleFunctions(
        sin_roll=sin(angles.x),
        cos_roll=cos(angles.x),
        sin_yaw=sin(angles.y),
        cos_yaw=cos(angles.y),
        sin_pitch=sin(angles.z),
        cos_pitch=cos(angles.z),
        tan_pitch=tan(angles.z),
    )


def radial_direction(a: AngleFunctions) -> Vector3:
    """Return the y axis of the orbital frame, radially up, in body axes."""
    return vector(a.sin_pitch, a.cos_roll * a.cos_pitch, -a.sin_roll * a.cos_pitch)


def angle_rates(a: AngleFunctions, w: Vector3, w0: float) -> Vector3:
    """Return the time derivatives (rad/s) of the angles for an angular velocity w (body) and orbital rate w0
    (rad/s).
    """
    q = w.y * a.cos_roll - w.z * a.sin_roll
    r = w.y * a.sin_roll + w.z * a.cos_roll
    return vector(
        w.x - a.tan_pitch * q - w0 * a.sin_yaw / a.cos_pitch,
        q / a.cos_pitch + w0 * a.sin_yaw * a.tan_pitch,
        r + w0 * a.cos_yaw,
    )


def angle_rate_derivatives(a: AngleFunctions, w: Vector3, w0: float) -> tuple[Matrix, Matrix]:
    """Return the derivatives of angle_rates with respect to the angles and to w, each 3 x 3."""
    q = w.y * a.cos_roll - w.z * a.sin_roll
    r = w.y * a.sin_roll + w.z * a.cos_roll
    square = a.cos_pitch * a.cos_pitch
    by_angles = matrix(
        [a.tan_pitch * r, -w0 * a.cos_yaw / a.cos_pitch, -(q + w0 * a.sin_yaw * a.sin_pitch) / square],
        [-r / a.cos_pitch, w0 * a.cos_yaw * a.tan_pitch, (q * a.sin_pitch + w0 * a.sin_yaw) / square],
        [q, -w0 * a.sin_yaw, 0.0],
    )
    by_rates = matrix(
        [1.0, -a.tan_pitch * a.cos_roll, a.tan_pitch * a.sin_roll],
        [0.0, a.cos_roll / a.cos_pitch, -a.sin_roll / a.cos_pitch],
        [0.0, a.sin_roll, a.cos_roll],
    )
    return by_angles, by_rates


def angular_acceleration(
    a: AngleFunctions, w: Vector3, torque: Vector3, inertia: Matrix, inverse_inertia: Matrix, w0: float
) -> Vector3:
    """Return w' (rad/s2, body) of a rigid body under gravity gradient and a torque (N m, body).

    J w' = 3 w0^2 j x (J j) + (J w) x w + torque, with j radially up and the inertia J (kg m2), which is passed with its
    inverse.
    """
    j = radial_direction(a)
    return inverse_inertia @ (3.0 * w0 * w0 * cross(j, inertia @ j) + cross(inertia @ w, w) + torque)


def gyric_matrix(inertia: Matrix, inverse_inertia: Matrix, v: Vector3) -> Matrix:
    """Return J^-1 ([J v] - [v] J), the derivative of J^-1 ((J w) x w) with respect to w at w = v."""
    return inverse_inertia @ (cross_matrix(inertia @ v) - cross_matrix(v) @ inertia)


def linear_model(inertia: Matrix, inverse_inertia: Matrix, w0: float) -> Matrix:
    """Return the 6 x 6 matrix of the linearised motion of (angles, w - wp) about angles of 0 and wp = (0, 0, -w0)."""
    by_radial = gyric_matrix(inertia, inverse_inertia, vector(0.0, 1.0, 0.0))
    a = zeros(6, 6)
    a[ROLL, YAW] = -w0
    a[YAW, ROLL] = w0
    a[ANGLES, RATES] = identity(3)
    # j changes by (pitch, 0, -roll), and J^-1 (j x (J j)) has the opposite sign of the matrix above
    a[RATES, ROLL] = 3.0 * w0 * w0 * by_radial[:, 2]
    a[RATES, PITCH] = -3.0 * w0 * w0 * by_radial[:, 0]
    a[RATES, RATES] = gyric_matrix(inertia, inverse_inertia, vector(0.0, 0.0, -w0))
    return a
