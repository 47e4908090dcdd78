"""Wheel allocations: torques of least norm (2 or infinity) that produce the command; null motion; limits; failures.

Truth: numpy's pseudo-inverse; linear programmes of all four torques by scipy (HiGHS); the torque envelopes of a pyramid
by hand (Markley, Reynolds, Liu and Lebsock 2010).
"""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import linprog

from perilune.fmus_src.actuators.wheel_allocation import WheelAllocationStatus
from perilune.fmus_src.actuators.wheel_allocation_minimax import WheelAllocationMinimax
from perilune.fmus_src.actuators.wheel_allocation_pseudo_inverse import WheelAllocationPseudoInverse
from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib.vectors import vector

PYRAMID = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]]) / np.sqrt(3.0)
BOTH = (WheelAllocationPseudoInverse, WheelAllocationMinimax)
seeds = st.integers(0, 2**32 - 1)


def allocate(kind, torque, axes=PYRAMID, speeds=(0.0,) * 4, **settings):
    settings = {"motor_torque_limit": 1e3, "null_gain": 0.0} | settings
    block = kind(
        wheel_axes=Matrix(np.asarray(axes).tolist()),
        torque_command=vector(*map(float, torque)),
        wheel_speeds=vector(*map(float, speeds)),
        **settings,
    )
    block.initialize()
    return block, np.array([*block.motor_torques])


