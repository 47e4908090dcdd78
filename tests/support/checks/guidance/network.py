"""Truth of the published network operator in space: the law written out, rotated into space."""

import numpy as np
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.vectors import unit
from tests.support.flights.independent_descent import LEGACY, encoded_law

STANDARD_GRAVITY, NOMINAL, VARIATION = 9.80665, 4314.926, 784.532
FOREVER = 1e9  # s
RADIUS, HANDOVER, SPECIFIC_IMPULSE, CONTROL_ALTITUDES = 1.7384e6, 5.9, 319.0, (1200.0, 1800.0)


def descent():
    """Return rows of local vertical, altitude, velocity, mass and active: two flights, the
    second slow across the vertical."""
    random, rows = np.random.default_rng(29), 40
    up = Rotation.from_rotvec(random.uniform(-0.2, 0.2, (rows, 3))).apply([0.0, 0.0, 1.0])
    altitude = np.linspace(18148.0, 1700.0, rows).round(1)
    speed, angle = np.linspace(1689.0, 40.0, rows).round(1), -random.uniform(0.3, 3.0, rows)
    forward = unit(np.cross(np.cross(up, random.normal(size=(rows, 3))), up))
    velocity = speed[:, None] * (np.cos(angle)[:, None] * up - np.sin(angle)[:, None] * forward)
    mass, active = np.linspace(940.0, 500.0, rows).round(1), np.ones(rows, dtype=bool)
    mass[[9, 10]] = 0.0
    active[[0, 1, 26, 27]] = False
    slow = 0.9 * HANDOVER
    up[20:23] = up[19]  # straight down: the horizontal direction is that of row 19
    altitude[[20, 21, 22]], velocity[[20, 21, 22]] = [1810.0, 1190.0, 1700.0], slow * up[[20, 21, 22]]
    up[28:34] = [0.0, 0.0, 1.0]
    velocity[28:34] = [
        [0.2, 0.3, 50.0],
        [0.3, -0.1, 40.0],
        [-3.0, 4.0, -40.0],
        [0.1, 0.4, 30.0],
        [0.0, 0.6, -20.0],
        [0.3, 0.2, -9.0],
    ]
    return up, altitude, velocity, mass, active


def hold_forward(velocity, up, active):
    """Return the horizontal direction of flight, of an earlier row of the flight where there is hardly any; first x."""
    horizontal = velocity - (velocity * up).sum(axis=1)[:, None] * up
    size = np.linalg.norm(horizontal, axis=1)
    rows = np.arange(len(up))
    last = np.maximum.accumulate(np.where(size >= 0.5, rows, -1))
    begun = last > np.maximum.accumulate(np.where(active, -1, rows))
    return np.where(begun[:, None], horizontal[last] / size[last, None], [1.0, 0.0, 0.0])


def network_operator_guidance():
    """Turn the planar law into space by rotations: no mass, a hand-over that stays, a second flight."""
    up, altitude, velocity, mass, active = descent()
    rows = np.arange(len(up))
    across = np.cross(up, velocity)
    velocity_angle = -np.arctan2(np.linalg.norm(across, axis=1), (up * velocity).sum(axis=1))
    law = np.array([encoded_law(a, h, LEGACY) for a, h in zip(velocity_angle, altitude, strict=True)])
    angle, above = law[:, 0].clip(0.0, np.pi), (STANDARD_GRAVITY * law[:, 1]).clip(-VARIATION, VARIATION)
    assert set(np.sign(np.abs(above) - VARIATION)) == {-1.0, 0.0}
    axis = np.cross(hold_forward(velocity, up, active), up)
    direction = Rotation.from_rotvec(angle[:, None] * unit(axis)).apply(up)
    speed, exhaust = np.linalg.norm(velocity, axis=1), STANDARD_GRAVITY * SPECIFIC_IMPULSE

    def braking_time(row):
        """Return the time at which the rocket equation has taken all but the speed of the hand-over."""
        flow = (NOMINAL + above[row]) / exhaust
        if speed[row] <= HANDOVER:
            return 0.0

        def excess(time):
            return speed[row] - HANDOVER + exhaust * np.log1p(-flow * time / mass[row])

        return brentq(excess, 0.0, 0.999 * mass[row] / flow, xtol=1e-12, rtol=1e-15)

    good = active & (mass > 0.0)
    starts = active & ~np.concatenate([[False], active[:-1]])
    low, high = CONTROL_ALTITUDES
    ends = good & ~starts & (speed < HANDOVER) & (altitude >= low) & (altitude <= high)
    flight = np.maximum.accumulate(np.where(active, -1, rows))  # the row before its start
    finished = active & (np.maximum.accumulate(np.where(ends, rows, -1)) > flight)
    first_end = finished & ~np.concatenate([[False], finished[:-1]])
    assert first_end.sum() == 1
    fresh = good & (~finished | first_end)
    last = np.maximum.accumulate(np.where(fresh, rows, -1))  # the row of the command
    unset, thrusts = last < 0, active & ~finished & (last > flight)
    acceleration = np.divide(NOMINAL + above, mass, out=np.zeros(len(rows)), where=mass > 0.0)
    time = np.array([braking_time(row) if good[row] else 0.0 for row in rows])
    outputs = {
        "thrust_acceleration": np.where(thrusts, acceleration[last], 0.0),
        "thrust_direction": np.where(unset[:, None], [0.0, 0.0, 1.0], direction[last]),
        "thrust_direction_rate": np.zeros((len(rows), 3)),
        "command_time": np.where(unset, 0.0, STEP * (last + 1)),
        "burn_duration": np.where(finished, 0.0, FOREVER),
        "time_to_go": np.where(thrusts, time[last], 0.0),
        "status": np.where(active & ~good & ~finished, 3, 0),
        "finished": finished,
    }
    exact = dict.fromkeys(("command_time", "burn_duration", "status", "finished"), (0.0, 0.0))
    return Check(
        truth="the law written out, rotations and a root finder by scipy",
        step=STEP,
        inputs={
            "position": (RADIUS + altitude)[:, None] * up - [0.0, 0.0, RADIUS],
            "velocity": velocity,
            "mass": mass,
            "active": active,
        },
        outputs={name: follow(values) for name, values in outputs.items()},
        tolerances=dict.fromkeys(outputs, (1e-12, 1e-12)) | exact,
        parameters={
            "moon_radius": RADIUS,
            "target_position": [0.0, 0.0, 1500.0],
            "handover_speed": HANDOVER,
            "handover_altitude_low": low,
            "handover_altitude_high": high,
            "specific_impulse": SPECIFIC_IMPULSE,
        },
    )


TRUTHS = {"network_operator_guidance": network_operator_guidance}
