"""`perilune.fmus_src.mathlib.estimation.directions`: measured directions in a filter of attitude errors.

Truth: filterpy with three components at once, numpy's inverse, differences of scipy's rotations for the sensitivity.
"""

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.kernel.matrices import Matrix, zeros
from perilune.fmus_src.mathlib.estimation.directions import innovation, sensitivity, squared_distance, update_three
from perilune.fmus_src.mathlib.vectors import vector

seeds = st.integers(0, 2**32 - 1)


def case(seed):
    """Draw attitude, inertial direction, covariance."""
    random = np.random.default_rng(seed)
    root = random.normal(size=(6, 6))
    return Rotation.random(rng=random), random.normal(size=3), root @ root.T + np.eye(6), random


@given(seeds)
def test_sensitivity_is_the_slope_of_the_predicted_direction(seed):
    """By central differences of a small rotation on the right; the bias has none."""
    attitude, direction, _, _ = case(seed)
    direction /= np.linalg.norm(direction)
    h = np.array(sensitivity(vector(*attitude.inv().apply(direction))).rows)
    step = 1e-5
    for k in range(3):
        turn = Rotation.from_rotvec(step * np.eye(3)[k])
        ahead, behind = ((attitude * turn ** (sign)).inv().apply(direction) for sign in (1, -1))
        assert h[:, k] == pytest.approx((ahead - behind) / (2.0 * step), abs=1e-9)
    assert not h[:, 3:].any()


@given(seeds)
def test_innovation_is_the_measured_direction_less_the_predicted_one(seed):
    attitude, direction, _, random = case(seed)
    measured = random.normal(size=3)
    q = vector(*attitude.as_quat(scalar_first=True))
    z = innovation(q, vector(*direction), vector(*measured))
    predicted = attitude.inv().apply(direction / np.linalg.norm(direction))
    assert [*z] == pytest.approx(measured / np.linalg.norm(measured) - predicted, abs=1e-14)


@given(seeds)
def test_three_scalars_are_as_three_at_once(seed):
    """State, covariance, and the sum of normalised squares, which is the squared distance."""
    attitude, direction, p, random = case(seed)
    h = sensitivity(vector(*attitude.inv().apply(direction)))
    variances, z = random.uniform(0.1, 2.0, 3), random.normal(size=3)
    reference = KalmanFilter(dim_x=6, dim_z=3)
    reference.P, reference.H, reference.R = p.copy(), np.array(h.rows), np.diag(variances)
    reference.update(z)
    x, corrected, square = update_three(zeros(6, 1), Matrix(p.tolist()), h, vector(*variances), vector(*z))
    assert np.ravel(x.rows) == pytest.approx(reference.x.ravel(), rel=1e-8, abs=1e-10)
    assert np.array(corrected.rows) == pytest.approx(reference.P, rel=1e-8, abs=1e-10)
    distance = z @ np.linalg.inv(reference.S) @ z
    assert square == pytest.approx(distance, rel=1e-8)
    assert squared_distance(Matrix(p.tolist()), h, vector(*variances), vector(*z)) == pytest.approx(distance, rel=1e-8)
