"""Torque of a central gravity field on a rigid body. Kernel functions."""

from ...kernel.matrices import Matrix
from ..vectors import Vector3, cross, dot, norm


def gravity_gradient_torque(position: Vector3, inertia: Matrix, mu: float) -> Vector3:
    """Return the torque 3 mu/r^3 u x (I u) (N m, body) at a position r u (m, body) relative to the planet's centre.

    ``mu`` is the gravitational parameter (m3/s2), ``inertia`` (kg m2) the inertia matrix about the centre of mass.
    Source: Wie 1998, section 6.10.
    """
    square = dot(position, position)
    distance = norm(position)
    u = position / distance
    return 3.0 * mu / (square * distance) * cross(u, inertia @ u)
