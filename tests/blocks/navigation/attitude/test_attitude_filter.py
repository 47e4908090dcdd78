"""Attitude filter compared with an integrated rigid body, filterpy, and the statistics that its covariance predicts.

Truth: a tumbling body with gyros and jets by scipy's DOP853 at 1e-12, from Euler's equations; filterpy for small
angles; means by numpy, rotations by scipy; normalised errors and innovations with chi-square intervals over
simulations.
"""

import itertools

import numpy as np
import pytest
from filterpy.common import Q_continuous_white_noise
from filterpy.kalman import KalmanFilter
from scipy import stats
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.navigation.attitude_filter import AttitudeFilter

ARCSEC = np.pi / 180.0 / 3600.0
INERTIA = np.array([812.0, 587.0, 910.0])
H = 0.125


def quaternion(rotation):
    return rotation.as_quat(scalar_first=True)


def rotation_of(q):
    return Rotation.from_quat(q, scalar_first=True)


def set_inputs(block, **values):
    for name, value in values.items():
        if name == "sample_count":
            block.sample_count = value
        else:
            setattr(block, name, np.asarray(value).tolist())


def gyros(t):
    """Return momentum of the cluster (N m s) and its derivative: tens of N m s, more than a turn of the robot needs."""
    phases = np.array([0.05, 0.08, 0.03])
    return 30.0 * np.sin(phases * t + [0.1, 0.7, 2.0]), 30.0 * phases * np.cos(phases * t + [0.1, 0.7, 2.0])


def tumble(end, torque, rate, step):
    """Return attitudes and angular velocities at multiples of a step, from Euler's equations."""

    def slope(t, y):
        q, w = y[:4], y[4:]
        momentum, change = gyros(t)
        spin = 0.5 * np.array(
            [
                -q[1:] @ w,
                q[0] * w[0] + q[2] * w[2] - q[3] * w[1],
                q[0] * w[1] + q[3] * w[0] - q[1] * w[2],
                q[0] * w[2] + q[1] * w[1] - q[2] * w[0],
            ]
        )
        return np.concatenate([spin, (torque - change - np.cross(w, INERTIA * w + momentum)) / INERTIA])

    times = np.arange(round(end / step) + 1) * step
    first = [*quaternion(Rotation.from_rotvec([0.3, -0.2, 0.9])), *rate]
    return times, solve_ivp(slope, (0.0, end), first, method="DOP853", t_eval=times, rtol=1e-12, atol=1e-12).y.T


def dead_reckoned(step):
    """Return largest errors of attitude (rad) and rate (rad/s) after 20 s without a sample but the first."""
    torque, rate = np.array([0.1, -0.05, 0.2]), np.array([0.02, -0.03, 0.01])
    times, truth = tumble(20.0, torque, rate, step)
    block = AttitudeFilter(first_rate_sigma=0.0)
    set_inputs(block, measured_quaternion=truth[0, :4], sample_count=1, jet_torque=torque)
    set_inputs(block, planned_angular_velocity=rate, planned_quaternion=truth[0, :4], gyro_momentum=gyros(0.0)[0])
    block.initialize()
    for k in range(1, len(times)):
        set_inputs(block, gyro_momentum=gyros(times[k])[0])
        block.step(times[k - 1], step)
    angle = (rotation_of(truth[-1, :4]).inv() * rotation_of(block.quaternion)).magnitude()
    return angle, np.linalg.norm(truth[-1, 4:] - block.angular_velocity)


def test_between_samples_it_follows_the_body_by_its_momentum():
    """Through 0.5 rad with the gyros' 30 N m s: second order in the step, 2 arcsec after 20 s at the declared one."""
    coarse, fine = dead_reckoned(0.25), dead_reckoned(0.125)
    assert fine[0] < 4.0 * ARCSEC
    assert fine[1] < 1.0 * ARCSEC
    for large, small in zip(coarse, fine, strict=True):
        assert np.log2(large / small) > 1.8


