"""Gyro steerings: torque at sample instants, mean torque, the turn of the rendezvous, and singular states.

Truth: the published momentum of the cluster, its derivative by complex steps, differences of the momentum over a hold
interval, and the turn's polynomial differentiated by numpy. Tolerance 1e-12 N.m at the instants.
"""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from perilune.fmus_src.actuators.gyro_steering_explicit import GyroSteeringExplicit
from perilune.fmus_src.actuators.gyro_steering_robust import GyroSteeringRobust
from perilune.fmus_src.mathlib.actuators.gyros import ISOTROPIC_ANGLES, ISOTROPIC_RHO, distribute_angles
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.runtime import BlockInstance
from tests.support.lengths import either

BLOCKS = [GyroSteeringExplicit, GyroSteeringRobust]
ROTOR = 30.0
PERIOD = 0.25
INERTIA = np.array([812.0, 587.0, 910.0])
AXIS = np.array([0.0, -0.9578, 0.2874]) / math.hypot(0.9578, 0.2874)
PROFILE = math.radians(127.46) * Polynomial([0.0, 0.0, 0.0, 20.0, -45.0, 36.0, -10.0])  # of time/100 s
seeds = st.integers(0, 2**32 - 1)


def momentum(angles):
    c, s = np.cos(angles), np.sin(angles)
    return ROTOR * np.array([c.sum(), s[0] + s[1], s[2] + s[3]])


def torque(angles, rates):
    """Return -H' for gimbal rates."""
    return -momentum(np.array(angles) + 1e-30j * np.array(rates)).imag / 1e-30


def answer(block_class, angles, wanted, time=0.25, **settings_):
    """Return the block after one sample at ``time``."""
    block = block_class(**settings_)
    block.initialize()
    block.gimbal_angles = angles
    block.torque_command = wanted
    block.step(time - PERIOD, PERIOD)
    return block


def turned(block_class, **settings_):
    """Return angles, rates and demanded torques J phi'' of every sample of the turn, and the angles at its end."""
    acceleration = PROFILE.deriv(2)
    component = BlockInstance(block_class)
    block = component.block
    for name, value in settings_.items():
        setattr(block, name, value)
    angles, rows = np.array(ISOTROPIC_ANGLES), []
    component.start()
    for k in range(400):
        wanted = INERTIA * AXIS * acceleration((k + 0.5) * PERIOD / 100.0) / 100.0**2
        block.gimbal_angles = angles
        block.torque_command = wanted
        component.do_step((k - 1) * PERIOD + PERIOD, PERIOD)
        rates = np.array(block.gimbal_rates)
        assert block.status == 0
        rows.append((angles, rates, wanted))
        angles = angles + PERIOD * rates
    return rows, angles


@pytest.mark.parametrize("block_class", BLOCKS)
def test_torque_is_exact_at_every_sample_of_the_turn(block_class):
    rows, angles = turned(block_class)
    largest = max(np.linalg.norm(momentum(beta)) for beta, _, _ in rows) / ROTOR
    assert largest == pytest.approx(0.953, abs=1e-3)  # half of what the law allows
    for beta, rates, wanted in rows:
        assert torque(beta, rates) == pytest.approx(wanted, abs=1e-12)
    held = [-(momentum(beta + PERIOD * rates) - momentum(beta)) / PERIOD - wanted for beta, rates, wanted in rows]
    assert 1e-3 < np.abs(held).max() < 3e-3  # what holding the rates for a quarter of a second costs
    assert np.degrees(angles - ISOTROPIC_ANGLES) == pytest.approx(np.zeros(4), abs=0.2)


@pytest.mark.parametrize("block_class", BLOCKS)
def test_lead_of_half_a_period_makes_the_mean_exact_to_second_order(block_class):
    rows, angles = turned(block_class, torque_lead=0.5 * PERIOD)
    held = [-(momentum(beta + PERIOD * rates) - momentum(beta)) / PERIOD - wanted for beta, rates, wanted in rows]
    assert np.abs(held).max() < 4e-6
    for beta, rates, wanted in rows:
        middle = beta + 0.5 * PERIOD * rates
        assert torque(middle, rates) == pytest.approx(wanted, abs=1e-5)
    assert np.degrees(angles - ISOTROPIC_ANGLES) == pytest.approx(np.zeros(4), abs=2e-3)


