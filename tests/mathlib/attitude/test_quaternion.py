"""`perilune.fmus_src.mathlib.attitude.quaternion`: products, rotations and kinematics of quaternions.

Truth: `scipy.spatial.transform.Rotation` (matrices, rotation vectors, products), the matrix exponential for the sign of
the kinematics, and quarter turns with integer results. Tolerance 1e-14 for components of unit size, 1e-13 for chains.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.attitude.quaternion import (
    angle_error,
    conjugate,
    difference,
    from_rotation_vector,
    multiply,
    normalise,
    to_body,
    to_reference,
    to_rodrigues,
    to_rotation_vector,
)
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.lengths import either

seeds = st.integers(0, 2**32 - 1)
HALF = math.sqrt(0.5)


def attitude(seed):
    q = np.random.default_rng(seed).normal(size=4)
    return vector(*(q / np.linalg.norm(q)).tolist())


def rotation(q):
    return Rotation.from_quat(q, scalar_first=True)


def drawn(seed):
    return vector(*np.random.default_rng([seed, 1]).normal(size=3).tolist())


@given(seeds, seeds)
@settings(max_examples=either(200, 16), deadline=None)
def test_product_turns_by_the_second_factor_first(a_seed, b_seed):
    a, b = attitude(a_seed), attitude(b_seed)
    product = multiply(a, b)
    matrix = rotation(a).as_matrix() @ rotation(b).as_matrix()
    assert rotation(product).as_matrix() == pytest.approx(matrix, abs=1e-14)
    assert np.linalg.norm(product) == pytest.approx(1.0, abs=1e-14)


@given(seeds, seeds)
@settings(max_examples=either(200, 16), deadline=None)
def test_vectors_turn_as_matrices_turn_them(q_seed, v_seed):
    q, v = attitude(q_seed), drawn(v_seed)
    matrix = rotation(q).as_matrix()
    assert to_reference(q, v) == pytest.approx(matrix @ np.array(v), abs=4e-15 * np.linalg.norm(v))
    assert to_body(q, v) == pytest.approx(matrix.T @ np.array(v), abs=4e-15 * np.linalg.norm(v))


def test_quarter_turns_of_the_axes():
    """About z by a right angle, x becomes y and y becomes -x; the body sees the opposite."""
    q, x = vector(HALF, 0.0, 0.0, HALF), vector(1.0, 0.0, 0.0)
    assert to_reference(q, x) == pytest.approx([0.0, 1.0, 0.0], abs=1e-15)
    assert to_body(q, x) == pytest.approx([0.0, -1.0, 0.0], abs=1e-15)
    product = multiply(vector(0.0, 1.0, 0.0, 0.0), vector(0.0, 0.0, 1.0, 0.0))
    assert product == [0.0, 0.0, 0.0, 1.0]  # i j = k


def test_conjugate_turns_back():
    q, v = attitude(1), drawn(3)
    assert conjugate(q) == [q[0], -q[1], -q[2], -q[3]]
    assert to_reference(conjugate(q), v) == to_body(q, v)
    assert to_body(q, to_reference(q, v)) == pytest.approx(v, abs=1e-15)


@given(seeds, st.floats(-300.0, 300.0))
@settings(max_examples=either(200, 16), deadline=None)
def test_normalised_quaternions_keep_their_direction_at_any_size(seed, exponent):
    q = attitude(seed)
    assert normalise(10.0**exponent * q) == pytest.approx(q, abs=1e-15)


@pytest.mark.parametrize("bad", [[0.0] * 4, [math.inf, 0.0, 0.0, 0.0], [0.0, -math.inf, 1.0, 1.0]])
def test_what_has_no_direction_becomes_no_rotation(bad):
    assert normalise(vector(*bad)) == [1.0, 0.0, 0.0, 0.0]


@given(seeds, st.floats(0.0, 3.14))
@settings(max_examples=either(300, 25), deadline=None)
def test_rotation_vectors_there_and_back(seed, angle):
    phi = drawn(seed)
    phi = vector(*(angle * np.array(phi) / np.linalg.norm(phi)).tolist())
    q = from_rotation_vector(phi)
    assert rotation(q).as_matrix() == pytest.approx(Rotation.from_rotvec(phi).as_matrix(), abs=2e-15)
    assert to_rotation_vector(q) == pytest.approx(phi, abs=2e-15 * (1.0 + angle))
    assert to_rotation_vector(-q) == pytest.approx(phi, abs=2e-15 * (1.0 + angle))  # the same attitude


@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-160, 1e-9, 1e-4])
def test_small_rotations_keep_their_relative_accuracy(size):
    q = from_rotation_vector(vector(0.6 * size, 0.0, -0.8 * size))
    assert q == pytest.approx([math.cos(size / 2), 0.3 * size, 0.0, -0.4 * size], rel=1e-8)
    assert q[1] == pytest.approx(0.6 * math.sin(size / 2), rel=1e-15, abs=0.0)
    assert to_rotation_vector(q) == pytest.approx([0.6 * size, 0.0, -0.8 * size], rel=1e-15, abs=0.0)


@given(seeds, st.floats(0.0, math.pi))
@settings(max_examples=either(100, 8), deadline=None)
def test_more_than_half_a_turn_comes_back_the_shorter_way(seed, angle):
    axis = np.array(drawn(seed))
    axis /= np.linalg.norm(axis)
    q = from_rotation_vector(vector(*(axis * (math.tau - angle))))
    back = to_rotation_vector(q)
    assert Rotation.from_rotvec(back).as_matrix() == pytest.approx(rotation(q).as_matrix(), abs=2e-15)
    assert np.linalg.norm(back) <= math.pi + 1e-15


@given(seeds, seeds)
@settings(max_examples=either(200, 16), deadline=None)
def test_difference_leads_from_the_one_to_the_other(reference_seed, q_seed):
    reference, q = attitude(reference_seed), attitude(q_seed)
    error = difference(reference, q)
    repeated = multiply(reference, error)
    assert error[0] >= 0.0
    assert rotation(repeated).as_matrix() == pytest.approx(rotation(q).as_matrix(), abs=1e-14)


@given(seeds, seeds, st.floats(0.0, 3.1))
@settings(max_examples=either(200, 16), deadline=None)
def test_angle_error_is_the_axis_times_the_sine(reference_seed, axis_seed, angle):
    reference, axis = attitude(reference_seed), np.array(drawn(axis_seed))
    axis /= np.linalg.norm(axis)
    q = (rotation(reference) * Rotation.from_rotvec(angle * axis)).as_quat(scalar_first=True)
    q = vector(*q)
    assert angle_error(reference, q) == pytest.approx(math.sin(angle) * axis, abs=2e-15)
    assert angle_error(reference, -q) == pytest.approx(math.sin(angle) * axis, abs=2e-15)


@given(seeds, st.floats(0.0, 3.1415))  # at half a turn either way is the shorter one
@settings(max_examples=either(100, 8), deadline=None)
def test_rodrigues_parameters_are_the_axis_times_the_tangent_of_a_quarter(seed, angle):
    axis = np.array(drawn(seed))
    axis /= np.linalg.norm(axis)
    sigma = to_rodrigues(from_rotation_vector(vector(*(angle * axis))))
    assert sigma == pytest.approx(math.tan(0.25 * angle) * axis, abs=2e-15)


def test_rate_is_half_the_product_with_the_body_rate():
    """q' = q w/2 with body rates: a steady spin is the exponential of its cross-product matrix from the right."""
    start, w = attitude(5), np.array([0.3, -0.2, 0.5])
    cross = np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])
    h = 1e-5
    product = multiply(start, vector(0.0, *(0.5 * w)))
    stepped = np.array(start) + h * np.array(product)
    matrix = rotation(start).as_matrix() @ expm(cross * h)
    assert rotation(stepped).as_matrix() == pytest.approx(matrix, abs=h * h)
