"""`perilune.fmus_src.mathlib.actuators.gyros`: a cluster of control moment gyros.

Truth: the Jacobian by complex steps, numpy's determinant, pseudo-inverse and solutions of linear systems, scipy's
brentq on the distribution law in its implicit form, and the published isotropic angles. Tolerance 1e-12 for rates and
for momenta, relative to one rotor.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from perilune.fmus_src.mathlib.actuators.gyros import (
    ISOTROPIC_ANGLES,
    ISOTROPIC_RHO,
    cluster_jacobian,
    cluster_momentum,
    distribute_angles,
    distribute_rates,
    robust_rates,
    singularity_measure,
)
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.lengths import either

RHO = ISOTROPIC_RHO
ISOTROPIC = vector(*ISOTROPIC_ANGLES)
seeds = st.integers(0, 2**32 - 1)


def complex_momentum(angles):
    """Return the cluster's momentum as printed, for complex angles too."""
    c, s = np.cos(angles), np.sin(angles)
    return np.array([c.sum(), s[0] + s[1], s[2] + s[3]])


def matrix(angles):
    steps = [complex_momentum(np.array(angles) + 1e-30j * np.eye(4)[i]).imag / 1e-30 for i in range(4)]
    return np.array(steps).T


def residual(angles):
    """Return the law u - v + rho (u v - 1), from the angles, which may be complex."""
    c, s = np.cos(angles), np.sin(angles)
    u = (c[0] + c[1]) / np.sqrt(4.0 - (s[0] + s[1]) ** 2)
    v = (c[2] + c[3]) / np.sqrt(4.0 - (s[2] + s[3]) ** 2)
    return u - v + RHO * (u * v - 1.0)


def direction(seed):
    sampled = np.random.default_rng(seed).normal(size=3)
    return sampled / np.linalg.norm(sampled)


def lawful_angles(momentum, rho=RHO, near=ISOTROPIC_ANGLES):
    possible, angles = distribute_angles(vector(*momentum), rho, vector(*near))
    assert possible
    return angles


def test_isotropic_angles_are_the_published_ones():
    assert np.degrees(ISOTROPIC_ANGLES) == pytest.approx([35.26, -35.26, 215.26, 144.74], abs=0.005)
    assert pytest.approx(2.0 * math.sqrt(6.0) / 5.0, abs=1e-16) == RHO
    jacobian = matrix(ISOTROPIC_ANGLES)
    assert complex_momentum(ISOTROPIC_ANGLES) == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)
    assert jacobian @ jacobian.T == pytest.approx(4.0 / 3.0 * np.eye(3), abs=1e-15)
    assert residual(ISOTROPIC_ANGLES) == pytest.approx(0.0, abs=1e-15)
    assert singularity_measure(ISOTROPIC) == pytest.approx(8.0 / math.sqrt(27.0), rel=1e-15)


@given(seeds)
@settings(max_examples=either(200, 16), deadline=None)
def test_momentum_jacobian_and_singularity(seed):
    angles = np.random.default_rng(seed).uniform(-7.0, 7.0, 4).tolist()
    angles = vector(*angles)
    momentum = cluster_momentum(angles)
    assert momentum == pytest.approx(complex_momentum(angles), abs=1e-15)
    expected = matrix(angles)
    assert np.asarray(cluster_jacobian(angles)) == pytest.approx(expected, abs=1e-15)
    determinant = np.linalg.det(expected @ expected.T)
    assert singularity_measure(angles) == pytest.approx(math.sqrt(max(determinant, 0.0)), abs=1e-7)


@given(seeds, st.floats(0.0, 1.9))
@settings(max_examples=either(500, 41), deadline=None)
def test_momentum_to_angles_and_back(seed, size):
    momentum = size * direction(seed)
    angles = lawful_angles(momentum)
    assert complex_momentum(angles) == pytest.approx(momentum, abs=1e-12)
    assert residual(angles) == pytest.approx(0.0, abs=1e-12)


