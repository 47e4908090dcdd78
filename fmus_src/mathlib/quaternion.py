"""Unit quaternions, scalar first, that turn body components into reference components. Kernel functions.

A quaternion q is the attitude of a body: v_reference = q v q*, and its rate is q' = q w/2 with the
angular velocity w in body axes (rad/s). q and -q are one attitude. A result may be the same list as
an argument. Source: Wertz 1978, appendix D; the order of factors is that of Hamilton.
"""

import math

from .vectors import norm


def copy4(target: list, source: list) -> None:
    """target = source, element by element."""
    for i in range(4):
        target[i] = source[i]


def multiply(a: list, b: list, product: list) -> None:
    """product = a b: first the rotation b, then a (Hamilton's product)."""
    w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]
    x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2]
    y = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1]
    z = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]
    product[0] = w
    product[1] = x
    product[2] = y
    product[3] = z


def conjugate(q: list, result: list) -> None:
    """result = q*, the inverse rotation of a unit quaternion."""
    result[0] = q[0]
    for i in range(1, 4):
        result[i] = -q[i]


def normalise(q: list) -> None:
    """Bring q to length one, in place; no rotation where its length is 0 or no number."""
    largest = 0.0
    for i in range(4):
        if abs(q[i]) > largest:
            largest = abs(q[i])
    if largest > 0.0 and math.isfinite(largest):
        square = 0.0
        for i in range(4):
            q[i] = q[i] / largest  # so that no square overflows
            square = square + q[i] * q[i]
        length = math.sqrt(square)
        for i in range(4):
            q[i] = q[i] / length
    else:
        q[0] = 1.0
        for i in range(1, 4):
            q[i] = 0.0


def turn(scalar: float, x: float, y: float, z: float, v: list, result: list) -> None:
    """result = v turned by the unit quaternion (scalar, x, y, z): v + 2 e0 (e x v) + 2 e x (e x v)."""
    a = 2.0 * (y * v[2] - z * v[1])
    b = 2.0 * (z * v[0] - x * v[2])
    c = 2.0 * (x * v[1] - y * v[0])
    first = v[0] + scalar * a + (y * c - z * b)
    second = v[1] + scalar * b + (z * a - x * c)
    third = v[2] + scalar * c + (x * b - y * a)
    result[0] = first
    result[1] = second
    result[2] = third


def to_reference(q: list, v: list, result: list) -> None:
    """result = q v q*: a vector in body components, expressed in the reference frame."""
    turn(q[0], q[1], q[2], q[3], v, result)


def to_body(q: list, v: list, result: list) -> None:
    """result = q* v q: a vector in reference components, expressed in the body frame."""
    turn(q[0], -q[1], -q[2], -q[3], v, result)


def from_rotation_vector(rotation: list, q: list) -> None:
    """q = the rotation about ``rotation`` by its length (rad)."""
    angle = norm(rotation)
    scale = 0.5
    if angle > 0.0:
        scale = math.sin(0.5 * angle) / angle
    q[0] = math.cos(0.5 * angle)
    for i in range(3):
        q[i + 1] = scale * rotation[i]


def to_rotation_vector(q: list, rotation: list) -> None:
    """rotation = axis times angle (rad) of q, the shorter way round: no longer than pi."""
    sine = math.sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    sign = 1.0
    if q[0] < 0.0:
        sign = -1.0
    scale = 2.0 * sign
    if sine > 0.0:
        scale = 2.0 * sign * math.atan2(sine, sign * q[0]) / sine
    for i in range(3):
        rotation[i] = scale * q[i + 1]


def difference(reference: list, q: list, error: list) -> None:
    """error = reference* q: the rotation from the attitude ``reference`` to q, scalar not negative."""
    inverse = [0.0] * 4
    conjugate(reference, inverse)
    multiply(inverse, q, error)
    if error[0] < 0.0:
        for i in range(4):
            error[i] = -error[i]


def angle_error(reference: list, q: list, error: list) -> None:
    """error = 2 e0 e of (e0, e) = reference* q (rad, body): the axis times the sine of the angle."""
    rotation = [0.0] * 4
    difference(reference, q, rotation)
    for i in range(3):
        error[i] = 2.0 * rotation[0] * rotation[i + 1]


def to_rodrigues(q: list, sigma: list) -> None:
    """sigma = e tan(angle/4): modified Rodrigues parameters, the shorter way round."""
    sign = 1.0
    if q[0] < 0.0:
        sign = -1.0
    for i in range(3):
        sigma[i] = sign * q[i + 1] / (1.0 + sign * q[0])
