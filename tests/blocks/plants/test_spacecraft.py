"""Spacecraft: trajectories from another program, closed forms, conservation laws.

Truth: trajectories by DOP853 at 2e-13 and modes, both from another program that shares no code with the plant;
conservation of momentum and energy; the order of the method. The check of the block combines all forces.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import perilune
from perilune.fmus_src.interfaces.ports.space import CelestialBody
from perilune.fmus_src.plants.spacecraft import Spacecraft
from tests.support.native.named_instance import NamedInstance
from tests.support.space.states import (
    FAR,
    FREQUENCY,
    FRICTIONLESS,
    INERTIA,
    MASS,
    PARTICLES,
    QUIET,
    ROTATION,
    TRANSLATION,
    UNDAMPED,
    WHEELS,
)

EARTH = 3.986004415e14  # m3/s2
seeds = st.integers(0, 2**32 - 1)


def plant(**settings):
    return NamedInstance(Spacecraft, **settings)


def random_start(seed):
    random = np.random.default_rng(seed)
    q = random.normal(size=4)
    return {
        "initial_quaternion": q / np.linalg.norm(q),
        "initial_angular_velocity": 0.05 * random.normal(size=3),
        "initial_wheel_speeds": 20.0 * random.normal(size=4),
    }


def test_a_low_orbit_of_the_earth():
    """Gravity of degree 8, Sun, Moon, spacecraft pole; 2e-6 m of the bound are the other program's."""
    flown = plant(**QUIET, gravity_degree=8, internal_step=1.0).fly(5676.0)
    expected = [6877971.77501071, 4755.1909619965345, 24504.531887988538]
    assert np.linalg.norm(flown["position"] - expected) < 1e-5
    np.testing.assert_allclose(flown["velocity"], [-26.3788690558191, -980.5181061366195, 7549.26391839155], atol=1e-8)


@pytest.mark.parametrize(("step", "error"), [(6.0, 2.0e-3), (2.0, 2.7e-5)])
def test_error_of_the_method(step, error):
    """As another Runge-Kutta of fourth order has it, with pole, Sun and Moon of the middle of each step."""
    flown = plant(**QUIET, gravity_degree=8, internal_step=step).fly(5676.0)
    expected = [6877971.77501071, 4755.1909619965345, 24504.531887988538]
    assert np.linalg.norm(flown["position"] - expected) == pytest.approx(error, rel=0.1)


@given(st.integers(0, 10**6))
def test_time_is_that_since_the_epoch(start):
    """A later start of the simulation and an earlier epoch are one, to the last bit."""
    settings = {"residual_dipole": [0.0, 0.0, 0.0], "sphere_area": 2.0, "internal_step": 1.0}
    early = plant(**settings, epoch=8.2e8 + start).fly(10.0)
    late = plant(**settings, epoch=8.2e8, start_time=float(start)).fly(10.0)
    for name in ("position", "velocity", "specific_force"):
        assert early[name].tolist() == late[name].tolist()


def test_third_bodies():
    flown = plant(**QUIET, gravity_degree=8, internal_step=2.0, third_bodies=False).fly(5676.0)
    expected = [6877971.77501071, 4755.1909619965345, 24504.531887988538]
    assert np.linalg.norm(flown["position"] - expected) == pytest.approx(6.19, abs=5e-3)


def test_a_low_orbit_of_the_moon():
    """Gravity of degree 8 in the Moon's axes, Earth and Sun as third bodies."""
    start = {"initial_position": [1837400.0, 0.0, 0.0], "initial_velocity": [0.0, 0.0, 1633.5042903107053]}
    flown = plant(**QUIET, **start, internal_step=1.0, central_body=CelestialBody.MOON).fly(7068.0)
    expected = [1837075.724270426, -530.3239357639303, 5291.919238500239]
    assert np.linalg.norm(flown["position"] - expected) < 1e-5
    np.testing.assert_allclose(
        flown["velocity"], [-4.714046863763457, 0.5532825349508612, 1633.7832480340546], atol=1e-8
    )


@given(st.floats(6.9e6, 9e6), st.floats(0.0, 0.05), *[st.floats(0.0, 6.0)] * 4)
def test_an_orbit_of_a_point_mass_closes(a, e, inclination, node, perigee, anomaly):
    """After Kepler's period 2 pi sqrt(a^3/mu)."""
    elements = {"node": node, "argument_of_perigee": perigee, "true_anomaly": anomaly, "inclination": inclination}
    r, v = perilune.orbit(semi_major_axis=a, eccentricity=e, **elements)
    settings = {"initial_position": r, "initial_velocity": v, "gravity_degree": 0, "third_bodies": False}
    period = 2.0 * np.pi * np.sqrt(a**3 / EARTH)
    flown = plant(**QUIET, **settings, internal_step=4.0).fly(period)
    np.testing.assert_allclose(flown["position"], r, atol=0.02)
    np.testing.assert_allclose(flown["velocity"], v, atol=2e-5)


