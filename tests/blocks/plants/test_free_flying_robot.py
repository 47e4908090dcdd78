"""Free-flying robot and drifting target: motion, conservation laws, frames and convergence.

Truth: Euler's equations with the explicit gyro torque -H' (the plant integrates the angular momentum instead) by
scipy's DOP853 at rtol 1e-12; Jacobi's elliptic functions for the torque-free body; conservation of momentum and energy;
closed forms of constant and of rotating thrust; the published axes and arms of the jets. Tolerances are stated at each
test.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from scipy.special import ellipj

from perilune.fmus_src.plants.drifting_target import DriftingTarget
from perilune.fmus_src.plants.free_flying_robot import FreeFlyingRobot
from tests.support.lengths import either

INERTIA = np.array([812.0, 587.0, 910.0])
MASS, ROTOR = 1000.0, 30.0
CA, SA, DIAGONAL = math.cos(math.radians(35.25)), math.sin(math.radians(35.25)), math.sqrt(0.5)
SIGNS = np.array(list(itertools.product([1.0, -1.0], repeat=3)))
NOZZLES = SIGNS * [CA * DIAGONAL, CA * DIAGONAL, SA]
ARMS = SIGNS * [1.0, 0.7, 0.6]
STEP = 0.125
seeds = st.integers(0, 2**32 - 1)


def plant(**settings_):
    block = FreeFlyingRobot(**settings_)
    block.initialize()
    return block


def fly(block, seconds, thrust=None, rates=None, step=STEP):
    """Fly under thrusts and gimbal rates, which may be functions of time; returns the rows at every step."""
    rows = []
    for n in range(round(seconds / step)):
        if thrust is not None:
            block.jet_thrust = thrust(n * step) if callable(thrust) else thrust
        if rates is not None:
            block.gimbal_rates = rates(n * step) if callable(rates) else rates
        block.step(n * step, step)
        rows.append(
            [*block.position, *block.velocity, *block.quaternion, *block.angular_velocity, *block.gimbal_angles]
        )
    return np.array(rows)


def rotation(block):
    return Rotation.from_quat(block.quaternion, scalar_first=True)


def momentum_of(angles):
    c, s = np.cos(angles), np.sin(angles)
    return ROTOR * np.array([c.sum(), s[0] + s[1], s[2] + s[3]])


def jet_wrench(thrust):
    return -np.asarray(thrust) @ NOZZLES, -np.asarray(thrust) @ np.cross(ARMS, NOZZLES)


def independent(start, thrust, rates, seconds):
    """Return r, v, q, w, angles after a time with constant thrusts and gimbal rates, by Euler's equations."""
    force, torque = jet_wrench(thrust)
    rates = np.asarray(rates, dtype=float)

    def slope(_, state):
        v, q, w, angles = state[3:6], state[6:10], state[10:13], state[13:]
        matrix = Rotation.from_quat(q, scalar_first=True).as_matrix()
        momentum_rate = momentum_of(angles + 1e-30j * rates).imag / 1e-30
        acceleration = (torque - momentum_rate - np.cross(w, INERTIA * w + momentum_of(angles))) / INERTIA
        q_rate = 0.5 * np.array([-q[1:] @ w, *(q[0] * w + np.cross(q[1:], w))])
        return np.concatenate([v, matrix @ force / MASS, q_rate, acceleration, rates])

    actual = solve_ivp(slope, (0.0, seconds), start, method="DOP853", rtol=1e-12, atol=1e-14)
    return actual.y[:, -1]


def random_start(seed):
    random = np.random.default_rng(seed)
    q = random.normal(size=4)
    return {
        "initial_position": (10.0 * random.normal(size=3)).tolist(),
        "initial_velocity": (0.1 * random.normal(size=3)).tolist(),
        "initial_quaternion": (q / np.linalg.norm(q)).tolist(),
        "initial_angular_velocity": (0.1 * random.normal(size=3)).tolist(),
        "initial_gimbal_angles": random.uniform(-4.0, 4.0, 4).tolist(),
    }