def test_small_angles_follow_filterpy():
    """A body at rest, samples of 1 arcsec: linear to 1e-10; jets that start in between widen the disturbance."""
    lever = 0.01
    block = AttitudeFilter(jet_torque_error=lever, process_noise=1e-14, disturbance_noise=1e-17)
    random = np.random.default_rng(2)
    axes = []
    for n in range(400):
        angles = ARCSEC * random.normal(size=3)
        set_inputs(block, measured_quaternion=quaternion(Rotation.from_rotvec(angles)), sample_count=n + 1)
        if n == 0:
            block.initialize()
        else:
            force = np.array([0.3, -0.1, 0.2]) if n > 100 else np.zeros(3)
            set_inputs(block, jet_force=force)
            block.step(H * (n - 1), H)
        for i in range(3):
            if n == 0:
                axis = KalmanFilter(dim_x=3, dim_z=1)
                axis.x = np.array([[angles[i]], [0.0], [0.0]])
                axis.P = np.diag([ARCSEC**2, 1e-8, 0.0])
                axis.H = np.array([[1.0, 0.0, 0.0]])
                axes.append(axis)
                continue
            if n == 101:
                axes[i].P[2, 2] += lever**2 * 0.14 / INERTIA.mean() ** 2
            q = Q_continuous_white_noise(dim=3, dt=H, spectral_density=1e-17)
            q[:2, :2] += Q_continuous_white_noise(dim=2, dt=H, spectral_density=1e-14)
            axes[i].predict(F=np.array([[1.0, H, 0.5 * H * H], [0.0, 1.0, H], [0.0, 0.0, 1.0]]), Q=q)
            axes[i].update(angles[i], R=ARCSEC**2)
        actual = np.array([block.attitude_error, block.rate_error, block.disturbance])
        expected = np.array([[axis.x[k, 0] for axis in axes] for k in range(3)])
        assert actual == pytest.approx(expected, rel=1e-4, abs=1e-5 * ARCSEC)
        assert block.attitude_error_sigma == pytest.approx(np.sqrt(axes[0].P[0, 0]), rel=1e-9)
        assert block.rate_error_sigma == pytest.approx(np.sqrt(axes[0].P[1, 1]), rel=1e-9)


class TurningRobot:
    """A body that turns at 2.6 deg/s, whose gyros take random torques; its momentum wanders with a density."""

    def __init__(self, seed, noise):
        self.random = np.random.default_rng(seed)
        self.noise = noise
        self.attitude = Rotation.random(random_state=seed)
        self.rate = np.array([0.0, -0.0435, 0.013])
        self.gyros = -INERTIA * self.rate + self.random.normal(size=3)
        self.disturbance = np.zeros(3)

    def step(self):
        """Step H in ten substeps: momentum kept, gyros at a constant torque, white torque by kicks."""
        torque = 0.5 * self.random.normal(size=3)
        kick = np.sqrt(self.noise * H) * self.random.normal(size=3)
        part = H / 10.0
        for _ in range(10):
            total = INERTIA * self.rate + self.gyros + part * INERTIA * self.disturbance
            middle = self.rate + 0.5 * part * (-torque - np.cross(self.rate, total)) / INERTIA
            turn = Rotation.from_rotvec(part * middle)
            self.gyros = self.gyros + part * torque
            self.rate = (turn.inv().apply(total) - self.gyros) / INERTIA
            self.attitude = self.attitude * turn
        self.rate = self.rate + kick

    def measured(self):
        return quaternion(self.attitude * Rotation.from_rotvec(ARCSEC * self.random.normal(size=3)))


@pytest.mark.slow
def test_errors_and_innovations_are_as_large_as_the_covariance_says():
    noise, flights = 1e-11, 25
    attitude, rate, innovations = 0.0, 0.0, []
    for seed in range(flights):
        robot = TurningRobot(seed, noise)
        block = AttitudeFilter(process_noise=noise, disturbance_noise=0.0, first_rate_sigma=1e-5)
        set_inputs(block, measured_quaternion=robot.measured(), sample_count=1, gyro_momentum=robot.gyros)
        set_inputs(block, planned_angular_velocity=robot.rate + 1e-5 * robot.random.normal(size=3))
        block.initialize()
        for n in range(80):
            robot.step()
            set_inputs(block, measured_quaternion=robot.measured(), sample_count=n + 2, gyro_momentum=robot.gyros)
            block.step(H * n, H)
            if n > 40:
                innovations.append(block.innovation_square)
        error = (robot.attitude.inv() * rotation_of(block.quaternion)).as_rotvec()
        attitude += (error**2).sum() / block.attitude_error_sigma**2
        rate += ((robot.rate - block.angular_velocity) ** 2).sum() / block.rate_error_sigma**2
    low, high = stats.chi2.interval(0.998, 3 * flights)
    assert low < attitude < high
    assert low < rate < high
    low, high = stats.chi2.interval(0.998, 3 * len(innovations))
    assert low < sum(innovations) < high


