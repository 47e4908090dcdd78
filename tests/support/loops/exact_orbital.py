"""The loops of orbital_attitude in closed form: the linear motion about the reference state, held torque, placed gains.

It is written from Euler's equations by numpy, independent of the FMUs. The estimate is assumed to equal the state, as
with ideal sensors and the true inertia.
"""

import control
import numpy as np
from scipy.linalg import expm

from tests.support.flights.orbital_motion import INERTIA, ORBITAL_RATE, acceleration, angles_of, body_from_orbital

TICK = 0.2
ANGLE_POLES, RATE_POLES = np.diag([0.10, 0.08, 0.10]), np.diag([0.15, 0.12, 0.15])
WANTED = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -ORBITAL_RATE])


def skew(v):
    """Return the matrix of v x."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def motion(x):
    """Return (angles, w)' by direction cosines."""
    matrix = body_from_orbital(x[:3])
    relative = x[3:] + ORBITAL_RATE * matrix[:, 2]
    h = 1e-4
    turned = expm(-0.5 * h * skew(relative))
    rates = (angles_of(turned @ matrix) - angles_of(turned.T @ matrix)) / h
    return np.concatenate([rates, acceleration(matrix, x[3:], 0.0)])


def linear_motion():
    """Return A about the reference state, by differences."""
    h = 1e-3
    return np.array([(motion(WANTED + h * e) - motion(WANTED - h * e)) / (2.0 * h) for e in np.eye(6)]).T


def linear_matrix(inertia):
    """Return A about the reference state, [A11 I; A21 A22] of the docs."""
    spin, up = WANTED[3:], np.array([0.0, 1.0, 0.0])
    tilt = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    kinematics = np.array([[0.0, -ORBITAL_RATE, 0.0], [ORBITAL_RATE, 0.0, 0.0], [0.0, 0.0, 0.0]])
    gyric = np.linalg.solve(inertia, skew(inertia @ spin) - skew(spin) @ inertia)
    gradient = 3.0 * ORBITAL_RATE**2 * np.linalg.solve(inertia, skew(up) @ inertia - skew(inertia @ up)) @ tilt
    return np.block([[kinematics, np.eye(3)], [gradient, gyric]])


def placed_gain(a):
    """Return K of u = K x with (s + S1)(angles) = z, (s + S0) z = 0."""
    lack = np.hstack([ANGLE_POLES + a[:3, :3], np.eye(3)])  # z = lack x
    free = lack @ a + RATE_POLES @ lack
    return -INERTIA @ free


def derivative_system(angle_poles, rate_poles, coupling, tick):
    """Return the motion over a tick, the effect of a torque and the gain, of (x, the angular velocity one tick before).

    Rates of angles, and w' as a difference over a tick, are fed back.
    """
    a = linear_motion()
    turn = coupling * np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    lack = np.hstack([np.diag(angle_poles) + turn + a[:3, :3], np.eye(3)])  # z = lack x
    driven = np.vstack([np.zeros((3, 3)), np.linalg.inv(INERTIA)])
    state = -INERTIA @ (lack @ a + (np.diag(rate_poles) + turn) @ lack)  # u = K x with the same poles
    of_rates, of_acceleration = np.hsplit(np.linalg.solve((a + driven @ state).T, state.T).T, 2)
    last = np.eye(6)[3:]
    step, effect = sample_motion(a, driven, tick)
    step = np.block([[step, np.zeros((6, 3))], [last, np.zeros((3, 3))]])
    effect = np.vstack([effect, np.zeros((3, 3))])
    return step, effect, np.hstack([of_rates @ a[:3] + of_acceleration @ last / tick, -of_acceleration / tick])


def derivative_loop(axis, angle_poles, rate_poles, coupling, tick):
    """Return L(z) at the torque about one axis of `derivative_system`."""
    return opened(*derivative_system(angle_poles, rate_poles, coupling, tick), axis, tick)


def sample_motion(a, driven, tick):
    """Return the motion over a tick under a torque that is held."""
    whole = expm(np.block([[a, driven], [np.zeros((3, 9))]]) * tick)
    return whole[:6, :6], whole[:6, 6:]


def opened(step, effect, gain, axis, tick):
    """Return L(z) of u = gain x at one axis, the other two closed."""
    others = [k for k in range(3) if k != axis]
    closed = step + effect[:, others] @ gain[others]
    return control.ss(closed, effect[:, [axis]], -gain[[axis]], 0.0, tick)


def loop(axis):
    """Return L(z) at the torque about one axis, the other two closed."""
    a = linear_motion()
    gain = placed_gain(a)
    driven = np.vstack([np.zeros((3, 3)), np.linalg.inv(INERTIA)])
    return opened(*sample_motion(a, driven, TICK), gain, axis, TICK)
