"""Lander with a rotating thrust axis, compared with an adaptive integrator and closed forms.

Truth: scipy's DOP853 for translation, thrust, mass and axis together; an axis on a circle at a constant rate; a
rotation with the largest acceleration; the rocket equation down to the dry mass; free fall under uniform gravity;
ground and probe contact at known heights.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.plants.attitude_moon_lander import AttitudeMoonLander

RADIUS = 1.7374e6
MU = 4.9028e12
EXHAUST = 300.0 * 9.80665  # m/s
DEGREE = math.pi / 180.0
UNIFORM = 1.622
STEP = 0.1


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


def lander(**settings):
    plant = AttitudeMoonLander(**settings)
    plant.initialize()
    return plant


def fly(plant, seconds, step=STEP, start=0.0):
    for k in range(round(seconds / step)):
        plant.step(start + k * step, step)
    return plant


def state(plant):
    """Return position, velocity, mass, thrust, axis, rate."""
    return np.array(
        [*plant.position, *plant.velocity, plant.mass, plant.delivered_thrust, *plant.attitude, *plant.angular_rate]
    )


def integrated(y, thrust, acceleration, limit, uniform, lag, seconds):
    """Integrate the same by DOP853."""

    def slope(_, y):
        axis, rate = y[8:11], y[11:14]
        turning = np.asarray(acceleration) - np.dot(acceleration, axis) * axis
        size = np.linalg.norm(turning)
        if size > limit:
            turning = turning * limit / size
        centred = np.add(y[:3], [0.0, 0.0, RADIUS])
        gravity = [0.0, 0.0, -uniform] if uniform else -MU * centred / np.linalg.norm(centred) ** 3
        pull = np.add(gravity, y[7] / y[6] * axis)
        return np.concatenate([y[3:6], pull, [-y[7] / EXHAUST, (thrust - y[7]) / lag], np.cross(rate, axis), turning])

    return solve_ivp(slope, (0.0, seconds), y, method="DOP853", rtol=1e-12, atol=1e-12, max_step=0.1).y[:, -1]


COMMANDS = [  # thrust, angular acceleration: beyond the limit, with a component along the axis, small; 4 s each
    (4200.0, [0.02, -0.01, 0.01]),
    (900.0, [-0.004, 0.006, -0.002]),
    (2500.0, [-0.001, 0.0, 0.001]),
]


@pytest.mark.parametrize("uniform", [0.0, UNIFORM])
def test_translation_and_axis_follow_dop853(uniform):
    plant = lander(
        uniform_gravity=uniform,
        thrust_factor=1.04,
        initial_position=[4e4, -2e3, 9e3],
        initial_velocity=[-100.0, 20.0, -30.0],
        initial_attitude=[0.3, -0.2, 1.5],
        initial_angular_rate=[0.02, 0.03, -0.01],
    )
    y = state(plant)
    for k, (thrust, acceleration) in enumerate(COMMANDS):
        plant.thrust, plant.angular_acceleration, plant.burn_duration = thrust, acceleration, 1e9
        fly(plant, 4.0, start=4.0 * k)
        y = integrated(y, 1.04 * thrust, acceleration, DEGREE, uniform, 0.1, 4.0)
        actual = state(plant)
        assert np.abs(actual[:3] - y[:3]).max() < 1e-5
        assert np.abs(actual[3:6] - y[3:6]).max() < 1e-6
        assert actual[6:8] == pytest.approx(y[6:8], rel=1e-9)
        assert np.abs(actual[8:] - y[8:]).max() < 1e-8  # where the limit is left, inside a step
    assert np.dot(plant.attitude, plant.angular_rate) == pytest.approx(0.0, abs=1e-15)
    up = [0.0, 0.0, 1.0] if uniform else unit(np.add(plant.position, [0.0, 0.0, RADIUS]))
    assert math.cos(plant.tilt) == pytest.approx(np.dot(plant.attitude, up), abs=1e-12)
    assert plant.vertical_speed == pytest.approx(np.dot(plant.velocity, up), abs=1e-9)
    assert math.hypot(plant.vertical_speed, plant.horizontal_speed) == pytest.approx(plant.speed, abs=1e-9)
    height = plant.position[2] if uniform else np.linalg.norm(np.add(plant.position, [0.0, 0.0, RADIUS])) - RADIUS
    assert plant.altitude == pytest.approx(height, abs=1e-8)


def test_a_constant_rate_moves_the_axis_on_a_circle():
    rate = np.array([0.12, 0.0, 0.0])
    plant = fly(lander(initial_angular_rate=rate.tolist()), 30.0)
    expected = Rotation.from_rotvec(30.0 * rate).apply([0.0, 0.0, 1.0])
    assert plant.attitude == pytest.approx(expected, abs=1e-10)
    assert plant.angular_rate == pytest.approx(rate, abs=1e-12)
    assert plant.tilt == pytest.approx(abs(math.remainder(3.6, 2.0 * math.pi)), abs=1e-10)


@given(st.floats(0.1, 40.0), st.floats(0.0, 2.0 * math.pi))
def test_accelerations_are_no_larger_than_the_limit(size, azimuth):
    """In a plane through the axis: half the limit times the square of time."""
    axis = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    plant = lander()
    plant.angular_acceleration = (size * DEGREE * axis).tolist()
    fly(plant, 5.0)
    largest = min(size, 1.0) * DEGREE
    assert plant.tilt == pytest.approx(12.5 * largest, rel=1e-9)
    assert plant.angular_rate == pytest.approx(5.0 * largest * axis, abs=1e-12)


def test_the_part_along_the_axis_does_nothing():
    plant = lander(initial_attitude=[0.0, 3.0, 4.0], initial_angular_rate=[0.0, 0.6, 0.8])
    plant.angular_acceleration = [0.0, 0.006, 0.008]
    assert plant.angular_rate == pytest.approx([0.0, 0.0, 0.0], abs=1e-16)
    fly(plant, 3.0)
    assert plant.attitude == pytest.approx([0.0, 0.6, 0.8], abs=1e-15)
    assert plant.angular_rate == pytest.approx([0.0, 0.0, 0.0], abs=1e-16)


def test_a_stone_falls_on_a_parabola():
    plant = fly(lander(uniform_gravity=UNIFORM, initial_velocity=[3.0, -2.0, 5.0]), 40.0)
    expected = [120.0, -80.0, 2400.0 + 200.0 - 0.5 * UNIFORM * 1600.0]
    assert plant.position == pytest.approx(expected, abs=1e-9)
    assert plant.velocity == pytest.approx([3.0, -2.0, 5.0 - 40.0 * UNIFORM], abs=1e-11)
    assert plant.altitude == plant.position[2]


@pytest.mark.parametrize("lag", [0.0, 0.1, 0.7])
@pytest.mark.parametrize("step", [0.1, 0.05, 0.25])
def test_thrust_ends_where_the_propellant_does(lag, step):
    """600 kg to 560 kg: the rocket equation's speed, reached inside a step, and nothing more."""
    plant = lander(uniform_gravity=UNIFORM, dry_mass=560.0, thrust_lag=lag)
    plant.thrust, plant.burn_duration = 4000.0, 1e9
    fly(plant, 40.0, step)
    assert plant.mass == 560.0
    assert plant.delivered_thrust == 0.0
    assert plant.sensed_velocity == pytest.approx([0.0, 0.0, EXHAUST * math.log(600.0 / 560.0)], abs=1e-9)
    assert plant.velocity[2] == pytest.approx(plant.sensed_velocity[2] - 40.0 * UNIFORM, abs=1e-9)
    assert plant.specific_force == [0.0, 0.0, 0.0]


