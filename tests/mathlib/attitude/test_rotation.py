"""`perilune.fmus_src.mathlib.attitude.rotation`: rotation of unit vectors.

Truth: `scipy.spatial.transform.Rotation` about the common normal, and exact cases along the axes. Tolerance 1e-12 (rad
and unit vectors), 1e-8 within 1e-6 rad of opposite vectors, where the axis has this uncertainty.
"""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.attitude.rotation import turn_towards
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.lengths import either

AXES = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def unit(seed):
    sampled = np.random.default_rng(seed).normal(size=3)
    return sampled / np.linalg.norm(sampled)


def angle_between(a, b):
    return 2.0 * math.atan2(np.linalg.norm(np.subtract(a, b)), np.linalg.norm(np.add(a, b)))


seeds = st.integers(0, 2**32 - 1)


@given(seeds, seeds, st.floats(0.0, 3.2))
@settings(max_examples=either(300, 25), deadline=None)
def test_turn_is_the_rotation_about_the_common_normal(start_seed, goal_seed, largest):
    start, goal = unit(start_seed), unit(goal_seed)
    apart = angle_between(start, goal)
    assume(1e-6 < apart < math.pi - 1e-3)
    turned, left = turn_towards(vector(*start), vector(*goal), largest)
    axis = np.cross(start, goal)
    rotation = Rotation.from_rotvec(min(largest, apart) * axis / np.linalg.norm(axis))
    assert turned == pytest.approx(rotation.apply(start), abs=1e-12)
    assert left == pytest.approx(max(apart - largest, 0.0), abs=1e-12)


@given(seeds, seeds, st.floats(1e-6, 3.0))
@settings(max_examples=either(200, 16), deadline=None)
def test_result_is_a_unit_vector_turned_by_no_more_than_allowed(start_seed, goal_seed, largest):
    start, goal = unit(start_seed), unit(goal_seed)
    turned, left = turn_towards(vector(*start), vector(*goal), largest)
    assert np.linalg.norm(turned) == pytest.approx(1.0, abs=1e-14)
    assert angle_between(start, turned) <= largest + 1e-12
    assert angle_between(turned, goal) == pytest.approx(left, abs=1e-10)


@pytest.mark.parametrize("k", range(3))
@pytest.mark.parametrize("largest", [0.1, 1.0, 3.0])
def test_opposite_vectors_turn_by_the_angle_allowed(k, largest):
    start = np.array(AXES[k])
    turned, left = turn_towards(vector(*start), vector(*-start), largest)
    assert left == pytest.approx(math.pi - largest, abs=1e-15)
    assert angle_between(start, turned) == pytest.approx(largest, abs=1e-12)
    assert np.linalg.norm(turned) == pytest.approx(1.0, abs=1e-15)


@given(seeds, st.floats(1e-16, 1e-6), st.floats(0.01, 3.0))
@settings(max_examples=either(200, 16), deadline=None)
def test_nearly_opposite_vectors_turn_by_the_angle_allowed(seed, offset, largest):
    start = unit(seed)
    goal = -start + offset * np.cross(start, unit(seed + 1))
    goal /= np.linalg.norm(goal)
    turned, left = turn_towards(vector(*start), vector(*goal), largest)
    assert np.linalg.norm(turned) == pytest.approx(1.0, abs=1e-14)
    assert angle_between(start, turned) == pytest.approx(largest, abs=1e-8)
    assert left == pytest.approx(math.pi - largest, abs=2e-6)


@given(seeds, seeds, st.floats(1e-9, 1e-6), st.floats(0.01, 0.9))
@settings(max_examples=either(200, 16), deadline=None)
def test_tiny_turns_go_towards_the_goal(start_seed, side_seed, apart, part):
    start = unit(start_seed)
    side = np.cross(start, unit(side_seed))
    assume(np.linalg.norm(side) > 0.1)
    side /= np.linalg.norm(side)
    goal = math.cos(apart) * start + math.sin(apart) * side
    turned, left = turn_towards(vector(*start), vector(*goal), part * apart)
    expected = math.cos(part * apart) * start + math.sin(part * apart) * side
    assert turned == pytest.approx(expected, abs=1e-15)
    assert left == pytest.approx((1.0 - part) * apart, abs=1e-15)


def test_repeated_turns_reach_the_goal_exactly():
    direction, goal = vector(1.0, 0.0, 0.0), vector(0.0, 0.6, 0.8)
    lefts = []
    for _ in range(16):
        direction, left = turn_towards(direction, goal, 0.1)
        lefts.append(left)
    assert lefts[:15] == pytest.approx([math.pi / 2 - 0.1 * (k + 1) for k in range(15)], abs=1e-12)
    assert lefts[15] == 0.0
    assert direction == goal


def test_no_turn_allowed_leaves_the_direction():
    turned, left = turn_towards(vector(0.0, 0.0, 1.0), vector(0.0, 1.0, 0.0), 0.0)
    assert left == math.pi / 2
    assert turned == [0.0, 0.0, 1.0]