def random_array(seed):
    """Return unit axes that are not nearly in a plane, and a torque."""
    random = np.random.default_rng(seed)
    axes = random.normal(size=(4, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    assume(np.linalg.svd(axes, compute_uv=False)[-1] > 0.1)
    return axes, random.normal(size=3)


@given(seeds, st.sampled_from(BOTH))
def test_the_body_gets_the_torque(seed, kind):
    axes, torque = random_array(seed)
    block, u = allocate(kind, torque, axes)
    np.testing.assert_allclose(-axes.T @ u, torque, atol=1e-12)
    np.testing.assert_allclose([*block.allocated_torque], torque, atol=1e-12)
    assert block.status == WheelAllocationStatus.GOOD


@given(seeds)
def test_pseudo_inverse(seed):
    axes, torque = random_array(seed)
    _, u = allocate(WheelAllocationPseudoInverse, torque, axes)
    np.testing.assert_allclose(u, -np.linalg.pinv(axes.T) @ torque, atol=1e-12)


@given(seeds)
def test_minimax(seed):
    """The largest size is the optimum of the programme: least t with A u = -torque and |u| <= t."""
    axes, torque = random_array(seed)
    _, u = allocate(WheelAllocationMinimax, torque, axes)
    bounds = np.vstack([np.hstack([np.eye(4), -np.ones((4, 1))]), np.hstack([-np.eye(4), -np.ones((4, 1))])])
    optimum = linprog(
        [0.0] * 4 + [1.0],
        A_ub=bounds,
        b_ub=np.zeros(8),
        A_eq=np.hstack([axes.T, np.zeros((3, 1))]),
        b_eq=-torque,
        bounds=[(None, None)] * 5,
    )
    assert np.abs(u).max() == pytest.approx(optimum.fun, rel=1e-9)


@pytest.mark.parametrize(("kind", "largest"), [(WheelAllocationPseudoInverse, 0.75), (WheelAllocationMinimax, 0.5)])
def test_a_pyramid_along_a_spin_axis(kind, largest):
    """The torque 1 along g1: 3/4, 1/4, -1/4, 1/4 have the least squares, four of 1/2 the smallest maximum."""
    _, u = allocate(kind, PYRAMID[0])
    assert np.abs(u).max() == pytest.approx(largest, rel=1e-12)


@pytest.mark.parametrize("kind", BOTH)
def test_a_pyramid_along_its_edges(kind):
    """About x, y and z all wheels give the same: nothing is left to choose."""
    for torque in np.eye(3):
        _, u = allocate(kind, torque)
        np.testing.assert_allclose(np.abs(u), np.sqrt(3.0) / 4.0, rtol=1e-12)


@given(seeds, st.sampled_from(BOTH), st.floats(0.01, 2.0))
def test_null_motion_does_not_turn_the_body_and_stays_within_the_limit(seed, kind, limit):
    axes, torque = random_array(seed)
    speeds = np.random.default_rng(seed).normal(0.0, 300.0, 4)
    _, plain = allocate(kind, torque, axes, speeds)
    block, u = allocate(kind, torque, axes, speeds, null_gain=0.5, wheel_inertia=0.05, motor_torque_limit=limit)
    assert np.abs(u).max() <= limit * (1.0 + 1e-12)
    scale = min(1.0, limit / np.abs(plain).max())
    np.testing.assert_allclose(-axes.T @ u, scale * torque, atol=1e-9)
    assert (block.status == WheelAllocationStatus.LIMITED) == (scale < 1.0)


def settle(kind, start, **settings):
    """Return speeds of wheels on a body at rest after 500 s of null motion alone."""
    speeds = np.asarray(start, dtype=float)
    for _ in range(1000):
        _, u = allocate(kind, np.zeros(3), speeds=speeds, null_gain=0.02, wheel_inertia=0.05, **settings)
        speeds = speeds + 0.5 / 0.05 * u
    return speeds


def test_null_motion_of_the_pseudo_inverse_ends_at_its_speed():
    """With the momentum, which it does not change."""
    start = np.array([50.0, 20.0, -30.0, 10.0])
    end = settle(WheelAllocationPseudoInverse, start, null_speed=80.0)
    null = np.array([1.0, -1.0, 1.0, -1.0])
    np.testing.assert_allclose(PYRAMID.T @ end, PYRAMID.T @ start, atol=1e-9)
    assert null @ end / 4.0 == pytest.approx(80.0, rel=1e-3)


def test_null_motion_of_the_minimax_ends_at_the_smallest_maximum():
    """Half-way between the largest and the smallest of n u, of u + s n."""
    start = np.array([50.0, 20.0, -30.0, 10.0])
    end = settle(WheelAllocationMinimax, start)
    signed = start * [1.0, -1.0, 1.0, -1.0]
    np.testing.assert_allclose(PYRAMID.T @ end, PYRAMID.T @ start, atol=1e-9)
    assert np.abs(end).max() == pytest.approx(0.5 * (signed.max() - signed.min()), rel=1e-3)


@given(seeds, st.sampled_from(BOTH), st.integers(0, 3))
def test_three_wheels_give_what_they_must(seed, kind, failed):
    axes, torque = random_array(seed)
    working = [k for k in range(4) if k != failed]
    assume(abs(np.linalg.det(axes[working])) > 0.05)
    _, u = allocate(kind, torque, axes, available=[k != failed for k in range(4)], null_gain=0.5)
    assert u[failed] == 0.0
    np.testing.assert_allclose(u[working], np.linalg.solve(axes[working].T, -torque), atol=1e-10)


@pytest.mark.parametrize("kind", BOTH)
def test_wheels_in_a_plane_are_reported(kind):
    axes = PYRAMID * [1.0, 1.0, 0.0]
    block, u = allocate(kind, [1.0, 0.0, 0.0], axes)
    assert block.status == WheelAllocationStatus.NO_INVERSE
    assert not u.any()


@pytest.mark.parametrize("kind", BOTH)
@pytest.mark.parametrize("wrong", [np.nan, np.inf, 1e101])
def test_a_command_that_is_no_number_switches_the_motors_off(kind, wrong):
    for torque, speeds in (([wrong, 0.0, 0.0], [0.0] * 4), ([0.1, 0.0, 0.0], [0.0, wrong, 0.0, 0.0])):
        block, u = allocate(kind, torque, speeds=speeds)
        assert block.status == WheelAllocationStatus.NOT_FINITE
        assert not u.any()