def test_gravity_gradient():
    inertia = [[4.2, -0.05, 0.02], [-0.05, 4.0, 0.03], [0.02, 0.03, 3.0]]
    torque = plant(**QUIET, initial_position=[4e6, 3e6, 4.7e6], inertia=inertia)["disturbance_torque"]
    expected = [-1.0461728601568117e-06, 1.6987470222748036e-06, -1.9394672897812067e-07]
    np.testing.assert_allclose(torque, expected, rtol=1e-13)


def test_motion_of_modes():
    """Two particles, 40 s from rest under torque and force, to what another program of the same equations prints."""
    drive = {"body_torque": [0.01, -0.008, 0.006], "body_force": [0.03, -0.02, 0.015]}
    small = {"wheel_inertia": 1e-9, "internal_step": 1.0 / 64.0}
    flown = plant(**FAR, **PARTICLES, **FRICTIONLESS, **small, **drive).fly(40.0)
    expected = [0.0021422721122615, -0.0021448226969544, 0.0020013969151169]
    np.testing.assert_allclose(flown["angular_velocity"], expected, atol=1e-13)
    # particles without a linearisation, by Basilisk: they differ by the square of the amplitude
    basilisk = [0.0021422812939362, -0.0021448133024560, 0.0020014032302001]
    np.testing.assert_allclose(flown["angular_velocity"], basilisk, atol=2e-8)


def test_frequencies_of_free_modes():
    """Frequencies by the eigenvalues; the larger one as the plant states it, both as it swings.

    What swings at two frequencies obeys x(n+4) + x(n) = a (x(n+3) + x(n+1)) + b x(n+2), with a = 2 (cos + cos) and b =
    -2 - 4 cos cos of both angles by sample (Prony's method).
    """
    expected = [0.9909749515958356, 1.756907491132191]
    shared = TRANSLATION @ TRANSLATION.T / MASS + ROTATION @ np.linalg.solve(INERTIA, ROTATION.T)
    eigenvalues = np.linalg.eigvals(np.linalg.solve(np.eye(2) - shared, np.diag(FREQUENCY**2)))
    np.testing.assert_allclose(np.sqrt(np.sort(eigenvalues)), expected, rtol=1e-12)
    settings = {"wheel_inertia": 1e-9, "internal_step": 1.0 / 64.0, "body_force": [0.01, 0.02, 0.0]}
    swinging = plant(**FAR, **UNDAMPED, **FRICTIONLESS, **settings)
    assert swinging["fastest"] == pytest.approx(expected[1], rel=1e-9)
    swinging.fly(1.0).set(body_force=[0.0, 0.0, 0.0])
    x = np.array([swinging.fly(0.5)["mode_displacements"][:2] for _ in range(60)])
    middle = np.stack([(x[3:-1] + x[1:-3]).ravel(), x[2:-2].ravel()], axis=1)
    (a, b), *_ = np.linalg.lstsq(middle, (x[4:] + x[:-4]).ravel())
    cosines = np.roots([4.0, -2.0 * a, -2.0 - b])
    np.testing.assert_allclose(np.sort(np.arccos(cosines)) / 0.5, expected, rtol=1e-7)


def rates(flown):
    """Return angular velocity, wheel speeds, and rates of the modes from their momenta p = (1 - L'L/M) eta' + D'w."""
    w = flown["angular_velocity"]
    matrix = np.eye(2) - TRANSLATION @ TRANSLATION.T / MASS
    return w, flown["wheel_speeds"], np.linalg.solve(matrix, flown["modal_momenta"][:2] - ROTATION @ w), matrix


def wheel_axes(flown):
    axes = flown["wheel_axes"].reshape(4, 3)
    return axes / np.linalg.norm(axes, axis=1)[:, None]


@given(seeds)
def test_angular_momentum_does_not_change_by_a_bit(seed):
    """Whatever wheels and modes do, without torque; and it is what can be observed, R (I w + Js A W + D eta')."""
    flown = plant(**FAR, **PARTICLES, **WHEELS, **random_start(seed), internal_step=0.125)
    before = flown["angular_momentum"].tolist()
    for n in range(10):
        flown.set(motor_torques=0.5 * np.sin(n + np.arange(4.0)))
        flown.fly(0.5)
    assert flown["angular_momentum"].tolist() == before
    w, speeds, modal, _ = rates(flown)
    momentum = INERTIA @ w + WHEELS["wheel_inertia"] * speeds @ wheel_axes(flown) + modal @ ROTATION
    observed = Rotation.from_quat(flown["quaternion"], scalar_first=True).apply(momentum)
    np.testing.assert_allclose(observed, before, atol=1e-13 * np.linalg.norm(before) + 1e-13)


