"""Invariance of the terminal guidances under rotation, reflection, translation, and scaling of units.

Truth: the laws depend on no direction but the vertical (method A*: also x), no position but the target, and no units.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.guidance.analytic import AnalyticGuidance
from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar_modified import AstarModifiedGuidance
from tests.support.flights.linear_thrust import EXHAUST_SPEED, GRAVITY, POSITION, TARGET, VELOCITY
from tests.support.flights.terminal_guidance import (
    ALL,
    GOOD,
    assert_points_along,
    box,
    command_of,
    commanded,
)
from tests.support.lengths import either


def turned(vector, azimuth):
    c, s = math.cos(azimuth), math.sin(azimuth)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]])


@pytest.mark.parametrize("guidance_class", [AnalyticGuidance, AnalyticExactGuidance])
@given(state=box, azimuth=st.integers(-3141, 3141).map(lambda number: number / 1000.0))
@settings(max_examples=either(60, 20), deadline=None)
def test_analytic_commands_turn_with_the_frame_about_the_vertical(guidance_class, state, azimuth):
    position, velocity = state
    plain = commanded(guidance_class, position, velocity)
    other = commanded(guidance_class, turned(position, azimuth), turned(velocity, azimuth))
    assert other.time_to_go == pytest.approx(plain.time_to_go, rel=1e-12)
    assert other.thrust_acceleration == pytest.approx(plain.thrust_acceleration, rel=1e-12)
    assert_points_along(
        other, turned(plain.thrust_direction, azimuth), turned(plain.thrust_direction_rate, azimuth), 1e-11
    )


@pytest.mark.parametrize("guidance_class", [AnalyticGuidance, AnalyticExactGuidance])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_analytic_command_along_the_y_axis_exactly(guidance_class, side):
    """No x component at all, where the published cos(yaw)/x is 0/0."""
    plain = commanded(guidance_class)
    other = commanded(guidance_class, [0.0, side * POSITION[0], POSITION[2]], [0.0, side * VELOCITY[0], VELOCITY[2]])
    assert other.thrust_direction == pytest.approx(
        [0.0, side * plain.thrust_direction[0], plain.thrust_direction[2]], abs=1e-12
    )
    assert other.thrust_direction_rate == pytest.approx(
        [0.0, side * plain.thrust_direction_rate[0], plain.thrust_direction_rate[2]], abs=1e-15
    )


@pytest.mark.parametrize("guidance_class", ALL)
@given(state=box)
@settings(max_examples=either(40, 13), deadline=None)
def test_commands_mirror_with_the_frame(guidance_class, state):
    position, velocity = state
    mirror = np.array([1.0, -1.0, 1.0])
    plain = commanded(guidance_class, position, velocity)
    other = commanded(guidance_class, mirror * position, mirror * velocity)
    assert other.status == plain.status
    assert other.time_to_go == plain.time_to_go
    assert_points_along(other, mirror * plain.thrust_direction, mirror * plain.thrust_direction_rate, 1e-12)


@pytest.mark.parametrize("guidance_class", ALL)
@given(state=box, shift=st.lists(st.integers(-5000, 5000).map(float), min_size=3, max_size=3))
@settings(max_examples=either(40, 13), deadline=None)
def test_commands_move_with_the_target(guidance_class, state, shift):
    position, velocity = state
    plain = commanded(guidance_class, position, velocity)
    other = commanded(guidance_class, position + shift, velocity, target_position=(TARGET + shift).tolist())
    assert other.status == plain.status
    assert other.time_to_go == pytest.approx(plain.time_to_go, rel=1e-9)
    if plain.status == GOOD and plain.thrust_direction[0] > 0.1:
        assert command_of(other) == pytest.approx(command_of(plain), rel=1e-7, abs=1e-10)


@pytest.mark.parametrize("guidance_class", ALL)
@given(
    state=box,
    length=st.integers(1, 100).map(lambda number: number / 10.0),
    duration=st.integers(1, 100).map(lambda number: number / 10.0),
)
@settings(max_examples=either(40, 13), deadline=None)
def test_commands_scale_with_the_units_of_length_and_time(guidance_class, state, length, duration):
    position, velocity = state
    speed, acceleration = length / duration, length / duration**2
    plain = commanded(guidance_class, position, velocity)
    extra = {"exhaust_speed": speed * EXHAUST_SPEED} if guidance_class is AstarModifiedGuidance else {}
    other = commanded(
        guidance_class,
        length * position,
        speed * velocity,
        target_position=(length * TARGET).tolist(),
        gravity=acceleration * GRAVITY,
        **extra,
    )
    if plain.status == GOOD and plain.thrust_direction[0] > 0.1:
        assert other.status == GOOD
        assert other.time_to_go == pytest.approx(duration * plain.time_to_go, rel=1e-9)
        assert other.thrust_acceleration == pytest.approx(acceleration * plain.thrust_acceleration, rel=1e-7)
        assert other.thrust_direction == pytest.approx(plain.thrust_direction, abs=1e-7)
        assert np.multiply(duration, other.thrust_direction_rate) == pytest.approx(
            np.array(plain.thrust_direction_rate), abs=1e-9
        )
