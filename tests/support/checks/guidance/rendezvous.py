"""Truth of the rendezvous plan: polynomials determined by their ends, rotations by scipy.

Adopted from the block: a command acts after a delay of `DELAY` times the sample period, the first command from the
start.
"""

import numpy as np
from numpy.polynomial import Polynomial
from scipy.interpolate import BPoly
from scipy.spatial.transform import Rotation

from tests.support.checks.check import Check

STEP, ROWS, DELAY, FAST, ATTITUDE = 0.25, 54, 0.25, 0.5, 0.25
TURN_START, TURN_END, ARRIVAL = 3.1, 5.3, 11.05
TARGET, DRIFT, SPIN, DISTANCE = np.array([6.0, 2.0, -1.0]), np.array([-0.2, 0.3, 0.1]), np.array([-1.2, 0.5, 1.6]), 1.5
STATION = TARGET + ARRIVAL * DRIFT - DISTANCE * SPIN / np.linalg.norm(SPIN)


def approach(acceleration):
    """Return the spline of degree 6: rest of acceleration at both ends, of jerk at the second."""
    coasting = TURN_START * acceleration
    begin = (TURN_END - 0.5 * TURN_START) * coasting
    return BPoly.from_derivatives(
        [TURN_END, ARRIVAL], [[begin, coasting, 0.0 * SPIN], [STATION, DRIFT, *np.zeros((2, 3))]]
    )


def balanced_acceleration():
    """Solve for the acceleration of phase 1 with which velocity has half of its change half-way through the spline."""

    def imbalance(acceleration):
        velocity = approach(acceleration).derivative()
        return velocity(0.5 * (TURN_END + ARRIVAL)) - 0.5 * (velocity(TURN_END) + velocity(ARRIVAL))

    offset = imbalance(np.zeros(3))
    return -offset / (imbalance(np.ones(3)) - offset)


def motion(time):
    """Return position and velocity of the plan, an array of (2, times, 3)."""
    acceleration, t = balanced_acceleration(), np.asarray(time)[:, None]
    spline, since = approach(acceleration), np.minimum(t, TURN_START)
    coasting = since * acceleration
    early = np.array([0.5 * since * coasting + np.maximum(t - TURN_START, 0.0) * coasting, coasting])
    late = np.array([STATION + (t - ARRIVAL) * DRIFT, 0.0 * t + DRIFT])
    middle = np.array([spline(t[:, 0]), spline.derivative()(t[:, 0])])
    return np.where(t <= TURN_END, early, np.where(t < ARRIVAL, middle, late))


def turn(time):
    """Return quaternion, angular velocity and, half an attitude period later, angular acceleration of the plan."""
    axis = np.cross([1.0, 0.0, 0.0], SPIN)
    axis, angle = axis / np.linalg.norm(axis), np.arccos(SPIN[0] / np.linalg.norm(SPIN))
    duration = TURN_END - TURN_START
    law = angle * Polynomial([0.0, 0.0, 0.0, 20.0, -45.0, 36.0, -10.0])
    s = np.clip((time - TURN_START) / duration, 0.0, 1.0)
    ahead = np.clip((time + 0.5 * ATTITUDE - TURN_START) / duration, 0.0, 1.0)
    attitude = Rotation.from_rotvec(np.outer(law(s), axis))
    rate, acceleration = law.deriv()(s) / duration, law.deriv(2)(ahead) / duration**2
    return attitude.as_quat(canonical=True, scalar_first=True), np.outer(rate, axis), np.outer(acceleration, axis)


def rendezvous_guidance():
    """Check all four phases; slow ticks every third fast period, the last of them cut short by the end of the turn."""
    time = STEP * np.arange(ROWS)
    slow = 3.0 * FAST
    first_fast = FAST * np.ceil(TURN_END / FAST)
    ticks = np.concatenate([np.arange(0.0, first_fast, slow), np.arange(first_fast, 20.0, FAST)])
    periods = np.where(ticks < first_fast, slow, FAST)
    assert first_fast % slow != 0.0
    changes = ticks + DELAY * periods
    changes[0] = 0.0
    commands = np.diff(motion(changes)[1], axis=0) / np.diff(changes)[:, None]
    tick = np.searchsorted(ticks, time, side="right") - 1
    position, velocity = motion(time)
    quaternion, rate, acceleration = turn(time)
    phase = 1 + np.searchsorted([TURN_START, TURN_END, ARRIVAL], time, side="right")
    assert set(phase) == {1, 2, 3, 4}
    outputs = {
        "planned_position": position,
        "planned_velocity": velocity,
        "planned_acceleration": commands[tick],
        "planned_relative_position": TARGET + np.outer(time, DRIFT) - position,
        "planned_quaternion": quaternion,
        "planned_angular_velocity": rate,
        "planned_angular_acceleration": acceleration,
        "phase": phase,
        "translation_period": periods[tick],
        "translation_count": tick + 1,
        "status": np.zeros(ROWS),
    }
    exact = dict.fromkeys(("phase", "translation_period", "translation_count", "status"), (0.0, 0.0))
    return Check(
        truth="polynomials by their ends, rotations by scipy",
        step=STEP,
        inputs={},
        outputs=outputs,
        tolerances=dict.fromkeys(outputs, (2e-13, 0.0)) | exact,
        parameters={
            "target_position": TARGET,
            "target_velocity": DRIFT,
            "spin_axis": SPIN,
            "turn_start": TURN_START,
            "turn_end": TURN_END,
            "arrival_time": ARRIVAL,
            "final_distance": DISTANCE,
            "spline_degree": 6,
            "slow_period": 1.3,
            "fast_period": FAST,
            "delay_fraction": DELAY,
            "attitude_period": ATTITUDE,
        },
    )


TRUTHS = {"rendezvous_guidance": rendezvous_guidance}