@given(seeds, st.floats(0.0, 1.9))
@settings(max_examples=either(200, 50), deadline=None)
def test_torque_is_exact_wherever_the_law_is_used(seed, size):
    random = np.random.default_rng(seed)
    sampled = random.normal(size=3)
    momentum_wanted = vector(*(size * sampled / np.linalg.norm(sampled)))
    possible, angles = distribute_angles(momentum_wanted, ISOTROPIC_RHO, vector(*ISOTROPIC_ANGLES))
    assert possible
    wanted = 0.3 * random.normal(size=3)
    block = answer(GyroSteeringExplicit, angles, wanted)
    assert block.status == 0
    assert torque(angles, block.gimbal_rates) == pytest.approx(wanted, abs=1e-12)


@given(seeds)
@settings(max_examples=either(200, 50), deadline=None)
def test_robust_torque_is_exact_away_from_singular_states(seed):
    random = np.random.default_rng(seed)
    angles, wanted = random.uniform(-4.0, 4.0, 4), 0.3 * random.normal(size=3)
    block = answer(GyroSteeringRobust, angles, wanted)
    assert (block.status == 0) == (block.singularity >= 0.5)
    if block.status == 0:
        assert torque(angles, block.gimbal_rates) == pytest.approx(wanted, abs=1e-12)


def test_law_leads_angles_that_are_off_it_back():
    """No torque demanded: the angles move along the null space until the law holds, with a time constant of 5 s."""
    angles = np.add(ISOTROPIC_ANGLES, [0.1, -0.05, 0.08, 0.02])
    start = momentum(angles)

    def residual(beta):
        c, s = np.cos(beta), np.sin(beta)
        u = (c[0] + c[1]) / math.sqrt(4.0 - (s[0] + s[1]) ** 2)
        v = (c[2] + c[3]) / math.sqrt(4.0 - (s[2] + s[3]) ** 2)
        return u - v + ISOTROPIC_RHO * (u * v - 1.0)

    first = residual(angles)
    for k in range(100):
        block = answer(GyroSteeringExplicit, angles, [0.0, 0.0, 0.0], time=PERIOD * (k + 1))
        angles = angles + PERIOD * np.array(block.gimbal_rates)
    assert residual(angles) / first == pytest.approx(math.exp(-0.2 * 25.0), rel=0.2)
    assert momentum(angles) == pytest.approx(start, abs=0.05)


@pytest.mark.parametrize("block_class", BLOCKS)
def test_nothing_wanted_at_the_isotropic_angles_is_nothing_done(block_class):
    block = answer(block_class, ISOTROPIC_ANGLES, [0.0, 0.0, 0.0])
    assert block.gimbal_rates == pytest.approx([0.0] * 4, abs=1e-15)
    assert (block.status, block.singularity) == (0, pytest.approx(8.0 / math.sqrt(27.0), rel=1e-15))


@pytest.mark.parametrize("block_class", BLOCKS)
@pytest.mark.parametrize(
    ("angles", "law_only"),
    [
        ([0.0, 0.0, 0.0, 0.0], False),  # all along x: the outer surface
        ([math.pi / 2, math.pi / 2, 0.0, 0.0], False),  # pair 1 at its end: a = 0
        ([0.0, math.pi, 0.4, 1.9], True),  # pair 1 without momentum: the law has no answer, the cluster has
        ([0.0, math.pi, 0.0, math.pi], False),  # both
        ([math.pi / 2, -math.pi / 2, math.pi / 2, -math.pi / 2], False),
        ([0.0, 0.0, math.pi, math.pi], False),  # inner: the pairs against each other
    ],
)
def test_singular_states_are_safe_and_reported(block_class, angles, law_only):
    for wanted in np.vstack([np.eye(3), -np.eye(3), np.zeros(3), 1e6 * np.eye(3)]):
        for offset in (0.0, 1e-12, 1e-6, 1e-3):
            near = np.array(angles) + offset * np.array([1.0, -0.7, 0.4, 0.9])
            block = answer(block_class, near, wanted)
            assert np.isfinite(block.gimbal_rates).all()
            assert max(map(abs, block.gimbal_rates)) <= 1.0 + 1e-15
            assert (block.singularity > 0.5) == law_only
            if not law_only or block_class is GyroSteeringExplicit:
                assert block.status in (1, 2)
            if law_only and block.status < 2:
                assert torque(near, block.gimbal_rates) == pytest.approx(wanted, abs=1e-12)