@given(seeds, st.floats(0.0, 1.9), st.floats(0.0, 0.97))
@settings(max_examples=either(200, 16), deadline=None)
def test_explicit_solution_is_the_root_of_the_implicit_law(seed, size, rho):
    """x - u a = v b with v of the law: one root for u within -1 to 1, found by bisection."""
    x, y, z = size * direction(seed)
    a, b = math.sqrt(4.0 - y * y), math.sqrt(4.0 - z * z)

    def excess(u):
        return u * a + b * (u - rho) / (1.0 - rho * u) - x

    possible, angles = distribute_angles(vector(x, y, z), rho, ISOTROPIC)
    if not possible:
        assert excess(-1.0) * excess(1.0) > -1e-9  # no root
        return
    u = (math.cos(angles[0]) + math.cos(angles[1])) / a
    assert u == pytest.approx(brentq(excess, -1.0, 1.0, xtol=1e-14), abs=1e-10)


@given(seeds)
@settings(max_examples=either(100, 8), deadline=None)
def test_angles_come_by_whole_turns_nearest_to_those_before(seed):
    random = np.random.default_rng(seed)
    momentum = 1.5 * direction(seed)
    principal = np.array(lawful_angles(momentum))
    before = principal + math.tau * random.integers(-3, 4, 4) + random.uniform(-3.1, 3.1, 4)
    angles = np.array(lawful_angles(momentum, near=before))
    assert np.abs(angles - before).max() <= math.pi + 1e-12
    turns = (angles - principal) / math.tau
    assert turns == pytest.approx(np.round(turns), abs=1e-12)


@pytest.mark.parametrize(
    "momentum", [[0.0, 2.0, 0.0], [0.0, 0.0, -2.0], [0.0, 3.0, 0.0], [5.0, 0.0, 0.0], [4.0, 0.0, 0.1]]
)
def test_what_the_law_cannot_give_leaves_the_angles(momentum):
    possible, angles = distribute_angles(vector(*momentum), RHO, ISOTROPIC)
    assert not possible
    assert angles == ISOTROPIC


def test_law_stays_away_from_singular_states_below_its_bound():
    """Published: free of singularity for |h| < 1.96; the bound is 2 rho, met where one pair has no momentum."""
    random = np.random.default_rng(3)
    minimum = {1.0: math.inf, 1.5: math.inf, 1.9: math.inf}
    for size in minimum:
        for _ in range(2000):
            sampled = random.normal(size=3)
            angles = lawful_angles(size * sampled / np.linalg.norm(sampled))
            minimum[size] = min(minimum[size], singularity_measure(angles))
    assert minimum[1.0] > 1.13
    assert minimum[1.5] > 0.60
    assert minimum[1.9] > 0.08
    nearly = lawful_angles([-2.0 * RHO + 1e-6, 0.0, 0.0])  # pair 1 without momentum, all of it in pair 2
    assert singularity_measure(nearly) < 1e-4
    assert abs(2.0 * RHO - 1.96) < 1e-3


@given(seeds, st.floats(0.0, 1.9), st.floats(0.0, 0.3))
@settings(max_examples=either(300, 25), deadline=None)
def test_rates_give_the_momentum_rate_and_pull_the_law_to_zero(seed, size, off):
    """Off the law as well: the residual's derivative along the rates is -gain times it, the momentum's is exact."""
    random = np.random.default_rng([seed, 7])
    angles = np.array(lawful_angles(size * direction(seed))) + off * random.normal(size=4)
    desired, gain = random.normal(size=3), 0.2
    lawful, rates = distribute_rates(vector(*angles), vector(*desired), RHO, gain, 0.02)
    if not lawful:
        return
    scale = 1.0 + np.abs(np.array(rates)).max()
    assert matrix(angles) @ np.array(rates) == pytest.approx(desired, abs=1e-13 * scale)
    change = residual(angles + 1e-30j * np.array(rates)).imag / 1e-30
    across = np.sin(angles[::2]) + np.sin(angles[1::2])
    steep = 1.0 / (4.0 - np.square(across).max()) ** 1.5  # the law's slope where a pair is nearly all across
    assert change == pytest.approx(-gain * residual(angles), abs=1e-12 * scale * (1.0 + steep))


