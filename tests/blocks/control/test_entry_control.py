"""Control blocks of the entry capsule.

Truth: the characteristic polynomial of the frozen closed loop by numpy (1e-9), a matrix from another program,
properties of relays, interpolation by hand.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.control.no_control import NoControl
from perilune.fmus_src.control.output_feedback import OutputFeedback
from perilune.fmus_src.control.robust_control import RobustControl
from perilune.fmus_src.control.standard_control import StandardControl

DEGREE = math.pi / 180.0
COS, SIN = math.cos(-20.0 * DEGREE), math.sin(-20.0 * DEGREE)
INERTIA = np.array([[1400.0, -40.0, 0.0], [-40.0, 1250.0, 0.0], [0.0, 0.0, 1200.0]])


def regulator(kind, **parameters):
    block = kind(**parameters)
    block.initialize()
    return block


def answer(block, bank=0.0, w=(0.0, 0.0, 0.0), **inputs):
    for name, value in {"measured_bank": bank, "measured_angular_velocity": w, **inputs}.items():
        setattr(block, name, value)
    block.step(0.0, 0.2)
    return np.array([*block.torque_command])


def small_gain(block):
    """Return torques over (bank error, wx, wy, wz) by small inputs."""
    h = 1e-4
    columns = [answer(block, bank=h)] + [answer(block, w=tuple(h * e)) for e in np.eye(3)]
    return np.array(columns).T / h


def test_the_robust_gain():
    """Compare with another program's, to its digits."""
    expected = [[-325.472, -1276.363, -299.691, 0.0], [-97.484, -244.495, -468.357, 0.0], [0.0, 0.0, 0.0, -360.0]]
    assert small_gain(regulator(RobustControl, dead_zone=0.0)) == pytest.approx(np.array(expected), abs=6e-4)


@given(st.floats(10.0, 3e4))
def test_the_robust_loop_at_any_pressure(q):
    """(p^2 + k_x p + k_g)(p^2 + k_b p + w_b^2): bank and sideslip on the simplified model, poles to 1e-6."""
    a = np.zeros((4, 4))
    a[0, 2:], a[1, 2:] = [COS, -SIN], [SIN, COS]
    inertia = INERTIA[:2, :2]
    a[2:, 1] = np.linalg.solve(inertia, [0.0527 * q, -1.061 * q])
    gain = small_gain(regulator(RobustControl, dead_zone=0.0))[:2, :3]
    c = np.delete(np.eye(4), 1, axis=0)
    closed = a + np.vstack([np.zeros((2, 2)), np.linalg.inv(inertia)]) @ gain @ c
    square = -np.array([SIN, COS]) @ a[2:, 1]
    expected = np.polymul([1.0, 1.0, 0.25], [1.0, 0.3, square])
    assert np.poly(closed) == pytest.approx(expected, rel=1e-6, abs=1e-9)
    assert square == pytest.approx(8.018e-4 * q, rel=1e-3)


def test_robust_limits_and_dead_zones():
    block = regulator(RobustControl)
    full = answer(block, bank=2.0)
    assert full == pytest.approx(INERTIA @ [-0.08 * COS, 0.08 * SIN, 0.0], rel=1e-12)
    limited = answer(block, bank=0.5, error_limit=0.1)
    assert limited == pytest.approx(INERTIA @ [-0.025 * COS, 0.025 * SIN, 0.0], rel=1e-12)
    assert answer(block, bank=1e-3, error_limit=math.pi).tolist() == [0.0, 0.0, 0.0]
    assert answer(block, bank=2.0 * math.pi + 0.01) == pytest.approx(answer(block, bank=0.01), abs=1e-9)
    turning = answer(block, w=(0.1 * COS, -0.1 * SIN, 0.0), reference_bank_rate=0.1)
    assert turning == pytest.approx([0.0] * 3, abs=1e-9)


@given(st.lists(st.floats(-0.1, 0.1), min_size=2, max_size=40))
def test_relays_close_and_open_at_their_thresholds(rates):
    """By their definition, written independently: closed beyond y, open within y/2 or on the other side."""
    block, sign, level = regulator(StandardControl), 0, 80.0
    threshold = 1.0 * DEGREE
    for rate in rates:
        if abs(rate) > threshold:
            sign = 1 if rate > 0.0 else -1
        elif sign * rate < 0.5 * threshold:
            sign = 0
        assert answer(block, w=(0.0, 0.0, rate))[2] == -sign * level


def test_the_roll_relay_acts_on_a_limited_error_and_leads():
    block = regulator(StandardControl)
    assert answer(block, bank=1.0, w=(-0.5 * 23.9 * DEGREE, 0.0, 0.0))[0] == 0.0
    assert answer(block, bank=1.0, w=(-0.5 * 20.0 * DEGREE, 0.0, 0.0))[0] == -100.0
    assert answer(block, bank=-2.5 * DEGREE)[0] == 100.0


def test_output_feedback_is_its_matrix_with_the_reference_taken_off():
    gains = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]
    block = regulator(OutputFeedback, dead_zone=0.0, gains=np.ravel(gains * 3).tolist())
    e, wx, wy, wz, rate, acceleration = 0.1, 0.2, -0.3, 0.01, 0.05, 0.02
    actual = answer(block, bank=e, w=(wx, wy, wz), reference_bank_rate=rate, reference_bank_acceleration=acceleration)
    expected = np.array(gains) @ [e, wx - rate * COS, wy + rate * SIN]
    expected = expected + (INERTIA @ [COS * acceleration, -SIN * acceleration, 0.0])[:2]
    assert actual == pytest.approx([*expected, -12.0])


@pytest.mark.parametrize(
    ("pressure", "factor"),
    [(100.0, 1.0), (600.0, 1.0), (600.0 * math.sqrt(2.0), 1.5), (1200.0, 2.0), (1200.0 * 2.0**0.25, 2.5), (9e3, 4.0)],
)
def test_scheduled_gains_are_straight_in_the_logarithm_of_pressure(pressure, factor):
    gains = [[1.0] * 6, [2.0] * 6, [4.0] * 6]
    block = regulator(OutputFeedback, dead_zone=0.0, gains=np.ravel(gains).tolist(), pressures=[600.0, 1200.0, 2400.0])
    assert answer(block, bank=0.1, dynamic_pressure=pressure)[0] == pytest.approx(0.1 * factor)


@pytest.mark.parametrize("kind", [RobustControl, StandardControl, OutputFeedback, NoControl])
def test_what_is_not_finite_asks_for_nothing(kind):
    block = regulator(kind)
    assert answer(block, bank=math.nan).tolist() == [0.0, 0.0, 0.0]
    assert block.status == 1
    assert answer(block, bank=0.0).tolist() == [0.0, 0.0, 0.0]
    assert block.status == 0