def energy(flown):
    """Return kinetic energy relative to the centre of mass, and the energy that bends the modes."""
    w, speeds, modal, matrix = rates(flown)
    spin, bent = WHEELS["wheel_inertia"], FREQUENCY * flown["mode_displacements"][:2]
    body = 0.5 * w @ INERTIA @ w + spin * speeds @ wheel_axes(flown) @ w + 0.5 * spin * speeds @ speeds
    return body + 0.5 * modal @ matrix @ modal + w @ (modal @ ROTATION) + 0.5 * bent @ bent


def test_energy_drifts_with_the_fifth_power_of_the_step():
    drifts = []
    for step in (0.25, 0.125, 0.0625):
        flown = plant(**FAR, **UNDAMPED, **WHEELS, **FRICTIONLESS, **random_start(5), internal_step=step)
        flown.set(body_force=[5.0, -4.0, 3.0])
        flown.fly(1.0).set(body_force=[0.0, 0.0, 0.0])
        before = energy(flown)
        drifts.append(energy(flown.fly(60.0)) - before)
    assert abs(drifts[-1]) > 1e-11 * before
    np.testing.assert_allclose(np.log2(np.divide(drifts[:-1], drifts[1:])), 5.0, atol=0.2)


@given(st.sampled_from([2, 4, 8, 16, 32]), seeds)
def test_communication_steps_change_no_bit(number, seed):
    start = random_start(seed) | {"sphere_area": 1.0, "motor_torques": [1e-3, 2e-3, 0.0, 0.0]}
    whole = plant(**start, internal_step=0.25).fly(8.0)
    divided = plant(**start, internal_step=0.25).fly(8.0, number)
    for name in ("position", "quaternion", "angular_momentum", "wheel_speeds"):
        assert divided[name].tolist() == whole[name].tolist()


@given(seeds)
def test_a_force_at_a_point_is_one_at_the_centre_and_a_torque(seed):
    random = np.random.default_rng(seed)
    point, force = random.normal(size=3), 0.1 * random.normal(size=3)
    start = random_start(seed) | PARTICLES | {"gravity_degree": 2, "internal_step": 0.25}
    at_point = plant(**start, force_point=point, body_force=force).fly(5.0)
    central = plant(**start, body_force=force, body_torque=np.cross(point, force)).fly(5.0)
    for name in ("position", "quaternion", "angular_momentum", "mode_displacements", "disturbance_torque"):
        np.testing.assert_allclose(at_point[name], central[name], rtol=1e-12, atol=1e-13)


def test_an_external_acceleration_acts_as_gravity():
    """It moves the spacecraft by a t^2/2, is not felt and excites no mode."""
    acceleration = np.array([1e-3, -2e-3, 3e-3])
    flown = plant(**FAR, **PARTICLES, external_acceleration=acceleration).fly(100.0)
    np.testing.assert_allclose(flown["velocity"], 100.0 * acceleration, rtol=1e-9)
    assert not flown["specific_force"].any()
    assert np.abs(flown["mode_displacements"]).max() < 1e-28
    assert np.abs(flown["angular_velocity"]).max() < 1e-28


def test_a_commanded_dipole_is_no_disturbance():
    """Its torque m x B adds to the angular momentum; that of the residual dipole is a disturbance."""
    dipole = np.array([3.0, -2.0, 1.0])
    settings = {"atmosphere": 0, "inertia": 3.0 * np.eye(3), "internal_step": 0.25}
    residual = plant(**settings, residual_dipole=dipole)
    commanded = plant(**settings, residual_dipole=[0.0, 0.0, 0.0], dipole=dipole)
    torque = residual["disturbance_torque"] - commanded["disturbance_torque"]
    assert abs(torque @ dipole) < 1e-12 * np.linalg.norm(torque) * np.linalg.norm(dipole)
    assert np.linalg.norm(commanded["disturbance_torque"]) < 1e-9
    np.testing.assert_allclose(commanded.fly(0.25)["angular_momentum"], 0.25 * torque, rtol=2e-3, atol=1e-9)
    assert commanded["angular_momentum"].tolist() == pytest.approx(
        residual.fly(0.25)["angular_momentum"].tolist(), rel=1e-12
    )
