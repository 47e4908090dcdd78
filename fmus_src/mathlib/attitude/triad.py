"""Attitude from three axes or two directions. Kernel functions."""

from ...kernel.records import Field, Record
from ..vectors import Vector3, Vector4, cross, norm, vector
from .quaternion import conjugate, multiply, normalise, quaternion


class AxesAttitude(Record):
    """Attitude determined by two directions, and a flag that it exists."""

    quaternion = Field(Vector4, unit="1", description="attitude quaternion from body to inertial, scalar first")
    exists = Field(bool, description="true: directions far enough from parallel in both frames")


def from_axes(x: Vector3, y: Vector3, z: Vector3) -> Vector4:
    """Return the quaternion that transforms the right-handed triad of unit vectors into x, y and z.

    Its scalar is not negative. Source: Shepperd 1978, the largest component first.
    """
    trace = x.x + y.y + z.z
    if trace >= x.x and trace >= y.y and trace >= z.z:
        q = quaternion(1.0 + trace, vector(y.z - z.y, z.x - x.z, x.y - y.x))
    elif x.x >= y.y and x.x >= z.z:
        q = quaternion(y.z - z.y, vector(1.0 + 2.0 * x.x - trace, x.y + y.x, x.z + z.x))
    elif y.y >= z.z:
        q = quaternion(z.x - x.z, vector(x.y + y.x, 1.0 + 2.0 * y.y - trace, y.z + z.y))
    else:
        q = quaternion(x.y - y.x, vector(x.z + z.x, y.z + z.y, 1.0 + 2.0 * z.z - trace))
    if q.w < 0.0:
        q = -q
    return normalise(q)


def from_pair(first: Vector3, second: Vector3) -> Vector4:
    """Return the attitude with x along the first vector and z along first x second, which must not be parallel."""
    x = first / norm(first)
    across = cross(first, second)
    z = across / norm(across)
    return from_axes(x, cross(z, x), z)


def parallel(a: Vector3, b: Vector3, sine: float) -> bool:
    """Return True if the sine of the angle between two vectors is at most ``sine``, or if one vector is 0."""
    return not norm(cross(a, b)) > sine * norm(a) * norm(b)


def triad(body_first: Vector3, body_second: Vector3, first: Vector3, second: Vector3, sine: float) -> AxesAttitude:
    """Return the attitude that aligns the first direction exactly and the second within their plane.

    Each direction, of any length, is passed in body axes and in inertial axes; ``sine`` is the sine of the smallest
    angle allowed between the two directions. Source: Black 1964; Markley and Crassidis 2014, section 5.1.
    """
    if parallel(body_first, body_second, sine) or parallel(first, second, sine):
        return AxesAttitude(quaternion=vector(1.0, 0.0, 0.0, 0.0), exists=False)
    q = multiply(from_pair(first, second), conjugate(from_pair(body_first, body_second)))
    if q.w < 0.0:
        q = -q
    return AxesAttitude(quaternion=normalise(q), exists=True)
