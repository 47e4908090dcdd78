"""`perilune.fmus_src.mathlib.attitude.triad`: attitude from axes and from two directions.

Truth: scipy's rotations, and the geometry of the two directions.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.attitude.triad import from_axes, from_pair, parallel, triad
from perilune.fmus_src.mathlib.vectors import vector

seeds = st.integers(0, 2**32 - 1)


def rotation(quaternion):
    return Rotation.from_quat([*quaternion], scalar_first=True)


@given(seeds)
def test_axes_of_a_rotation(seed):
    truth = Rotation.random(rng=np.random.default_rng(seed))
    q = from_axes(*(vector(*axis) for axis in truth.as_matrix().T))
    assert q.w >= 0.0
    assert [*q] == pytest.approx(truth.as_quat(scalar_first=True, canonical=True), abs=1e-14)


@pytest.mark.parametrize("axis", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.36, -0.48, 0.8]])
@pytest.mark.parametrize("angle", [0.0, 1e-9, math.pi / 2.0, math.pi - 1e-9, math.pi])
def test_axes_of_half_a_turn_and_of_no_turn(axis, angle):
    """Three of four components or the scalar are near 0."""
    truth = Rotation.from_rotvec(angle * np.array(axis))
    q = from_axes(*(vector(*column) for column in truth.as_matrix().T))
    assert (rotation(q).inv() * truth).magnitude() < 1e-14


@given(seeds)
def test_two_directions_have_the_rotation_between_their_frames(seed):
    """Directions of any length; and x of `from_pair` is along the first, z across both."""
    random = np.random.default_rng(seed)
    truth, first, second = Rotation.random(rng=random), random.normal(size=3), 10.0 * random.normal(size=3)
    sine = np.linalg.norm(np.cross(first, second)) / np.linalg.norm(first) / np.linalg.norm(second)
    body = truth.inv().apply([first, second])
    attitude = triad(*(vector(*v) for v in (3.0 * body[0], 0.1 * body[1], first, second)), 0.5 * sine)
    assert attitude.exists
    assert attitude.quaternion.w >= 0.0
    assert (rotation(attitude.quaternion).inv() * truth).magnitude() < 1e-14 / sine
    axes = rotation(from_pair(vector(*first), vector(*second))).as_matrix()
    assert axes[:, 0] == pytest.approx(first / np.linalg.norm(first), abs=1e-14 / sine)
    assert axes[:, 2] @ first == pytest.approx(0.0, abs=1e-13 / sine)
    assert axes[:, 2] @ second == pytest.approx(0.0, abs=1e-12 / sine)
    assert axes[:, 1] @ second > 0.0


@given(seeds)
def test_an_error_of_the_second_direction_turns_about_the_first(seed):
    """The first one is exact, the second in the plane of both."""
    random = np.random.default_rng(seed)
    truth = Rotation.random(rng=random)
    first, second = random.normal(size=(2, 3)) + np.array([[4.0, 0.0, 0.0], [0.0, 4.0, 0.0]])
    measured = truth.inv().apply([first, second + 0.3 * random.normal(size=3)])
    attitude = triad(*(vector(*v) for v in (*measured, first, second)), 0.01)
    assert attitude.exists
    directions = rotation(attitude.quaternion).apply(measured)
    assert directions[0] == pytest.approx(first, abs=1e-13)
    normal = np.cross(first, second)
    assert directions[1] @ normal == pytest.approx(0.0, abs=1e-12 * np.linalg.norm(normal))


@pytest.mark.parametrize(("angle", "expected"), [(0.16, True), (0.18, False), (math.pi - 0.16, True), (2.0, False)])
def test_parallel_is_by_the_sine(angle, expected):
    a, b = vector(0.0, 0.0, 2.0), vector(3.0 * math.sin(angle), 0.0, 3.0 * math.cos(angle))
    assert parallel(a, b, 0.17) == expected
    for frames in (
        (a, b, vector(1.0, 0.0, 0.0), vector(0.0, 1.0, 0.0)),
        (vector(1.0, 0.0, 0.0), vector(0.0, 1.0, 0.0), a, b),
    ):
        attitude = triad(*frames, 0.17)
        assert attitude.exists == (not expected)
        if expected:
            assert [*attitude.quaternion] == [1.0, 0.0, 0.0, 0.0]


@pytest.mark.parametrize("wrong", [vector(0.0, 0.0, 0.0), vector(math.nan, 0.0, 0.0)])
def test_without_a_direction_there_is_no_attitude(wrong):
    good = vector(1.0, 0.0, 0.0), vector(0.0, 1.0, 0.0)
    assert not triad(wrong, good[1], *good, 0.17).exists
    assert not triad(*good, good[0], wrong, 0.17).exists
