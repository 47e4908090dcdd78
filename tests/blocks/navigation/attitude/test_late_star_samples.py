"""Late star tracker samples of a rotating body: propagated with gyro data, they equal samples without latency.

Truth: the same filter with samples without latency, and the motion by scipy's rotations.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from perilune.fmus_src.navigation.attitude_navigation import AttitudeNavigationStatus as Status
from perilune.fmus_src.navigation.attitude_navigation_filter import AttitudeNavigationFilter

STEP, RATE = 0.25, np.array([0.02, -0.05, 0.03])
START = Rotation.from_rotvec([0.4, -1.1, 0.7])
SETTINGS = {"star_sigma": 3e-5, "gyro_random_walk": 1e-6, "bias_random_walk": 1e-8}


def quaternion(time):
    return (START * Rotation.from_rotvec(time * RATE)).as_quat(scalar_first=True).tolist()


def error(block, time):
    estimate = Rotation.from_quat([*block.estimated_quaternion], scalar_first=True)
    return np.linalg.norm((estimate.inv() * Rotation.from_quat(quaternion(time), scalar_first=True)).as_rotvec())


def fly(delays, steps, start=True, **settings):
    """Return a filter with perfect gyros and star samples that are ``delays[n]`` (s) late in cycle n; None: no
    sample."""
    block = AttitudeNavigationFilter(**SETTINGS, **settings)
    block.measured_angular_velocity = RATE.tolist()
    block.gyro_count = 1
    if start:
        block.measured_quaternion, block.star_count, block.star_time = quaternion(0.0), 1, 0.0
    block.initialize()
    for n in range(steps):
        time = (n + 1) * STEP
        block.gyro_count += 1
        if delays.get(n) is not None:
            block.measured_quaternion, block.star_time = quaternion(time - delays[n]), time - delays[n]
            block.star_count += 1
        block.step(n * STEP, STEP)
    return block


@pytest.mark.parametrize("delay", [0.25, 0.5, 2.0, 0.1, 0.6])
def test_a_late_sample_equals_one_on_time(delay):
    """By whole cycles, and by fractions of one."""
    on_time, late = (fly({n: by for n in range(9, 60, 2)}, 60) for by in (0.0, delay))
    assert [*late.estimated_quaternion] == pytest.approx([*on_time.estimated_quaternion], abs=1e-14)
    assert [*late.estimated_bias] == pytest.approx([*on_time.estimated_bias], abs=1e-14)
    assert np.ravel(late.covariance.rows) == pytest.approx(np.ravel(on_time.covariance.rows), rel=1e-9, abs=1e-20)
    assert error(late, 60 * STEP) < 1e-13


def test_without_its_time_a_late_sample_is_off_by_the_turn():
    block = fly({}, 8)
    block.star_count, block.star_time, block.measured_quaternion = 2, -1.0, quaternion(8 * STEP - 0.5)
    block.gyro_count += 1
    block.step(8 * STEP, STEP)
    assert error(block, 9 * STEP) > 0.1 * 0.75 * np.linalg.norm(RATE)


def test_the_first_sample_may_be_late():
    block = fly({11: 0.75}, 12, start=False)
    assert block.attitude_known
    assert error(block, 12 * STEP) < 1e-13


@pytest.mark.parametrize(("delay", "status"), [(2.0, Status.GOOD), (2.01, Status.TOO_LATE), (2.5, Status.TOO_LATE)])
def test_a_sample_of_more_than_eight_cycles_ago_is_left_out(delay, status):
    block, without = fly({39: delay}, 40), fly({}, 40)
    assert block.status == status
    assert (block.covariance.rows == without.covariance.rows) == (status != Status.GOOD)


def test_a_first_sample_after_a_long_flight_leaves_a_covariance():
    """The errors of attitude and bias are independent then: one as the sample's, one as before."""
    block = fly({4000: 0.0}, 4001, start=False)
    p = np.array(block.covariance.rows)
    assert np.linalg.eigvalsh(p).min() > 0.0
    assert p[:3, :3] == pytest.approx(9e-10 * np.eye(3), rel=1e-12)
    assert np.abs(p[:3, 3:]).max() == 0.0
    assert np.diag(p)[3:] == pytest.approx(block.first_bias_sigma**2 + 1e-16 * 4001 * STEP, rel=1e-9)
