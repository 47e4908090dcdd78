"""Four reaction wheels: their axes, their friction, and how a torque is shared among them. Kernel functions.

The spin axes g are the columns of a 3 x 4 matrix A, unit vectors in body axes. Motors that turn the wheels by torques
u (N m) turn the body by -A u. One direction of u does not turn it: the null direction n, A n = 0.
Source: Markley, Reynolds, Liu and Lebsock 2010 (minimax); Schaub and Junkins 2018, section 8.
"""

import math

from ...kernel.matrices import Matrix, inverse, zeros
from ..vectors import Vector3, Vector4, clip, cross, dot, norm, vector

WHEELS = 4
SMALLEST_VOLUME = 1e-9  # of three unit axes: below it they count as lying in a plane


def unit_axes(rows: Matrix) -> Matrix:
    """Return A (3 x 4) from axes by row (4 x 3), of any length; one of length 0 is a column of zeros."""
    a = zeros(3, WHEELS)
    for j in range(WHEELS):
        length = norm(rows[j, 0:3])
        if length > 0.0:
            a[0:3, j] = rows[j, 0:3] / length
    return a


def largest_size(v: Vector4) -> float:
    """Return the largest size of an element."""
    largest = 0.0
    for j in range(WHEELS):
        if abs(v[j]) > largest:
            largest = abs(v[j])
    return largest


def drag_torque(speed: float, viscous: float, coulomb: float, band: float) -> float:
    """Return friction (N m) against the speed (rad/s) of a wheel: viscous, and Coulomb's, in
    proportion within the band."""
    return -viscous * speed - coulomb * clip(speed / band, -1.0, 1.0)


def null_direction(a: Matrix) -> Vector4:
    """Return the unit vector n with A n = 0, its first element not negative.

    Of length 0 where all axes lie in a plane, or where one column is 0.
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
            length = 0.0  # the wheel's axis itself is null then, and is not used
    if length > SMALLEST_VOLUME:
        if n.w < 0.0:
            return -n / length
        return n / length
    return vector(0.0, 0.0, 0.0, 0.0)


def pseudo_inverse(a: Matrix) -> tuple[Matrix, bool]:
    """Return A' (A A')^-1 (4 x 3), and whether there is one."""
    gram = a @ a.T
    determinant = dot(gram[0:3, 0], cross(gram[0:3, 1], gram[0:3, 2]))
    inverted, invertible = inverse(gram)
    return a.T @ inverted, invertible and determinant > SMALLEST_VOLUME


def minimax_shift(u: Vector4, n: Vector4) -> float:
    """Return the s for which the largest size of u + s n is smallest.

    The largest size is a convex function of s, made of straight lines: it is smallest where two of them meet, one that
    falls and one that rises, so that all such s are tried.
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
    """Return torque (N m, body) on the body of motors that turn the wheels by torques u."""
    return -(a @ u)