@pytest.mark.parametrize(("internal_step", "tolerance"), [(0.0625, 2e-8), (0.015625, 1e-10)])
@given(seed=seeds)
@settings(max_examples=either(8, 5), deadline=None)
def test_motion_is_that_of_eulers_equations(internal_step, tolerance, seed):
    """Everything at once for 20 s: jets, gimbals, tumbling at 0.1 rad/s (m, rad, rad/s)."""
    random = np.random.default_rng([seed, 2])
    start = random_start(seed)
    thrust, rates = random.uniform(0.0, 0.5, 8), random.uniform(-0.1, 0.1, 4)
    block = plant(**start, internal_step=internal_step)
    reached = fly(block, 20.0, thrust.tolist(), rates.tolist())[-1]
    expected = independent(np.concatenate(list(start.values())), thrust, rates, 20.0)
    expected[6:10] /= np.linalg.norm(expected[6:10])
    assert reached == pytest.approx(expected, abs=tolerance)
    assert block.impulse == pytest.approx(20.0 * thrust.sum(), rel=1e-13)


def test_torque_free_body_is_jacobis():
    """Euler and Poinsot: w = (dn, sn, cn) of time, for inertias C > A > B turning mostly about the largest."""
    # sorted: I1 = 910 (z) > I2 = 812 (x) > I3 = 587 (y); G^2 > 2 E I2, so w about z never vanishes
    i1, i2, i3 = 910.0, 812.0, 587.0
    w0 = np.array([0.0, 0.04, 0.1])  # x, y, z
    energy2, momentum2 = (INERTIA * w0**2).sum(), ((INERTIA * w0) ** 2).sum()
    assert momentum2 > energy2 * i2
    rate = math.sqrt((momentum2 - energy2 * i3) * (i1 - i2) / (i1 * i2 * i3))
    modulus2 = (i2 - i3) * (i1 * energy2 - momentum2) / ((i1 - i2) * (momentum2 - energy2 * i3))
    block = plant(initial_angular_velocity=w0.tolist(), rotor_momentum=0.0)
    rows = fly(block, 400.0)
    times = STEP * np.arange(1, len(rows) + 1)
    sn, cn, dn, _ = ellipj(rate * times, modulus2)
    about_z = math.sqrt((momentum2 - energy2 * i3) / (i1 * (i1 - i3))) * dn
    about_y = math.sqrt((i1 * energy2 - momentum2) / (i3 * (i1 - i3))) * cn
    about_x = math.sqrt((i1 * energy2 - momentum2) / (i2 * (i1 - i2))) * sn
    assert np.abs(np.diff(np.sign(rows[:, 10]))).sum() >= 4  # more than one period
    sign = np.sign(rows[0, 10] / sn[0])
    assert rows[:, 10:13] == pytest.approx(np.array([sign * about_x, about_y, about_z]).T, abs=1e-9)


@given(seeds)
@settings(max_examples=either(20, 6), deadline=None)
def test_angular_momentum_is_kept_while_gimbals_move(seed):
    """No jets, new random gimbal rates in every step: R(q)(J w + H) stays to rounding (1e-12 of 100 N m s)."""
    random = np.random.default_rng([seed, 3])
    start = random_start(seed)
    block = plant(**start)

    def momentum():
        return rotation(block).apply(INERTIA * block.angular_velocity + momentum_of(block.gimbal_angles))

    first, state = momentum(), list(block.angular_momentum)
    for n in range(200):
        block.gimbal_rates = random.uniform(-0.3, 0.3, 4)
        block.step(n * STEP, STEP)
        assert momentum() == pytest.approx(first, abs=2e-12 * np.linalg.norm(first))
    assert block.angular_momentum == state  # not a bit
    assert block.gyro_momentum == pytest.approx(momentum_of(block.gimbal_angles), abs=1e-13)
    assert np.linalg.norm(block.quaternion) == pytest.approx(1.0, abs=1e-15)
    assert block.velocity == start["initial_velocity"]


@given(seeds)
@settings(max_examples=either(10, 5), deadline=None)
def test_energy_is_kept_without_any_actuation(seed):
    """Gimbals locked, rotors spinning, tumbling at 0.1 rad/s: w'Jw/2 is kept, to the integration's 1e-7 over 125 s."""
    block = plant(**random_start(seed))
    first = 0.5 * (INERTIA * np.square(block.angular_velocity)).sum()
    for n in range(1000):
        block.step(n * STEP, STEP)
    assert 0.5 * (INERTIA * np.square(block.angular_velocity)).sum() == pytest.approx(first, rel=1e-7)


