"""Spacecraft on its orbit: motion, pulses, conservation laws, communication steps.

Truth: direction cosines in inertial axes by scipy's DOP853 (tests/support/flights/orbital_motion.py); Jacobi's
integral; numbers from another program. Tolerances are stated at each test.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.orbits.attitude import AttitudeState
from perilune.fmus_src.plants.orbital_spacecraft import OrbitalSpacecraft
from tests.support.flights.orbital_motion import (
    DEGREE,
    INERTIA,
    JET_TORQUE,
    ORBITAL_RATE,
    acceleration,
    angles_of,
    body_from_orbital,
    flown,
)
from tests.support.lengths import either

CORNER = ([3.0 * DEGREE, 17.0 * DEGREE, 3.0 * DEGREE], [0.01 * DEGREE] * 3)
TICK = 0.2


def plant(start=CORNER, **parameters):
    block = OrbitalSpacecraft(initial_angles=start[0], initial_angular_velocity=start[1], **parameters)
    block.initialize()
    return block


def fly(block, ticks, steps=1):
    """Fly through ticks, each (three signed lengths); the state after each."""
    rows = []
    for number, pulses in enumerate(ticks):
        block.pulse_lengths, block.pulse_count = pulses, number + 1
        for part in range(steps):
            block.step(TICK * (number + part / steps), TICK / steps)
        rows.append([*block.angles, *block.angular_velocity])
    return np.array(rows)


def some_ticks(count, seed=1):
    """Return pulses of all kinds: none, short ones, full ones."""
    lengths = np.random.default_rng(seed).uniform(-0.3, 0.3, (count, 3)).clip(-TICK, TICK)
    lengths[np.abs(lengths) < 0.03] = 0.0
    return lengths.tolist()


def test_a_tick_with_three_pulses():
    """The digits of another program, from the corner of the box of starts."""
    row = fly(plant(), [[0.05, -0.10, 0.20]])[0]
    assert row[:3] == pytest.approx([0.0524126433, 0.2966790547, 0.0526863802], abs=1e-10)
    assert row[3:] == pytest.approx([6.3971449e-4, -2.175749878e-4, 1.0010677646e-3], abs=5e-12)


def test_motion_is_that_of_direction_cosines_in_inertial_axes():
    """Within 1e-10 over 20 s of pulses, which is what Runge-Kutta's fourth order leaves at 0.1 s."""
    ticks = some_ticks(100)
    rows = fly(plant(), ticks)
    times = [TICK * (n + 1) for n in range(len(ticks))]
    cuts = [TICK * n + abs(length) for n, pulses in enumerate(ticks) for length in pulses]

    def torque_at(time):
        n = int(time / TICK)
        pulses = np.array(ticks[n])
        return np.where(time - TICK * n < np.abs(pulses), np.sign(pulses), 0.0) * JET_TORQUE

    angles, w = flown(*CORNER, times, torque_at, cuts)
    assert np.abs(rows[:, :3] - angles).max() < 1e-10
    assert np.abs(rows[:, 3:] - w).max() < 1e-11


@pytest.mark.parametrize("steps", [2, 4, 8, 20])
def test_the_communication_step_changes_nothing(steps):
    """Within 1e-10 over 100 s, whatever whole fraction of the tick it is."""
    ticks = some_ticks(500, seed=2)
    once, parted = plant(), plant()
    difference = fly(once, ticks) - fly(parted, ticks, steps)
    assert np.abs(difference).max() < 1e-10
    assert once.jet_seconds == pytest.approx(parted.jet_seconds, abs=1e-10)


def test_jet_seconds_are_the_lengths_of_the_pulses():
    ticks = some_ticks(200, seed=3)
    block = plant()
    fly(block, ticks)
    assert block.jet_seconds == pytest.approx(np.abs(ticks).sum(), abs=1e-11)


