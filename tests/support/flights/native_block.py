"""Trajectories of a point mass under the guidance of a native block."""

from dataclasses import dataclass

import numpy as np

from tests.support.flights.convex_descent import EXHAUST_SPEED, MAXIMUM, MINIMUM, MU, RADIUS, central
from tests.support.native.named_instance import NamedInstance

STEP = 0.1  # s


@dataclass(frozen=True)
class Flight:
    """Rows of a flight each cycle: time (s), position, velocity, thrust direction, and outputs by name."""

    rows: np.ndarray
    propellant: float
    miss: float
    speed: float
    guidance: NamedInstance
    outputs: dict

    @property
    def tilt(self):
        """Largest tilt of the thrust from z (rad)."""
        return np.arccos(self.rows[:, 9].min())


def begin(block, descent, **parameters):
    """Return the block at the start of a descent with the limits of that."""
    return NamedInstance(
        block,
        target_position=descent.target,
        gravity_correction=True,
        gravity=1.624219,
        gravitational_parameter=MU,
        moon_radius=RADIUS,
        sample_period=STEP,
        glide_slope=descent.slope,
        glide_offset=descent.depth,
        largest_tilt=descent.tilt,
        position=descent.position,
        velocity=descent.velocity,
        mass=descent.mass,
        active=True,
        **parameters,
    )


def fly(block, descent, factor=1.0, shifts=(), **parameters):
    """Fly a point mass in the Moon's central field by Runge and Kutta's method, thrust clipped and times ``factor``.

    ``shifts``: pairs of a time (s) and how far (m) position jumps then, as where knowledge is corrected.
    """
    guidance = begin(block, descent, **parameters)
    state = np.concatenate([descent.position, descent.velocity, [descent.mass]])
    rows = []
    outputs = {name: [] for name in ("status", "limit", "choices", "time_to_go", "glide_margin")}
    for k in range(6000):
        time = k * STEP
        left = min(STEP, guidance["command_time"] + guidance["burn_duration"] - time)
        if guidance["finished"] or left <= 0.0:
            break
        thrust = factor * np.clip(guidance["thrust_acceleration"] * state[6], MINIMUM, MAXIMUM)
        direction, rate, since = (
            guidance[f"{name}"] for name in ("thrust_direction", "thrust_direction_rate", "command_time")
        )
        rows.append([time, *state[:6], *direction])
        for name, values in outputs.items():
            values.append(guidance[name])

        def slope(moment, y, thrust=thrust, direction=direction, rate=rate, since=since):
            along = direction + rate * (moment - since)
            field = central(y[np.newaxis, :3])[0]
            return np.concatenate(
                [y[3:6], thrust / y[6] * along / np.linalg.norm(along) + field, [-thrust / EXHAUST_SPEED]]
            )

        k1 = slope(time, state)
        k2 = slope(time + left / 2.0, state + left / 2.0 * k1)
        k3 = slope(time + left / 2.0, state + left / 2.0 * k2)
        k4 = slope(time + left, state + left * k3)
        state = state + left / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        if left < STEP * (1.0 - 1e-9):
            break
        for moment, jump in shifts:
            if abs(time + STEP - moment) < STEP / 2.0:
                state[:3] += jump
        guidance.set(position=state[:3], velocity=state[3:6], mass=state[6])
        guidance.step(time, STEP)
    return Flight(
        rows=np.array(rows),
        propellant=descent.mass - state[6],
        miss=np.linalg.norm(state[:3] - descent.target),
        speed=np.linalg.norm(state[3:6]),
        guidance=guidance,
        outputs={name: np.array(values) for name, values in outputs.items()},
    )
