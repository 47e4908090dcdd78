"""`perilune.fmus_src.mathlib.estimation.tracking`: covariance of value, rate and disturbance.

Truth: `filterpy.kalman.KalmanFilter` with `Q_continuous_white_noise`, to 1e-10 relative; the steady state by scipy's
discrete Riccati equation; a straight line fitted to samples by least squares, for systems without process noise.
"""

import numpy as np
import pytest
from filterpy.common import Q_continuous_white_noise
from filterpy.kalman import KalmanFilter
from scipy.linalg import solve_discrete_are

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib.estimation.tracking import measure_chain, predict_pair, predict_triple


def matrices(rate_noise, disturbance_noise, h, n):
    f = np.array([[1.0, h, 0.5 * h * h], [0.0, 1.0, h], [0.0, 0.0, 1.0]])[:n, :n]
    q = np.zeros((n, n))
    q[:2, :2] = Q_continuous_white_noise(dim=2, dt=h, spectral_density=rate_noise)
    if n == 3:
        q += Q_continuous_white_noise(dim=3, dt=h, spectral_density=disturbance_noise)
    return f, q


def predict(p, rate_noise, disturbance_noise, h):
    """Return the covariance of two or of three ahead."""
    return predict_pair(p, rate_noise, h) if len(p) == 2 else predict_triple(p, rate_noise, disturbance_noise, h)


@pytest.mark.parametrize("n", [2, 3])
def test_follows_filterpy(n):
    generator = np.random.default_rng(n)
    root = generator.normal(size=(n, n))
    reference = KalmanFilter(dim_x=n, dim_z=1)
    reference.P = root @ root.T + np.eye(n)
    reference.H = np.eye(n)[:1]
    p = Matrix(reference.P.tolist())
    for _ in range(100):
        h, rate_noise, disturbance_noise, variance = generator.uniform(0.1, 2.0, 4)
        f, q = matrices(rate_noise, disturbance_noise, h, n)
        reference.predict(F=f, Q=q)
        p = predict(p, rate_noise, disturbance_noise, h)
        assert np.ravel(p) == pytest.approx(reference.P.ravel(), rel=1e-10)
        reference.update(1.0, R=variance)
        gain, p, s = measure_chain(p, variance)
        assert s == pytest.approx(reference.S[0, 0], rel=1e-10)
        assert np.ravel(gain) == pytest.approx(reference.K.ravel(), rel=1e-9)
        assert np.ravel(p) == pytest.approx(reference.P.ravel(), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("n", [2, 3])
def test_settles_where_the_riccati_equation_says(n):
    h, rate_noise, disturbance_noise, variance = 0.5, 0.02, 0.003, 0.7
    f, q = matrices(rate_noise, disturbance_noise, h, n)
    p = Matrix(np.eye(n).tolist())
    for _ in range(2000):
        _, p, _ = measure_chain(p, variance)
        p = predict(p, rate_noise, disturbance_noise, h)
    expected = solve_discrete_are(f.T, np.eye(n)[:1].T, q, np.array([[variance]]))
    assert np.ravel(p) == pytest.approx(expected.ravel(), rel=1e-9)


def test_without_process_noise_it_is_a_fitted_line():
    """Variances of value at the end and slope of a line through k samples: numpy's least squares."""
    h, variance = 1.0, 0.25
    p = Matrix([[1e12, 0.0], [0.0, 1e12]])
    for k in range(1, 50):
        _, p, _ = measure_chain(p, variance)
        if k > 2:
            times = h * np.arange(1 - k, 1)
            design = np.column_stack([np.ones(k), times])
            assert np.ravel(p) == pytest.approx(variance * np.linalg.inv(design.T @ design).ravel(), rel=1e-3)
        p = predict(p, 0.0, 0.0, h)