def test_rates_on_the_law_are_the_derivatives_of_its_angles():
    momentum, desired = np.array([0.4, -0.9, 0.7]), np.array([0.01, 0.02, -0.015])
    lawful, rates = distribute_rates(lawful_angles(momentum), vector(*desired), RHO, 0.2, 0.02)
    assert lawful
    before, after = (np.array(lawful_angles(momentum + k * 1e-4 * desired)) for k in (-1.0, 1.0))
    assert rates == pytest.approx((after - before) / 2e-4, abs=1e-10)


@pytest.mark.parametrize(
    "angles", [[0.0] * 4, [0.0, math.pi, 0.3, 0.2], [1.0, -1.0, 0.5, 0.5], [math.pi / 2] * 2 + [1.0, 2.0]]
)
def test_law_is_refused_in_singular_states(angles):
    desired = vector(0.1, 0.1, 0.1)
    assert not distribute_rates(vector(*angles), desired, RHO, 0.2, 0.02)[0]
    assert not distribute_rates(ISOTROPIC, desired, RHO, 0.2, 0.0)[0]  # without a margin


@given(seeds)
@settings(max_examples=either(200, 16), deadline=None)
def test_robust_rates_are_the_pseudo_inverse_away_from_singular_states(seed):
    random = np.random.default_rng(seed)
    angles, desired = random.uniform(-4.0, 4.0, 4), random.normal(size=3)
    rates, measure = robust_rates(vector(*angles), vector(*desired), 0.05, 0.5, 0.1, 3.3)
    assert measure == pytest.approx(singularity_measure(vector(*angles)), rel=1e-12)
    if measure >= 0.5:
        assert rates == pytest.approx(np.linalg.pinv(matrix(angles)) @ desired, abs=1e-11)


@given(seeds, st.sampled_from([0.0, 0.2, 0.45]), st.floats(0.0, 10.0))
@settings(max_examples=either(300, 25), deadline=None)
def test_robust_rates_near_singular_states_solve_the_damped_problem(seed, swing, time):
    """Against numpy's solution of A W A' + k E; bounded by |A|/k times the demanded rate."""
    random = np.random.default_rng(seed)
    angles = np.repeat(random.uniform(-4.0, 4.0, 2), 2) + random.normal(size=4) * 10.0 ** random.uniform(-9.0, -1.0)
    desired = random.normal(size=3)
    rates, measure = robust_rates(vector(*angles), vector(*desired), 0.05, 0.5, swing, time)
    lack = max(0.0, 1.0 - measure / 0.5)
    weights = np.diag([1.0 + swing * lack, 1.0 - swing * lack] * 2)
    e1, e2, e3 = (swing * math.sin(0.5 * math.pi * (time + phase)) for phase in range(3))
    damping = np.array([[1.0, e3, e2], [e3, 1.0, e1], [e2, e1, 1.0]])
    jacobian = matrix(angles)
    damped = jacobian @ weights @ jacobian.T + 0.05 * lack**2 * damping
    expected = weights @ jacobian.T @ np.linalg.solve(damped, desired)
    assert rates == pytest.approx(expected, abs=1e-9)
    assert np.linalg.norm(rates) < 100.0 * np.linalg.norm(desired)


@pytest.mark.parametrize("angles", [[0.0] * 4, [0.0, math.pi, 0.0, math.pi], [math.pi / 2, -math.pi / 2] * 2])
def test_robust_rates_are_finite_in_singular_states(angles):
    for desired in np.vstack([np.eye(3), -np.eye(3), np.zeros(3)]):
        rates, measure = robust_rates(vector(*angles), vector(*desired), 0.05, 0.5, 0.1, 0.3)
        assert measure < 1e-6
        assert np.isfinite(np.array(rates)).all()
    rates, measure = robust_rates(vector(*angles), vector(1.0, 1.0, 1.0), 0.0, 0.0, 0.0, 0.0)  # no damping: none at all
    assert measure < 1e-6
    assert np.isfinite(np.array(rates)).all()
