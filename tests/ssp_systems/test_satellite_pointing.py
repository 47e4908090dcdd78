"""System satellite_pointing: pointing in time with all allocations, profiles and sets; filter consistency.

Truth: durations of the profiles in closed form; the requirement of the page (10 arcsec); torque envelopes by hand; the
chi-square distribution of innovations.
"""

import math

import numpy as np
import pytest
from scipy import stats
from scipy.spatial.transform import Rotation

import perilune

pytestmark = pytest.mark.usefixtures("fmus")
ARCSEC = math.pi / 648000.0
ANGLE, START, RATE, ACCELERATION, JERK = math.radians(120.0), 20.0, 0.02, 1e-3, 1e-4
ENDS = {  # s, of the turns
    "slew_bang_coast": START + ANGLE / RATE + RATE / ACCELERATION,
    "slew_jerk_limited": START + ANGLE / RATE + RATE / ACCELERATION + ACCELERATION / JERK,
    "slew_quintic": START + 15.0 / 8.0 * ANGLE / RATE,
}


def fly(*sets, stop_time=400.0, use=None, **values):
    return perilune.simulate(
        "satellite_pointing",
        parameters=[f"{name}.ssv" for name in sets],
        use=use or {},
        stop_time=stop_time,
        set={name.replace("__", "."): setting for name, setting in values.items()},
    )


def pointing_error(flight, target):
    """Return angle (rad) between the true attitude and the target at every sample."""
    true = Rotation.from_quat(flight["satellite.quaternion"], scalar_first=True)
    return (target.inv() * true).magnitude()


TARGET = Rotation.from_rotvec(ANGLE * np.array([0.64, 0.48, 0.6]))


@pytest.mark.parametrize("wheels", ["wheel_allocation_pseudo_inverse", "wheel_allocation_minimax"])
@pytest.mark.parametrize("guidance", list(ENDS))
def test_it_points_soon_after_the_turn(wheels, guidance):
    """For 60 s from the settling time on, which is within 20 s of the end of the turn.

    Or 60 s by the smallest maximum, which leads the wheels to rest, where friction changes sign.
    """
    flight = fly(use={"wheels": wheels, "guidance": guidance})
    final = flight.final()
    assert final["guidance.duration"] + START == pytest.approx(ENDS[guidance], rel=1e-5)
    assert final["monitor.finished"]
    assert (
        ENDS[guidance] - 5.0
        < final["monitor.settling_time"]
        < ENDS[guidance] + (60.0 if wheels.endswith("minimax") else 20.0)
    )
    assert flight.time[-1] == pytest.approx(final["monitor.settling_time"] + 60.0, abs=1e-9)
    errors = pointing_error(flight, TARGET)
    assert errors[0] == pytest.approx(ANGLE, rel=1e-9)
    assert errors[flight.time >= final["monitor.settling_time"]].max() <= 10.0 * ARCSEC


def test_it_points_with_three_wheels_and_at_a_step():
    for flight in (fly("wheel_failed"), fly(use={"guidance": "slew_step"})):
        assert flight.final()["monitor.finished"]
        assert pointing_error(flight, TARGET)[-1] < 10.0 * ARCSEC


def test_momentum_is_what_the_external_torque_adds():
    """A torque that is constant in inertial axes: L t, whatever wheels and control do."""
    flight = fly(stop_time=100.0)
    torque = np.array([2e-5, -1e-5, 3e-5])
    expected = np.outer(flight.time, torque)
    np.testing.assert_allclose(flight["satellite.angular_momentum"], expected, atol=1e-14)


def test_ideal_navigation_and_ideal_sensors_fly_the_same():
    """The filter propagates by rates whose mean over a step it knows to second order: within an arcsecond."""
    filtered, true = (
        fly("ideal", stop_time=180.0, use=use) for use in ({}, {"navigation": "attitude_navigation_ideal"})
    )
    np.testing.assert_allclose(filtered["satellite.quaternion"], true["satellite.quaternion"], atol=ARCSEC)


def test_the_filter_knows_its_errors():
    """Innovations of twelve flights are chi-square of three each."""
    squares = []
    for seed in range(1, 13):
        flight = fly(stop_time=60.0, star__seed=seed, gyros__seed=seed + 100)
        new = np.diff(flight["star.sample_count"]) > 0
        innovations = flight["navigation.innovation_square"][1:][new][20:]
        squares += innovations.tolist()
    low, high = stats.chi2.ppf([1e-4, 1.0 - 1e-4], 3 * len(squares))
    assert low < sum(squares) < high


def test_a_fast_turn_is_within_the_envelope_of_one_allocation_only():
    """J a of 2.4e-3 rad/s2 about the turn's axis is 0.38 N m.

    Its motor torques are beyond 0.2 N m by the pseudo-inverse and not by the smallest maximum, for the torque of that
    axis: both by numpy.
    """
    inertia = np.array([[180.0, -4.0, 2.0], [-4.0, 150.0, 3.0], [2.0, 3.0, 120.0]])
    axes = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]]) / np.sqrt(3.0)
    torque = inertia @ (2.4e-3 * np.array([0.64, 0.48, 0.6]))
    smallest = np.linalg.pinv(axes.T) @ torque
    null = np.array([1.0, -1.0, 1.0, -1.0])
    signed = null * smallest  # smallest + s null has the largest size half of their range
    assert 0.5 * (signed.max() - signed.min()) < 0.2
    assert np.abs(smallest).max() > 0.25
    settings = {"guidance__acceleration_limit": 2.4e-3, "guidance__rate_limit": 0.03}
    for wheels, limited in (("wheel_allocation_pseudo_inverse", True), ("wheel_allocation_minimax", False)):
        flight = fly("ideal", stop_time=40.0, use={"wheels": wheels}, **settings)
        assert (flight["wheels.status"] == 1).any() == limited
