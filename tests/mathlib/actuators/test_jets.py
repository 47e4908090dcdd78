"""`perilune.fmus_src.mathlib.actuators.jets`: allocation of a wrench to eight jets.

Truth: the 6 x 8 matrix built from the published nozzle axes and arms with cross products, numpy's rank, null
space and pseudo-inverse, scipy's HiGHS for the attainable set and the least propellant, and a
search over all combinations of levels for the lattice. Tolerances: wrenches 1e-12 N and N.m, propellant
1e-9 N as HiGHS solves to.
"""

import itertools
import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import sparse
from scipy.linalg import null_space
from scipy.optimize import linprog

from perilune.fmus_src.mathlib.actuators.jets import (
    XY,
    XYZ,
    YZ,
    ZX,
    Wrench,
    X,
    Y,
    Z,
    jet_strength,
    jet_wrench,
    least_propellant,
    nearest_levels,
    pseudo_inverse,
    shift_and_scale,
    thrust_of_levels,
)
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.lengths import either

TILT, AZIMUTH, ARM, MAXIMUM = math.radians(35.25), math.radians(45.0), (1.0, 0.7, 0.6), 0.5
TRIALS = 10000
seeds = st.integers(0, 2**32 - 1)


def published_matrix(tilt=TILT, azimuth=AZIMUTH, arm=ARM):
    """Return B of [P; M] = B p, from the axes and arms in the order of the paper; a jet pushes against its nozzle."""
    ca, sa, cb, sb = math.cos(tilt), math.sin(tilt), math.cos(azimuth), math.sin(azimuth)
    first = np.array(
        [[ca * cb, ca * sb, sa], [ca * cb, ca * sb, -sa], [ca * cb, -ca * sb, sa], [ca * cb, -ca * sb, -sa]]
    )
    axes = np.vstack([first, -first[3], -first[2], -first[1], -first[0]])
    signs = np.array(list(itertools.product([1.0, -1.0], repeat=3)))
    arms = signs * arm
    return -np.vstack([axes.T, np.cross(arms, axes).T])


B = published_matrix()
ROWS = np.array([X, Y, Z, YZ, ZX, XY])
NULL = np.array([[1.0] * 8, XYZ])


def strength_of(tilt=TILT, azimuth=AZIMUTH, arm=ARM):
    return jet_strength(tilt, azimuth, vector(*arm))


def wrench_of(elements):
    return Wrench.of_elements([float(x) for x in elements])


FORCE = np.array(strength_of().force)


def shared(wrench, rule, maximum=MAXIMUM):
    """Return thrusts and scale of a rule for a wrench."""
    thrust = [0.0] * 8
    assert pseudo_inverse(strength_of(), wrench_of(wrench), thrust)
    scale = rule(thrust, maximum)
    return np.array(thrust), scale