def test_constant_thrust_at_a_held_attitude_is_a_parabola():
    """r0 + v0 t + P t^2/(2 m) along the inertial axes, to rounding. A force without torque: pairs of all corners."""
    start = random_start(5) | {"initial_angular_velocity": [0.0, 0.0, 0.0], "rotor_momentum": 0.0}
    thrust = np.array([0.1, 0.1, 0.1, 0.1, 0.4, 0.4, 0.4, 0.4])
    force, torque = jet_wrench(thrust)
    assert torque == pytest.approx([0.0, 0.0, 0.0], abs=1e-16)
    block = plant(**start)
    acceleration = rotation(block).apply(force) / MASS
    fly(block, 1000.0, thrust.tolist())
    r0, v0 = np.array(start["initial_position"]), np.array(start["initial_velocity"])
    assert block.velocity == pytest.approx(v0 + 1000.0 * acceleration, abs=1e-12)
    assert block.position == pytest.approx(r0 + 1000.0 * v0 + 0.5e6 * acceleration, abs=1e-9)
    assert block.jet_force == pytest.approx(force, abs=1e-15)
    assert block.impulse == pytest.approx(1000.0 * thrust.sum(), rel=1e-12)


def test_thrust_of_a_spinning_body_turns_with_it():
    """Spin about z at w: v = (P/m)(sin wt, 1 - cos wt)/w, r by integrating once more. 1e-11 m/s, 1e-9 m in 100 s."""
    w, thrust = 0.05, np.array([0.0, 0.0, 0.0, 0.0, 0.4, 0.4, 0.4, 0.4])
    push = jet_wrench(thrust)[0][0] / MASS
    block = plant(initial_angular_velocity=[0.0, 0.0, w], rotor_momentum=0.0)
    fly(block, 100.0, thrust.tolist())
    angle = w * 100.0
    assert block.velocity == pytest.approx(
        push / w * np.array([math.sin(angle), 1.0 - math.cos(angle), 0.0]), abs=1e-11
    )
    moved = push / w**2 * np.array([1.0 - math.cos(angle), angle - math.sin(angle), 0.0])
    assert block.position == pytest.approx(moved, abs=1e-9)
    assert rotation(block).as_rotvec()[2] == pytest.approx(angle - math.tau, abs=1e-9)


def test_each_jet_pushes_and_turns_as_its_axis_and_arm_say():
    for p in range(8):
        thrust = [0.0] * 8
        thrust[p] = 0.3
        block = plant(rotor_momentum=0.0)
        block.jet_thrust = thrust
        block.step(0.0, STEP)
        force, torque = jet_wrench(thrust)
        assert block.jet_force == pytest.approx(force, abs=1e-15)
        assert block.jet_torque == pytest.approx(torque, abs=1e-15)
        assert block.angular_velocity == pytest.approx(torque * STEP / INERTIA, rel=1e-6, abs=1e-12)


def test_gimbals_push_the_body_the_other_way():
    """At rest and balanced: J w = -(H - H0) about axes that do not turn yet."""
    block = plant()
    assert block.gyro_momentum == pytest.approx([0.0, 0.0, 0.0], abs=1e-14)
    block.gimbal_rates = [0.02, 0.02, -0.01, -0.01]
    block.step(0.0, STEP)
    assert INERTIA * block.angular_velocity == pytest.approx(-np.array(block.gyro_momentum), abs=1e-12)
    assert np.linalg.norm(block.gyro_momentum) > 0.05


def test_integration_is_of_fourth_order():
    """Error against a step of 1/64 s, halving from 1 s: between 3.7 and 4.4 powers of two each time."""
    start = random_start(11) | {"initial_angular_velocity": [0.5, -0.4, 0.6]}
    rows = {}
    for step in (1.0, 0.5, 0.25, 0.015625):
        block = plant(**start, internal_step=step)
        rows[step] = fly(block, 16.0, [0.5, 0.1, 0.0, 0.3, 0.2, 0.0, 0.4, 0.1], [0.1, -0.2, 0.15, 0.05], step=1.0)[-1]
    errors = [np.abs(rows[step] - rows[0.015625])[:13].max() for step in (1.0, 0.5, 0.25)]
    orders = [math.log2(coarse / fine) for coarse, fine in itertools.pairwise(errors)]
    assert all(3.7 < order < 4.4 for order in orders), orders


