"""Truths of plants: closed forms, and scipy's DOP853 on equations written out anew."""

import itertools
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check
from tests.support.flights.entry_motion import Coefficients, Entry
from tests.support.flights.orbital_motion import DEGREE, JET_TORQUE, flown

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


def fly(rates_of, start, rows, **tolerances):
    """The state at every row; ``rates_of``: row -> y' as a function of time and state while its inputs are held."""
    states = [np.asarray(start, dtype=float)]
    for row in range(rows - 1):
        states.append(integrate(rates_of(row), STEP * row, STEP * (row + 1), states[-1], **tolerances))
    return np.array(states)


def planar_moon_lander():
    """V, th, h, central angle and mass as published, with the turn of the vertical."""
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
    return Check(
        truth="the published equations by DOP853 at 1e-13",
        step=STEP,
        inputs={"thrust": thrust, "thrust_angle": angle},
        outputs=dict(zip(names, y.T, strict=True)),
        tolerances=dict(zip(names, [(1e-9, 0.0), (1e-12, 0.0), (1e-8, 0.0), (1e-13, 0.0), (1e-10, 0.0)], strict=True)),
        parameters={
            **{f"initial_{name}": number for name, number in zip(names, start, strict=True)},
            "specific_impulse": specific_impulse,
            "curvature": True,
        },
    )


def spherical_moon_lander():
    """Central gravity, an engine with a lag, an attitude that turns no faster than a limit, a burn that ends."""
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


def orbital_spacecraft():
    """Direction cosines in inertial axes, from one end of a pulse to the next."""
    start, rate, rows = [3.0 * DEGREE, 17.0 * DEGREE, -5.0 * DEGREE], [0.01 * DEGREE, -0.02 * DEGREE, 0.0], 33
    pulses = np.random.default_rng(28).uniform(-0.18, 0.18, (rows, 3)).clip(-STEP, STEP)
    pulses[np.abs(pulses) < 0.03] = 0.0
    pulses[2::4] = 0.0
    times = STEP * np.arange(rows)
    cuts = [STEP * n + abs(length) for n, row in enumerate(pulses[:-1]) for length in row]

    def torque_at(time):
        n = int(time / STEP)
        return np.where(time - STEP * n < np.abs(pulses[n]), np.sign(pulses[n]), 0.0) * JET_TORQUE

    angles, w = flown(start, rate, times[1:].tolist(), torque_at, cuts)
    return Check(
        truth="direction cosines in inertial axes by DOP853 at 1e-13",
        step=STEP,
        inputs={"pulse_lengths": pulses, "pulse_count": np.arange(rows) + 1},
        outputs={
            "angles": np.vstack([[start], angles]),
            "angular_velocity": np.vstack([[rate], w]),
            "jet_seconds": np.concatenate([[0.0], np.cumsum(np.abs(pulses).sum(axis=1))[:-1]]),
        },
        tolerances={"angles": (1e-11, 0.0), "angular_velocity": (1e-12, 0.0), "jet_seconds": (1e-12, 0.0)},
        parameters={"initial_angles": start, "initial_angular_velocity": rate},
    )


def entry_capsule():
    """Cartesian inertial axes and a quaternion, with tables of coefficients of the check's own."""
    machs, angles, rows = (
        np.array([1.2, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 30.0]),
        np.radians(5.0 * np.arange(13)),
        17,
    )
    axial = np.outer(1.4 + 0.5 / machs, np.cos(angles) ** 2)
    normal = np.outer(0.3 - 0.1 / machs, np.sin(angles))
    position, path = [6371000.0 + 62000.0, 1.0, 0.7], [6800.0, -0.03, 0.6]
    attitude, w, torque = [0.9, 0.06, -0.3], [0.02, -0.03, 0.04], [10.0, -20.0, 5.0]
    entry = Entry(Coefficients(machs, axial, normal), torque=torque)
    begun = entry.start(position, path, attitude, w)
    states = [np.concatenate([position, path, attitude, w])]
    for time in STEP * np.arange(1, rows):
        states.append(np.concatenate(entry.read(entry.fly(begun, time), time)))
    y = np.array(states)
    names = ("height", "longitude", "latitude", "speed", "path_angle", "course", "bank", "sideslip", "attack")
    start = dict(zip(names, states[0][:9] - [6371000.0, *[0.0] * 8], strict=True))
    return Check(
        truth="inertial axes and a quaternion by DOP853 at 1e-13",
        step=STEP,
        inputs={"mean_torque": np.tile(torque, (rows, 1))},
        outputs={
            **dict(zip(names, (y[:, :9] - [6371000.0, *[0.0] * 8]).T, strict=True)),
            "angular_velocity": y[:, 9:],
        },
        tolerances={
            **dict.fromkeys(("longitude", "latitude"), (1e-12, 0.0)),
            **dict.fromkeys(("path_angle", "course"), (1e-11, 0.0)),
            **dict.fromkeys(("bank", "sideslip", "attack"), (1e-8, 0.0)),
            "height": (1e-7, 0.0),
            "speed": (1e-7, 0.0),
            "angular_velocity": (1e-8, 0.0),
        },
        parameters={
            **{f"initial_{name}": number for name, number in start.items()},
            "initial_angular_velocity": w,
            "internal_step": 0.0078125,
            "axial_coefficient": axial,
            "normal_coefficient": normal,
        },
    )


