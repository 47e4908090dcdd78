"""Commands of the three guidances of method A* over the published box of initial states.

Truth: the linear thrust acceleration solved by numpy, with whose lateral and vertical components the method agrees;
times to go by `numpy.roots` and by the published closed formula. Tolerance 1e-9 relative.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings

from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar import AstarGuidance
from perilune.fmus_src.guidance.astar_modified import AstarModifiedGuidance
from perilune.fmus_src.guidance.astar_robust import AstarRobustGuidance
from tests.support.flights.linear_thrust import (
    POSITION,
    VELOCITY,
    astar_roots,
    balance_roots,
    impulse_and_miss,
    linear_thrust,
    modified_time,
    states_of_the_box,
)
from tests.support.flights.terminal_guidance import (
    CLAMPED,
    GOOD,
    NOT_CONVERGED,
    assert_points_along,
    box,
    commanded,
)
from tests.support.lengths import either


@pytest.mark.parametrize("guidance_class", [AstarGuidance, AstarModifiedGuidance, AstarRobustGuidance])
def test_astar_pitch_programme_of_the_test_state(guidance_class):
    """In the plane of motion psi = 0: th0 = asin(w/W), thd = w'/(W cos th0), w the vertical acceleration."""
    guidance = commanded(guidance_class)
    a, b = impulse_and_miss(POSITION, VELOCITY, guidance.time_to_go)
    t = guidance.time_to_go
    w = guidance.thrust_acceleration
    pitch = math.asin((-2.0 * a[2] / t + 6.0 * b[2] / t**2) / w)
    pitch_rate = (6.0 * a[2] / t**2 - 12.0 * b[2] / t**3) / (w * math.cos(pitch))
    assert_points_along(
        guidance,
        [math.cos(pitch), 0.0, math.sin(pitch)],
        [-math.sin(pitch) * pitch_rate, 0.0, math.cos(pitch) * pitch_rate],
    )


@pytest.mark.parametrize("guidance_class", [AstarGuidance, AstarModifiedGuidance, AstarRobustGuidance])
@given(state=box)
@settings(max_examples=either(60, 20), deadline=None)
def test_astar_command_keeps_the_lateral_and_vertical_linear_thrust(guidance_class, state):
    """W d_y = a_y and W d_z = a_z with their rates; d_x completes the unit vector (braking: positive)."""
    position, velocity = state
    guidance = commanded(guidance_class, position, velocity)
    time = guidance.time_to_go
    if guidance_class is AstarGuidance:
        roots = astar_roots(position, velocity)
        assert guidance.status == (GOOD if roots else NOT_CONVERGED)
        if not roots:
            assert (guidance.thrust_acceleration, time) == (0.0, 0.0)
            return
        assert min(abs(time - root) for root in roots) < 1e-9 * time
    elif guidance_class is AstarRobustGuidance:
        assert min(abs(time - root) for root in balance_roots(position, velocity, 3)) < 1e-9 * time
    else:
        assert time == pytest.approx(modified_time(position, velocity), rel=1e-12)
    a0, a1 = linear_thrust(position, velocity, time)
    _, b = impulse_and_miss(position, velocity, time)
    w = np.linalg.norm(a0) if guidance_class is AstarRobustGuidance else 2.0 * np.linalg.norm(b) / time**2
    assert guidance.thrust_acceleration == pytest.approx(w, rel=1e-9)
    y, z = a0[1] / w, a0[2] / w
    inside = y * y + z * z
    if inside > 1.0:
        assert guidance.status == CLAMPED
        assert guidance.clamp_count > 0
        assert np.linalg.norm(guidance.thrust_direction) == pytest.approx(1.0, abs=1e-12)
    elif inside < 0.999:
        assert guidance.status == GOOD
        assert guidance.clamp_count == 0
        x = math.sqrt(1.0 - inside)
        y_rate, z_rate = a1[1] / w, a1[2] / w
        assert_points_along(guidance, [x, y, z], [-(y * y_rate + z * z_rate) / x, y_rate, z_rate])


def test_robust_astar_flies_the_exact_direction_without_clamping():
    for position, velocity in states_of_the_box(200, 5):
        robust = commanded(AstarRobustGuidance, position, velocity)
        exact = commanded(AnalyticExactGuidance, position, velocity)
        assert robust.status == GOOD
        assert robust.thrust_direction == pytest.approx(exact.thrust_direction, abs=1e-9)


def test_share_of_the_box_without_a_root_is_about_fifteen_percent():
    states = states_of_the_box(600, 6)
    rootless = sum(not astar_roots(*state) for state in states)
    assert sum(commanded(AstarGuidance, *state).status == NOT_CONVERGED for state in states) == rootless
    assert 0.10 < rootless / len(states) < 0.21


def test_astar_converges_quadratically_to_its_root():
    """A last change below 1e-6 s leaves an error near rounding, roots that almost coincide left out."""
    compared = 0
    for state in states_of_the_box(100, 11):
        roots = astar_roots(*state)
        if roots and all(abs(first / second - 1.0) > 0.05 for first, second in itertools.pairwise(roots)):
            time = commanded(AstarGuidance, *state).time_to_go
            assert min(abs(time - root) for root in roots) < 1e-12 * time
            compared += 1
    assert compared > 50


def test_clamped_states_of_the_modified_method_exist_and_are_counted():
    actual = [commanded(AstarModifiedGuidance, *state) for state in states_of_the_box(600, 7)]
    clamped = [guidance for guidance in actual if guidance.status == CLAMPED]
    assert clamped
    assert all(guidance.clamp_count in (1, 2) for guidance in clamped)
    assert all(guidance.clamp_count == 0 for guidance in actual if guidance.status == GOOD)
