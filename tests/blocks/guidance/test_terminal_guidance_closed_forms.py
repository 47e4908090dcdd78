"""Commands of the terminal guidances compared with the published formulas, over the published box of initial states.

Truth: the published test state, to half a unit of the last digit; the linear thrust acceleration a(t) = a0 + a1 t that
meets all six boundary conditions, solved by numpy as a linear system, of which every command is the value (and, per
method, the rate) at the start; times-to-go by `numpy.roots`. Tolerance 1e-9 relative.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings

from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar import AstarGuidance
from perilune.fmus_src.guidance.astar_modified import AstarModifiedGuidance
from perilune.fmus_src.guidance.astar_robust import AstarRobustGuidance
from tests.support.flights.linear_thrust import UP, balance_roots, impulse_and_miss, linear_thrust
from tests.support.flights.terminal_guidance import ALL, GOOD, assert_points_along, box, commanded
from tests.support.lengths import either


@pytest.mark.parametrize(
    ("guidance_class", "time"),
    [
        (AnalyticGuidance, 217.578132),
        (AnalyticExactGuidance, 213.645917),
        (AstarRobustGuidance, 213.645917),
        (AstarGuidance, 212.982772),
        (AstarModifiedGuidance, 209.126308),
    ],
)
def test_time_to_go_of_the_test_state(guidance_class, time):
    guidance = commanded(guidance_class)
    assert guidance.status == GOOD
    assert guidance.time_to_go == pytest.approx(time, abs=5e-7)


@pytest.mark.parametrize(
    ("guidance_class", "acceleration", "pitch", "pitch_rate"),
    [
        (AnalyticGuidance, 4.7323943, 0.2885476, 8.14639e-4),
        (AnalyticExactGuidance, 4.8079921, 0.2926228, 9.36934e-4),
    ],
)
def test_pitch_programme_of_the_test_state(guidance_class, acceleration, pitch, pitch_rate):
    guidance = commanded(guidance_class)
    assert guidance.thrust_acceleration == pytest.approx(acceleration, abs=5e-8)
    assert math.asin(guidance.thrust_direction[2]) == pytest.approx(pitch, abs=5e-8)
    assert guidance.thrust_direction_rate[2] / math.cos(pitch) == pytest.approx(pitch_rate, abs=6e-10)
    assert guidance.thrust_direction[1] == 0.0
    assert guidance.thrust_direction_rate[1] == 0.0


@given(box)
@settings(max_examples=either(60, 20), deadline=None)
def test_analytic_command_is_the_linear_thrust_without_the_growth_of_its_horizontal_part(state):
    """Time from the quadratic; exact direction and yaw rate; the pitch rate holds cos(pitch) at its start."""
    position, velocity = state
    guidance = commanded(AnalyticGuidance, position, velocity)
    time = guidance.time_to_go
    assert guidance.status == GOOD
    assert min(abs(time - root) for root in balance_roots(position, velocity, 2)) < 1e-9 * time
    a, _ = impulse_and_miss(position, velocity, time)
    assert guidance.thrust_acceleration == pytest.approx(np.linalg.norm(a) / time, rel=1e-9)
    a0, a1 = linear_thrust(position, velocity, time)
    flat = math.hypot(a0[0], a0[1])
    direction = a0 / np.linalg.norm(a0)
    upward = (UP - direction[2] * direction) / math.hypot(direction[0], direction[1])
    turning = (a0[0] * a1[1] - a0[1] * a1[0]) / flat**2 * np.cross(UP, direction)
    assert_points_along(guidance, direction, a1[2] / flat * upward + turning)


@given(box)
@settings(max_examples=either(60, 20), deadline=None)
def test_exact_analytic_command_is_the_linear_thrust_and_its_rate(state):
    position, velocity = state
    guidance = commanded(AnalyticExactGuidance, position, velocity)
    time = guidance.time_to_go
    assert guidance.status == GOOD
    assert min(abs(time - root) for root in balance_roots(position, velocity, 3)) < 1e-9 * time
    a, b = impulse_and_miss(position, velocity, time)
    assert guidance.thrust_acceleration == pytest.approx(2.0 * np.linalg.norm(b) / time**2, rel=1e-9)
    assert guidance.thrust_acceleration == pytest.approx(np.linalg.norm(a) / time, rel=1e-9)
    a0, a1 = linear_thrust(position, velocity, time)
    size = np.linalg.norm(a0)
    direction = a0 / size
    assert_points_along(guidance, direction, (a1 - (a1 @ direction) * direction) / size)


@pytest.mark.parametrize("guidance_class", ALL)
@given(state=box)
@settings(max_examples=either(40, 13), deadline=None)
def test_direction_is_a_unit_vector_and_its_rate_perpendicular(guidance_class, state):
    guidance = commanded(guidance_class, *state)
    assert np.linalg.norm(guidance.thrust_direction) == pytest.approx(1.0, abs=1e-12)
    assert np.dot(guidance.thrust_direction, guidance.thrust_direction_rate) == pytest.approx(0.0, abs=1e-13)
