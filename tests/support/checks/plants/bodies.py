"""Truths of rotating bodies: scipy's rotations, and DOP853 on independently written equations."""

import itertools
import math

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check
from tests.support.checks.plants.motion import fly
from tests.support.checks.vectors import unit
from tests.support.flights.entry_motion import Coefficients, Entry
from tests.support.flights.orbital_motion import DEGREE, JET_TORQUE, flown


def orbital_spacecraft():
    """Integrate direction cosines in inertial axes, from one end of a pulse to the next."""
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
    """Integrate Cartesian inertial axes and a quaternion, with tables of coefficients of the check's own."""
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
    """Integrate Euler's equations with the torque of the gyros written out."""
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
    """Compute a straight line and a turn about a fixed axis."""
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
    "free_flying_robot": free_flying_robot,
    "orbital_spacecraft": orbital_spacecraft,
}
