"""Inertial navigation under central gravity, and how its errors grow. Kernel functions.

Frame: landing site (z up); the Moon's centre is ``radius`` below the origin.
"""

from .gravity import central_gravity


def dead_reckon(position: list, velocity: list, force: list, before: list, radius: float, mu: float, h: float) -> None:
    """Move position and velocity by h (s) with the mean specific forces of this step and of the one before.

    Gravity by the trapezoidal rule. The specific force is taken as linear in time, with the slope
    between the two means: as constant in each step it would put the position wrong by h^2/12 times
    its change since the start, which is 7 mm over a landing with steps of 0.1 s.
    """
    g = [0.0] * 3
    ahead = [0.0] * 3
    g_ahead = [0.0] * 3
    central_gravity(position, radius, mu, g)
    for i in range(3):
        ahead[i] = position[i] + h * velocity[i]
    central_gravity(ahead, radius, mu, g_ahead)
    for i in range(3):
        gained = h * (force[i] + 0.5 * (g[i] + g_ahead[i]))
        position[i] = position[i] + h * (velocity[i] + 0.5 * gained - h * (force[i] - before[i]) / 12.0)
        velocity[i] = velocity[i] + gained


def sensor_addition(errors: list, f: list, added: list) -> None:
    """added = b + diag(k) f + w x f, with bias b (m/s2), scale factors k and rotation w (rad) in errors (9)."""
    added[0] = errors[0] + errors[3] * f[0] + errors[7] * f[2] - errors[8] * f[1]
    added[1] = errors[1] + errors[4] * f[1] + errors[8] * f[0] - errors[6] * f[2]
    added[2] = errors[2] + errors[5] * f[2] + errors[6] * f[1] - errors[7] * f[0]


def predict_errors(p: list, f: list, walk: float, drift: float, h: float) -> None:
    """Covariance p (15 x 15, row order) of inertial navigation h (s) ahead under the specific force f (m/s2).

    States: position, velocity, and what the inertial sensor adds to the specific force: bias b,
    scale factors k and a small rotation w, b + diag(k) f + w x f, constant but for a random walk of b of density
    ``drift`` (m2/s5). Velocity increments have white errors of density ``walk`` (m2/s3) besides. The gradient of
    gravity is left out.

    p = m p m' + q, done on the blocks that change: with a = b + diag(k) f + w x f, the error of
    the acceleration, position moves by h velocity - h^2/2 a and velocity by -h a.
    """
    a = [0.0] * 45  # covariance of a with every state, 3 x 15
    half = 0.5 * h
    for j in range(15):
        a[j] = p[15 * 6 + j] + f[0] * p[15 * 9 + j] + f[2] * p[15 * 13 + j] - f[1] * p[15 * 14 + j]
        a[15 + j] = p[15 * 7 + j] + f[1] * p[15 * 10 + j] + f[0] * p[15 * 14 + j] - f[2] * p[15 * 12 + j]
        a[30 + j] = p[15 * 8 + j] + f[2] * p[15 * 11 + j] + f[1] * p[15 * 12 + j] - f[0] * p[15 * 13 + j]
    for i in range(3):
        for j in range(15):
            p[15 * i + j] = p[15 * i + j] + h * (p[15 * (3 + i) + j] - half * a[15 * i + j])
            p[15 * (3 + i) + j] = p[15 * (3 + i) + j] - h * a[15 * i + j]
    for i in range(6):
        r = 15 * i
        a[0] = p[r + 6] + f[0] * p[r + 9] + f[2] * p[r + 13] - f[1] * p[r + 14]
        a[1] = p[r + 7] + f[1] * p[r + 10] + f[0] * p[r + 14] - f[2] * p[r + 12]
        a[2] = p[r + 8] + f[2] * p[r + 11] + f[1] * p[r + 12] - f[0] * p[r + 13]
        for j in range(3):
            p[r + j] = p[r + j] + h * (p[r + 3 + j] - half * a[j])
            p[r + 3 + j] = p[r + 3 + j] - h * a[j]
    for i in range(3):
        # an increment's error moves position by half a step times itself
        p[16 * i] = p[16 * i] + walk * h * half * half
        p[16 * i + 3] = p[16 * i + 3] + walk * h * half
        p[15 * (3 + i) + i] = p[15 * (3 + i) + i] + walk * h * half
        p[16 * (3 + i)] = p[16 * (3 + i)] + walk * h
        p[16 * (6 + i)] = p[16 * (6 + i)] + drift * h
    for i in range(6):
        for j in range(i + 1, 15):
            p[15 * j + i] = p[15 * i + j]
