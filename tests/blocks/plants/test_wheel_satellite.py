"""Satellite with reaction wheels: conservation laws, closed forms, limits.

Truth: conservation of momentum and energy; closed forms of one wheel on one axis; convergence of fourth order. The full
equations are covered by the block's check, and by the cross-check against Basilisk.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.plants.wheel_satellite import WheelSatellite, WheelSatelliteStatus

STEP = 0.125
INERTIA = np.array([[12.0, -0.7, 0.3], [-0.7, 9.0, 0.5], [0.3, 0.5, 7.0]])
AXES = np.array([[1.0, 0.2, 0.5], [-0.3, 1.2, 0.4], [-0.9, -0.2, 0.6], [0.1, -1.0, 0.8]])
UNIT = (AXES / np.linalg.norm(AXES, axis=1)[:, None]).T
SPIN = 0.4
FRICTIONLESS = {"viscous_friction": 0.0, "coulomb_friction": 0.0}
seeds = st.integers(0, 2**32 - 1)


def plant(inertia=INERTIA, axes=AXES, **settings):
    settings = {"wheel_inertia": SPIN, "motor_torque_limit": 10.0, "speed_limit": 0.0} | settings
    block = WheelSatellite(inertia=Matrix(np.asarray(inertia).tolist()), wheel_axes=Matrix(np.asarray(axes).tolist()))
    for name, setting in settings.items():
        setattr(block, name, np.asarray(setting, dtype=float).tolist() if np.ndim(setting) else setting)
    block.initialize()
    return block


def random_start(seed):
    random = np.random.default_rng(seed)
    return {
        "initial_quaternion": random.normal(size=4),
        "initial_angular_velocity": 0.2 * random.normal(size=3),
        "initial_wheel_speeds": 20.0 * random.normal(size=4),
    }


def fly(block, seconds, motors=None, step=STEP):
    """Fly under motor torques, a function of time; the rows (w, W) at every step."""
    rows = []
    for n in range(round(seconds / step)):
        if motors is not None:
            block.motor_torques = np.asarray(motors(n * step), dtype=float).tolist()
        block.step(n * step, step)
        rows.append([*block.angular_velocity, *block.wheel_speeds])
    return np.array(rows)


def momentum(block):
    """Return the angular momentum in inertial axes, from observable outputs."""
    body = INERTIA @ np.array([*block.angular_velocity]) + SPIN * UNIT @ np.array([*block.wheel_speeds])
    return Rotation.from_quat([*block.quaternion], scalar_first=True).apply(body)


def energy(block):
    """Return kinetic energy of a body with wheels, I of both as if they did not spin (Schaub and Junkins 2018, 4.5)."""
    w, speeds = np.array([*block.angular_velocity]), np.array([*block.wheel_speeds])
    return 0.5 * w @ INERTIA @ w + SPIN * speeds @ UNIT.T @ w + 0.5 * SPIN * speeds @ speeds


@given(seeds)
def test_momentum_is_conserved_whatever_the_wheels_do(seed):
    block = plant(**random_start(seed))
    before, observed = tuple(block.angular_momentum), momentum(block)
    fly(block, 5.0, lambda t: 2.0 * np.sin(t + np.arange(4.0)))
    assert tuple(block.angular_momentum) == before
    np.testing.assert_allclose(momentum(block), observed, atol=1e-12 * np.linalg.norm(observed) + 1e-12)


@pytest.mark.slow
@given(seeds)
def test_energy_is_conserved_without_motors_and_friction(seed):
    block = plant(**random_start(seed), **FRICTIONLESS, internal_step=1.0 / 128.0)
    before = energy(block)
    fly(block, 5.0)
    assert energy(block) == pytest.approx(before, rel=1e-8)


def test_energy_is_what_motors_give_and_friction_takes():
    """The power of a torque u on a wheel is u W; the work by Simpson's rule on the observed speeds."""
    block = plant(**random_start(7), viscous_friction=0.02, coulomb_friction=0.0, internal_step=1.0 / 64.0)
    before, start = energy(block), np.array([*block.wheel_speeds])
    motors, step = np.array([1.0, -0.5, 0.3, 0.2]), 1.0 / 64.0
    speeds = np.vstack([start, fly(block, 4.0, lambda t: motors, step)[:, 3:]])
    power = (speeds * (motors - 0.02 * speeds)).sum(axis=1)
    work = step / 3.0 * (power[0] + 4.0 * power[1::2].sum() + 2.0 * power[2:-1:2].sum() + power[-1])
    assert energy(block) - before == pytest.approx(work, rel=1e-6)


def test_the_method_is_of_fourth_order():
    ends = []
    for step in (0.25, 0.125, 0.0625, 0.0078125):
        block = plant(**random_start(3), **FRICTIONLESS, internal_step=step)
        ends.append(fly(block, 4.0, lambda t: [1.0, -0.5, 0.3, 0.2], 0.25)[-1])
    errors = [np.abs(end - ends[-1]).max() for end in ends[:-1]]
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([4.0, 4.0], abs=0.3)


