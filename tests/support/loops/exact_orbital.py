"""The loops of orbital_attitude in closed form: the linear motion about the wanted state, held torque, placed gains.

Written from Euler's equations by numpy; knows nothing of the FMUs. The estimate is taken for the state, which ideal
sensors and the right inertia make it.
"""

import control
import numpy as np
from scipy.linalg import expm

from tests.support.flights.orbital_motion import INERTIA, ORBITAL_RATE, acceleration, angles_of, body_from_orbital

TICK = 0.2
ANGLE_POLES, RATE_POLES = np.diag([0.10, 0.08, 0.10]), np.diag([0.15, 0.12, 0.15])
WANTED = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -ORBITAL_RATE])


def skew(v):
    """The matrix of v x."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def motion(x):
    """(angles, w)' by direction cosines."""
    matrix = body_from_orbital(x[:3])
    relative = x[3:] + ORBITAL_RATE * matrix[:, 2]
    h = 1e-4
    turned = expm(-0.5 * h * skew(relative))
    rates = (angles_of(turned @ matrix) - angles_of(turned.T @ matrix)) / h
    return np.concatenate([rates, acceleration(matrix, x[3:], 0.0)])


def linear_motion():
    """A about the wanted state, by differences."""
    h = 1e-3
    return np.array([(motion(WANTED + h * e) - motion(WANTED - h * e)) / (2.0 * h) for e in np.eye(6)]).T


def linear_matrix(inertia):
    """A about the wanted state, [A11 I; A21 A22] of the docs."""
    spin, up = WANTED[3:], np.array([0.0, 1.0, 0.0])
    tilt = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    kinematics = np.array([[0.0, -ORBITAL_RATE, 0.0], [ORBITAL_RATE, 0.0, 0.0], [0.0, 0.0, 0.0]])
    gyric = np.linalg.solve(inertia, skew(inertia @ spin) - skew(spin) @ inertia)
    gradient = 3.0 * ORBITAL_RATE**2 * np.linalg.solve(inertia, skew(up) @ inertia - skew(inertia @ up)) @ tilt
    return np.block([[kinematics, np.eye(3)], [gradient, gyric]])


def placed_gain(a):
    """u = K x with (s + S1)(angles) = z, (s + S0) z = 0."""
    lack = np.hstack([ANGLE_POLES + a[:3, :3], np.eye(3)])  # z = lack x
    free = lack @ a + RATE_POLES @ lack
    return -INERTIA @ free


def loop(axis):
    """L(z) at the torque about one axis, the other two closed."""
    a = linear_motion()
    gain = placed_gain(a)
    driven = np.vstack([np.zeros((3, 3)), np.linalg.inv(INERTIA)])
    whole = expm(np.block([[a, driven], [np.zeros((3, 9))]]) * TICK)
    step, push = whole[:6, :6], whole[:6, 6:]
    others = [k for k in range(3) if k != axis]
    closed = step + push[:, others] @ gain[others]
    return control.ss(closed, push[:, [axis]], -gain[[axis]], 0.0, TICK)
