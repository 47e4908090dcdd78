"""Second-order cones: Nesterov-Todd scaling, product, and step to the boundary. Truth: numpy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.lunar.convex.cones import (
    AXIS,
    CENTRE,
    CORRECTION,
    FACTOR,
    FIELDS,
    LAMBDA,
    MULTIPLIER,
    RESIDUAL,
    SCALED_SLACK,
    SHIFT,
    SLACK,
    SLACK_STEP,
    add_weighted,
    divide_by_lambda,
    inverse_step,
    scale_cone,
    scale_down,
    scale_up,
    weight_at,
)

ROW = 10
numbers = st.floats(-1.0, 1.0)


@st.composite
def cones(draw):
    """Draw slack and multiplier inside a cone of one, three or four rows, and any direction."""
    size = draw(st.sampled_from([1, 3, 4]))
    rows = []
    for _ in range(2):
        side = np.array(draw(st.lists(numbers, min_size=size - 1, max_size=size - 1)))
        head = np.linalg.norm(side) + draw(st.floats(1e-2, 2.0))
        rows.append(draw(st.floats(1e-2, 1e2)) * np.concatenate([[head], side]))
    return rows[0], rows[1], np.array(draw(st.lists(numbers, min_size=size, max_size=size)))


def scaled(slack, multiplier):
    c = [0.0] * FIELDS
    for i in range(len(slack)):
        c[SLACK + ROW + i] = float(slack[i])
        c[MULTIPLIER + ROW + i] = float(multiplier[i])
    assert scale_cone(c, ROW, len(slack))
    return c


def put(c, field, values):
    c[field + ROW : field + ROW + len(values)] = [float(value) for value in values]


def get(c, field, size):
    return np.array(c[field + ROW : field + ROW + size])


def product(x, y):
    """Return the product of the cone's algebra."""
    return np.concatenate([[x @ y], x[0] * y[1:] + y[0] * x[1:]])


@given(cones())
def test_scaling_makes_slack_and_multiplier_one(cone):
    """W zeta = W^-1 s = lambda; W^-2 is what applies W^-1 twice, and its elements are those of a matrix."""
    slack, multiplier, direction = cone
    size = len(slack)
    c = scaled(slack, multiplier)
    scale = np.abs(get(c, LAMBDA, size)).max()
    scale_down(c, ROW, size, SLACK, SHIFT)
    assert get(c, SHIFT, size) == pytest.approx(get(c, LAMBDA, size), abs=1e-9 * scale)
    put(c, RESIDUAL, direction)
    scale_down(c, ROW, size, RESIDUAL, SHIFT)
    scale_down(c, ROW, size, SHIFT, SHIFT)
    twice = get(c, SHIFT, size)
    matrix = np.array([[weight_at(c, ROW, i, j) for j in range(size)] for i in range(size)])
    assert matrix @ direction == pytest.approx(twice, abs=1e-9 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix).min() > 0.0
    put(c, SHIFT, np.ones(size))
    add_weighted(c, ROW, size, -2.0, RESIDUAL, SHIFT)
    assert get(c, SHIFT, size) == pytest.approx(1.0 - 2.0 * twice, abs=1e-8 * np.abs(matrix).max())
    scale_up(c, ROW, size, RESIDUAL, SHIFT)
    scale_down(c, ROW, size, SHIFT, SHIFT)
    assert get(c, SHIFT, size) == pytest.approx(direction, abs=1e-7)
    assert c[FACTOR + ROW] > 0.0
    assert c[CENTRE + ROW] >= 1.0 - 1e-12
    assert c[AXIS + ROW] >= 1.0 - 1e-12


@given(cones())
def test_division_undoes_the_product(cone):
    slack, multiplier, direction = cone
    size = len(slack)
    c = scaled(slack, multiplier)
    middle = get(c, LAMBDA, size)
    put(c, CORRECTION, product(middle, direction))
    divide_by_lambda(c, ROW, size)
    assert get(c, CORRECTION, size) == pytest.approx(direction, abs=1e-7)


@given(cones())
def test_the_largest_step_ends_on_the_boundary(cone):
    """Lambda and so much of the direction has the eigenvalue 0, or none is reached at all."""
    slack, multiplier, direction = cone
    size = len(slack)
    c = scaled(slack, multiplier)
    middle = get(c, LAMBDA, size)
    put(c, SLACK_STEP, direction)
    put(c, SCALED_SLACK, direction)
    inverse = inverse_step(c, ROW, size, SCALED_SLACK)
    if inverse <= 1e-6 * np.abs(direction).max() / middle[0]:
        far = middle + 1e3 * middle[0] * direction
        assert far[0] - np.linalg.norm(far[1:]) > -1e-2 * np.abs(far).max()
        return
    end = middle + direction / inverse
    assert end[0] == pytest.approx(np.linalg.norm(end[1:]), abs=1e-7 * np.abs(end).max() + 1e-9 * np.abs(middle).max())


def test_a_boundary_has_no_scaling():
    c = [0.0] * FIELDS
    put(c, SLACK, [5.0, 3.0, 4.0])
    put(c, MULTIPLIER, [2.0, 1.0, 1.0])
    assert not scale_cone(c, ROW, 3)
