"""`perilune.fmus_src.mathlib.estimation.kalman`: Kalman filter for random systems of one to fifteen states.

Truth: `filterpy.kalman.KalmanFilter` with its matrix inverse, and the information form of the update by numpy;
tolerance 1e-10 of the largest element. The covariance stays symmetric to 1e-12 of its largest element and positive
definite over thousands of steps, also with nearly perfect measurements.
"""

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib.estimation.kalman import innovation_variance, predict, update, update_covariance


def random_system(generator, n):
    """Draw x, P, F, Q of n states: stable F, full positive P and Q."""
    f = generator.normal(size=(n, n))
    f *= 0.95 / max(abs(np.linalg.eigvals(f)))
    root = generator.normal(size=(n, n))
    noise = generator.normal(size=(n, n))
    return generator.normal(size=n), root @ root.T + np.eye(n), f, 0.1 * noise @ noise.T + 0.01 * np.eye(n)


def column(x):
    """Return a column of ours."""
    return Matrix([[element] for element in x.tolist()])


def row(h):
    """Return a row of ours."""
    return Matrix([h.tolist()])


def assert_close(actual, expected, tolerance=1e-10):
    expected = np.asarray(expected).ravel()
    assert np.asarray(actual).ravel() == pytest.approx(expected, rel=0.0, abs=tolerance * max(1.0, abs(expected).max()))


@pytest.mark.parametrize("n", range(1, 16))
def test_predict_and_scalar_updates_follow_filterpy(n):
    generator = np.random.default_rng(100 + n)
    x, p, f, q = random_system(generator, n)
    mine_x, mine_p = column(x), Matrix(p.tolist())
    reference = KalmanFilter(dim_x=n, dim_z=1)
    reference.x, reference.P, reference.F, reference.Q = x.reshape(n, 1), p.copy(), f, q
    for _ in range(30):
        mine_x, mine_p = Matrix(f.tolist()) @ mine_x, predict(mine_p, Matrix(f.tolist()), Matrix(q.tolist()))
        reference.predict()
        h = generator.normal(size=n)
        variance = float(generator.uniform(0.05, 2.0))
        z = float(generator.normal())
        mine_x, mine_p, nis = update(mine_x, mine_p, row(h), variance, z)
        reference.update(np.array([[z]]), R=np.array([[variance]]), H=h.reshape(1, n))
        assert_close(mine_x, reference.x)
        assert_close(mine_p, reference.P)
        assert nis == pytest.approx((reference.y.T @ reference.SI @ reference.y).item(), rel=1e-9)


@pytest.mark.parametrize("n", [2, 6, 9, 15])
def test_scalars_one_after_another_equal_one_vector_measurement(n):
    generator = np.random.default_rng(200 + n)
    x, p, _, _ = random_system(generator, n)
    rows = generator.normal(size=(3, n))
    variances = generator.uniform(0.1, 1.0, size=3)
    z = generator.normal(size=3)
    mine_x, mine_p = column(x), Matrix(p.tolist())
    for k in range(3):
        mine_x, mine_p, _ = update(mine_x, mine_p, row(rows[k]), float(variances[k]), float(z[k]))
    reference = KalmanFilter(dim_x=n, dim_z=3)
    reference.x, reference.P = x.reshape(n, 1), p.copy()
    reference.update(z.reshape(3, 1), R=np.diag(variances), H=rows)
    assert_close(mine_x, reference.x)
    assert_close(mine_p, reference.P)
    information = np.linalg.inv(p) + rows.T @ np.diag(1.0 / variances) @ rows
    assert_close(mine_p, np.linalg.inv(information))
    assert_close(mine_x, np.linalg.solve(information, np.linalg.solve(p, x) + rows.T @ (z / variances)))


@given(st.integers(1, 15), st.integers(0, 2**32 - 1))
@settings(max_examples=40, deadline=None)
def test_update_never_adds_variance_in_any_direction(n, seed):
    generator = np.random.default_rng(seed)
    x, p, _, _ = random_system(generator, n)
    _, mine_p, nis = update(column(x), Matrix(p.tolist()), row(generator.normal(size=n)), 0.5, 1.0)
    after = np.array(mine_p)
    assert nis >= 0.0
    assert np.linalg.eigvalsh(0.5 * (after + after.T)).min() > 0.0
    assert np.linalg.eigvalsh(p - 0.5 * (after + after.T)).min() > -1e-10 * abs(p).max()


@pytest.mark.parametrize("n", [1, 6, 15])
def test_an_update_in_two_steps_is_the_update(n):
    generator = np.random.default_rng(300 + n)
    x, p, _, _ = random_system(generator, n)
    h = generator.normal(size=n)
    before = Matrix(p.tolist())
    whole_x, whole_p, nis = update(column(x), before, row(h), 0.3, 2.0)
    s = innovation_variance(before, row(h), 0.3)
    assert s == pytest.approx(h @ p @ h + 0.3)
    gain, parted_p = update_covariance(before, row(h), s, 0.3)
    assert before == Matrix(p.tolist())
    assert_close(x + (2.0 - h @ x) * np.ravel(gain), whole_x)
    assert_close(parted_p, whole_p)
    assert (2.0 - h @ x) ** 2 / s == pytest.approx(nis)


@pytest.mark.parametrize("variance", [1.0, 1e-12])
def test_covariance_stays_symmetric_and_positive_over_thousands_of_steps(variance):
    """Double integrators, ill conditioned: 1 km and 1 mm/s at first, then nearly perfect positions."""
    n = 6
    step = 0.2
    f = np.eye(n)
    q = np.zeros((n, n))
    for i in range(3):
        f[i, 3 + i] = step
        q[i, i], q[i, 3 + i], q[3 + i, i], q[3 + i, 3 + i] = step**3 / 3, step**2 / 2, step**2 / 2, step
    p = Matrix(np.diag([1e6] * 3 + [1e-6] * 3).tolist())
    x = column(np.zeros(n))
    rows = np.eye(n)
    for _ in range(1500):
        p = predict(p, Matrix(f.tolist()), Matrix((1e-6 * q).tolist()))
        for i in range(3):
            x, p, square = update(x, p, row(rows[i]), variance, 0.0)
            assert square >= 0.0
    matrix = np.array(p)
    scale = np.sqrt(np.outer(matrix.diagonal(), matrix.diagonal()))
    assert abs((matrix - matrix.T) / scale).max() < 1e-12
    assert np.linalg.eigvalsh(0.5 * (matrix + matrix.T) / scale).min() > 0.0
