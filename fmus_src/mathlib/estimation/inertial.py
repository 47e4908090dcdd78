"""Inertial navigation under central gravity, and propagation of its errors. Kernel functions.

Frame: landing site (z up); the Moon's centre is ``radius`` below the origin.
"""

from ...kernel.matrices import Matrix, block, identity, mirror, zeros
from ..lunar.gravity import central_gravity, gravity_difference
from ..vectors import Vector3, vector
from .sensor_errors import add_cross

# The states of a covariance: errors of position and velocity, and of the inertial sensor.
STATES = 15
MOTION_STATES = 6  # number of position and velocity states
POSITION = block(0, 3)
VELOCITY = block(3, 3)
BIAS = block(6, 3)
SCALE_FACTOR = block(9, 3)
ROTATION = block(12, 3)
MOTION = block(0, 6)
SENSOR = block(6, 9)


def dead_reckon(
    position: Vector3, velocity: Vector3, force: Vector3, before: Vector3, radius: float, mu: float, h: float
) -> tuple[Vector3, Vector3]:
    """Return position (m) and velocity (m/s) after h (s), from the mean specific forces of two successive steps.

    Gravity is integrated by the trapezoidal rule. The specific force is linear in time, with the slope between the two
    means; a constant specific force in each step would give a position error of h^2/12 times its change since the
    start, 7 mm over a landing with steps of 0.1 s.
    """
    here = central_gravity(position, radius, mu)
    ahead = central_gravity(position + h * velocity, radius, mu)
    gained = h * (force + 0.5 * (here + ahead))
    return position + h * (velocity + 0.5 * gained - h * (force - before) / 12.0), velocity + gained


def sensor_addition(bias: Vector3, scale_factor: Vector3, rotation: Vector3, f: Vector3) -> Vector3:
    """Return the error b + diag(k) f + w x f of a specific force f (m/s2).

    b is the bias (m/s2), k are the scale factors and w is the small rotation (rad).
    """
    return add_cross(bias + scale_factor * f, rotation, f)


def propagate(
    position: Vector3, velocity: Vector3, added: Vector3, up: Vector3, gradient: float, h: float
) -> tuple[Vector3, Vector3]:
    """Return the errors of position and velocity after h (s) with an error ``added`` (m/s2) in specific force."""
    a = added
    if gradient > 0.0:
        a = a - gravity_difference(position + 0.5 * h * velocity, up, gradient)
    return position + h * (velocity - 0.5 * h * a), velocity - h * a


def start_errors(position: float, velocity: float, bias: float, scale_factor: float, rotation: float) -> Matrix:
    """Return the initial covariance P (15 x 15) from five standard deviations, each for three axes."""
    p = zeros(STATES, STATES)
    p[POSITION, POSITION] = position * position * identity(3)
    p[VELOCITY, VELOCITY] = velocity * velocity * identity(3)
    p[BIAS, BIAS] = bias * bias * identity(3)
    p[SCALE_FACTOR, SCALE_FACTOR] = scale_factor * scale_factor * identity(3)
    p[ROTATION, ROTATION] = rotation * rotation * identity(3)
    return p


def predict_errors(
    p: Matrix, f: Vector3, sensing: bool, walk: float, drift: float, up: Vector3, gradient: float, h: float
) -> None:
    """Return the covariance P (15 x 15) of inertial navigation after h (s) under the specific force f (m/s2).

    States: position, velocity, and the errors b + diag(k) f + w x f of measured specific force: bias b, scale factors k
    and a small rotation w, constant except for a random walk of b of density ``drift`` (m2/s5). Velocity increments
    also have white errors of density ``walk`` (m2/s3). If ``sensing`` is False, no specific force is measured and the
    sensor errors have no effect. A ``gradient`` of gravity (1/s2, along the unit vector ``up``) adds gradient (3 up up'
    - 1) times the position error after half a step to the acceleration, as in dead reckoning by the trapezoidal rule; 0
    omits it.

    The result is F P F' + Q, where `propagate` applies F, first to each column of P and then to each row.
    """
    a = vector(0.0, 0.0, 0.0)
    for j in range(STATES):  # F P
        if sensing:
            a = sensor_addition(p[BIAS, j], p[SCALE_FACTOR, j], p[ROTATION, j], f)
        position, velocity = propagate(p[POSITION, j], p[VELOCITY, j], a, up, gradient, h)
        p[POSITION, j] = position
        p[VELOCITY, j] = velocity
    for i in range(MOTION_STATES):  # (F P) F'; the other elements by symmetry
        if sensing:
            a = sensor_addition(p[i, BIAS], p[i, SCALE_FACTOR], p[i, ROTATION], f)
        position, velocity = propagate(p[i, POSITION], p[i, VELOCITY], a, up, gradient, h)
        p[i, POSITION] = position
        p[i, VELOCITY] = velocity
    if sensing:
        # the error of an increment changes the position by half a step times the error
        of_velocity = walk * h * identity(3)
        of_both = 0.5 * h * of_velocity
        p[POSITION, POSITION] += 0.5 * h * of_both
        p[POSITION, VELOCITY] += of_both
        p[VELOCITY, POSITION] += of_both
        p[VELOCITY, VELOCITY] += of_velocity
    p[BIAS, BIAS] += drift * h * identity(3)
    p[SENSOR, MOTION] = p[MOTION, SENSOR].T
    mirror(p, MOTION_STATES)
