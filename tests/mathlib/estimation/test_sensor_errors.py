"""`perilune.fmus_src.mathlib.estimation.sensor_errors`: common error models of sensors.

Truth: the moments of a stationary process, Python's fractions for rounding, numpy for limits and delays.
"""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.kernel.matrices import zeros
from perilune.fmus_src.mathlib.estimation.sensor_errors import (
    LATEST,
    add_cross,
    make_room,
    next_markov,
    quantise,
    saturate,
)
from perilune.fmus_src.mathlib.vectors import vector

numbers = st.floats(-1e3, 1e3)
ONE, ZERO = vector(1.0, 1.0, 1.0), vector(0.0, 0.0, 0.0)


@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3), st.floats(0.01, 100.0))
def test_a_gauss_markov_error_keeps_its_variance(elapsed, time, sigma):
    """Its decay is e^(-t/T); decay^2 sigma^2 and the new share are sigma^2 again."""
    decay, fresh = next_markov(ONE, elapsed, time, sigma, ZERO).x, next_markov(ZERO, elapsed, time, sigma, ONE).x
    assert decay == pytest.approx(math.exp(-elapsed / time), rel=1e-14)
    assert (decay * sigma) ** 2 + fresh**2 == pytest.approx(sigma**2, rel=1e-12)


@given(st.floats(0.1, 10.0), st.floats(0.1, 10.0))
def test_two_steps_are_one_of_both_lengths(first, second):
    """In decay, and in the variance of the new share."""
    decay = next_markov(next_markov(ONE, first, 3.0, 2.0, ZERO), second, 3.0, 2.0, ZERO).x
    assert decay == pytest.approx(next_markov(ONE, first + second, 3.0, 2.0, ZERO).x, rel=1e-13)
    early = next_markov(next_markov(ZERO, first, 3.0, 2.0, ONE), second, 3.0, 2.0, ZERO).x
    late = next_markov(ZERO, second, 3.0, 2.0, ONE).x
    assert math.hypot(early, late) == pytest.approx(next_markov(ZERO, first + second, 3.0, 2.0, ONE).x, rel=1e-12)


@given(st.lists(numbers, min_size=3, max_size=3), st.sampled_from([0.125, 0.1, 3.0, 1e-4]))
def test_steps_are_the_nearest_multiples(values, quantum):
    """Half a step away at the farthest, in exact fractions of the doubles but for one rounding."""
    for value, rounded in zip(values, quantise(vector(*values), quantum), strict=True):
        steps = round(rounded / quantum)
        assert rounded == quantum * steps
        assert abs(Fraction(value) / Fraction(quantum) - steps) <= Fraction(1, 2) + Fraction(1e-9)


def test_without_a_quantum_a_vector_stays():
    y = vector(0.1, -0.2, 0.3)
    assert [*quantise(y, 0.0)] == [*y]


@given(st.lists(numbers, min_size=3, max_size=3), st.floats(0.0, 1e3))
def test_limits(values, largest):
    assert [*saturate(vector(*values), largest)] == np.clip(values, -largest, largest).tolist()


@given(st.lists(numbers, min_size=9, max_size=9))
def test_a_small_rotation_adds_its_vector_product(values):
    a, rotation, f = np.reshape(values, (3, 3))
    actual = add_cross(vector(*a), vector(*rotation), vector(*f))
    assert [*actual] == pytest.approx(a + np.cross(rotation, f), rel=1e-14, abs=1e-9)


def test_samples_move_down():
    samples = zeros(LATEST + 1, 2)
    for k in range(8):
        make_room(samples, 2)
        samples[0, 0], samples[0, 1] = float(k), 10.0 * k
        expected = [max(k - i, 0) for i in range(LATEST + 1)]
        assert samples.rows == [[float(n), 10.0 * n] for n in expected]