def test_jacobi_s_integral_is_kept_without_jets():
    """1/2 w'Jw, w against the orbit, + 3/2 w0^2 j'Jj - 1/2 w0^2 n'Jn, n the orbit's normal: to 1e-13 over 500 s."""

    def integral(row):
        matrix = body_from_orbital(row[:3])
        up, normal = matrix[:, 1], matrix[:, 2]
        relative = row[3:] + ORBITAL_RATE * normal
        gradient = 1.5 * ORBITAL_RATE**2 * up @ INERTIA @ up - 0.5 * ORBITAL_RATE**2 * normal @ INERTIA @ normal
        return 0.5 * relative @ INERTIA @ relative + gradient

    actual = [integral(row) for row in fly(plant(), [[0.0, 0.0, 0.0]] * 2500)]
    assert np.ptp(actual) < 1e-13 * 30000.0


def test_left_alone_at_the_wanted_state_products_of_inertia_turn_it():
    block = plant(([0.0] * 3, [0.0, 0.0, -ORBITAL_RATE]))
    block.step(0.0, 0.01)
    actual = (np.array([*block.angular_velocity]) - [0.0, 0.0, -ORBITAL_RATE]) / 0.01
    assert actual == pytest.approx(acceleration(np.eye(3), np.array([0.0, 0.0, -ORBITAL_RATE]), 0.0), abs=1e-12)
    assert actual == pytest.approx([-1.49e-7, 3.4e-9, 1.8e-8], rel=0.03)


angle = st.floats(-0.5, 0.5)
rate = st.floats(-0.05, 0.05)


@settings(max_examples=either(30, 10))
@given(st.tuples(angle, angle, angle), st.tuples(rate, rate, rate))
def test_angles_turn_as_direction_cosines_do(angles, w):
    """Half a step of 1e-3 s either way: the cosines' own derivative, to 1e-8 rad/s."""
    h = 1e-3
    block = plant((angles, w))
    here = AttitudeState(angles=block.angles, angular_velocity=block.angular_velocity)
    turning = block.derivatives(0.0, here, block.mean_torque).angles
    matrix = body_from_orbital(angles)
    relative = np.array(w) + ORBITAL_RATE * matrix[:, 2]
    skew = np.array([[0, -relative[2], relative[1]], [relative[2], 0, -relative[0]], [-relative[1], relative[0], 0]])
    change = h * -skew @ matrix
    expected = (angles_of(matrix + 0.5 * change) - angles_of(matrix - 0.5 * change)) / h
    assert [*turning] == pytest.approx(expected, abs=1e-7)


def test_a_mean_torque_acts_beside_the_pulses():
    block, pulsed = plant(), plant()
    block.mean_torque = JET_TORQUE.tolist()
    rows = [fly(block, [[0.0] * 3] * 5)[-1], fly(pulsed, [[TICK] * 3] * 5)[-1]]
    assert rows[0] == pytest.approx(rows[1], abs=1e-14)
    assert [*block.held_torque] == JET_TORQUE.tolist()
    assert (block.jet_seconds, pulsed.jet_seconds) == (0.0, pytest.approx(3.0))


def test_a_new_count_replaces_what_is_left_and_an_old_one_fires_nothing():
    block = plant()
    block.pulse_lengths, block.pulse_count = [1.0, 0.0, 0.0], 1
    block.step(0.0, 0.1)
    block.step(0.1, 0.1)
    assert [*block.left] == pytest.approx([0.8, 0.0, 0.0])
    block.pulse_lengths, block.pulse_count = [-0.05, 0.0, 0.0], 2
    block.step(0.2, 0.1)
    block.step(0.3, 0.1)
    assert block.jet_seconds == pytest.approx(0.25)
    assert [*block.left] == [0.0, 0.0, 0.0]


def test_an_inertia_that_cannot_be_inverted_is_a_status():
    block = plant(inertia=[0.0] * 9)
    block.step(0.0, 0.2)
    assert block.status == 1
    assert [*block.angles] == CORNER[0]
