"""Truths of the observers of the orbital attitude: direction cosines by DOP853 between samples, gains by numpy.

The gain of a full-order observer is from docs/systems/orbital_attitude.md; its poles are compared with the requested
poles. The derivatives of the motion are complex steps of the nonlinear equations.
"""

import itertools
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from tests.support.checks.check import STEP
from tests.support.checks.navigation.orbital_samples import GOOD, ROWS, Samples, observe
from tests.support.flights.orbital_motion import ORBITAL_RATE, derivatives_of, rates_of

YAW_POLE, MEASURED_POLE = 0.25, 0.08  # 1/s
FULL = {"yaw_pole": YAW_POLE, "measured_pole": MEASURED_POLE}
WANTED = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -ORBITAL_RATE])
YAW = np.eye(6)[:, 1:2]
C = np.delete(np.eye(6), 1, axis=0)


def check_poles(closed, yaw, measured):
    """Check that a matrix of errors has a pole of yaw, and the five others independent directions."""
    shifted = closed - measured * np.eye(6)
    assert np.linalg.matrix_rank(shifted, tol=1e-9 * np.abs(closed).max()) == 1
    assert abs(np.trace(shifted) + measured - yaw) < 1e-9


def orbital_observer_continuous():
    """Check slow poles: one step of a method of fourth order is the exact solution to 3e-9 rad of yaw.

    A sample is taken in over the tick that begins with it; where the next one is missing it stays, pulse by pulse.
    """
    samples = Samples(3e-3, 1e-4)
    a = derivatives_of(rates_of, WANTED)
    gain = (a + MEASURED_POLE * np.eye(6)) @ (C.T + YAW @ [[-YAW_POLE / ORBITAL_RATE, 0.0, 0.0, 0.0, 0.0]])
    check_poles(a - gain @ C, -YAW_POLE, -MEASURED_POLE)

    def advance(tick, split):
        cuts = np.abs(samples.pulses[tick.row]) if split else ()
        state = tick.state
        for start, end in itertools.pairwise(sorted({0.0, *cuts, STEP})):
            torque = samples.torque_at(tick.row, (start + end) / 2.0, split)

            def rates(t, x, torque=torque):
                return rates_of(x, torque) + gain @ (samples.measured[tick.previous] - C @ x)

            state = solve_ivp(rates, (start, end), state, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
        return state

    def correct(tick):
        return advance(tick, split=False)

    def coast(tick):
        return advance(tick, split=True)

    return observe("DOP853 at 1e-13; gain by numpy", samples, correct, 0.18, (5e-9, 1e-11), coast, **FULL)


def orbital_observer_discrete():
    """Check pulse by pulse."""
    samples = Samples(3e-3, 1e-4)
    ahead = expm(STEP * derivatives_of(rates_of, WANTED))
    observed = C @ ahead @ YAW
    change = ahead[1, 1] - math.exp(-YAW_POLE * STEP)
    gain = (np.eye(6) - math.exp(-MEASURED_POLE * STEP) * np.linalg.inv(ahead)) @ (
        C.T + YAW @ np.linalg.pinv(observed) * change
    )
    check_poles((np.eye(6) - gain @ C) @ ahead, math.exp(-YAW_POLE * STEP), math.exp(-MEASURED_POLE * STEP))

    def correct(tick):
        carried = samples.carry(tick.row, tick.state, True)
        return carried + gain @ (samples.measured[tick.row] - C @ carried)

    truth = "direction cosines by DOP853 at 1e-13; gain by numpy"
    return observe(truth, samples, correct, 0.165, (1e-11, 1e-12), split=True, **FULL)


def orbital_observer_continuous_reduced():
    """Integrate z' = f - pole z by the exponential of a matrix; f is the motion's derivative of
    yaw - l roll, but for -pole z."""
    pole = 0.25
    samples = Samples(2e-4, 1e-5)
    slope = -pole / ORBITAL_RATE
    linear = expm(STEP * np.array([[-pole, 1.0], [0.0, 0.0]]))

    def correct(tick):
        mean = (samples.measured[tick.previous] + samples.measured[tick.row]) / 2.0
        state = np.insert(mean, 1, tick.state[1])
        rates = rates_of(state)
        f = rates[1] - slope * rates[0] + pole * (state[1] - slope * state[0])
        z = (linear @ [tick.yaw - slope * tick.state[0], f])[0]
        return samples.state(tick.row, z + slope * samples.measured[tick.row, 0])

    return observe("matrix exponential", samples, correct, 0.1, (2e-10, 1e-12), reduced_yaw_pole=pole)


def orbital_observer_discrete_reduced():
    """Check under the mean torque: yaw of the motion, less roll's lead over its sample."""
    pole = 0.25
    samples = Samples(2e-4, 1e-5)

    def correct(tick):
        roll, yaw = samples.carry(tick.row, tick.state, False)[:2]
        fraction = -math.expm1(-pole * STEP) / (ORBITAL_RATE * STEP)
        return samples.state(tick.row, yaw - fraction * (samples.measured[tick.row, 0] - roll))

    truth = "direction cosines by DOP853 at 1e-13"
    return observe(truth, samples, correct, 0.1, (2e-10, 1e-12), reduced_yaw_pole=pole)


def orbital_sequence():
    """Check all three stages; the roll rate is integrated over all its good samples at once."""
    levelling, averaging = 0.8, 2.09  # s; no multiples of a tick
    samples = Samples(5e-7, 1e-6)
    ticks = 1 + np.arange(ROWS)
    good = np.flatnonzero(samples.status[:-1] == GOOD)
    first = good[ticks[good] >= round(levelling / STEP)][0]
    last = good[ticks[good] >= round(averaging / STEP)][0]
    used = good[(good >= first) & (good <= last)]
    assert np.diff(used).max() > 1
    rolled = np.trapezoid(samples.measured[used, 2], STEP * used)
    behind = rolled - (samples.measured[last, 0] - samples.measured[first, 0])
    mean_yaw = behind / (ORBITAL_RATE * STEP * (last - first))

    def correct(tick):
        if tick.row <= last:
            return samples.state(tick.row, mean_yaw if tick.row == last else 0.0)
        return samples.state(tick.row, samples.carry(tick.row, tick.state, True)[1])

    truth = "direction cosines by DOP853 at 1e-13, integral by numpy"
    return observe(truth, samples, correct, 0.7, (1e-11, 1e-12), levelling_end=levelling, averaging_end=averaging)


TRUTHS = {
    "orbital_observer_continuous": orbital_observer_continuous,
    "orbital_observer_continuous_reduced": orbital_observer_continuous_reduced,
    "orbital_observer_discrete": orbital_observer_discrete,
    "orbital_observer_discrete_reduced": orbital_observer_discrete_reduced,
    "orbital_sequence": orbital_sequence,
}