def programmes(wrenches, maximum=MAXIMUM):
    """Compute least sums of thrusts for many wrenches, as one sparse linear programme per 50.

    Scipy 1.15 takes a hundred times as long as 1.17 for larger ones.
    """
    sums = []
    for block in np.array_split(np.asarray(wrenches), max(1, len(wrenches) // 50)):
        matrix = sparse.block_diag([B] * len(block), format="csc")
        actual = linprog(
            np.ones(8 * len(block)), A_eq=matrix, b_eq=block.ravel(), bounds=(0.0, maximum), method="highs"
        )
        assert actual.status == 0, actual.message
        sums += actual.x.reshape(-1, 8).sum(axis=1).tolist()
    return np.array(sums)


def largest_scale(wrench, maximum=MAXIMUM):
    """Return the share of a wrench that the jets can give, by linear programming."""
    matrix = np.hstack([B, -np.asarray(wrench)[:, None]])
    bounds = [(0.0, maximum)] * 8 + [(0.0, None)]
    return -linprog([0.0] * 8 + [-1.0], A_eq=matrix, b_eq=np.zeros(6), bounds=bounds, method="highs").fun


def attainable_wrenches(count):
    """Return wrenches of random thrusts, a third of them with jets at their limits, a third
    scaled to the surface's inside."""
    random = np.random.default_rng(8)
    thrusts = random.uniform(0.0, MAXIMUM, (count, 8))
    at_limit = random.random((count, 8)) < 0.4
    thrusts[::3][at_limit[::3]] = MAXIMUM * random.integers(0, 2, (count, 8))[::3][at_limit[::3]]
    thrusts[1::3] *= random.random((len(thrusts[1::3]), 1))
    return thrusts @ B.T


def test_matrix_is_that_of_the_published_geometry():
    for p in range(8):
        wrench = jet_wrench(strength_of(), np.eye(8)[p].tolist())
        assert wrench.elements() == pytest.approx(B[:, p], abs=1e-15)
    for tilt, azimuth, arm in [(0.2, 1.1, (0.3, 2.0, 0.9)), (-0.4, 0.3, (1.0, 1.0, 2.0))]:
        actual = np.array(strength_of(tilt, azimuth, arm).elements())[:, None] * ROWS
        assert actual == pytest.approx(published_matrix(tilt, azimuth, arm), abs=1e-15)


def test_a_jet_at_a_corner_pushes_towards_the_opposite_one():
    """The sign that is wrong in print: nozzle 1 points to +x, +y, +z, so its jet pushes to -x, -y, -z."""
    assert (B[:3, 0] < 0.0).all()
    assert pytest.approx(-B[:3, 7]) == B[:3, 0]


def test_rank_and_null_space():
    assert np.linalg.matrix_rank(B) == 6
    walsh = np.vstack([ROWS, NULL])
    assert walsh @ walsh.T == pytest.approx(8.0 * np.eye(8), abs=0.0)
    assert np.abs(B @ NULL.T).max() < 1e-15
    assert np.linalg.matrix_rank(np.hstack([null_space(B), NULL.T]), tol=1e-9) == 2


def test_largest_forces_and_torques():
    """The published 1.15 N along each axis, and the torques of our own."""
    for k, largest in enumerate([1.1549, 1.1549, 1.1543, 0.1150, 0.4614, 0.3465]):
        assert largest_scale(np.eye(6)[k]) == pytest.approx(largest, abs=6e-5)
        thrust, scale = shared(1e3 * np.eye(6)[k], least_propellant)
        assert 1e3 * scale == pytest.approx(largest, abs=6e-5)
        assert B @ thrust == pytest.approx(1e3 * scale * np.eye(6)[k], abs=1e-12)


@given(seeds)
@settings(max_examples=either(100, 8), deadline=None)
def test_pseudo_inverse_is_that_of_numpy(seed):
    wrench = np.random.default_rng(seed).normal(size=6)
    thrust = [0.0] * 8
    assert pseudo_inverse(strength_of(), wrench_of(wrench), thrust)
    assert thrust == pytest.approx(np.linalg.pinv(B) @ wrench, abs=1e-13)


def test_what_the_geometry_cannot_give_is_left_out_and_told():
    """Equal arms and angles: every jet's line goes through the centre, and there is no torque."""
    strength = strength_of(math.atan(math.sqrt(0.5)), math.radians(45.0), (1.0, 1.0, 1.0))
    assert strength.torque == (0.0, 0.0, 0.0)
    thrust = [0.0] * 8
    assert pseudo_inverse(strength, wrench_of([0.1, 0.2, -0.3, 0.0, 0.0, 0.0]), thrust)
    assert not pseudo_inverse(strength, wrench_of([0.1, 0.2, -0.3, 0.0, 0.01, 0.0]), thrust)
    assert jet_wrench(strength, thrust).elements() == pytest.approx([0.1, 0.2, -0.3, 0.0, 0.0, 0.0], abs=1e-15)


def test_least_propellant_is_the_linear_programme_over_the_attainable_set():
    wrenches = attainable_wrenches(TRIALS)
    sums, miss = np.empty(TRIALS), 0.0
    for n, wrench in enumerate(wrenches):
        thrust, scale = shared(wrench, least_propellant)
        assert scale >= 1.0 - 1e-12
        assert thrust.min() >= 0.0
        assert thrust.max() <= MAXIMUM
        miss = max(miss, np.abs(B @ thrust - wrench).max())
        sums[n] = thrust.sum()
    assert miss < 1e-12
    # inside by a hair, so that rounding errors of wrenches on the surface do not make them infeasible
    assert sums == pytest.approx(programmes(wrenches * (1.0 - 1e-11)), abs=1e-9)


def test_least_propellant_is_the_least_maximum_too():
    """So a maximum changes nothing where it can be kept. Least maximum by linear programming."""
    matrix = np.hstack([B, np.zeros((6, 1))])
    below = np.hstack([np.eye(8), -np.ones((8, 1))])
    for wrench in attainable_wrenches(TRIALS)[:: TRIALS // 200]:
        unlimited, _ = shared(wrench, least_propellant, 1e9)
        limited, _ = shared(wrench, least_propellant)
        assert limited == pytest.approx(unlimited, abs=1e-14)
        minimum = linprog([0.0] * 8 + [1.0], A_eq=matrix, b_eq=wrench, A_ub=below, b_ub=np.zeros(8), method="highs").fun
        assert unlimited.max() == pytest.approx(minimum, abs=1e-9)


@given(seeds, st.floats(0.05, 30.0))
@settings(max_examples=either(150, 12), deadline=None)
def test_beyond_the_attainable_set_the_wrench_is_scaled_to_its_surface(seed, size):
    wrench = size * np.random.default_rng(seed).normal(size=6) * [1.0, 1.0, 1.0, 0.1, 0.4, 0.3]
    thrust, scale = shared(wrench, least_propellant)
    assert scale == pytest.approx(min(1.0, largest_scale(wrench)), rel=1e-7)
    assert B @ thrust == pytest.approx(scale * wrench, abs=1e-12)
    assert thrust.min() >= 0.0
    assert thrust.max() <= MAXIMUM


@given(seeds)
@settings(max_examples=either(200, 16), deadline=None)
def test_a_force_alone_is_attainable_where_two_axes_say_so(seed):
    """|Fi| + |Fj| <= 2 maximum |strength| for each two axes, in units of the strengths: 1.155 N."""
    force = np.random.default_rng(seed).normal(size=3)
    levels = np.sort(np.abs(force / FORCE))
    limit = 4.0 * MAXIMUM / (levels[1] + levels[2])
    inside, scale = shared([*(force * limit * (1.0 - 1e-9)), 0.0, 0.0, 0.0], least_propellant)
    assert scale == 1.0
    assert inside.max() == pytest.approx(MAXIMUM, rel=1e-8)
    _, scale = shared([*(force * limit * 1.25), 0.0, 0.0, 0.0], least_propellant)
    assert scale == pytest.approx(0.8, rel=1e-12)
    unlimited, _ = shared([*(force * limit * (1.0 - 1e-9)), 0.0, 0.0, 0.0], least_propellant, 1e9)
    assert inside == pytest.approx(unlimited, abs=1e-15)  # without torque the maximum does not change the optimum


def test_rule_of_the_paper_is_exact_exactly_where_its_condition_says():
    random = np.random.default_rng(4)
    exact = 0
    for wrench in attainable_wrenches(TRIALS) * random.uniform(0.1, 1.5, (TRIALS, 1)):
        shortest = np.linalg.pinv(B) @ wrench
        thrust, scale = shared(wrench, shift_and_scale)
        assert thrust.min() >= 0.0
        assert thrust.max() <= MAXIMUM
        spread = shortest.max() - shortest.min()
        assert scale == pytest.approx(min(1.0, MAXIMUM / spread), rel=1e-12)
        assert B @ thrust == pytest.approx(scale * wrench, abs=1e-12)  # the factor missing in print
        exact += spread <= MAXIMUM
    assert 0.2 * TRIALS < exact < 0.9 * TRIALS


@given(seeds)
@settings(max_examples=either(100, 8), deadline=None)
def test_rule_of_the_paper_for_a_force_alone(seed):
    """Exact while the sum over the axes, in units of the strengths, is 4 jets' worth of maximum: 1.154 N."""
    force = np.random.default_rng(seed).normal(size=3)
    limit = 4.0 * MAXIMUM / np.abs(force / FORCE).sum()
    assert shared([*(force * limit * (1.0 - 1e-9)), 0.0, 0.0, 0.0], shift_and_scale)[1] == 1.0
    assert shared([*(force * limit * 1.25), 0.0, 0.0, 0.0], shift_and_scale)[1] == pytest.approx(0.8, rel=1e-12)


def test_no_maximum_no_thrust_and_nothing_wanted():
    for rule in (shift_and_scale, least_propellant):
        thrust, scale = shared([0.1, 0.2, -0.1, 0.01, 0.0, 0.0], rule, 0.0)
        assert (scale, thrust.tolist()) == (0.0, [0.0] * 8)
        thrust, scale = shared([0.0] * 6, rule)
        assert (scale, thrust.tolist()) == (1.0, [0.0] * 8)


def torque_free_levels(highest):
    """Return all levels of eight jets up to ``highest`` without torque, and the sums of their signs along the axes."""
    levels = np.array(list(itertools.product(range(highest + 1), repeat=8)))
    free = levels[(levels @ ROWS[3:].T == 0).all(axis=1)]
    return free, (free @ ROWS[:3].T).astype(int)


def test_lattice_of_forces_without_torque():
    """Searched: twice integers that are all even or all odd, attainable while two of them make at most 2 highest."""
    highest = 3
    free, sums = torque_free_levels(highest)
    assert (sums % 2 == 0).all()
    actual = {tuple(n) for n in sums // 2}
    axis = range(-2 * highest, 2 * highest + 1)
    expected = {
        n
        for n in itertools.product(axis, repeat=3)
        if len({k % 2 for k in n}) == 1 and sum(map(abs, n)) - min(map(abs, n)) <= 2 * highest
    }
    assert actual == expected
    minimum = {}
    for thrust, n in zip(free, map(tuple, sums // 2), strict=True):
        minimum[n] = min(minimum.get(n, 10**9), int(thrust.sum()))
    for n in expected:
        thrust = [0.0] * 8
        thrust_of_levels(vector(*map(float, n)), 0.05, thrust)
        levels = [round(p / 0.05) for p in thrust]
        assert thrust == [0.05 * k for k in levels]  # to the last bit
        assert min(levels) >= 0
        assert max(levels) <= highest
        assert sum(levels) == minimum[n]
        wrench = B @ thrust
        assert wrench[:3] == pytest.approx(0.1 * np.array(n) * FORCE, abs=1e-15)
        assert wrench[3:] == pytest.approx([0.0, 0.0, 0.0], abs=1e-16)


@cache
def lattice(highest):
    """Return the lattice from its description, which the test above has searched for."""
    points = np.array(list(itertools.product(range(-2 * highest, 2 * highest + 1), repeat=3)))
    sizes = np.abs(points)
    return points[(points % 2 == points[:, :1] % 2).all(axis=1) & (sizes.sum(1) - sizes.min(1) <= 2 * highest)]


@given(seeds, st.floats(0.001, 1.5))
@settings(max_examples=either(200, 16), deadline=None)
def test_nearest_levels_are_the_nearest_of_all_attainable_ones(seed, size):
    """Against a search over the whole lattice; at the surface neighbours only are looked at, which may be farther."""
    highest = 4
    attainable = 0.1 * lattice(highest) * FORCE
    force = size * 0.4 * np.random.default_rng(seed).normal(size=3)
    units = np.sort(np.abs(force / FORCE / 0.1))
    levels, scale = nearest_levels(strength_of().force, vector(*force), 0.05, float(highest))
    assert scale == pytest.approx(min(1.0, 2 * highest / (units[1] + units[2])), rel=1e-14)
    given_force = 0.1 * np.array(levels) * FORCE
    nearest = np.linalg.norm(attainable - scale * force, axis=1).min()
    reached = np.linalg.norm(given_force - scale * force)
    assert reached >= nearest - 1e-12
    if units[1] + units[2] <= 2 * highest - 2:
        assert reached == pytest.approx(nearest, abs=1e-12)
    assert reached <= 0.1001 * 0.5774 * math.sqrt(3.0)


def test_too_coarse_levels_give_nothing():
    levels, scale = nearest_levels(strength_of().force, vector(0.3, -0.2, 0.1), 0.7, 0.0)
    assert scale == 0.0
    assert levels == [0.0, 0.0, 0.0]