def free_flying_robot():
    """Euler's equations with the torque of the gyros written out."""
    inertia, mass, rotor, rows = np.array([812.0, 587.0, 910.0]), 1000.0, 30.0, 33
    tilt, diagonal = math.radians(35.25), math.sqrt(0.5)
    signs = np.array(list(itertools.product([1.0, -1.0], repeat=3)))
    nozzles = signs * [math.cos(tilt) * diagonal, math.cos(tilt) * diagonal, math.sin(tilt)]
    arms = signs * [1.0, 0.7, 0.6]
    random = np.random.default_rng(28)
    thrust = np.repeat(random.uniform(0.0, 0.5, (5, 8)), 8, axis=0)[:rows]
    rates = np.repeat(random.uniform(-0.1, 0.1, (5, 4)), 8, axis=0)[:rows]
    start = np.array([9.0, -3.0, 5.0, 0.1, -0.05, 0.02, 0.5, 0.1, -0.7, 0.5, 0.02, -0.05, 0.1, 0.3, -2.0, 1.5, 3.0])

    def momentum_of(angles):
        c, s = np.cos(angles), np.sin(angles)
        return rotor * np.array([c.sum(), s[0] + s[1], s[2] + s[3]])

    def rates_of(row):
        force, torque = -thrust[row] @ nozzles, -thrust[row] @ np.cross(arms, nozzles)

        def slope(t, y):
            v, q, w, angles = y[3:6], y[6:10], y[10:13], y[13:]
            gyros = momentum_of(angles + 1e-30j * rates[row]).imag / 1e-30
            angular = (torque - gyros - np.cross(w, inertia * w + momentum_of(angles))) / inertia
            q_rate = 0.5 * np.array([-q[1:] @ w, *(q[0] * w + np.cross(q[1:], w))])
            linear = Rotation.from_quat(q, scalar_first=True).as_matrix() @ force / mass
            return np.concatenate([v, linear, q_rate, angular, rates[row]])

        return slope

    y = fly(rates_of, start, rows, atol=1e-14)
    motion = {"position": y[:, :3], "velocity": y[:, 3:6], "quaternion": y[:, 6:10], "angular_velocity": y[:, 10:13]}
    motion["gimbal_angles"] = y[:, 13:]
    return Check(
        truth="Euler's equations by DOP853 at 1e-13",
        step=STEP,
        inputs={"jet_thrust": thrust, "gimbal_rates": rates},
        outputs={**motion, "impulse": np.concatenate([[0.0], STEP * np.cumsum(thrust.sum(axis=1))[:-1]])},
        tolerances={**dict.fromkeys(motion, (1e-12, 0.0)), "impulse": (1e-12, 0.0)},
        parameters={**{f"initial_{name}": rows[0] for name, rows in motion.items()}, "internal_step": 0.015625},
    )


def drifting_target():
    """A straight line and a turn about a fixed axis."""
    start, velocity, axis, rate = np.array([400.0, 300.0, -50.0]), np.array([0.5, -0.25, 1.0]), [1.0, -2.0, 2.0], 0.4
    time = STEP * np.arange(65)
    turn = Rotation.from_rotvec(rate * time[:, None] * unit(axis))
    return Check(
        truth="closed form; the quaternion by scipy",
        step=STEP,
        inputs={},
        outputs={
            "position": start + time[:, None] * velocity,
            "velocity": np.tile(velocity, (len(time), 1)),
            "quaternion": turn.as_quat(canonical=True, scalar_first=True),
        },
        tolerances={"position": (1e-12, 0.0), "velocity": (0.0, 0.0), "quaternion": (1e-14, 0.0)},
        parameters={
            "initial_position": start,
            "constant_velocity": velocity,
            "spin_axis": axis,
            "spin_rate": rate,
        },
    )


TRUTHS = {
    "drifting_target": drifting_target,
    "entry_capsule": entry_capsule,
    "flat_moon_lander": flat_moon_lander,
    "free_flying_robot": free_flying_robot,
    "orbital_spacecraft": orbital_spacecraft,
    "planar_moon_lander": planar_moon_lander,
    "spherical_moon_lander": spherical_moon_lander,
}
