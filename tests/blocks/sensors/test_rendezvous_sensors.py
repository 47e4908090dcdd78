"""Star-inertial attitude sensor and laser ranger: errors have the declared distributions.

Truth: rotation vectors by scipy; chi-square and Kolmogorov-Smirnov tests of scipy with fixed seeds, at 1e-3, on 20 000
samples (10 000 in `make test`); the sensors' timing through `BlockInstance`, the FMI life cycle.
"""

import numpy as np
import pytest
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.runtime import BlockInstance
from perilune.fmus_src.sensors.laser_ranger import LaserRanger
from perilune.fmus_src.sensors.star_inertial import StarInertial
from tests.support.lengths import either

ARCSEC = np.pi / 180.0 / 3600.0
SAMPLES = either(20_000, 4_000)


def assert_white_normal(errors, sigma):
    """Assert normal errors with a sigma, independent between axes and from sample to sample."""
    scaled = np.asarray(errors) / sigma
    count = len(scaled)
    for axis in range(3):
        assert stats.kstest(scaled[:, axis], "norm").pvalue > 1e-3
    square = (scaled**2).sum()
    low, high = stats.chi2.interval(0.999, 3 * count)
    assert low < square < high
    for first, second in ((0, 1), (1, 2), (2, 0)):
        assert abs(np.mean(scaled[:, first] * scaled[:, second])) < 4.0 / np.sqrt(count)
    assert (abs((scaled[1:] * scaled[:-1]).mean(axis=0)) < 4.0 / np.sqrt(count)).all()


def quaternion(rotation):
    return rotation.as_quat(scalar_first=True).tolist()


def test_attitude_errors_are_white_rotations_in_body_axes():
    sensor = StarInertial(seed=3)
    truth = Rotation.random(SAMPLES, random_state=1)
    errors = []
    sensor.quaternion = quaternion(truth[0])
    sensor.initialize()
    for k in range(1, SAMPLES):
        sensor.quaternion = quaternion(truth[k])
        sensor.step(0.125 * (k - 1), 0.125)
        assert np.linalg.norm(sensor.measured_quaternion) == pytest.approx(1.0, abs=1e-15)
        measured = Rotation.from_quat(sensor.measured_quaternion, scalar_first=True)
        errors.append((truth[k].inv() * measured).as_rotvec())
    assert_white_normal(errors, ARCSEC)
    assert sensor.sample_count == SAMPLES


@pytest.mark.parametrize(("distance", "sigma"), [(400.0, 0.025), (300.0, 0.025), (299.9, 0.01), (20.0, 0.01)])
def test_range_errors_depend_on_the_true_range(distance, sigma):
    sensor = LaserRanger(seed=5, stream=int(distance))
    direction = np.array([0.6, -0.64, 0.48])
    robot = np.array([1.0, 2.0, 3.0])
    relative = distance * direction
    sensor.robot_position = robot.tolist()
    sensor.target_position = (robot + relative).tolist()
    sensor.initialize()
    errors = []
    for k in range(SAMPLES):
        sensor.step(float(k), 1.0)
        errors.append(np.array(sensor.relative_position) - relative)
        assert sensor.range == pytest.approx(np.linalg.norm(sensor.relative_position), rel=1e-15)
    assert_white_normal(errors, sigma)


@pytest.mark.parametrize(
    ("block", "name"), [(StarInertial, "measured_quaternion"), (LaserRanger, "relative_position")], ids=str
)
def test_errors_of_sample_k_do_not_depend_on_the_motion(block, name):
    """Two motions, one seed: the generators stay together; another stream differs."""
    still, moving, other = block(seed=7, stream=2), block(seed=7, stream=2), block(seed=7, stream=3)
    for sensor in (still, moving, other):
        sensor.initialize()
    assert getattr(still, name) == getattr(moving, name) != getattr(other, name)
    for k in range(20):
        if block is LaserRanger:
            moving.robot_position = [40.0 * k, 0.0, 0.0]
        else:
            moving.quaternion = quaternion(Rotation.from_rotvec([0.1 * k, 0.0, 0.0]))
        for sensor in (still, moving):
            sensor.step(float(k), 1.0)
        assert still.generator == moving.generator


def test_without_errors_they_tell_the_truth():
    star, ranger = StarInertial(attitude_sigma=0.0), LaserRanger(far_sigma=0.0, near_sigma=0.0)
    star.quaternion = [0.5, -0.5, 0.5, 0.5]
    ranger.target_position = [3.0, 0.0, 4.0]
    for sensor in (star, ranger):
        sensor.initialize()
    assert star.measured_quaternion == star.quaternion
    assert (ranger.relative_position, ranger.range) == ([3.0, 0.0, 4.0], 5.0)


@pytest.mark.parametrize(("block", "period"), [(StarInertial, 0.125), (LaserRanger, 1.0)], ids=str)
def test_samples_come_at_their_period_and_are_held(block, period):
    component = BlockInstance(block)
    component.start()
    counts = []
    for k in range(64):
        component.do_step(0.0625 * k, 0.0625)
        counts.append(component.block.sample_count)
    times = 0.0625 * np.arange(1, 65)
    assert counts == (1 + np.floor(times / period)).astype(int).tolist()
