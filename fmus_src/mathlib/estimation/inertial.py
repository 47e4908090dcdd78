"""Inertial navigation under central gravity, and how its errors grow. Kernel functions.

Frame: landing site (z up); the Moon's centre is ``radius`` below the origin.
"""

from ...kernel.matrices import add_isotropic, column, mirror, row, set_column, set_isotropic, set_row
from ..lunar.gravity import central_gravity, gravity_difference
from ..vectors import Vector3, vector

# The states of a covariance: errors of position and velocity, and of the inertial sensor, by the first of each three.
STATES = 15
POSITION = 0
VELOCITY = 3
BIAS = 6
SCALE_FACTOR = 9
ROTATION = 12


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


def sensor_addition(bias: Vector3, scale_factor: Vector3, rotation: Vector3, f: Vector3) -> Vector3:
    """b + diag(k) f + w x f, with bias b (m/s2), scale factors k and rotation w (rad)."""
    return vector(
        bias.x + scale_factor.x * f.x + rotation.y * f.z - rotation.z * f.y,
        bias.y + scale_factor.y * f.y + rotation.z * f.x - rotation.x * f.z,
        bias.z + scale_factor.z * f.z + rotation.x * f.y - rotation.y * f.x,
    )


def propagate(
    position: Vector3, velocity: Vector3, added: Vector3, up: Vector3, gradient: float, h: float
) -> tuple[Vector3, Vector3]:
    """Errors of position and velocity h (s) later, where the sensor's errors have ``added`` to the specific force."""
    a = added
    if gradient > 0.0:
        a = a - gravity_difference(position + 0.5 * h * velocity, up, gradient)
    return position + h * (velocity - 0.5 * h * a), velocity - h * a


def start_errors(p: list, position: float, velocity: float, bias: float, scale_factor: float, rotation: float) -> None:
    """Diagonal of the covariance P from standard deviations of the states, each the same for three."""
    set_isotropic(p, STATES, POSITION, POSITION, position * position)
    set_isotropic(p, STATES, VELOCITY, VELOCITY, velocity * velocity)
    set_isotropic(p, STATES, BIAS, BIAS, bias * bias)
    set_isotropic(p, STATES, SCALE_FACTOR, SCALE_FACTOR, scale_factor * scale_factor)
    set_isotropic(p, STATES, ROTATION, ROTATION, rotation * rotation)


def predict_errors(
    p: list, f: Vector3, sensing: bool, walk: float, drift: float, up: Vector3, gradient: float, h: float
) -> None:
    """Covariance P (15 x 15, row order) of inertial navigation h (s) ahead under the specific force f (m/s2).

    States: position, velocity, and what the inertial sensor adds to the specific force: bias b,
    scale factors k and a small rotation w, b + diag(k) f + w x f, constant but for a random walk of b of density
    ``drift`` (m2/s5). Velocity increments have white errors of density ``walk`` (m2/s3) besides. Where ``sensing`` is
    false no specific force is measured, and none of these errors acts. A ``gradient`` of gravity (1/s2, along the unit
    vector ``up``) adds gradient (3 up up' - 1) times the position error half a step on to the acceleration, which is
    what it does to dead reckoning by the trapezoidal rule; 0 leaves it out.

    P = F P F' + Q, where F is `propagate`, applied to each column of P and then to the rows that are not yet F P F'.
    """
    added = vector(0.0, 0.0, 0.0)
    for j in range(STATES):  # F P
        if sensing:
            bias = column(p, STATES, BIAS, j)
            scale_factor = column(p, STATES, SCALE_FACTOR, j)
            added = sensor_addition(bias, scale_factor, column(p, STATES, ROTATION, j), f)
        position = column(p, STATES, POSITION, j)
        velocity = column(p, STATES, VELOCITY, j)
        position, velocity = propagate(position, velocity, added, up, gradient, h)
        set_column(p, STATES, POSITION, j, position)
        set_column(p, STATES, VELOCITY, j, velocity)
    for i in range(BIAS):  # (F P) F'; the rest by symmetry
        if sensing:
            bias = row(p, STATES, i, BIAS)
            scale_factor = row(p, STATES, i, SCALE_FACTOR)
            added = sensor_addition(bias, scale_factor, row(p, STATES, i, ROTATION), f)
        position = row(p, STATES, i, POSITION)
        velocity = row(p, STATES, i, VELOCITY)
        position, velocity = propagate(position, velocity, added, up, gradient, h)
        set_row(p, STATES, i, POSITION, position)
        set_row(p, STATES, i, VELOCITY, velocity)
    if sensing:
        # an increment's error moves position by half a step times itself
        half = 0.5 * h
        add_isotropic(p, STATES, POSITION, POSITION, walk * h * half * half)
        add_isotropic(p, STATES, POSITION, VELOCITY, walk * h * half)
        add_isotropic(p, STATES, VELOCITY, POSITION, walk * h * half)
        add_isotropic(p, STATES, VELOCITY, VELOCITY, walk * h)
    add_isotropic(p, STATES, BIAS, BIAS, drift * h)
    mirror(p, STATES, BIAS)
