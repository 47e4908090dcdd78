"""Control blocks of the orbital attitude.

Truth: the prescribed closed-loop matrices (1e-12), gains from another program, the least rotation in closed form,
symmetry properties.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.control.orbital_arrival_control import OrbitalArrivalControl
from perilune.fmus_src.control.orbital_derivative_control import OrbitalDerivativeControl
from perilune.fmus_src.control.orbital_modal_control import OrbitalModalControl
from perilune.fmus_src.kernel.matrices import matrix
from perilune.fmus_src.kernel.records import replace
from perilune.fmus_src.mathlib.orbits.attitude import AttitudeState, linear_model
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.plants.orbital_spacecraft import OrbitalSpacecraft
from tests.support.flights.orbital_motion import DEGREE, INERTIA, JET_TORQUE, ORBITAL_RATE
from tests.support.lengths import either

WANTED = [0.0, 0.0, -ORBITAL_RATE]
WANTED_VECTOR = vector(*WANTED)


def regulator(kind, **parameters):
    block = kind(**parameters)
    block.initialize()
    return block


def answer(block, angles, w, time=0.0):
    block.estimated_angles, block.estimated_angular_velocity = angles, w
    block.step(time, 0.0)
    return np.array([*block.torque_command])


def test_gains_of_the_modal_law():
    """To the digits of another program."""
    block = regulator(OrbitalModalControl)
    gains = np.hstack([np.reshape(block.angle_gain, (3, 3)), np.reshape(block.rate_gain, (3, 3))])
    expected = [
        [-97.4628, 3.2273, 1.5004, -1625.0, 38.25, 24.56],
        [-4.3507, -288.0050, 2.9993, 29.25, -6000.0, 50.22],
        [1.5442, 1.8923, -435.0853, 25.44, 39.78, -7250.0],
    ]
    assert gains == pytest.approx(np.array(expected), abs=6e-5)


poles = st.lists(st.floats(0.01, 1.0), min_size=3, max_size=3)


@settings(max_examples=either(30, 10))
@given(poles, poles, st.integers(0, 2**32 - 1))
def test_angles_and_their_lack_decay_as_placed(angle_poles, rate_poles, seed):
    """a' = S1 a + z and z' = S0 z in the linear model, for any body: to 1e-9."""
    root = np.random.default_rng(seed).normal(size=(3, 3))
    inertia = 1000.0 * (root @ root.T + 3.0 * np.eye(3))
    block = regulator(
        OrbitalModalControl, inertia=inertia.ravel().tolist(), angle_poles=angle_poles, rate_poles=rate_poles
    )
    a = np.array(linear_model(block.inertia, block.inverse_inertia, ORBITAL_RATE))
    gain = np.hstack([np.array(block.angle_gain), np.array(block.rate_gain)])
    closed = a + np.vstack([np.zeros((3, 3)), np.linalg.inv(inertia)]) @ gain
    lack = closed[:3] + np.hstack([np.diag(angle_poles), np.zeros((3, 3))])
    assert lack @ closed == pytest.approx(-np.diag(rate_poles) @ lack, abs=1e-9)


def test_the_modal_law_is_linear_in_what_is_lacking():
    block = regulator(OrbitalModalControl)
    assert answer(block, [0.0] * 3, WANTED) == pytest.approx([0.0] * 3)
    once = answer(block, [0.01, -0.02, 0.03], [1e-3, 2e-3, -ORBITAL_RATE])
    twice = answer(block, [0.02, -0.04, 0.06], [2e-3, 4e-3, -ORBITAL_RATE])
    assert twice == pytest.approx(2.0 * once)


def test_arrival_asks_for_the_rate_that_arrives():
    """At rest 10 deg off in yaw: after the first tick at full torque or less it turns at (10 - 0.1) deg in 35 s."""
    block = regulator(OrbitalArrivalControl)
    plant = OrbitalSpacecraft(initial_angles=[0.0, 10.0 * DEGREE, 0.0], initial_angular_velocity=WANTED)
    plant.initialize()
    torque = answer(block, plant.angles, plant.angular_velocity)
    rate = torque[1] * 0.2 * np.linalg.inv(INERTIA)[1, 1]
    here = AttitudeState(angles=plant.angles, angular_velocity=plant.angular_velocity)
    turning = plant.derivatives(0.0, here, plant.held_torque).angles
    assert turning.y + rate == pytest.approx(-9.9 * DEGREE / 35.0, rel=1e-12)
    assert torque[2] == 0.0


@pytest.mark.parametrize(("error", "asked"), [(0.09, False), (0.4, False), (0.6, True)])
def test_arrival_lets_small_errors_be(error, asked):
    """Late, with least_time 8 s to go: a least pulse about yaw gives 120 * 0.03/30000 rad/s, 0.055 deg in 8 s."""
    block = regulator(OrbitalArrivalControl)
    needed = 0.1 + 8.0 * np.linalg.inv(INERTIA)[1, 1] * JET_TORQUE[1] * 0.03 / DEGREE
    yaw = 0.1 + (needed - 0.1) * (error / 0.5)
    torque = answer(block, [0.0, yaw * DEGREE, 0.0], [ORBITAL_RATE * yaw * DEGREE, 0.0, WANTED[2]], 200.0)
    assert (torque[1] != 0.0) == asked


@settings(max_examples=either(50, 16))
@given(st.floats(0.0, 500.0), st.floats(-1.0, 1.0))
def test_the_turn_goes_to_its_angle_and_back(time, angle):
    block = regulator(OrbitalArrivalControl, turn_angle=angle)
    h = 1e-4
    yaw, rate = block.lead_yaw(time)
    assert 0.0 <= abs(yaw) <= abs(angle)
    assert yaw * angle >= 0.0
    before, _ = block.lead_yaw(time - h)
    after, _ = block.lead_yaw(time + h)
    assert abs(after - before) <= 2.0 * h * block.turn_rate * (1.0 + 1e-6)
    assert rate in (0.0, block.turn_rate, -block.turn_rate)
    ramp = abs(angle) / block.turn_rate
    if block.turn_start + ramp <= time <= block.turn_start + ramp + block.turn_stay:
        assert yaw == pytest.approx(angle)
    if time >= block.turn_start + 2.0 * ramp + block.turn_stay:
        assert (yaw, rate) == (0.0, 0.0)


def test_the_derivative_fed_back_makes_the_same_motion():
    """(1 + B K) x' = A x: a' = S1 a + z, z' = S0 z with the coupling in both, to 1e-9 of the smallest pole."""
    turn = np.array([[0.0, 0.0, -0.0026], [0.0, 0.0, 0.0], [0.0026, 0.0, 0.0]])
    block = regulator(OrbitalDerivativeControl)
    assert block.usable
    a = np.array(linear_model(block.inertia, block.inverse_inertia, ORBITAL_RATE))
    gain = np.hstack([np.array(block.angle_gain), np.array(block.rate_gain)])
    closed = np.linalg.solve(np.eye(6) - np.vstack([np.zeros((3, 3)), np.linalg.inv(INERTIA)]) @ gain, a)
    upper = turn - np.diag([0.0015, 0.003, 0.0015])
    lack = closed[:3] - np.hstack([upper, np.zeros((3, 3))])
    assert lack @ closed == pytest.approx(upper @ lack, abs=1.5e-12)


