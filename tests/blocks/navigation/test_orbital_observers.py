"""Observers of the orbital attitude: gains, errors in the linear model, missing and invalid samples.

Truth: poles by numpy's eigenvalues; the errors' decay in closed form; the motion of the plant, which an observer that
integrates each pulse must reproduce; yaw after ten samples by another program.
"""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.kernel.records import replace
from perilune.fmus_src.mathlib.orbits.attitude import linear_model
from perilune.fmus_src.plants.orbital_spacecraft import OrbitalSpacecraft
from tests.support.flights.orbital_motion import DEGREE, INERTIA, ORBITAL_RATE
from tests.support.flights.orbital_runs import OBSERVERS, TICK, Run

FULL = OBSERVERS[:2] + OBSERVERS[3:5]
SPLIT = ["orbital_observer_discrete_split", "orbital_observer_discrete_reduced_split", "orbital_sequence"]
C = np.delete(np.eye(6), 1, axis=0)
YAW_AFTER_TEN = [-0.00697647, -0.00707183, 0.00266202, 0.02316316, 0.04026581, 0.03892598, 0.06657346, 0.16449053]


def model(inertia=INERTIA):
    return np.array(linear_model(Matrix(inertia.tolist()), Matrix(np.linalg.inv(inertia).tolist()), ORBITAL_RATE))


def moving_sample(k):
    return 0.05 - 2e-4 * k, -0.02 + 1e-4 * k, (-0.001, 0.0005, -0.0006)


def still_sample(roll=0.0, pitch=0.0, rates=(0.0, 0.0, -ORBITAL_RATE)):
    return roll, pitch, rates


@pytest.mark.parametrize(("name", "yaw"), list(zip(OBSERVERS, YAW_AFTER_TEN, strict=False)))
def test_yaw_after_ten_ticks(name, yaw):
    run = Run(name, moving_sample(0), (0.05, -0.10, 0.0))
    for k in range(1, 11):
        row = run.step(moving_sample(k), (0.05, -0.10, 0.0))
    assert row[1] == pytest.approx(yaw, abs=6e-9)


@pytest.mark.parametrize("name", FULL)
@pytest.mark.parametrize(("period", "yaw_pole", "measured_pole"), [(0.2, 0.1, 1.0), (1.0, 0.04, 0.3)])
def test_poles_of_the_whole_state(name, period, yaw_pole, measured_pole):
    """Within 1e-9 for yaw and the fifth root of rounding for the pole of five."""
    run = Run(name, still_sample(), sample_period=period, yaw_pole=yaw_pole, measured_pole=measured_pole)
    gain = np.reshape(run.block.gain, (6, 5))
    if "discrete" in name:
        closed = (np.eye(6) - gain @ C) @ expm(model() * period)
        yaw, measured = math.exp(-yaw_pole * period), math.exp(-measured_pole * period)
    else:
        closed, yaw, measured = model() - gain @ C, -yaw_pole, -measured_pole
    actual = np.linalg.eigvals(closed)
    order = np.argsort(np.abs(actual - yaw))
    assert abs(actual[order[0]] - yaw) < 1e-9
    assert np.abs(actual[order[1:]] - measured).max() < 2e-3
    shifted = closed - measured * np.eye(6)
    assert np.abs(shifted @ (closed - yaw * np.eye(6))).max() < 1e-9 * np.abs(closed).max() ** 2


def test_some_gains_of_the_discrete_observer():
    """The yaw and the roll row at 0.2 s with the poles 0.1 and 1, to the digits of another program."""
    run = Run("orbital_observer_discrete", still_sample())
    gain = np.reshape(run.block.gain, (6, 5))
    assert gain[1] == pytest.approx([-16.3151, 0.0, 0.0, 0.1637, 0.0], abs=6e-5)
    assert gain[0] == pytest.approx([0.19748, 0.0, 0.16375, 0.0, 0.0], abs=3e-5)


