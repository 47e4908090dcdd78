"""`perilune.fmus_src.mathlib.vectors`: operations on vectors.

Truth: numpy's operators on arrays, bit for bit, for single operations per component; Python fractions (exact sums of
products) and exact cases for other functions. Tolerance: 4 rounding errors of the largest term.
"""

import copy
import math
import pickle
import struct
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.vectors import (
    Vector2,
    Vector3,
    Vector4,
    across,
    add_along,
    all_below,
    clip,
    cross,
    dot,
    is_finite,
    limit_length,
    norm,
    smallest_component,
    vector,
)

ROUNDING = 2.0**-53
components = st.floats(-1e6, 1e6).filter(lambda value: value == 0.0 or abs(value) > 1e-100)
vectors = st.builds(vector, components, components, components)
anything = st.floats(allow_nan=True, allow_infinity=True)
pairs = st.integers(2, 4).flatmap(
    lambda size: st.tuples(*[st.lists(anything, min_size=size, max_size=size) for _ in range(2)])
)


def bits(values):
    """Return floats as bytes; all NaNs are one."""
    return [b"nan" if math.isnan(value) else struct.pack("<d", value) for value in values]


@given(pairs, anything)
def test_operators_are_those_of_arrays_bit_for_bit(pair, number):
    a, b = (vector(*each) for each in pair)
    one, other = (np.array(each) for each in pair)
    with np.errstate(all="ignore"):
        assert bits(a + b) == bits(one + other)
        assert bits(a - b) == bits(one - other)
        assert bits(-a) == bits(-one)
        assert bits(a * b) == bits(one * other)
        assert bits(number * a) == bits(number * one)
        assert bits(a * number) == bits(one * number)
        if number != 0.0:
            assert bits(a / number) == bits(one / number)
        if 0.0 not in b.elements():
            assert bits(a / b) == bits(one / other)
    for result in (a + b, -a, number * a):
        assert type(result) is type(a)


def test_division_by_zero_is_that_of_floats():
    for divisor in (0.0, -0.0, 0, vector(1.0, 0.0, 2.0)):
        with pytest.raises(ZeroDivisionError):
            vector(1.0, 2.0, 3.0) / divisor


def test_vectors_read_like_sequences():
    q = vector(1.0, 2.0, 3.0, 4.0)
    assert (q.w, q.x, q.y, q.z) == (1.0, 2.0, 3.0, 4.0) == (q[0], q[1], q[2], q[-1])
    assert [type(part) for part in (q, q[1:4], q[2:4])] == [Vector4, Vector3, Vector2]
    assert q[1:4] == vector(2.0, 3.0, 4.0)
    w, x, y, z = q
    assert [w, x, y, z] == list(q)
    assert len(q) == 4
    assert np.array(q).tolist() == [1.0, 2.0, 3.0, 4.0]
    assert repr(q) == "vector(1.0, 2.0, 3.0, 4.0)"
    assert eval(repr(q)) == q
    assert hash(q) == hash(vector(1.0, 2.0, 3.0, 4.0))
    assert pickle.loads(pickle.dumps(q)) == copy.deepcopy(q) == q
    for bad in (lambda: q[4], lambda: q[0:1], lambda: vector(1.0)):
        with pytest.raises((IndexError, TypeError)):
            bad()


def test_vectors_do_not_change():
    a = vector(1.0, 2.0, 3.0)
    b = a
    b += vector(1.0, 1.0, 1.0)
    assert (a, b) == ([1.0, 2.0, 3.0], [2.0, 3.0, 4.0])
    with pytest.raises(TypeError):
        a[0] = 5.0
    with pytest.raises(TypeError):
        del a[0]


def test_sizes_do_not_mix():
    for bad in (
        lambda: vector(1.0, 2.0) + vector(1.0, 2.0, 3.0),
        lambda: vector(1.0, 2.0, 3.0) - vector(1.0, 2.0, 3.0, 4.0),
        lambda: vector(1.0, 2.0, 3.0) * vector(1.0, 2.0),
        lambda: vector(1.0, 2.0, 3.0) / vector(1.0, 2.0, 3.0, 4.0),
        lambda: vector(1.0, 2.0, 3.0) + 1.0,
        lambda: 1.0 / vector(1.0, 2.0, 3.0),
        lambda: vector(1.0, 2.0, 3.0) - [1.0, 2.0, 3.0],
        lambda: vector(1.0, 2.0) * vector(1.0, 2.0, 3.0),
    ):
        with pytest.raises(TypeError):
            bad()


