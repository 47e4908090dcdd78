"""Quaternions: `perilune.fmus_src.mathlib.quaternion` against rotations of scipy and exact cases.

Truth: `scipy.spatial.transform.Rotation` (matrices, rotation vectors, products), the matrix exponential for
the kinematic sign, and quarter turns whose results are whole numbers. Tolerance 1e-14 for components
of unit size, 1e-13 for chains.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.quaternion import (
    angle_error,
    conjugate,
    copy4,
    difference,
    from_rotation_vector,
    multiply,
    normalise,
    to_body,
    to_reference,
    to_rodrigues,
    to_rotation_vector,
)

seeds = st.integers(0, 2**32 - 1)
HALF = math.sqrt(0.5)


def attitude(seed):
    q = np.random.default_rng(seed).normal(size=4)
    return (q / np.linalg.norm(q)).tolist()


def rotation(q):
    return Rotation.from_quat(q, scalar_first=True)


def vector(seed, size=1.0):
    return (size * np.random.default_rng([seed, 1]).normal(size=3)).tolist()


@given(seeds, seeds)
@settings(max_examples=200, deadline=None)
def test_product_turns_by_the_second_factor_first(a_seed, b_seed):
    a, b = attitude(a_seed), attitude(b_seed)
    product = [0.0] * 4
    multiply(a, b, product)
    matrix = rotation(a).as_matrix() @ rotation(b).as_matrix()
    assert rotation(product).as_matrix() == pytest.approx(matrix, abs=1e-14)
    assert np.linalg.norm(product) == pytest.approx(1.0, abs=1e-14)


@given(seeds, seeds)
@settings(max_examples=200, deadline=None)
def test_vectors_turn_as_matrices_turn_them(q_seed, v_seed):
    q, v = attitude(q_seed), vector(v_seed)
    matrix = rotation(q).as_matrix()
    turned = [0.0] * 3
    to_reference(q, v, turned)
    assert turned == pytest.approx(matrix @ v, abs=4e-15 * np.linalg.norm(v))
    to_body(q, v, turned)
    assert turned == pytest.approx(matrix.T @ v, abs=4e-15 * np.linalg.norm(v))


def test_quarter_turns_of_the_axes():
    """About z by a right angle, x becomes y and y becomes -x; the body sees the opposite."""
    q = [HALF, 0.0, 0.0, HALF]
    result = [0.0] * 3
    to_reference(q, [1.0, 0.0, 0.0], result)
    assert result == pytest.approx([0.0, 1.0, 0.0], abs=1e-15)
    to_body(q, [1.0, 0.0, 0.0], result)
    assert result == pytest.approx([0.0, -1.0, 0.0], abs=1e-15)
    product = [0.0] * 4
    multiply([0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], product)
    assert product == [0.0, 0.0, 0.0, 1.0]  # i j = k


def test_results_may_be_the_arguments():
    a, b = attitude(1), attitude(2)
    expected = [0.0] * 4
    multiply(a, b, expected)
    for target in (list(a), list(b)):
        first, second = (target, b) if target == a else (a, target)
        multiply(first, second, target)
        assert target == expected
    v = vector(3)
    turned = [0.0] * 3
    to_reference(a, v, turned)
    to_reference(a, v, v)
    assert v == turned
    to_body(a, v, v)
    assert v == pytest.approx(vector(3), abs=1e-15)
    inverse = list(a)
    conjugate(inverse, inverse)
    assert inverse == [a[0], -a[1], -a[2], -a[3]]
    copy4(inverse, a)
    assert inverse == a


@given(seeds, st.floats(-300.0, 300.0))
@settings(max_examples=200, deadline=None)
def test_normalised_quaternions_keep_their_direction_at_any_size(seed, exponent):
    q = attitude(seed)
    scaled = [10.0**exponent * x for x in q]
    normalise(scaled)
    assert scaled == pytest.approx(q, abs=1e-15)


@pytest.mark.parametrize("bad", [[0.0] * 4, [math.inf, 0.0, 0.0, 0.0], [0.0, -math.inf, 1.0, 1.0]])
def test_what_has_no_direction_becomes_no_rotation(bad):
    q = list(bad)
    normalise(q)
    assert q == [1.0, 0.0, 0.0, 0.0]


@given(seeds, st.floats(0.0, 3.14))
@settings(max_examples=300, deadline=None)
def test_rotation_vectors_there_and_back(seed, angle):
    phi = vector(seed)
    phi = (angle * np.array(phi) / np.linalg.norm(phi)).tolist()
    q, back = [0.0] * 4, [0.0] * 3
    from_rotation_vector(phi, q)
    assert rotation(q).as_matrix() == pytest.approx(Rotation.from_rotvec(phi).as_matrix(), abs=2e-15)
    to_rotation_vector(q, back)
    assert back == pytest.approx(phi, abs=2e-15 * (1.0 + angle))
    to_rotation_vector([-x for x in q], back)  # the same attitude
    assert back == pytest.approx(phi, abs=2e-15 * (1.0 + angle))


@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-160, 1e-9, 1e-4])
def test_small_rotations_keep_their_relative_accuracy(size):
    q, back = [0.0] * 4, [0.0] * 3
    from_rotation_vector([0.6 * size, 0.0, -0.8 * size], q)
    assert q == pytest.approx([math.cos(size / 2), 0.3 * size, 0.0, -0.4 * size], rel=1e-8)
    assert q[1] == pytest.approx(0.6 * math.sin(size / 2), rel=1e-15, abs=0.0)
    to_rotation_vector(q, back)
    assert back == pytest.approx([0.6 * size, 0.0, -0.8 * size], rel=1e-15, abs=0.0)


@given(seeds, st.floats(0.0, math.pi))
@settings(max_examples=100, deadline=None)
def test_more_than_half_a_turn_comes_back_the_shorter_way(seed, angle):
    axis = np.array(vector(seed))
    axis /= np.linalg.norm(axis)
    q, back = [0.0] * 4, [0.0] * 3
    from_rotation_vector((axis * (math.tau - angle)).tolist(), q)
    to_rotation_vector(q, back)
    assert Rotation.from_rotvec(back).as_matrix() == pytest.approx(rotation(q).as_matrix(), abs=2e-15)
    assert np.linalg.norm(back) <= math.pi + 1e-15


@given(seeds, seeds)
@settings(max_examples=200, deadline=None)
def test_difference_leads_from_the_one_to_the_other(reference_seed, q_seed):
    reference, q = attitude(reference_seed), attitude(q_seed)
    error, again = [0.0] * 4, [0.0] * 4
    difference(reference, q, error)
    multiply(reference, error, again)
    assert error[0] >= 0.0
    assert rotation(again).as_matrix() == pytest.approx(rotation(q).as_matrix(), abs=1e-14)


@given(seeds, seeds, st.floats(0.0, 3.1))
@settings(max_examples=200, deadline=None)
def test_angle_error_is_the_axis_times_the_sine(reference_seed, axis_seed, angle):
    reference, axis = attitude(reference_seed), np.array(vector(axis_seed))
    axis /= np.linalg.norm(axis)
    q = (rotation(reference) * Rotation.from_rotvec(angle * axis)).as_quat(scalar_first=True).tolist()
    error = [0.0] * 3
    angle_error(reference, q, error)
    assert error == pytest.approx(math.sin(angle) * axis, abs=2e-15)
    angle_error(reference, [-x for x in q], error)
    assert error == pytest.approx(math.sin(angle) * axis, abs=2e-15)


@given(seeds, st.floats(0.0, 3.1415))  # at half a turn either way is the shorter one
@settings(max_examples=100, deadline=None)
def test_rodrigues_parameters_are_the_axis_times_the_tangent_of_a_quarter(seed, angle):
    axis = np.array(vector(seed))
    axis /= np.linalg.norm(axis)
    q, sigma = [0.0] * 4, [0.0] * 3
    from_rotation_vector((angle * axis).tolist(), q)
    to_rodrigues(q, sigma)
    assert sigma == pytest.approx(math.tan(0.25 * angle) * axis, abs=2e-15)


def test_rate_is_half_the_product_with_the_body_rate():
    """q' = q w/2 with body rates: a steady spin is the exponential of its cross-product matrix from the right."""
    start, w = attitude(5), np.array([0.3, -0.2, 0.5])
    cross = np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])
    h, product = 1e-5, [0.0] * 4
    multiply(start, [0.0, *(0.5 * w)], product)
    stepped = np.array(start) + h * np.array(product)
    matrix = rotation(start).as_matrix() @ expm(cross * h)
    assert rotation(stepped).as_matrix() == pytest.approx(matrix, abs=h * h)