def test_at_or_below_dry_mass_there_is_no_thrust():
    plant = lander(dry_mass=600.0)
    plant.thrust, plant.burn_duration = 4000.0, 1e9
    fly(plant, 1.0)
    assert plant.mass == 600.0
    assert plant.sensed_velocity == [0.0, 0.0, 0.0]


def test_a_burn_ends_inside_a_step():
    """The impulse of a whole burn is the commanded one, times the true factor."""
    plant = lander(thrust_factor=0.9)
    plant.thrust, plant.burn_duration, plant.command_time = 3000.0, 4.27, 0.31
    fly(plant, 12.0)
    assert 600.0 - plant.mass == pytest.approx(0.9 * 3000.0 * (4.27 + 0.31) / EXHAUST, rel=1e-12)
    assert plant.coast_time == pytest.approx(12.0 - 4.58, abs=1e-9)


@pytest.mark.parametrize("uniform", [0.0, UNIFORM])
def test_on_the_ground_the_state_is_kept(uniform):
    """Dropped from 10 m at 3 m/s across: at altitude 0 with the speed of the fall; the probe a little earlier."""
    start = {"initial_position": [0.0, 0.0, 10.0], "initial_velocity": [3.0, 0.0, 0.0]}
    plant = lander(uniform_gravity=uniform, probe_length=2.0, **start)
    probe = []
    for k in range(80):
        plant.step(k * STEP, STEP)
        probe.append(plant.probe_contact)
    fall = uniform or MU / RADIUS**2
    assert plant.ground_contact
    assert plant.altitude == pytest.approx(0.0, abs=1e-9)
    time = math.sqrt(2.0 * 10.0 / fall)
    assert plant.position[0] == pytest.approx(3.0 * time, abs=1e-4)
    assert -plant.vertical_speed == pytest.approx(fall * time, abs=1e-4)
    assert probe.index(True) == pytest.approx(math.sqrt(2.0 * 8.0 / fall) / STEP, abs=1.0)
    held = state(plant)
    plant.thrust, plant.burn_duration, plant.angular_acceleration = 4000.0, 1e9, [0.01, 0.0, 0.0]
    fly(plant, 1.0, start=8.0)
    assert (state(plant) == held).all()


def test_communication_does_not_change_a_flight():
    def flown(step):
        plant = lander(initial_angular_rate=[0.03, 0.0, 0.0])
        plant.thrust, plant.burn_duration, plant.angular_acceleration = 3500.0, 7.77, [0.001, -0.004, 0.0]
        return state(fly(plant, 12.0, step))

    for step in (0.05, 0.2, 1.0):
        assert flown(step) == pytest.approx(flown(0.1), rel=1e-11, abs=1e-11)


def test_an_attitude_without_length_is_upright():
    assert lander(initial_attitude=[0.0, 0.0, 0.0]).attitude == [0.0, 0.0, 1.0]