@pytest.mark.parametrize("friction", [0.0, 0.05])
def test_one_wheel_spins_up_one_axis(friction):
    """I w + Js W = 0 and W' = (u - c W)(1/Js + 1/(I - Js)): a straight line, or an exponential."""
    torque, inertia, time = 0.3, 12.0, 20.0
    block = plant(
        np.diag([inertia, 9.0, 7.0]), np.vstack([np.eye(3), [0, 0, 1]]), viscous_friction=friction, coulomb_friction=0.0
    )
    (*rate, speed), *_ = fly(block, time, lambda t: [torque, 0.0, 0.0, 0.0])[-1:, :4]
    slope = 1.0 / SPIN + 1.0 / (inertia - SPIN)
    expected = torque * slope * time
    if friction > 0.0:
        expected = torque / friction * (1.0 - np.exp(-friction * slope * time))
    assert speed == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(rate, [-SPIN / inertia * expected, 0.0, 0.0], rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("frame", ["body", "inertial"])
def test_external_torque_adds_to_the_momentum(frame):
    """From rest, about a principal axis both frames have the same torque; wheels without torque stay behind."""
    axes = [*np.eye(3), [1.0, 0.0, 0.0]]
    block = plant(np.diag([12.0, 9.0, 7.0]), axes, **FRICTIONLESS, **{f"{frame}_torque": [0.0, 0.0, 0.02]})
    end = fly(block, 10.0)[-1]
    rate = 0.02 * 10.0 / (7.0 - SPIN)
    np.testing.assert_allclose(end, [0.0, 0.0, rate, 0.0, 0.0, -rate, 0.0], atol=1e-12)
    assert block.angular_momentum.z == pytest.approx(0.2, rel=1e-12)


def test_coulomb_friction_stops_a_wheel_and_holds_it():
    """With one wheel: W falls by mu (1/Js + 1/(I - Js)) t, to rest; below the band it decays."""
    inertia, mu, band = 12.0, 0.5, 0.01
    block = plant(
        np.diag([inertia, 9.0, 7.0]),
        np.vstack([np.eye(3), [0, 0, 1]]),
        viscous_friction=0.0,
        coulomb_friction=mu,
        coulomb_band=band,
        initial_wheel_speeds=[10.0, 0.0, 0.0, 0.0],
        internal_step=1.0 / 512.0,
    )
    slope = mu * (1.0 / SPIN + 1.0 / (inertia - SPIN))
    speeds = fly(block, 12.0)[:, 3]
    time = STEP * np.arange(1, speeds.size + 1)
    sliding = time < 10.0 / slope - STEP
    np.testing.assert_allclose(speeds[sliding], 10.0 - slope * time[sliding], rtol=1e-9)
    assert np.abs(speeds[time > 10.0 / slope + 1.0]).max() < 1e-9


def test_a_motor_gives_no_more_than_its_limit_times_its_factor():
    block = plant(motor_torque_limit=0.2, torque_factor=[1.0, 0.5, 0.0, 1.1])
    fly(block, STEP, lambda t: [0.5, -0.5, 0.5, 0.1])
    np.testing.assert_allclose([*block.applied_torques], [0.2, -0.1, 0.0, 0.11], rtol=1e-15)
    assert block.status == WheelSatelliteStatus.TORQUE_LIMITED
    fly(block, STEP, lambda t: [0.2 * (1.0 + 1e-15), 0.0, 0.0, 0.0])
    assert block.status == WheelSatelliteStatus.GOOD


def test_a_wheel_at_its_speed_limit_is_driven_back_only():
    """It goes beyond the limit by what one integration step gives, and comes back at once."""
    block = plant(speed_limit=10.0, **FRICTIONLESS, internal_step=STEP)
    speeds = fly(block, 20.0, lambda t: [0.4, 0.0, 0.0, 0.0])[:, 3]
    assert block.status == WheelSatelliteStatus.SPEED_LIMITED
    assert 10.0 <= speeds.max() <= 10.0 + 0.5 * STEP / SPIN
    assert block.applied_torques.w == 0.0
    fly(block, STEP, lambda t: [-0.4, 0.0, 0.0, 0.0])
    assert block.applied_torques.w == -0.4
    assert block.wheel_speeds.w < speeds[-1]


@pytest.mark.parametrize("inertia", [np.zeros((3, 3)), np.diag([0.1, 9.0, 7.0]), -INERTIA])
def test_an_inertia_that_no_body_has_is_reported(inertia):
    block = plant(inertia, initial_angular_velocity=[0.1, 0.0, 0.0])
    fly(block, 1.0, lambda t: [1.0, 0.0, 0.0, 0.0])
    assert block.status == WheelSatelliteStatus.NO_INERTIA
    assert tuple(block.angular_velocity) == (0.1, 0.0, 0.0)
    assert tuple(block.quaternion) == (1.0, 0.0, 0.0, 0.0)
