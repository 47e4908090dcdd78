"""Inertial navigation under central gravity, and how its errors grow. Kernel functions.

Frame: landing site (z up); the Moon's centre is ``radius`` below the origin.
"""

from ..lunar.gravity import central_gravity, gravity_difference
from ..vectors import Vector3, vector


def dead_reckon(
    position: Vector3, velocity: Vector3, force: Vector3, before: Vector3, radius: float, mu: float, h: float
) -> tuple[Vector3, Vector3]:
    """Position and velocity h (s) later, from the mean specific forces of this step and of the one before.

    Gravity by the trapezoidal rule. The specific force is taken as linear in time, with the slope
    between the two means: as constant in each step it would put the position wrong by h^2/12 times
    its change since the start, which is 7 mm over a landing with steps of 0.1 s.
    """
    here = central_gravity(position, radius, mu)
    ahead = central_gravity(position + h * velocity, radius, mu)
    gained = h * (force + 0.5 * (here + ahead))
    return position + h * (velocity + 0.5 * gained - h * (force - before) / 12.0), velocity + gained


def sensor_addition(errors: list, f: Vector3) -> Vector3:
    """b + diag(k) f + w x f, with bias b (m/s2), scale factors k and rotation w (rad) in errors (9)."""
    return vector(
        errors[0] + errors[3] * f.x + errors[7] * f.z - errors[8] * f.y,
        errors[1] + errors[4] * f.y + errors[8] * f.x - errors[6] * f.z,
        errors[2] + errors[5] * f.z + errors[6] * f.y - errors[7] * f.x,
    )


def predict_errors(
    p: list, f: Vector3, sensing: bool, walk: float, drift: float, up: Vector3, gradient: float, h: float
) -> None:
    """Covariance p (15 x 15, row order) of inertial navigation h (s) ahead under the specific force f (m/s2).

    States: position, velocity, and what the inertial sensor adds to the specific force: bias b,
    scale factors k and a small rotation w, b + diag(k) f + w x f, constant but for a random walk of b of density
    ``drift`` (m2/s5). Velocity increments have white errors of density ``walk`` (m2/s3) besides. Where ``sensing`` is
    false no specific force is measured, and none of these errors acts. A ``gradient`` of gravity (1/s2, along the unit
    vector ``up``) adds gradient (3 up up' - 1) times the position error half a step on to the acceleration, which is
    what it does to dead reckoning by the trapezoidal rule; 0 leaves it out.

    p = m p m' + q, done on the blocks that change: with a the error of the acceleration with its sign turned,
    b + diag(k) f + w x f less what gravity differs by, position moves by h velocity - h^2/2 a and velocity by -h a.
    """
    a = [0.0] * 45  # covariance of a with every state, 3 x 15
    half = 0.5 * h
    for j in range(15):
        if sensing:
            a[j] = p[15 * 6 + j] + f.x * p[15 * 9 + j] + f.z * p[15 * 13 + j] - f.y * p[15 * 14 + j]
            a[15 + j] = p[15 * 7 + j] + f.y * p[15 * 10 + j] + f.x * p[15 * 14 + j] - f.z * p[15 * 12 + j]
            a[30 + j] = p[15 * 8 + j] + f.z * p[15 * 11 + j] + f.y * p[15 * 12 + j] - f.x * p[15 * 13 + j]
        if gradient > 0.0:
            ahead = vector(p[j] + half * p[45 + j], p[15 + j] + half * p[60 + j], p[30 + j] + half * p[75 + j])
            pull = gravity_difference(ahead, up, gradient)
            a[j] = a[j] - pull.x
            a[15 + j] = a[15 + j] - pull.y
            a[30 + j] = a[30 + j] - pull.z
    for i in range(3):
        for j in range(15):
            p[15 * i + j] = p[15 * i + j] + h * (p[15 * (3 + i) + j] - half * a[15 * i + j])
            p[15 * (3 + i) + j] = p[15 * (3 + i) + j] - h * a[15 * i + j]
    for i in range(6):
        r = 15 * i
        error = vector(0.0, 0.0, 0.0)
        if sensing:
            error = vector(
                p[r + 6] + f.x * p[r + 9] + f.z * p[r + 13] - f.y * p[r + 14],
                p[r + 7] + f.y * p[r + 10] + f.x * p[r + 14] - f.z * p[r + 12],
                p[r + 8] + f.z * p[r + 11] + f.y * p[r + 12] - f.x * p[r + 13],
            )
        if gradient > 0.0:
            ahead = vector(p[r] + half * p[r + 3], p[r + 1] + half * p[r + 4], p[r + 2] + half * p[r + 5])
            error = error - gravity_difference(ahead, up, gradient)
        for j in range(3):
            p[r + j] = p[r + j] + h * (p[r + 3 + j] - half * error[j])
            p[r + 3 + j] = p[r + 3 + j] - h * error[j]
    for i in range(3):
        if sensing:
            # an increment's error moves position by half a step times itself
            p[16 * i] = p[16 * i] + walk * h * half * half
            p[16 * i + 3] = p[16 * i + 3] + walk * h * half
            p[15 * (3 + i) + i] = p[15 * (3 + i) + i] + walk * h * half
            p[16 * (3 + i)] = p[16 * (3 + i)] + walk * h
        p[16 * (6 + i)] = p[16 * (6 + i)] + drift * h
    for i in range(6):
        for j in range(i + 1, 15):
            p[15 * j + i] = p[15 * i + j]