def test_the_derivative_regulator_holds_the_body_in_the_orbital_frame():
    """At rest there its torque is the one of the products of inertia, by accelerations of the plant."""
    block, plant = regulator(OrbitalDerivativeControl), OrbitalSpacecraft()
    plant.initialize()
    here = AttitudeState(angles=block.estimated_angles, angular_velocity=block.estimated_angular_velocity)
    falling = plant.derivatives(0.0, replace(here, angular_velocity=WANTED_VECTOR), plant.held_torque)
    expected = -INERTIA @ np.array([*falling.angular_velocity])
    assert answer(block, [0.0] * 3, WANTED, 0.0) == pytest.approx(expected, abs=1e-15)


@settings(max_examples=either(100, 33))
@given(st.integers(0, 2**32 - 1))
def test_which_poles_stand_a_delay(seed):
    """Hurwitz's condition, against eigenvalues by numpy."""
    e = np.random.default_rng(seed).normal(size=(3, 3)) + np.eye(3)
    block = OrbitalDerivativeControl()
    assert block.is_stable_with_delay(matrix(*e.tolist())) == bool(np.all(np.linalg.eigvals(e).real > 0.0))


def test_derivatives_that_cannot_be_fed_back():
    """Poles without a coupling stand no delay; a body that the orbit does not turn in yaw has a singular A."""
    assert regulator(OrbitalDerivativeControl, coupling=0.0).status == 2
    symmetric = np.diag([20000.0, 30000.0, 20000.0])
    assert regulator(OrbitalDerivativeControl, inertia=symmetric.ravel().tolist()).status == 2


def test_a_tick_without_a_finite_estimate_is_bridged():
    """The difference is taken over both ticks: a body that turns ever faster shows the same acceleration."""
    whole, bridged = regulator(OrbitalDerivativeControl), regulator(OrbitalDerivativeControl)
    for block in (whole, bridged):
        block.estimated_angles, block.estimated_angular_velocity = [0.0] * 3, WANTED
        block.initialize()
    faster, fastest = [1e-5, 0.0, WANTED[2]], [2e-5, 0.0, WANTED[2]]
    answer(whole, [0.0] * 3, faster, 0.2)
    assert answer(bridged, [math.nan] * 3, faster, 0.2).tolist() == [0.0] * 3
    assert answer(bridged, [0.0] * 3, fastest, 0.4) == pytest.approx(answer(whole, [0.0] * 3, fastest, 0.4), rel=1e-9)


@pytest.mark.parametrize("kind", [OrbitalModalControl, OrbitalArrivalControl, OrbitalDerivativeControl])
def test_what_cannot_be_used_asks_for_nothing(kind):
    block = regulator(kind)
    assert answer(block, [math.nan, 0.0, 0.0], WANTED).tolist() == [0.0, 0.0, 0.0]
    assert block.status == 1
    assert regulator(kind, inertia=[0.0] * 9).status == 2
