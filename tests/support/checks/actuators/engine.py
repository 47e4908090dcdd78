"""Truth of the allocation to one engine."""

import numpy as np
from scipy import signal
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.vectors import unit

ROWS, SEED, STREAM = 49, 28, 7
TIME = STEP * np.arange(ROWS)


def leave_dead_band(thrust, low, high, full):
    """Return thrust above ``high`` in full, and in between where the last one outside of the band was that."""
    outside = (thrust < low) | (thrust > high)
    last = np.maximum.accumulate(np.where(outside, np.arange(len(thrust)), 0))
    return np.where(thrust[last] > high, full, thrust)


def thrust_allocation():
    """Compute the lag by scipy's filters, turns by scipy's rotations: no demand, too small, too large and within
    limits.

    The direction turns after a demand that jumps and moves on; short burns are ended by thrust_lead where they begin.
    """
    smallest, largest, lag, slew, sigma, thrust_lead, direction_lead = 900.0, 4000.0, 0.3, 0.4, 0.02, 0.35, 0.25
    random = np.random.default_rng(294)
    mass = 900.0 - 4.0 * TIME
    acceleration = np.repeat([0.0, 0.5, 2.0, 3.0, 6.0, 2.5, 0.7], 7)
    direction = np.repeat(unit(np.array([0.0, 0.1, 1.0]) + random.normal(0.0, 0.15, (4, 3))), [13, 12, 12, 12], axis=0)
    rate = np.repeat(random.normal(0.0, 0.1, (4, 3)), [13, 12, 12, 12], axis=0)
    since = TIME - random.uniform(0.0, 0.2, ROWS)
    lasting = np.where(np.arange(ROWS) % 5 > 0, random.uniform(0.4, 9.0, ROWS), random.uniform(0.0, 0.3, ROWS))
    inputs = {
        "thrust_acceleration": acceleration,
        "demanded_direction": direction,
        "demanded_direction_rate": rate,
        "demand_time": since,
        "demanded_duration": lasting,
        "mass": mass,
    }
    demanded = follow(mass * acceleration)
    commanded = np.where(demanded > 0.0, demanded.clip(smallest, largest), 0.0)
    commanded = leave_dead_band(commanded, 0.4 * largest, 0.6 * largest, largest)
    by_thrust = commanded != demanded
    assert {*commanded} >= {0.0, smallest, largest}
    commanded = commanded * (1.0 + sigma * Numbers(SEED, STREAM).normal(1)[0])
    numerator, denominator, _ = signal.cont2discrete(([1.0], [lag, 1.0]), STEP)
    steady_state = signal.lfilter_zi(np.ravel(numerator), denominator) * commanded[0]
    thrust, _ = signal.lfilter(np.ravel(numerator), denominator, commanded, zi=steady_state)
    observed, turning, counted, remaining = map(follow, (direction, rate, since - direction_lead, lasting))
    goals = unit(observed + (TIME + STEP - counted)[:, None] * turning)
    flown, ahead, left = [direction[0]], [direction[0]], [0.0]
    for goal in goals[1:]:
        now = ahead[-1]
        axis, cosine = np.cross(now, goal), now @ goal
        angle = np.arctan2(np.linalg.norm(axis), cosine)
        flown.append(now)
        ahead.append(Rotation.from_rotvec(min(angle, slew * STEP) * unit(axis)).apply(now))
        left.append(angle - slew * STEP)
    now, by_slew = np.array(flown), np.array(left) > 0.0
    assert (by_slew & ~by_thrust).any()
    assert (~by_slew & by_thrust).any()
    assert (~by_slew[1:] & ~by_thrust[1:]).any()
    started = np.arange(ROWS) == 0  # at the start the demand is passed on
    direction_rate = (ahead / (now * ahead).sum(axis=1)[:, None] - now) / STEP
    end = follow(since) + (remaining - thrust_lead).clip(0.0)
    command_time = np.where(started, counted, TIME)
    return Check(
        truth="filter and rotations by scipy, an exact random number",
        step=STEP,
        inputs=inputs,
        outputs={
            "thrust": thrust,
            "thrust_direction": now,
            "thrust_direction_rate": direction_rate,
            "command_time": command_time,
            "burn_duration": end - command_time,
            "status": by_slew | by_thrust,
        },
        tolerances={
            "thrust": (1e-11, 0.0),
            "thrust_direction": (1e-13, 0.0),
            "thrust_direction_rate": (1e-12, 0.0),
            "command_time": (0.0, 0.0),
            "burn_duration": (1e-13, 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            "minimum_thrust": smallest,
            "maximum_thrust": largest,
            "dead_band_low": 0.4,
            "dead_band_high": 0.6,
            "thrust_lag": lag,
            "slew_rate_limit": slew,
            "thrust_error": sigma,
            "thrust_lead": thrust_lead,
            "direction_lead": direction_lead,
            "seed": np.array(SEED),
            "stream": np.array(STREAM),
        },
    )


TRUTHS = {"thrust_allocation": thrust_allocation}