@pytest.mark.parametrize("name", OBSERVERS[:8])
def test_errors_of_yaw_decay(name):
    """A body at rest at a yaw of 1 deg, measured without errors: found within 2 % of it after eight decay times."""
    plant = OrbitalSpacecraft(
        initial_angles=[0.0, DEGREE, 0.0], initial_angular_velocity=[0.0, 0.0, -ORBITAL_RATE], internal_step=0.2
    )
    plant.initialize()
    run = Run(name, still_sample(plant.angles.x, plant.angles.z, plant.angular_velocity))
    for k in range(400):
        plant.step(TICK * k, TICK)
        row = run.step(still_sample(plant.angles.x, plant.angles.z, plant.angular_velocity))
    assert abs(row[1] - plant.angles.y) < 0.02 * DEGREE


@pytest.mark.parametrize("name", SPLIT)
def test_what_follows_each_pulse_stays_with_the_plant(name):
    """Once it has the true state it keeps it through pulses of all kinds: 1e-9 rad after 20 s."""
    plant = OrbitalSpacecraft(
        initial_angles=[0.02, 0.0, -0.01], initial_angular_velocity=[0.0, 1e-4, -ORBITAL_RATE], internal_step=0.2
    )
    plant.initialize()
    options = {"levelling_end": 0.2, "averaging_end": 0.4} if name == "orbital_sequence" else {}
    run = Run(name, still_sample(plant.angles.x, plant.angles.z, plant.angular_velocity), **options)
    lengths = np.random.default_rng(5).uniform(-0.1, 0.1, (100, 3))
    for k, pulses in enumerate(lengths.tolist()):
        if name == "orbital_sequence" and k == 2:
            run.block.estimate = replace(run.block.estimate, angles=plant.angles)
        plant.pulse_lengths, plant.pulse_count = pulses, k + 1
        plant.step(TICK * k, TICK)
        row = run.step(still_sample(plant.angles.x, plant.angles.z, plant.angular_velocity), pulses)
    assert row == pytest.approx([*plant.angles, *plant.angular_velocity], abs=1e-9)


@pytest.mark.parametrize("name", OBSERVERS)
def test_a_missing_and_a_wrong_sample_carry_the_motion_on(name):
    run = Run(name, still_sample())
    run.step(still_sample())
    assert run.block.status == 0
    row = run.step(still_sample(0.3), new=False)
    assert run.block.status == 1
    assert abs(row[0]) < 1e-3
    row = run.step(still_sample(math.nan))
    assert run.block.status == 2
    assert np.isfinite(row).all()
    row = run.step(still_sample())
    assert run.block.status == 0
    assert np.abs(row[:3]).max() < 1e-3


@pytest.mark.parametrize("name", OBSERVERS[:9])
def test_parameters_without_a_gain_are_a_status(name):
    run = Run(name, still_sample(), inertia=[0.0] * 9)
    assert run.block.status == 4
    run.step(still_sample())
    assert run.block.status == 4


@pytest.mark.parametrize("name", OBSERVERS[:7])
def test_yaw_is_bounded(name):
    run = Run(name, still_sample())
    for k in range(1, 300):
        run.step(still_sample(0.02 * k))
    assert abs(run.block.estimated_angles.y) <= 0.9
    assert run.block.status == 3


def test_the_truth():
    run = Run("orbital_true_state", still_sample(), true_angles=[0.1, 0.2, 0.3], true_angular_velocity=[0.4, 0.5, 0.6])
    assert run.step(still_sample()) == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]


def test_the_sequence_finds_the_mean_yaw():
    """A body held at a yaw of 2 deg turns with wx = w0 sin(yaw): 0 until averaging ends, then that yaw to 0.2 %."""
    yaw = 2.0 * DEGREE
    held = still_sample(0.0, 0.0, (ORBITAL_RATE * math.sin(yaw), 0.0, -ORBITAL_RATE * math.cos(yaw)))
    run = Run("orbital_sequence", held)
    rows = [run.step(held) for _ in range(1350)]
    assert {row[1] for row in rows[:-1]} == {0.0}
    assert rows[-1][1] == pytest.approx(yaw, rel=2e-3)
