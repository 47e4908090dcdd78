"""Kalman filter: `mathlib.estimation.kalman` against filterpy, random systems of one to fifteen states.

Truth: `filterpy.kalman.KalmanFilter` with its matrix inverse, and the information form of the update by
numpy; tolerance 1e-10 of the largest element. The covariance stays symmetric to 1e-12 of its largest
element and positive over thousands of steps, with nearly perfect measurements too.
"""

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.estimation.kalman import correct, innovation_variance, predict, update


def random_system(generator, n):
    """x, P, F, Q of n states: stable F, full positive P and Q."""
    f = generator.normal(size=(n, n))
    f *= 0.95 / max(abs(np.linalg.eigvals(f)))
    root = generator.normal(size=(n, n))
    noise = generator.normal(size=(n, n))
    return generator.normal(size=n), root @ root.T + np.eye(n), f, 0.1 * noise @ noise.T + 0.01 * np.eye(n)


def assert_close(actual, expected, tolerance=1e-10):
    expected = np.asarray(expected).ravel()
    assert np.asarray(actual) == pytest.approx(expected, rel=0.0, abs=tolerance * max(1.0, abs(expected).max()))


@pytest.mark.parametrize("n", range(1, 16))
def test_predict_and_scalar_updates_follow_filterpy(n):
    generator = np.random.default_rng(100 + n)
    x, p, f, q = random_system(generator, n)
    mine_x, mine_p = x.tolist(), p.ravel().tolist()
    reference = KalmanFilter(dim_x=n, dim_z=1)
    reference.x, reference.P, reference.F, reference.Q = x.reshape(n, 1), p.copy(), f, q
    for _ in range(30):
        predict(mine_x, mine_p, f.ravel().tolist(), q.ravel().tolist(), n)
        reference.predict()
        h = generator.normal(size=n)
        variance = float(generator.uniform(0.05, 2.0))
        z = float(generator.normal())
        nis = update(mine_x, mine_p, h.tolist(), variance, z, n)
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
    mine_x, mine_p = x.tolist(), p.ravel().tolist()
    for k in range(3):
        update(mine_x, mine_p, rows[k].tolist(), float(variances[k]), float(z[k]), n)
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
    mine_p = p.ravel().tolist()
    nis = update(x.tolist(), mine_p, generator.normal(size=n).tolist(), 0.5, 1.0, n)
    after = np.array(mine_p).reshape(n, n)
    assert nis >= 0.0
    assert np.linalg.eigvalsh(0.5 * (after + after.T)).min() > 0.0
    assert np.linalg.eigvalsh(p - 0.5 * (after + after.T)).min() > -1e-10 * abs(p).max()


@pytest.mark.parametrize("n", [1, 6, 15])
def test_an_update_in_two_parts_is_the_update(n):
    generator = np.random.default_rng(300 + n)
    x, p, _, _ = random_system(generator, n)
    h = generator.normal(size=n)
    whole_x, whole_p = x.tolist(), p.ravel().tolist()
    nis = update(whole_x, whole_p, h.tolist(), 0.3, 2.0, n)
    ph = [0.0] * n
    parted_p = p.ravel().tolist()
    s = innovation_variance(parted_p, h.tolist(), ph, 0.3, n)
    assert s == pytest.approx(h @ p @ h + 0.3)
    assert parted_p == p.ravel().tolist()
    correction = [0.0] * n
    correct(correction, parted_p, h.tolist(), ph, 2.0 - h @ x, s, 0.3, n)
    assert_close(x + correction, whole_x)
    assert_close(parted_p, whole_p)
    assert (2.0 - h @ x) ** 2 / s == pytest.approx(nis)


def test_nothing_beyond_n_states_is_touched():
    x = [1.0, 2.0, 99.0]
    p = [2.0, 0.5, 0.5, 3.0, 99.0, 99.0]
    predict(x, p, [1.0, 0.1, 0.0, 1.0], [0.0] * 4, 2)
    update(x, p, [1.0, 0.0], 1.0, 0.0, 2)
    assert x[2:] == [99.0]
    assert p[4:] == [99.0, 99.0]


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
    p = np.diag([1e6] * 3 + [1e-6] * 3).ravel().tolist()
    x = [0.0] * n
    rows = np.eye(n).tolist()
    for _ in range(1500):
        predict(x, p, f.ravel().tolist(), (1e-6 * q).ravel().tolist(), n)
        for i in range(3):
            assert update(x, p, rows[i], variance, 0.0, n) >= 0.0
    matrix = np.array(p).reshape(n, n)
    scale = np.sqrt(np.outer(matrix.diagonal(), matrix.diagonal()))
    assert abs((matrix - matrix.T) / scale).max() < 1e-12
    assert np.linalg.eigvalsh(0.5 * (matrix + matrix.T) / scale).min() > 0.0
