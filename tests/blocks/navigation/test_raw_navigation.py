"""Raw navigation compared with a trajectory in closed form and with its position fixes.

Truth: with perfect increments and no fixes, the braking flight of braking_flight.py to 1 mm and 1e-5 m/s; at
the time of a fix, the fix. An altitude moves the estimate along the local vertical: by geometry, to 1e-9.
"""

import numpy as np
import pytest

from perilune.fmus_src.navigation.kalman import KalmanNavigation
from perilune.fmus_src.navigation.kalman_filterpy import KalmanNavigationFilterpy
from perilune.fmus_src.navigation.raw import RawNavigation
from tests.support.flights.braking_flight import CENTRE, MOON_RADIUS, measurements, position, velocity
from tests.support.flights.navigation_runs import NO_FIRST_ERRORS, plain, state_of, truth


def test_with_perfect_sensors_it_stays_on_the_trajectory():
    measured = measurements(scale=0.0)
    for new in (measured.new_altitude, measured.new_velocity, measured.new_position):
        new[:] = False
    for k, block in plain(RawNavigation, measured, **NO_FIRST_ERRORS):
        error = state_of(block) - truth(k)
        assert np.linalg.norm(error[:3]) < 1e-3
        assert np.linalg.norm(error[3:]) < 1e-5
        assert block.sample_count == k


def test_the_latest_fix_is_put_in():
    measured = measurements(6)
    for k, block in plain(RawNavigation, measured):
        if measured.new_position[k]:
            assert block.estimated_position == measured.position[k].tolist()
        elif measured.new_altitude[k]:
            actual = np.linalg.norm(np.array(block.estimated_position) - CENTRE) - MOON_RADIUS
            assert actual == pytest.approx(measured.altitude[k], abs=1e-8)
        if measured.new_velocity[k]:
            assert block.estimated_velocity == measured.velocity[k].tolist()
        assert not any([*block.position_estimate_sigma, *block.velocity_estimate_sigma, *block.estimate_covariance])
        assert block.status == 0


def test_an_altitude_moves_the_estimate_along_the_local_vertical():
    block = RawNavigation(position=[2.5e5, -3e4, 1e4], velocity=[0.0] * 3, **NO_FIRST_ERRORS)
    block.initialize()
    before = np.array(block.estimated_position) - CENTRE
    block.altitude_count = 1
    block.measured_altitude = 5e3
    block.use_samples()
    after = np.array(block.estimated_position) - CENTRE
    assert np.linalg.norm(after) == pytest.approx(MOON_RADIUS + 5e3, abs=1e-8)
    assert np.cross(after, before) / np.linalg.norm(before) ** 2 == pytest.approx(np.zeros(3), abs=1e-12)


def test_errors_of_fixes_come_through_and_the_filter_has_less():
    measured = measurements(7)
    errors = {}
    for block_class in (RawNavigation, KalmanNavigation):
        rows = [state_of(block) - truth(k) for k, block in plain(block_class, measured, seed=3)]
        errors[block_class] = np.sqrt(np.mean(np.square(rows[1000:]), axis=0))
    assert (errors[KalmanNavigation] < errors[RawNavigation]).all()


def test_variants_face_the_same_first_error():
    start = {"position": position(0.0).tolist(), "velocity": velocity(0.0).tolist(), "seed": 11, "stream": 5}
    actual = []
    for block_class in (RawNavigation, KalmanNavigation, KalmanNavigationFilterpy):
        block = block_class(**start)
        block.initialize()
        actual.append(state_of(block).tolist())
    assert actual[0] == actual[1] == actual[2]
    assert np.linalg.norm(np.array(actual[0])[:3] - position(0.0)) > 1.0


def test_a_vehicle_at_the_centre_of_the_moon_does_not_fail():
    block = RawNavigation(position=CENTRE.tolist(), **NO_FIRST_ERRORS)
    block.altitude_count = 1
    block.initialize()
    assert block.estimated_position == CENTRE.tolist()