@pytest.mark.parametrize("internal", [0.0625, 0.03125])
def test_communication_steps_do_not_change_a_bit(internal):
    random = np.random.default_rng(2)
    thrusts, rates = random.uniform(0.0, 0.6, (40, 8)), random.uniform(-0.1, 0.1, (40, 4))
    rows = []
    for step in (0.25, 0.125, 0.0625):
        block = plant(**random_start(3), internal_step=internal, thrust_error=0.05)
        flown = fly(block, 10.0, lambda t: thrusts[int(t / 0.25)], lambda t: rates[int(t / 0.25)], step=step)
        rows.append((flown[round(0.25 / step) - 1 :: round(0.25 / step)].tolist(), block.impulse))
    assert rows[0] == rows[1] == rows[2]


def test_thrusts_are_kept_within_what_a_jet_gives():
    block = plant()
    block.jet_thrust = [-1.0, 0.7, math.inf, 0.5, 0.2, 0.0, -math.inf, 0.1]
    block.step(0.0, STEP)
    force, torque = jet_wrench([0.0, 0.5, 0.5, 0.5, 0.2, 0.0, 0.0, 0.1])
    assert block.jet_force == pytest.approx(force, abs=1e-15)
    assert block.jet_torque == pytest.approx(torque, abs=1e-15)
    assert block.impulse == pytest.approx(1.8 * STEP, rel=1e-15)


def test_thrust_error_is_normal_per_jet_and_constant():
    """100 robots with 8 jets each: sizes by a chi-square interval (99.9 %), form by Kolmogorov and Smirnov."""
    factors = []
    for seed in range(100):
        block = plant(thrust_error=0.05, seed=seed)
        factors += block.thrust_factor
        before = list(block.thrust_factor)
        fly(block, 1.0, [0.3] * 8)
        assert block.thrust_factor == before
        assert block.impulse == pytest.approx(0.3 * sum(before), rel=1e-13)
    errors = (np.array(factors) - 1.0) / 0.05
    assert stats.kstest(errors, "norm").pvalue > 1e-3
    low, high = stats.chi2.ppf([0.0005, 0.9995], 800)
    assert low < (errors**2).sum() < high
    assert min(plant(thrust_error=50.0).thrust_factor) == 0.0  # no jet pulls
    assert plant(seed=9).thrust_factor == [1.0] * 8


def test_start_is_the_declared_one_with_a_unit_quaternion():
    block = plant(initial_quaternion=[0.0, 3.0, 0.0, 4.0], initial_angular_velocity=[0.01, 0.02, 0.03])
    assert block.quaternion == [0.0, 0.6, 0.0, 0.8]
    assert block.angular_velocity == [0.01, 0.02, 0.03]
    assert plant(initial_quaternion=[0.0] * 4).quaternion == [1.0, 0.0, 0.0, 0.0]


def test_target_drifts_and_spins():
    block = DriftingTarget()
    block.start_time = 10.0
    block.initialize()
    start = 500.0 * np.array([math.cos(math.radians(20.0)), math.sin(math.radians(20.0)), 0.0])
    assert block.position == pytest.approx(start, abs=1e-12)
    assert np.linalg.norm(block.position) == pytest.approx(500.0, rel=1e-15)
    axis = np.array([-0.608, 0.228, 0.760])
    axis /= np.linalg.norm(axis)
    for k in range(1, 5001, 7):
        block.step(10.0 + k - 1.0, 1.0)
        assert block.position == pytest.approx(start + k * np.array([-0.05, 0.05, 0.075]), abs=1e-11)
        assert block.velocity == [-0.05, 0.05, 0.075]
        turned = Rotation.from_rotvec(k * math.radians(1.0) * axis)
        assert rotation(block).as_matrix() == pytest.approx(turned.as_matrix(), abs=1e-12)
        assert block.quaternion[0] >= 0.0


def test_target_is_30_m_from_the_published_final_point():
    """At 4250 s, 30 m along its axis: the point that the guidance steers for, (275.593, 376.667, 295.941) m."""
    block = DriftingTarget()
    block.initialize()
    block.step(4249.875, 0.125)
    axis = np.array([-0.608, 0.228, 0.760])
    final = np.array(block.position) - 30.0 * axis / np.linalg.norm(axis)
    assert final == pytest.approx([275.593, 376.667, 295.941], abs=6e-4)


def test_target_without_axis_does_not_turn():
    block = DriftingTarget(spin_axis=[0.0, 0.0, 0.0])
    block.initialize()
    block.step(100.0, 1.0)
    assert block.quaternion == [1.0, 0.0, 0.0, 0.0]