def flown(block_class, wanted, seconds, angles=ISOTROPIC_ANGLES, **settings_):
    """Return angles at every sample under a constant torque demand, and the statuses."""
    component = BlockInstance(block_class)
    block = component.block
    for name, value in settings_.items():
        setattr(block, name, value)
    angles = np.array(angles)
    path, statuses = [angles], []
    block.gimbal_angles = angles
    component.start()
    for k in range(int(seconds / PERIOD)):
        block.gimbal_angles = angles
        block.torque_command = wanted
        component.do_step(k * PERIOD, PERIOD)
        angles = angles + PERIOD * np.array(block.gimbal_rates)
        path.append(angles)
        statuses.append(block.status)
        assert np.isfinite(block.gimbal_rates).all()
    return np.array(path), statuses


@pytest.mark.parametrize("block_class", BLOCKS)
@pytest.mark.parametrize(
    "wanted", [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.3, -1.0], [0.7, 0.7, 0.7]]
)
def test_torque_beyond_the_envelope_ends_at_it_safely_and_the_way_back_is_free(block_class, wanted):
    """A constant torque fills the cluster: good until near its end, then reported; the opposite torque empties it."""
    path, statuses = flown(block_class, wanted, 200.0)
    sizes = [np.linalg.norm(momentum(beta)) / ROTOR for beta in path]
    first = next(n for n, status in enumerate(statuses) if status != 0)
    assert sizes[first] > 1.5
    assert max(sizes) <= 4.0
    assert statuses[-1] == 1
    for beta, after in pairwise(path[:first]):
        assert torque(beta, (after - beta) / PERIOD) == pytest.approx(wanted, abs=1e-11)
    back, statuses = flown(block_class, -np.array(wanted), 60.0, angles=path[-1])
    minimum = min(np.linalg.norm(momentum(beta)) / ROTOR for beta in back)
    assert minimum < 0.75 * sizes[-1]


def test_swing_leads_out_of_a_state_in_which_the_pseudo_inverse_is_locked():
    """Pairs against each other along x, torque along x demanded: A' maps it to zero rates. With a swing it moves."""
    angles = [0.0, 0.0, math.pi, math.pi]
    locked, _ = flown(GyroSteeringRobust, [1.0, 0.0, 0.0], 60.0, angles=angles, swing=0.0)
    assert np.abs(locked[-1] - angles).max() < 1e-6
    free, statuses = flown(GyroSteeringRobust, [1.0, 0.0, 0.0], 60.0, angles=angles)
    assert np.linalg.norm(momentum(free[-1])) / ROTOR > 0.5
    assert 0 in statuses


@pytest.mark.parametrize("block_class", BLOCKS)
def test_limited_rates_keep_the_direction_of_the_torque(block_class):
    wanted = np.array([3.0, -4.0, 2.0])
    free = answer(block_class, ISOTROPIC_ANGLES, wanted, gimbal_rate_limit=0.0)
    limited = answer(block_class, ISOTROPIC_ANGLES, wanted, gimbal_rate_limit=0.05)
    assert (free.status, limited.status) == (0, 2)
    assert torque(ISOTROPIC_ANGLES, free.gimbal_rates) == pytest.approx(wanted, abs=1e-12)
    assert max(map(abs, limited.gimbal_rates)) == pytest.approx(0.05, rel=1e-15)
    given_torque = torque(ISOTROPIC_ANGLES, limited.gimbal_rates)
    assert np.cross(given_torque, wanted) == pytest.approx(np.zeros(3), abs=1e-13)


@pytest.mark.parametrize("block_class", BLOCKS)
@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf, 1e200])
@pytest.mark.parametrize("name", ["torque_command", "gimbal_angles"])
def test_command_that_is_no_number_stops_the_gimbals(block_class, bad, name):
    block = answer(block_class, ISOTROPIC_ANGLES, [0.3, 0.1, 0.0])
    values = list(getattr(block, name))
    values[2] = bad
    setattr(block, name, values)
    block.step(0.25, 0.25)
    assert (block.gimbal_rates, block.status) == ([0.0] * 4, 3)


@pytest.mark.parametrize("block_class", BLOCKS)
def test_rates_are_held_between_samples(block_class):
    component = BlockInstance(block_class)
    component.start()
    component.block.torque_command = [0.5, 0.0, 0.0]
    component.do_step(0.0, 0.125)
    assert component.block.gimbal_rates == pytest.approx([0.0] * 4, abs=1e-15)
    component.do_step(0.125, 0.125)
    held = list(component.block.gimbal_rates)
    assert max(held) > 1e-3
    component.block.torque_command = [0.0, 0.0, 0.0]
    component.do_step(0.25, 0.125)
    assert component.block.gimbal_rates == held
