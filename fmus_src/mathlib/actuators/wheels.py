"""Four reaction wheels: spin axes, friction, and allocation of a torque. Kernel functions.

The spin axes g are the columns of a 3 x 4 matrix A, unit vectors in body axes. Motor torques u (N m) on the wheels
exert the torque -A u on the body. Motor torques along the null direction n, with A n = 0, exert no torque on the body.

Source: Markley, Reynolds, Liu and Lebsock 2010 (minimax); Schaub and Junkins 2018, section 8.
"""

import math

from ...kernel.matrices import Matrix, inverse, zeros
from ..vectors import Vector3, Vector4, clip, cross, dot, norm, vector

WHEELS = 4
SMALLEST_VOLUME = 1e-9  # volume spanned by three unit axes, below which they count as coplanar


def unit_axes(rows: Matrix) -> Matrix:
    """Return the unit axes as the columns of A (3 x 4) from axes of any length in the rows of a 4 x 3 matrix.

    An axis of length 0 gives a column of zeros.
    """
    a = zeros(3, WHEELS)
    for j in range(WHEELS):
        length = norm(rows[j, 0:3])
        if length > 0.0:
            a[0:3, j] = rows[j, 0:3] / length
    return a


def largest_size(v: Vector4) -> float:
    """Return the largest magnitude of the elements."""
    largest = 0.0
    for j in range(WHEELS):
        if abs(v[j]) > largest:
            largest = abs(v[j])
    return largest


def drag_torque(speed: float, viscous: float, coulomb: float, band: float) -> float:
    """Return the friction torque (N m) against a wheel's speed (rad/s): viscous plus Coulomb friction.

    Below the speed ``band``, Coulomb friction is proportional to speed.
    """
    return -viscous * speed - coulomb * clip(speed / band, -1.0, 1.0)


def null_direction(a: Matrix) -> Vector4:
    """Return the unit vector n with A n = 0 and a nonnegative first element.

    The vector is 0 if all axes lie in a plane or one column is 0.
    """
    first = a[0:3, 0]
    second = a[0:3, 1]
    third = a[0:3, 2]
    fourth = a[0:3, 3]
    n = vector(
        -dot(second, cross(third, fourth)),
        dot(first, cross(third, fourth)),
        -dot(first, cross(second, fourth)),
        dot(first, cross(second, third)),
    )
    length = math.sqrt(n.w * n.w + n.x * n.x + n.y * n.y + n.z * n.z)
    for j in range(WHEELS):
        if norm(a[0:3, j]) == 0.0:
            length = 0.0  # wheel j alone is then the null direction, and shifts have no effect
    if length > SMALLEST_VOLUME:
        if n.w < 0.0:
            return -n / length
        return n / length
    return vector(0.0, 0.0, 0.0, 0.0)


def pseudo_inverse(a: Matrix) -> tuple[Matrix, bool]:
    """Return (A' (A A')^-1, True), with a 4 x 3 matrix, or False as the second value if no pseudo-inverse exists."""
    gram = a @ a.T
    determinant = dot(gram[0:3, 0], cross(gram[0:3, 1], gram[0:3, 2]))
    inverted, invertible = inverse(gram)
    return a.T @ inverted, invertible and determinant > SMALLEST_VOLUME


def minimax_shift(u: Vector4, n: Vector4) -> float:
    """Return the s for which the largest magnitude of u + s n is smallest.

    The largest magnitude is a convex, piecewise linear function of s. Its minimum lies at the intersection of a falling
    and a rising line, so all such intersections are evaluated.
    """
    shift = 0.0
    smallest = largest_size(u)
    for i in range(WHEELS):
        for j in range(i):
            for k in range(2):
                sign = float(2 * k - 1)
                slope = n[i] - sign * n[j]
                if abs(slope) > SMALLEST_VOLUME:
                    s = (sign * u[j] - u[i]) / slope
                    largest = largest_size(u + s * n)
                    if largest < smallest:
                        smallest = largest
                        shift = s
    return shift


def body_torque(a: Matrix, u: Vector4) -> Vector3:
    """Return the torque (N m, body) that motor torques u (N m) on the wheels exert on the body."""
    return -(a @ u)