def test_disturbance_is_found():
    """A constant angular acceleration of 1e-6 rad/s2, as jets with errors give: known to 1e-7 after two minutes."""
    robot = TurningRobot(1, 0.0)
    robot.rate = np.zeros(3)
    robot.disturbance = np.array([1e-6, -5e-7, 2e-6])
    block = AttitudeFilter(first_disturbance_sigma=1e-6)
    set_inputs(block, measured_quaternion=robot.measured(), sample_count=1, gyro_momentum=robot.gyros)
    block.initialize()
    for n in range(1000):
        robot.step()
        set_inputs(block, measured_quaternion=robot.measured(), sample_count=n + 2, gyro_momentum=robot.gyros)
        block.step(H * n, H)
    assert block.disturbance == pytest.approx(robot.disturbance, abs=1e-7)


@pytest.mark.parametrize("samples", [1, 2, 5])
def test_mean_of_errors_against_the_plan(samples):
    """Sines of the angles from plan to sample, averaged; rate from two means."""
    random = np.random.default_rng(4)
    block = AttitudeFilter(method=0, mean_samples=samples)
    actual, errors = [], []
    for n in range(31):
        plan = Rotation.from_rotvec([0.0, -0.01 * n, 0.003 * n])
        angles = 1e-3 * random.normal(size=3)
        angle = np.linalg.norm(angles)
        errors.append(np.sin(angle) * angles / angle)
        set_inputs(block, planned_quaternion=quaternion(plan), sample_count=n + 1)
        set_inputs(block, measured_quaternion=quaternion(plan * Rotation.from_rotvec(angles)))
        if n == 0:
            block.initialize()
        else:
            block.step(H * (n - 1), H)
        if n % samples == 0:
            actual.append((n, list(block.attitude_error), list(block.rate_error)))
        turned = plan.inv() * rotation_of(block.quaternion)
        assert turned.as_rotvec() == pytest.approx(block.attitude_error, abs=1e-8)
    assert actual[0][1] == pytest.approx(errors[0], abs=1e-15)
    mean = np.array(errors[0])
    for (before, *_), (n, attitude, rate) in itertools.pairwise(actual):
        last, mean = mean, np.mean(errors[before + 1 : n + 1], axis=0)
        assert attitude == pytest.approx(mean, abs=1e-15)
        assert rate == pytest.approx((mean - last) / (samples * H), abs=1e-13)


@pytest.mark.parametrize("method", [0, 1])
def test_error_and_rate_against_a_turning_plan(method):
    """The estimate of a robot that is on its plan but for a constant turn, in its own axes."""
    plan_rate = np.array([0.0, -0.04, 0.02])
    wrong = Rotation.from_rotvec([0.2, 0.1, -0.3])
    block = AttitudeFilter(method=method, mean_samples=1)
    true_rate = wrong.inv().apply(plan_rate) + np.array([1e-3, 0.0, 0.0])
    set_inputs(block, planned_angular_velocity=true_rate, sample_count=1)
    set_inputs(block, planned_quaternion=[1.0, 0.0, 0.0, 0.0], measured_quaternion=quaternion(wrong))
    block.initialize()
    assert rotation_of(block.quaternion).as_rotvec() == pytest.approx(wrong.as_rotvec(), abs=0.03)
    set_inputs(block, planned_angular_velocity=plan_rate)
    block.publish()
    angle = wrong.magnitude()
    assert block.attitude_error == pytest.approx(np.sin(angle) / angle * wrong.as_rotvec(), abs=1e-12)
    if method == 1:
        assert block.rate_error == pytest.approx([1e-3, 0.0, 0.0], abs=1e-12)


@pytest.mark.parametrize("method", [0, 1])
@pytest.mark.parametrize("wrong", [float("nan"), float("inf")])
def test_samples_that_are_not_finite_are_left_out(method, wrong):
    block = AttitudeFilter(method=method)
    set_inputs(block, sample_count=1)
    block.initialize()
    set_inputs(block, sample_count=2, measured_quaternion=[wrong, 0.0, 0.0, 0.0])
    block.step(0.0, H)
    assert (block.status, block.samples_taken) == (1, 1)
    assert block.attitude_error == [0.0] * 3
    set_inputs(block, sample_count=3, measured_quaternion=[1.0, 1e-6, 0.0, 0.0])
    for n in (1, 2):
        set_inputs(block, sample_count=2 + n)
        block.step(H * n, H)
    assert (block.status, block.samples_taken) == (0, 3)
    assert 0.0 < block.attitude_error[0] < 3e-6