def test_numbers_of_numpy_are_numbers_and_arrays_stay_arrays():
    a = vector(1.0, 2.0, 3.0)
    assert type(np.float64(2.0) * a) is Vector3
    assert type(a * np.float64(2.0)) is Vector3
    assert np.float64(2.0) * a == [2.0, 4.0, 6.0]
    assert np.subtract(np.ones(3), a).tolist() == [0.0, -1.0, -2.0]
    assert (np.eye(3) @ np.array(a)).tolist() == list(a)


@given(vectors, vectors)
def test_cross_is_that_of_numpy(a, b):
    assert list(cross(a, b)) == np.cross(list(a), list(b)).tolist()


@given(vectors, vectors)
def test_dot_is_the_exact_sum_rounded(a, b):
    terms = [Fraction(x) * Fraction(y) for x, y in zip(a, b, strict=True)]
    assert abs(Fraction(dot(a, b)) - sum(terms)) <= Fraction(4 * ROUNDING) * sum(abs(term) for term in terms)


@given(vectors)
def test_norm_is_the_exact_root_rounded(a):
    assert norm(a) == pytest.approx(math.hypot(*a), rel=4 * ROUNDING, abs=0.0)


@given(vectors, st.integers(-40, 40))
def test_norm_scales_exactly_by_powers_of_two(a, exponent):
    factor = 2.0**exponent
    assert norm(factor * a) == factor * norm(a)


def test_norms_of_whole_numbers():
    assert norm(vector(2.0, 3.0, 6.0)) == 7.0
    assert norm(vector(-1.0, 4.0, -8.0)) == 9.0
    assert norm(vector(0.0, 0.0, 0.0)) == 0.0


def test_whether_all_components_are_finite_or_small():
    for bad in (math.inf, -math.inf, math.nan):
        for k in range(3):
            values = [0.0, 1.0, -2.0]
            values[k] = bad
            assert not is_finite(vector(*values))
            assert not all_below(vector(*values), 1e300)
    assert is_finite(vector(1e308, -1e308, 0.0))
    assert all_below(vector(1.0, -2.9, 0.0, 2.0), 3.0)
    assert not all_below(vector(1.0, -3.0), 3.0)


@given(vectors)
def test_smallest_component_is_the_first_of_the_smallest(a):
    k, value = smallest_component(a)
    assert k == int(np.argmin(np.abs(list(a))))
    assert value == a[k]


def test_amounts_are_added_along_one_axis():
    for k in range(3):
        expected = [1.0, 2.0, -0.0]
        expected[k] += 0.5
        assert bits(add_along(vector(1.0, 2.0, -0.0), k, 0.5)) == bits(expected)


@given(components, components, st.floats(0.0, 1e6))
def test_clip_is_the_nearest_value_between_the_bounds(value, low, width):
    high = low + width
    assert clip(value, low, high) == sorted([low, value, high])[1]


@given(vectors, vectors.filter(lambda v: norm(v) > 1.0))
def test_the_part_across_a_direction_is_perpendicular_and_the_rest_parallel(a, along):
    direction = along / norm(along)
    part = across(a, direction)
    assert abs(dot(part, direction)) <= 8.0 * ROUNDING * norm(a)
    assert norm(cross(a - part, direction)) <= 8.0 * ROUNDING * norm(a)


@given(vectors, st.floats(0.0, 2e6))
def test_a_shortened_vector_keeps_its_direction(a, longest):
    actual = limit_length(a, longest)
    assert norm(actual) == pytest.approx(min(norm(a), longest), rel=1e-12)
    assert norm(cross(actual, a)) <= 8.0 * ROUNDING * norm(a) * norm(actual)
    if norm(a) <= longest:
        assert actual == a
