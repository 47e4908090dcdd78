"""Attitude control: torque of the published law, closed loop with a rigid body, and margins.

Truth: the paper's law in matrices, by numpy; a rigid body with an ideal gyro cluster by scipy's DOP853; scipy's
bilinear discretisation; python-control's margins against the published design's 49 deg and 16.5 dB.
"""

import math

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.control.attitude_control import AttitudeControl

INERTIA = np.array([812.0, 587.0, 910.0])
LEAD = (0.16, 5.0, 0.417, 0.25)  # gain, lead, lag, period
small = st.lists(st.floats(-0.5, 0.5), min_size=3, max_size=3)
INPUTS = (
    "attitude_error",
    "rate_error",
    "planned_angular_velocity",
    "planned_angular_acceleration",
    "gyro_momentum",
    "jet_torque",
    "disturbance",
)


def set_inputs(block, **values):
    for name, value in values.items():
        setattr(block, name, np.asarray(value).tolist())


def skew(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


@given(small, small, small, small, small, small)
def test_torque_is_that_of_the_paper(rotation, rate, planned_rate, acceleration, gyros, jets):
    """Without a period, so that now is the middle: M = w x G + J (C ep + [C wp x] w + m) - jets."""
    q = Rotation.from_rotvec(rotation).as_quat(scalar_first=True)
    e = 2.0 * q[0] * q[1:]
    block = AttitudeControl(sample_period=0.0, natural_frequency=0.7, damping=0.8)
    set_inputs(block, attitude_error=e, rate_error=rate, planned_angular_velocity=planned_rate)
    set_inputs(block, planned_angular_acceleration=acceleration, gyro_momentum=gyros, jet_torque=jets)
    block.initialize()
    turned = np.eye(3) - 2.0 * skew(q[1:]) @ (q[0] * np.eye(3) + skew(q[1:])).T
    wp = turned @ planned_rate
    w = wp + rate
    m = -0.49 * e - 2.0 * 0.8 * 0.7 * np.array(rate)
    expected = skew(w) @ (INERTIA * w + gyros) + INERTIA * (turned @ acceleration + skew(wp) @ w + m) - jets
    assert block.torque_command == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_lead_is_the_bilinear_one():
    errors = np.random.default_rng(2).normal(scale=1e-5, size=(40, 3))
    block = AttitudeControl(law=0)
    actual = []
    for k, error in enumerate(errors):
        set_inputs(block, attitude_error=error)
        if k == 0:
            block.initialize()
        else:
            block.step(0.25 * (k - 1), 0.125)
        actual.append(list(block.torque_command))
    gain, lead, lag, period = LEAD
    numerator, denominator, _ = signal.cont2discrete(([gain * lead, gain], [lag, 1.0]), period, method="bilinear")
    expected = -INERTIA * signal.lfilter(np.ravel(numerator), denominator, errors, axis=0)
    assert actual == pytest.approx(expected, rel=1e-9)


def flown_turn(period):
    """Return largest error of the angular velocity (rad/s) over a turn flown with ideal gyros and no feedback."""
    axis = np.array([0.0, -0.9578, 0.2874]) / np.linalg.norm([0.0, -0.9578, 0.2874])
    block = AttitudeControl(natural_frequency=0.0, sample_period=period)
    jets = np.array([0.004, -0.01, 0.007])
    start = np.array([0.3, -0.2, 0.5])  # momentum of the cluster: not that of a robot at rest

    def plan(t):
        return 0.02 * (1.0 - math.cos(0.1 * t)) * axis, 0.002 * math.sin(0.1 * t) * axis

    w, gyros, worst = np.zeros(3), start, 0.0
    for k in range(round(20.0 / period)):
        t = k * period
        set_inputs(block, planned_angular_velocity=plan(t)[0], gyro_momentum=gyros, jet_torque=jets)
        set_inputs(block, planned_angular_acceleration=plan(t + 0.5 * period)[1], rate_error=w - plan(t)[0])
        if k == 0:
            block.initialize()
        else:
            block.step(t - 0.125, 0.125)
        torque = np.array(block.torque_command)

        def slope(_, y, torque=torque):
            rate, momentum = y[:3], y[3:]
            turning = np.cross(rate, INERTIA * rate + momentum)
            return np.concatenate([(jets + torque - turning) / INERTIA, -torque])

        y = solve_ivp(slope, (0.0, period), [*w, *gyros], method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        w, gyros = y[:3], y[3:]
        worst = max(worst, np.linalg.norm(w - plan(t + period)[0]))
    return worst


def test_a_turn_is_flown_by_feed_forward_alone():
    """Mid-period terms: after 20 s without attitude feedback the rate is off by less than 0.2 arcsec/s."""
    coarse, fine = flown_turn(0.5), flown_turn(0.25)
    assert fine < 0.2 * math.pi / 180.0 / 3600.0
    assert math.log2(coarse / fine) > 1.8


def test_jets_and_disturbance_are_fed_forward_if_wanted():
    for desired in (True, False):
        block = AttitudeControl(feed_forward=desired)
        set_inputs(block, jet_torque=[0.01, 0.02, -0.03], disturbance=[1e-6, 0.0, 2e-6])
        block.initialize()
        expected = -np.array([0.01, 0.02, -0.03]) - INERTIA * [1e-6, 0.0, 2e-6]
        assert block.torque_command == pytest.approx(expected if desired else [0.0] * 3, abs=1e-15)


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("name", INPUTS)
def test_inputs_that_are_not_finite_leave_the_torque(law, name):
    block = AttitudeControl(law=law)
    set_inputs(block, attitude_error=[1e-5, 0.0, 0.0])
    block.initialize()
    held = list(block.torque_command)
    values = list(getattr(block, name))
    values[2] = math.inf
    setattr(block, name, values)
    block.step(0.0, 0.25)
    assert (block.status, block.torque_command) == (1, held)
    values = list(getattr(block, name))
    values[2] = 0.0
    setattr(block, name, values)
    block.step(0.25, 0.25)
    assert block.status == 0
    assert all(math.isfinite(x) for x in block.torque_command)


def test_margins_of_the_lead():
    """No delay but the mean's of two samples: a quarter of the period."""
    gain, lead, lag, period = LEAD
    numerator, denominator, _ = signal.cont2discrete(([gain * lead, gain], [lag, 1.0]), period, method="bilinear")
    law = control.tf(np.ravel(numerator), denominator, period)
    z = control.tf([1, 0], [1], period)
    plant = control.sample_system(control.tf([1], [1, 0, 0]), period, method="zoh")
    loop = control.minreal(law * plant * (0.75 + 0.25 / z), verbose=False)
    gain_margin, phase_margin, *_ = control.margin(loop)
    assert phase_margin == pytest.approx(49.0, abs=0.5)
    assert 20.0 * math.log10(gain_margin) == pytest.approx(16.5, abs=0.1)
