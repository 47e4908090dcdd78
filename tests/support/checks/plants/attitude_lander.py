"""Truth of a lander with a rotating thrust axis: DOP853 from event to event."""

import numpy as np
from scipy.integrate import solve_ivp

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.plants.motion import STANDARD_GRAVITY, UP
from tests.support.checks.vectors import unit

ROWS, INTERNAL_STEP, RADIUS, MU = 41, 0.0078125, 1.7374e6, 4.9028e12
CENTRE = -RADIUS * UP
DRY_MASS, EXHAUST, LAG, FACTOR, LARGEST, PROBE = 558.5, 310.0 * STANDARD_GRAVITY, 0.15, 1.04, 0.03, 2.0


def split(y):
    """Return position, velocity, mass and thrust, axis, angular rate, sensed velocity."""
    return np.split(y, [3, 6, 8, 11, 14])


def altitude(position):
    return np.linalg.norm(position - CENTRE) - RADIUS


def slope(t, y, command, acceleration):
    """Return y' under a command (N) and an angular acceleration (rad/s2), in matrices that project across the axis."""
    position, velocity, (mass, thrust), axis, rate, _ = split(y)
    turning = (np.eye(3) - np.outer(axis, axis)) @ acceleration
    turning = turning * min(1.0, LARGEST / np.linalg.norm(turning))
    specific, centred = thrust / mass * axis, position - CENTRE
    gravity = -MU * centred / np.linalg.norm(centred) ** 3
    flow = [-thrust / EXHAUST, (command - thrust) / LAG]
    return np.concatenate([velocity, specific + gravity, flow, np.cross(rate, axis), turning, specific])


def empty(t, y, command, acceleration):
    return y[6] - DRY_MASS


def ground(t, y, command, acceleration):
    return altitude(y[:3])


empty.terminal = ground.terminal = True


def integrate(start, end, y, command, acceleration):
    """Return the state at ``end``, and the time of touchdown: infinite, or the time from which integration stops.

    Without propellant there is no thrust. The axis turns to the end of the internal step that comes to the ground.
    """
    while start < end:
        dry = y[6] <= DRY_MASS
        if dry:
            y[6:8] = DRY_MASS, 0.0
        events = [ground] if dry else [empty, ground]
        arguments = (0.0 if dry else command, acceleration)
        flown = solve_ivp(slope, (start, end), y, "DOP853", events=events, args=arguments, rtol=1e-13, atol=1e-13)
        start, y = flown.t[-1], flown.y[:, -1]
        if flown.t_events[-1].size:
            stop = INTERNAL_STEP * np.ceil(start / INTERNAL_STEP)
            after_turn = solve_ivp(slope, (start, stop), y, "DOP853", args=arguments, rtol=1e-13, atol=1e-13).y[:, -1]
            y[7], y[8:14] = 0.0, after_turn[8:14]
            return y, start
        if flown.t_events[0].size and not dry:
            y[6:8] = DRY_MASS, 0.0
    return y, np.inf


def attitude_moon_lander():
    """Check a burn, a coast while thrust dies away, a burn until the tank is empty, the fall, the probe, the ground.

    Angular accelerations beyond the limit, with a component along the axis, and small ones.
    """
    time = STEP * np.arange(ROWS)
    late = time >= 1.5
    thrust = np.select([late, time == 0.75], [6000.0, -50.0], 3000.0)
    since, lasting = np.where(late, 1.5, 0.0), np.where(late, 1e9, 1.06)
    acceleration = np.repeat([[0.05, -0.02, 0.01], [-0.01, 0.006, 0.002], [-0.02, -0.05, 0.0]], [9, 13, 19], axis=0)
    axis = unit([0.1, -0.05, 1.0])
    rate = np.array([0.02, 0.03, -0.01])
    start = np.array([300.0, -200.0, 29.0, 2.0, -1.0, -11.0])
    y = np.concatenate([start, [560.0, 0.0], axis, rate - axis * (rate @ axis), np.zeros(3)])
    states, contact, emptied = [y], np.inf, np.inf
    for row in range(ROWS - 1):
        begin, end = STEP * row, STEP * (row + 1)
        off = min(max(since[row] + lasting[row], begin), end)
        for first, last, command in ((begin, off, max(0.0, FACTOR * thrust[row])), (off, end, 0.0)):
            if last > first and contact == np.inf:
                y, contact = integrate(first, last, y.copy(), command, acceleration[row])
        if y[6] == DRY_MASS:
            emptied = min(emptied, end)
        states.append(y)
    position, velocity, engine, axis, rate, sensed = (np.array(rows) for rows in zip(*map(split, states), strict=True))
    heights = np.array([altitude(row) for row in position])
    assert 1.5 < emptied < contact < time[-2]
    up = np.array([unit(row - CENTRE) for row in position])
    vertical = (velocity * up).sum(axis=1)
    coasted = time - follow(since + lasting)
    coasted[0] = 0.0
    outputs = {
        "position": position,
        "velocity": velocity,
        "speed": np.linalg.norm(velocity, axis=1),
        "mass": engine[:, 0],
        "altitude": heights,
        "specific_force": np.diff(sensed, axis=0, prepend=0.0) / STEP,
        "sensed_velocity": sensed,
        "delivered_thrust": engine[:, 1],
        "attitude": axis,
        "coast_time": coasted.clip(0.0),
        "ground_contact": time >= contact,
        "angular_rate": rate,
        "tilt": np.arccos((axis * up).sum(axis=1)),
        "vertical_speed": vertical,
        "horizontal_speed": np.linalg.norm(velocity - vertical[:, None] * up, axis=1),
        "probe_contact": heights <= PROBE,
    }
    assert (outputs["probe_contact"] & ~outputs["ground_contact"]).any()
    return Check(
        truth="DOP853 at 1e-13 from event to event",
        step=STEP,
        inputs={
            "thrust": thrust,
            "command_time": since,
            "burn_duration": lasting,
            "angular_acceleration": acceleration,
        },
        outputs=outputs,
        tolerances={
            **dict.fromkeys(outputs, (1e-8, 0.0)),
            **dict.fromkeys(("attitude", "angular_rate", "tilt"), (1e-13, 0.0)),
            "mass": (1e-10, 0.0),
            "coast_time": (1e-14, 0.0),
            "ground_contact": (0.0, 0.0),
            "probe_contact": (0.0, 0.0),
        },
        parameters={
            "initial_position": start[:3],
            "initial_velocity": start[3:],
            "initial_mass": 560.0,
            "initial_attitude": np.array([0.2, -0.1, 2.0]),
            "initial_angular_rate": np.array([0.02, 0.03, -0.01]),
            "specific_impulse": 310.0,
            "thrust_lag": LAG,
            "thrust_factor": FACTOR,
            "dry_mass": DRY_MASS,
            "probe_length": PROBE,
            "maximum_angular_acceleration": LARGEST,
            "internal_step": INTERNAL_STEP,
        },
    )


TRUTHS = {"attitude_moon_lander": attitude_moon_lander}
