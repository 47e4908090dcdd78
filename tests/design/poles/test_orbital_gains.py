"""Gains for the orbital attitude of a spacecraft without yaw measurement, compared with numbers from elsewhere.

In the orbital frame, with absolute rates, x = (roll, yaw, pitch, rates - reference rates) and u = torques; all states
except yaw are measured. The model is linear about the reference state: A = [A11 I; A21 A22], B = [0; J^-1], where [v]
is the matrix of v x,

    A11 = [0 -w0 0; w0 0 0; 0 0 0]    A22 = J^-1 ([J wp] - [wp] J)    wp = (0, 0, -w0)    e2 = (0, 1, 0)
    A21 = 3 w0^2 J^-1 ([e2] J - [J e2]) [0 0 1; 0 0 0; -1 0 0].

The numbers are from the specification of the task; the closed forms of gains are for one unmeasured state.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from perilune import modal
from tests.support.modal.draws import pole_error

INERTIA = np.array([[6500.0, -150.0, -100.0], [-150.0, 30000.0, -200.0], [-100.0, -200.0, 29000.0]])  # kg m^2
ORBIT = 0.0011  # w0, rad/s
PERIOD = 0.2  # s
YAW, MEASURED = 1, [0, 2, 3, 4, 5]
I3, I6, ZERO = np.eye(3), np.eye(6), np.zeros((3, 3))


def cross_matrix(v: np.ndarray) -> np.ndarray:
    """Return [v] with [v] x = v x x."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def plant() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return A, B, C."""
    inverse, desired, up = np.linalg.inv(INERTIA), np.array([0.0, 0.0, -ORBIT]), np.array([0.0, 1.0, 0.0])
    kinematics = np.array([[0.0, -ORBIT, 0.0], [ORBIT, 0.0, 0.0], [0.0, 0.0, 0.0]])
    gyroscopic = inverse @ (cross_matrix(INERTIA @ desired) - cross_matrix(desired) @ INERTIA)
    tilt = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
    gradient = 3.0 * ORBIT**2 * inverse @ (cross_matrix(up) @ INERTIA - cross_matrix(INERTIA @ up)) @ tilt
    return np.block([[kinematics, I3], [gradient, gyroscopic]]), np.vstack([ZERO, inverse]), I6[MEASURED]


A, B, C = plant()


def test_the_plant_is_that_of_diagonal_inertia_in_scalars() -> None:
    """Rates of the specification's scalar equations, for the diagonal of J; the smallest singular value of [C; CA]."""
    jx, jy, jz = np.diag(INERTIA)
    products = INERTIA - np.diag(np.diag(INERTIA))
    scalar = np.zeros((3, 6))
    scalar[0, [0, 4]] = np.array([3.0 * ORBIT**2, -ORBIT]) * (jy - jz) / jx
    scalar[1, 3] = -ORBIT * (jz - jx) / jy
    scalar[2, 2] = 3.0 * ORBIT**2 * (jy - jx) / jz
    # off-diagonal inertia changes the rates in proportion
    np.testing.assert_allclose(A[3:], scalar, atol=5.0 * ORBIT * np.max(np.abs(products)) / jx)
    assert np.linalg.svd(np.vstack([C, C @ A]), compute_uv=False)[-1] == pytest.approx(7.8e-4, rel=0.01)


def test_modal_regulator_with_levels_angles_and_rates() -> None:
    """u = J ((N A11 - S0 N - A21) a + (N + S0 - A22) (w - wp)), N = S1 - A11."""
    angles, rates = -np.diag([0.10, 0.08, 0.10]), -np.diag([0.15, 0.12, 0.15])
    actual = modal.place_levels(A, B, [rates, angles], bases=[I6[:, 3:], I6[:, :3]])
    gains = [
        (-97.4628, 3.2273, 1.5004, -1625, 38.25, 24.56),
        (-4.3507, -288.0050, 2.9993, 29.25, -6000, 50.22),
        (1.5442, 1.8923, -435.0853, 25.44, 39.78, -7250),
    ]
    np.testing.assert_allclose(-actual.gain[:, :3], np.array(gains)[:, :3], atol=5.01e-5)
    np.testing.assert_allclose(-actual.gain[:, 3:], np.array(gains)[:, 3:], atol=5.01e-3)
    n = angles - A[:3, :3]
    closed = INERTIA @ np.hstack([n @ A[:3, :3] - rates @ n - A[3:, :3], n + rates - A[3:, 3:]])
    np.testing.assert_allclose(-actual.gain, closed, rtol=1e-10, atol=1e-9)
    assert pole_error(A - B @ actual.gain, [-0.10, -0.08, -0.10, -0.15, -0.12, -0.15]) < 1e-8


