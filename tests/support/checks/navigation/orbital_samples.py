"""Inputs of observers of the orbital attitude: samples of a rotating body, and the pulses of its jets."""

from typing import NamedTuple

import numpy as np

from tests.support.checks.check import STEP, Check
from tests.support.flights.orbital_motion import DEGREE, INERTIA, JET_TORQUE, ORBITAL_RATE, flown

ROWS = 33
BODY = {"inertia": INERTIA, "jet_torque": JET_TORQUE, "orbital_rate": ORBITAL_RATE, "sample_period": STEP}
GOOD, NO_NEW, NOT_FINITE, YAW_LIMITED = 0, 1, 2, 3


class Tick(NamedTuple):
    """A row, that of the last good sample before it, the estimate, and its yaw before it was limited."""

    row: int
    previous: int
    state: np.ndarray
    yaw: float


class Samples:
    """Row 0 is measured at the start, row n at the end of its tick; two ticks miss a sensor, the last is not finite."""

    def __init__(self, sigma, rate_sigma):
        random = np.random.default_rng(40)
        self.pulses = random.uniform(-0.18, 0.18, (ROWS, 3)).clip(-STEP, STEP)
        self.pulses[np.abs(self.pulses) < 0.03] = 0.0
        self.torque = random.normal(0.0, 3.0, (ROWS, 3))
        states = [np.array([3.0, 10.0, -4.0, 0.2, -0.4, 0.3]) * DEGREE]
        for row in range(ROWS):
            states.append(self.carry(row, states[-1], True))
        states[1] = states[0]
        noise = random.normal(0.0, 1.0, (ROWS, 6)) * np.repeat([sigma, rate_sigma], 3)
        self.measured = (np.array(states)[1:] + noise)[:, [0, 2, 3, 4, 5]]  # roll, pitch, rates
        self.new = np.ones((ROWS, 2), dtype=bool)
        self.new[12, 1] = self.new[18, 0] = False
        # of the step from each row; in the first one the sample is that of the start
        self.status = np.where(self.new.all(axis=1), GOOD, NO_NEW)
        self.status[0], self.status[-2] = NO_NEW, NOT_FINITE

    def inputs(self):
        roll, pitch = self.measured[:, :2].T.copy()
        pitch[-2] = np.nan
        return {
            "measured_roll": roll,
            "measured_pitch": pitch,
            "vertical_count": np.cumsum(self.new[:, 0]),
            "measured_angular_velocity": self.measured[:, 2:],
            "gyro_count": np.cumsum(self.new[:, 1]),
            "fired_pulses": self.pulses,
            "held_torque": self.torque,
        }

    def state(self, row, yaw):
        """Return the state as measured, with a yaw."""
        return np.insert(self.measured[row], 1, yaw)

    def torque_at(self, row, time, split):
        """Return torque (N m) of a tick: pulses each as it is or all in the mean, and the constant rest."""
        pulses = self.pulses[row]
        lengths = np.where(time < np.abs(pulses), np.sign(pulses), 0.0) if split else pulses / STEP
        return JET_TORQUE * lengths + self.torque[row]

    def carry(self, row, state, split):
        """Return (angles, w) a tick later by DOP853."""
        cuts = np.abs(self.pulses[row]) if split else ()
        angles, w = flown(state[:3], state[3:], [STEP], lambda time: self.torque_at(row, time, split), cuts)
        return np.concatenate([angles[0], w[0]])


def observe(truth, samples, correct, largest_yaw, tolerances, coast=None, **parameters):
    """Return the check of an observer whose estimate after a good sample is ``correct`` (Tick), without one ``coast``.

    Without ``coast`` it is the motion's, pulse by pulse. ``tolerances``: of angles (rad) and rates (rad/s).
    """
    state = samples.state(0, 0.0)
    yaw, previous = 0.0, 0
    states, statuses = [state], [GOOD]
    for row, status in enumerate(samples.status[:-1]):
        tick = Tick(row, previous, state, yaw)
        if status == GOOD:
            state, previous = correct(tick), row
        else:
            state = coast(tick) if coast else samples.carry(row, state, True)
        yaw = state[1]
        state[1] = np.clip(yaw, -largest_yaw, largest_yaw)
        states.append(state)
        statuses.append(status if state[1] == yaw else YAW_LIMITED)
    assert set(statuses) == {GOOD, NO_NEW, NOT_FINITE, YAW_LIMITED}
    y = np.array(states)
    return Check(
        truth=truth,
        step=STEP,
        inputs=samples.inputs(),
        outputs={"estimated_angles": y[:, :3], "estimated_angular_velocity": y[:, 3:], "status": np.array(statuses)},
        tolerances={
            "estimated_angles": (tolerances[0], 0.0),
            "estimated_angular_velocity": (tolerances[1], 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            **BODY,
            "largest_yaw": largest_yaw,
            **parameters,
        },
    )
