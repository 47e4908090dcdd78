"""Truths of plants: closed forms, and scipy's DOP853 on equations written out anew."""

import numpy as np
from scipy.integrate import solve_ivp

from tests.support.checks.check import Check

STEP = 0.125  # s; its multiples are exact
STANDARD_GRAVITY = 9.80665
UP = np.array([0.0, 0.0, 1.0])


def integrate(slope, start, end, y, rtol=1e-13, atol=1e-10):
    """The state at ``end`` by DOP853."""
    return solve_ivp(slope, (start, end), y, method="DOP853", rtol=rtol, atol=atol).y[:, -1]


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


def flat_moon_lander():
    """A parabola, thrust along a turning direction that ends inside a step, a parabola."""
    gravity, mass, thrust, since, duration, rows = 1.62, 940.0, 4500.0, 0.5, 2.05, 33
    direction, rate = np.array([0.8, -0.36, 0.48]), np.array([-0.036, -0.048, 0.024])
    start = np.array([1.0e5, -2.0e4, 1.05e4, -930.0, 180.0, -40.0])

    def fall(y, time):
        return np.concatenate([y[:3] + time * y[3:] - 0.5 * gravity * time**2 * UP, y[3:] - gravity * time * UP])

    def slope(t, y):
        return np.concatenate([y[3:], thrust / mass * unit(direction + (t - since) * rate) - gravity * UP])

    first, last = fall(start, since), since + duration
    states = []
    for time in STEP * np.arange(rows):
        if time <= since:
            states.append(fall(start, time))
        elif time <= last:
            states.append(integrate(slope, since, time, first))
        else:
            states.append(fall(integrate(slope, since, last, first), time - last))
    y = np.array(states)
    on = STEP * np.arange(rows) >= since
    return Check(
        truth="parabolas and DOP853 at 1e-13",
        step=STEP,
        inputs={
            "thrust": np.where(on, thrust, 0.0),
            "thrust_direction": np.tile(direction, (rows, 1)),
            "thrust_direction_rate": np.tile(rate, (rows, 1)),
            "command_time": np.where(on, since, 0.0),
            "burn_duration": np.where(on, duration, 0.0),
        },
        outputs={"position": y[:, :3], "velocity": y[:, 3:], "mass": np.full(rows, mass)},
        tolerances={"position": (1e-8, 0.0), "velocity": (1e-9, 0.0), "mass": (0.0, 0.0)},
        parameters={"initial_position": start[:3], "initial_velocity": start[3:], "initial_mass": mass},
    )


TRUTHS = {
    "flat_moon_lander": flat_moon_lander,
}
