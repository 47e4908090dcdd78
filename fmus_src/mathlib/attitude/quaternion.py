"""Unit quaternions, scalar first, that transform body components into reference components. Kernel functions.

The quaternion q is the attitude of a body: v_reference = q v q*, and its rate is q' = q w/2 with the angular velocity w
in body axes (rad/s). q and -q are the same attitude. Factors have Hamilton's order. Source: Wertz 1978, appendix D.
"""

import math

from ...kernel.functions import atan2, cos, sin
from ..vectors import Vector3, Vector4, cross, norm, vector

SHORTEST = 0.5  # least length of a quaternion that counts as an attitude; a tracker without attitude outputs zeros


def quaternion(scalar: float, e: Vector3) -> Vector4:
    """Return the quaternion with this scalar and vector."""
    return vector(scalar, e.x, e.y, e.z)


def multiply(a: Vector4, b: Vector4) -> Vector4:
    """Return Hamilton's product a b, which is the rotation b followed by a."""
    return vector(
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
    )


def conjugate(q: Vector4) -> Vector4:
    """Return the conjugate q*, the inverse rotation of a unit quaternion."""
    return vector(q.w, -q.x, -q.y, -q.z)


def normalise(q: Vector4) -> Vector4:
    """Return q scaled to length 1, or the identity rotation if the length of q is 0 or NaN."""
    largest = 0.0
    for i in range(4):
        size = abs(q[i])
        if size > largest:
            largest = size
    if largest > 0.0 and math.isfinite(largest):
        r = q / largest  # avoids overflow of squares
        return r / math.sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z)
    return vector(1.0, 0.0, 0.0, 0.0)


def is_attitude(q: Vector4) -> bool:
    """Return True if a finite q is at least `SHORTEST` long, so that it defines an attitude after normalisation."""
    for i in range(4):
        if abs(q[i]) >= SHORTEST:
            return True  # avoids overflow of squares
    return q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z >= SHORTEST * SHORTEST


def turn(scalar: float, e: Vector3, v: Vector3) -> Vector3:
    """Return v rotated by the unit quaternion (scalar, e): v + 2 e0 (e x v) + 2 e x (e x v)."""
    twice = 2.0 * cross(e, v)
    return v + scalar * twice + cross(e, twice)


def to_reference(q: Vector4, v: Vector3) -> Vector3:
    """Return q v q*, a vector in body components transformed to the reference frame."""
    return turn(q.w, vector(q.x, q.y, q.z), v)


def to_body(q: Vector4, v: Vector3) -> Vector3:
    """Return q* v q, a vector in reference components transformed to the body frame."""
    return turn(q.w, vector(-q.x, -q.y, -q.z), v)


def from_rotation_vector(rotation: Vector3) -> Vector4:
    """Return the quaternion of a rotation vector, axis times angle (rad)."""
    angle = norm(rotation)
    scale = 0.5
    if angle > 0.0:
        scale = sin(0.5 * angle) / angle
    return quaternion(cos(0.5 * angle), scale * rotation)


def to_rotation_vector(q: Vector4) -> Vector3:
    """Return the rotation vector of q, axis times angle (rad), with an angle of at most pi."""
    sine = norm(q[1:4])
    sign = 1.0
    if q.w < 0.0:
        sign = -1.0
    scale = 2.0 * sign
    if sine > 0.0:
        scale = 2.0 * sign * atan2(sine, sign * q.w) / sine
    return scale * q[1:4]


def difference(reference: Vector4, q: Vector4) -> Vector4:
    """Return reference* q, the rotation from the attitude ``reference`` to q, with a nonnegative scalar."""
    error = multiply(conjugate(reference), q)
    if error.w < 0.0:
        return -error
    return error


def angle_error(reference: Vector4, q: Vector4) -> Vector3:
    """Return the axis times the sine of the angle of the rotation from ``reference`` to q (body).

    With (e0, e) = reference* q the result is 2 e0 e.
    """
    rotation = difference(reference, q)
    return 2.0 * rotation.w * rotation[1:4]


def to_rodrigues(q: Vector4) -> Vector3:
    """Return the modified Rodrigues parameters e tan(angle/4) of the rotation q, with an angle of at most pi."""
    sign = 1.0
    if q.w < 0.0:
        sign = -1.0
    return sign * q[1:4] / (1.0 + sign * q.w)
