"""`perilune.fmus_src.mathlib.attitude.thrust_axis`: motion of a rotating thrust axis.

Truth: scipy's rotations for a constant rate (the axis stays on a circle), DOP853 at 1e-12 under an acceleration, the
order of convergence relative to it, and conservation of the axis' unit length and of its perpendicular rate.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.attitude.thrust_axis import AxisState, turn_axis
from perilune.fmus_src.mathlib.vectors import across, dot, norm, vector

small = st.floats(-0.3, 0.3)
vectors = st.builds(vector, small, small, small)
AXIS = vector(0.36, -0.48, 0.8)
ACCELERATION = vector(0.02, 0.05, -0.03)


@given(vectors, st.floats(0.01, 0.1))
def test_a_constant_rate_turns_the_axis_on_a_circle(rate, h):
    w = across(rate, AXIS)
    s = turn_axis(AxisState(axis=AXIS, rate=w), vector(0.0, 0.0, 0.0), 0.0, h)
    assert np.array(s.axis) == pytest.approx(Rotation.from_rotvec(h * np.array(w)).apply(AXIS), abs=1e-8)
    assert np.array(s.rate) == pytest.approx(np.array(w), abs=1e-15)


def flown(steps, limit):
    s = AxisState(axis=AXIS, rate=across(vector(0.1, 0.2, 0.0), AXIS))
    for _ in range(steps):
        s = turn_axis(s, ACCELERATION, limit, 4.0 / steps)
    return np.array(s.elements())


def integrated(limit):
    def slope(_, y):
        turning = np.array(ACCELERATION) - np.dot(ACCELERATION, y[:3]) * y[:3]
        size = np.linalg.norm(turning)
        return np.concatenate([np.cross(y[3:], y[:3]), turning * (limit / size if 0.0 < limit < size else 1.0)])

    start = [*AXIS, *across(vector(0.1, 0.2, 0.0), AXIS)]
    return solve_ivp(slope, (0.0, 4.0), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]


@pytest.mark.parametrize("limit", [0.0, 0.01])
def test_it_is_of_fourth_order(limit):
    coarse, fine = (np.linalg.norm(flown(steps, limit) - integrated(limit)) for steps in (8, 32))
    assert np.log2(coarse / fine) / 2.0 > 3.7


@given(vectors, vectors)
def test_the_axis_stays_a_unit_vector_and_the_rate_perpendicular(rate, acceleration):
    s = turn_axis(AxisState(axis=AXIS, rate=across(rate, AXIS)), acceleration, 0.02, 0.5)
    assert norm(s.axis) == pytest.approx(1.0, abs=1e-15)
    assert dot(s.axis, s.rate) == pytest.approx(0.0, abs=1e-16)