@pytest.mark.parametrize(("slow", "fast"), [(0.1, 1.0), (0.04, 0.3)])
def test_observer_1_continuous_of_full_order(slow: float, fast: float) -> None:
    """L = (A + mu I)(C' + ey l), l = (-lambda/w0, 0, 0, 0, 0): levels of 5 and 1."""
    actual = modal.observer(A, C, [-slow, *[-fast] * 5])
    assert actual.method == "multilevel"
    row = np.array([-slow / ORBIT, 0.0, 0.0, 0.0, 0.0])
    expected = (A + fast * I6) @ (C.T + np.outer(I6[YAW], row))
    np.testing.assert_allclose(actual.gain, expected, rtol=1e-9, atol=1e-12)
    assert actual.gain[YAW, 0] == pytest.approx(ORBIT - fast * slow / ORBIT, rel=1e-12)
    # the same from multiples of I on the dual's levels
    dual = modal.place_levels(A.T, C.T, [-fast * np.eye(5), [[-slow]]])
    np.testing.assert_allclose(dual.gain.T, actual.gain, rtol=1e-9, atol=1e-12)


def test_the_yaw_row_of_observer_1() -> None:
    assert modal.observer(A, C, [-0.1, *[-1.0] * 5]).gain[YAW, 0] == pytest.approx(-90.908, abs=5e-4)


def test_observer_3_continuous_of_reduced_order() -> None:
    """Lr = -lambda/w0 on roll; the error decays with lambda."""
    actual = modal.reduced_observer(A, C, [-0.1], b=B)
    # W is the yaw axis up to its sign, which changes that of Lr
    np.testing.assert_allclose(actual.of_zeta[YAW] @ actual.gain, [-0.1 / ORBIT, 0, 0, 0, 0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(actual.closed_loop, [[-0.1]], rtol=1e-12)


def test_observer_4_discrete_of_full_order() -> None:
    """Ad Ld is the dual placement for (Ad, C); Ld = (I - exp(-mu T) Ad^-1)(C' + ey ld)."""
    sampled = expm(A * PERIOD)
    slow, fast = np.exp(-0.1 * PERIOD), np.exp(-1.0 * PERIOD)
    dual = modal.place_levels(sampled.T, C.T, [fast * np.eye(5), [[slow]]])
    gain = np.linalg.solve(sampled, dual.gain.T)
    observed = C @ sampled @ I6[YAW]
    row = (sampled[YAW, YAW] - slow) * observed / (observed @ observed)
    expected = (I6 - fast * np.linalg.inv(sampled)) @ (C.T + np.outer(I6[YAW], row))
    np.testing.assert_allclose(gain, expected, rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(gain[YAW], [-16.3151, 0.0, 0.0, 0.1637, 0.0], atol=5.5e-5)
    np.testing.assert_allclose(gain[0], [0.19748, 0.0, 0.16375, 0.0, 0.0], atol=2.5e-5)
    # five times exp(-mu T): the product over the distinct poles is zero
    loop = (I6 - gain @ C) @ sampled
    left = np.linalg.matrix_power(loop - fast * I6, 2) @ (loop - slow * I6)
    assert np.linalg.norm(left, 2) < 1e-12 * np.linalg.norm(loop, 2) ** 3


def test_a_tick_of_pulses_about_the_wanted_state() -> None:
    """Derivatives of the whole motion over a tick, split at the switch-offs, equal expm(A T)."""
    desired = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -ORBIT])

    def rate(x: np.ndarray, u: np.ndarray) -> np.ndarray:
        (sg, sy, st), (cg, cy, ct) = np.sin(x[:3]), np.cos(x[:3])
        w = x[3:]
        q, r = w[1] * cg - w[2] * sg, w[1] * sg + w[2] * cg
        angles = [w[0] - st / ct * q - ORBIT * sy / ct, q / ct + ORBIT * sy * st / ct, r + ORBIT * cy]
        up = np.array([st, cg * ct, -sg * ct])
        torque = 3.0 * ORBIT**2 * np.cross(up, INERTIA @ up) + np.cross(INERTIA @ w, w) + u
        return np.concatenate([angles, np.linalg.solve(INERTIA, torque)])

    state = np.array([*np.radians([3.0, 17.0, 3.0]), *np.radians([0.01, 0.01, 0.01])])
    after = modal.pulsed_step(rate, state, [0.05, 0.10, 0.20], [60.0, -120.0, 120.0], PERIOD, longest=0.1)
    np.testing.assert_allclose(after[:3], [0.0524126433, 0.2966790547, 0.0526863802], atol=6e-11)
    np.testing.assert_allclose(after[3:], [6.3971448538e-4, -2.1757498780e-4, 1.00106776457e-3], rtol=0.0, atol=6e-14)
    h = 1e-4
    for i in range(6):
        one, other = (
            modal.pulsed_step(rate, desired + step * I6[i], [0.05, 0.1, 0.2], np.zeros(3), PERIOD) for step in (h, -h)
        )
        np.testing.assert_allclose((one - other) / (2.0 * h), expm(A * PERIOD)[:, i], atol=3e-9)
