"""Simulation of earth_pointing with half the communication step, and with half the internal step of its plant.

Truth: the simulation with the finer step, within 1 mm and 1 arcsec; attitudes by scipy. `make long` simulates six
revolutions.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import perilune
from tests.support.lengths import either
from tests.support.space.pointing_page import ARCSEC, in_nadir

pytestmark = pytest.mark.usefixtures("fmus")
HALVES = {
    "`--set satellite.internal_step=0.125`": {"set": {"satellite.internal_step": 0.125}},
    "`--step 0.125`": {"step": 0.125},
    "both": {"set": {"satellite.internal_step": 0.125}, "step": 0.125},
}
EXACT = {"gyros.quantum": 0.0, "magnetometer.quantum": 0.0}
# The short flight begins slowly enough for the wheels, so that its loop is closed after a minute.
SLOW = dict.fromkeys([f"satellite.initial_angular_velocity[{i}]" for i in (1, 2, 3)], 1e-3)
QUICK = either({}, SLOW | {"stop_time": 400.0})


def fly(options=None, values=EXACT):
    options = dict(options or {})
    quick = dict(QUICK)
    stop = quick.pop("stop_time", None)
    values = values | quick | options.pop("set", {})
    return perilune.simulate("earth_pointing", parameters=["ideal.ssv"], set=values, stop_time=stop, **options)


def largest_differences(coarse, fine):
    """Return largest differences of position (m) and attitude (rad), and of attitude in nadir
    mode, at the coarse samples."""
    every = round((coarse.time[1] - coarse.time[0]) / (fine.time[1] - fine.time[0]))
    np.testing.assert_array_equal(coarse.time, fine.time[::every])
    off = np.linalg.norm(coarse["satellite.position"] - fine["satellite.position"][::every], axis=1)
    first, second = (
        Rotation.from_quat(quaternion, scalar_first=True)
        for quaternion in (coarse["satellite.quaternion"], fine["satellite.quaternion"][::every])
    )
    angle = (first.inv() * second).magnitude()
    nadir = in_nadir(coarse)
    return off.max(), angle.max(), angle[nadir].max() if nadir.any() else 0.0


@pytest.fixture(scope="module")
def flights(fmus):
    """Return the flight as it is, and those at half a step."""
    return fly(), {name: fly(options) for name, options in HALVES.items()}


def test_half_the_step_moves_orbit_and_attitude_within_their_bounds(flights):
    coarse, fine = flights
    for flown in fine.values():
        off, angle, _ = largest_differences(coarse, flown)
        assert off < 1e-3
        assert angle < ARCSEC
    assert coarse["modes.wheels_on"][-1] == 1.0


def test_where_the_plant_takes_its_steps_from_changes_no_bit(flights):
    _, fine = flights
    first, *others = (
        largest_differences(fine["`--set satellite.internal_step=0.125`"], flown) for flown in fine.values()
    )
    assert all(differences == first == (0.0, 0.0, 0.0) for differences in others)
