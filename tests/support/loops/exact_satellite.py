"""The loops of satellite_pointing in closed form: the linear motion at rest, held motor torques, sampled feedback.

It is written from the equations of Schaub and Junkins by numpy, independent of the FMUs. Estimates are assumed to equal
the truth, and the total momentum of body and wheels to be 0, so that the axes are coupled by products of inertia alone.
"""

import control
import numpy as np
from scipy.linalg import expm, null_space

TICK = 0.125
INERTIA = np.array([[180.0, -4.0, 2.0], [-4.0, 150.0, 3.0], [2.0, 3.0, 120.0]])
AXES = np.array([[1, -1, -1, 1], [1, 1, -1, -1], [1, 1, 1, 1]]) / np.sqrt(3.0)
SPIN_INERTIA, FRICTION, NULL_GAIN = 0.03, 1e-5, 0.02
FREQUENCY, DAMPING, INTEGRAL_TIME = 0.3, 0.9, 20.0


def gains(integral_time):
    """Return gains of attitude, rate and summed attitude: (s^2 + 2 z w s + w^2)(s + 1/T),
    without the last factor if T is 0."""
    pole = 1.0 / integral_time if integral_time > 0.0 else 0.0
    _, rate, attitude, integral = np.polymul([1.0, 2.0 * DAMPING * FREQUENCY, FREQUENCY**2], [1.0, pole])
    return attitude, rate, integral * TICK


def motion():
    """Return A and B of (attitude, w, wheel speeds), with the demanded wheel torque as input; null motion is closed."""
    locked = INERTIA - SPIN_INERTIA * AXES @ AXES.T
    null = null_space(AXES)[:, 0]
    from_speeds = -FRICTION * np.eye(4) - NULL_GAIN * SPIN_INERTIA * np.outer(null, null)  # torques on the wheels
    from_torque = -np.linalg.pinv(AXES)
    a, b = np.zeros((10, 10)), np.zeros((10, 3))
    a[:3, 3:6] = np.eye(3)
    a[3:6, 6:], b[3:6] = (-np.linalg.solve(locked, AXES @ each) for each in (from_speeds, from_torque))
    a[6:, 6:] = from_speeds / SPIN_INERTIA - AXES.T @ a[3:6, 6:]
    b[6:] = from_torque / SPIN_INERTIA - AXES.T @ b[3:6]
    return a, b


def loop(axis, integral_time=INTEGRAL_TIME):
    """Return L(z) at the torque about one axis, the other two closed; null motion is taken as
    continuous, so slow is it."""
    a, b = motion()
    whole = expm(np.block([[a, b], [np.zeros((3, 13))]]) * TICK)
    attitude, rate, integral = gains(integral_time)
    # the sum has the attitude of this tick already
    step = np.block([[whole[:10, :10], np.zeros((10, 3))], [np.eye(3, 10), np.eye(3)]])
    driven = np.vstack([whole[:10, 10:], np.zeros((3, 3))])
    feedback = INERTIA @ np.hstack(
        [(attitude + integral) * np.eye(3), rate * np.eye(3), np.zeros((3, 4)), integral * np.eye(3)]
    )
    others = [k for k in range(3) if k != axis]
    closed = step - driven[:, others] @ feedback[others]
    return control.ss(closed, driven[:, [axis]], feedback[[axis]], 0.0, TICK)
