"""Truths of landers with commanded attitude: closed forms, and DOP853 on independently written equations."""

import math

import numpy as np
from scipy.integrate import solve_ivp

from tests.support.checks.check import STEP, Check
from tests.support.checks.plants.motion import STANDARD_GRAVITY, UP, fly, integrate
from tests.support.checks.vectors import unit


def flat_moon_lander():
    """Compute a parabola, thrust along a turning direction that ends inside a step, a parabola."""
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


def planar_moon_lander():
    """Integrate V, th, h, central angle, mass and load factor as published, with the turn of the vertical."""
    gravity, radius, specific_impulse, rows = 1.623, 1.7384e6, 310.0, 33
    start = [1650.0, -1.5, 17000.0, 0.02, 900.0]
    time = STEP * np.arange(rows)
    thrust, angle = np.where(time < 3.0, 4500.0, 2000.0), np.where(time < 1.5, 1.4, 0.3)

    def rates_of(row):
        def slope(t, y):
            v, th, h, _, m = y
            w, g, r, u = thrust[row] / m, gravity * (radius / (radius + h)) ** 2, radius + h, angle[row]
            turn = (w * math.sin(u - th) + g * math.sin(th)) / v - v * math.sin(th) / r
            flow = thrust[row] / (STANDARD_GRAVITY * specific_impulse)
            return [w * math.cos(u - th) - g * math.cos(th), turn, v * math.cos(th), v * math.sin(th) / r, -flow]

        return slope

    y = fly(rates_of, start, rows, atol=1e-14)
    names = ("speed", "path_angle", "altitude", "central_angle", "mass")
    tolerances = [(1e-9, 0.0), (1e-12, 0.0), (1e-8, 0.0), (1e-13, 0.0), (1e-10, 0.0)]
    load_factor = np.concatenate([[0.0], thrust[:-1] / STANDARD_GRAVITY / y[1:, 4]])
    return Check(
        truth="the published equations by DOP853 at 1e-13",
        step=STEP,
        inputs={"thrust": thrust, "thrust_angle": angle},
        outputs=dict(zip(names, y.T, strict=True)) | {"load_factor": load_factor},
        tolerances=dict(zip(names, tolerances, strict=True)) | {"load_factor": (1e-13, 0.0)},
        parameters={
            **{f"initial_{name}": number for name, number in zip(names, start, strict=True)},
            "specific_impulse": specific_impulse,
            "curvature": True,
        },
    )


def spherical_moon_lander():
    """Integrate central gravity, an engine with a lag, an attitude that turns no faster than a limit, a burn that
    ends."""
    radius, mu, exhaust, lag, response, limit, rows = 1.7374e6, 4.9028e12, 319.0 * STANDARD_GRAVITY, 0.2, 0.5, 0.2, 33
    start, mass, duration = np.array([266731.0, 3000.0, -2233.0, -1676.0, 20.0, 208.0]), 920.0, 2.0625
    centre = np.array([0.0, 0.0, -radius])
    since = np.where(STEP * np.arange(rows) < 1.5, 0.0, 1.5)
    lasting = np.where(since > 0.0, duration, 1e9)
    thrust = np.where(since > 0.0, 5000.0, 4500.0)
    direction = np.where(since[:, None] > 0.0, [-0.3, 0.6, 0.74], [-0.8, 0.0, 0.6])
    rate = np.where(since[:, None] > 0.0, [0.02, -0.01, 0.01], [0.003, 0.004, 0.004])

    def slope_of(row, force):
        def slope(t, y):
            attitude = unit(y[8:11])
            goal = unit(direction[row] + (t - since[row]) * rate[row])
            axis = np.cross(attitude, goal)
            angle = math.atan2(np.linalg.norm(axis), attitude @ goal)
            turning = np.zeros(3)
            if angle > 0.0:
                turning = min(angle / response, limit) * np.cross(unit(axis), attitude)
            specific, centred = y[7] / y[6] * attitude, y[:3] - centre
            gravity = -mu * centred / np.linalg.norm(centred) ** 3
            mass_flow = [-y[7] / exhaust, (force - y[7]) / lag]
            return np.concatenate([y[3:6], specific + gravity, mass_flow, turning, specific])

        return slope

    states = [np.concatenate([start, [mass, 0.0], unit(direction[0]), np.zeros(3)])]
    for row, time in enumerate(STEP * np.arange(rows - 1)):
        y, off = states[-1], since[row] + lasting[row]
        burning = min(max(off, time), time + STEP)
        for begin, end, force in ((time, burning, thrust[row]), (burning, time + STEP, 0.0)):
            if end > begin:
                y = solve_ivp(slope_of(row, force), (begin, end), y, "DOP853", rtol=1e-12, atol=1e-12, max_step=0.01).y[
                    :, -1
                ]
        states.append(y)
    y = np.array(states)
    y[0, 8:11] = UP  # before the first step there is no command
    return Check(
        truth="DOP853 at 1e-12, the attitude by cross products",
        step=STEP,
        inputs={
            "thrust": thrust,
            "thrust_direction": direction,
            "thrust_direction_rate": rate,
            "command_time": since,
            "burn_duration": lasting,
        },
        outputs={
            "position": y[:, :3],
            "velocity": y[:, 3:6],
            "mass": y[:, 6],
            "delivered_thrust": y[:, 7],
            "attitude": y[:, 8:11],
            "sensed_velocity": y[:, 11:],
        },
        tolerances={
            "position": (1e-6, 0.0),
            "velocity": (1e-7, 0.0),
            "mass": (1e-9, 0.0),
            "delivered_thrust": (1e-7, 0.0),
            "attitude": (1e-10, 0.0),
            "sensed_velocity": (1e-7, 0.0),
        },
        parameters={
            "initial_position": start[:3],
            "initial_velocity": start[3:],
            "initial_mass": mass,
            "thrust_lag": lag,
            "direction_response": response,
            "slew_rate_limit": limit,
            "internal_step": 0.015625,
        },
    )


TRUTHS = {
    "flat_moon_lander": flat_moon_lander,
    "planar_moon_lander": planar_moon_lander,
    "spherical_moon_lander": spherical_moon_lander,
}
