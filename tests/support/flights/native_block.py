"""A native block with its variables by name, and flights of a point mass under a guidance in it."""

from dataclasses import dataclass

import numpy as np

from tests.support.flights.convex_descent import EXHAUST_SPEED, MAXIMUM, MINIMUM, MU, RADIUS, central
from tests.support.kernels.native_instance import OK, NativeInstance

STEP = 0.1  # s


class NativeBlock:
    """One instance; inputs and parameters are set, all variables read, by name."""

    def __init__(self, block, **values):
        self.instance = NativeInstance(block)
        self.sizes = {name: variable.size for name, variable in block.variables.items()}
        firsts = np.cumsum([0, *self.sizes.values()]).tolist()
        self.references = {
            name: list(range(first, first + size))
            for (name, size), first in zip(self.sizes.items(), firsts, strict=False)
        }
        self.set(**values)
        self.instance.enter()
        assert self.instance.start() == OK, self.instance.log

    def set(self, **values):
        for name, value in values.items():
            numbers = np.atleast_1d(value).tolist()
            assert self.instance.set(self.references[name], numbers) == OK, self.instance.log

    def step(self, time, step):
        assert self.instance.do_step(time, step) == OK, self.instance.log

    def __getitem__(self, name):
        numbers = self.instance.get(self.references[name])
        return numbers[0] if len(numbers) == 1 else np.array(numbers)

    def read(self):
        """All numbers, in order of declaration."""
        return self.instance.get([reference for group in self.references.values() for reference in group])


@dataclass(frozen=True)
class Flight:
    """Rows of a flight each cycle: time (s), position, velocity, thrust direction, and outputs by name."""

    rows: np.ndarray
    propellant: float
    miss: float
    speed: float
    guidance: NativeBlock
    outputs: dict

    @property
    def tilt(self):
        """Largest tilt of the thrust from z (rad)."""
        return np.arccos(self.rows[:, 9].min())


def begin(block, descent, **parameters):
    """The block at the start of a descent with the limits of that."""
    return NativeBlock(
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
    """A point mass in the Moon's central field by Runge and Kutta's method, thrust clipped and times ``factor``.

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
