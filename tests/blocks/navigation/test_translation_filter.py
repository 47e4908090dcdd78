"""Translation filter compared with filterpy, and with the statistics that its covariance predicts.

Truth: `filterpy.kalman.KalmanFilter` with position and velocity per axis, fed with the same samples and the
same commanded force; means by numpy; normalised errors and innovations with chi-square intervals over 60 flights
(25 in `make test`) simulated here.
"""

import itertools

import numpy as np
import pytest
from filterpy.common import Q_continuous_white_noise
from filterpy.kalman import KalmanFilter
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.navigation.translation_filter import TranslationFilter
from tests.support.lengths import either

H = 0.125
MASS = 1000.0
ATTITUDE = Rotation.from_rotvec([0.4, -1.1, 0.7])
RELATIVE = np.array([100.0, -60.0, 40.0])  # nearby
FAR = np.array([300.0, -260.0, 40.0])


def start(block, relative, planned=RELATIVE, velocity=(0.0, 0.0, 0.0)):
    block.quaternion = ATTITUDE.as_quat(scalar_first=True).tolist()
    feed(block, relative, planned, velocity, 1)
    block.initialize()


def feed(block, relative, planned, velocity, count):
    block.relative_position = np.asarray(relative).tolist()
    block.planned_relative_position = np.asarray(planned).tolist()
    block.planned_velocity = np.asarray(velocity).tolist()
    block.sample_count = count


class Flight:
    """Truth and samples of a robot under random piecewise constant forces, whose plan is not met."""

    def __init__(self, seed, far=False, force_error=0.0, noise=0.0):
        self.random = np.random.default_rng(seed)
        self.relative = FAR if far else RELATIVE
        self.sigma = 0.025 if far else 0.01
        self.force_error = force_error
        self.noise = noise  # density of acceleration
        self.position = self.random.normal(size=3) * 0.01  # error against the plan
        self.velocity = self.random.normal(size=3) * 0.02
        self.planned_velocity = np.zeros(3)
        self.force = np.zeros(3)  # commanded, inertial

    def sample(self):
        return self.relative - self.position + self.sigma * self.random.normal(size=3)

    def step(self, k):
        """Move by H under the force; returns the commanded force over the step (inertial)."""
        if k % 32 == 0:
            self.force = self.random.normal(size=3) * 0.1
            self.wrong = 1.0 + self.force_error * self.random.normal()
        planned = 1e-4 * np.sin(0.01 * k) * np.ones(3)
        acceleration = self.wrong * self.force / MASS - planned
        kick = self.random.normal(size=3) * np.sqrt(self.noise * H)
        self.position = self.position + H * self.velocity + 0.5 * H * H * acceleration + 0.5 * H * kick
        self.velocity = self.velocity + H * acceleration + kick
        self.planned_velocity = self.planned_velocity + H * planned
        return self.force


def fly(block, flight, steps):
    """Yield rows of (new sample or None, commanded force, planned velocity) with the block stepped along."""
    first = flight.sample()
    start(block, first, flight.relative, flight.planned_velocity)
    count = 1
    yield first, None, flight.planned_velocity
    for k in range(steps):
        force = flight.step(k)
        block.allocated_force = ATTITUDE.inv().apply(force).tolist()
        sample = None
        if (k + 1) % 8 == 0:
            sample = flight.sample()
            count += 1
        feed(
            block,
            block.relative_position if sample is None else sample,
            flight.relative,
            flight.planned_velocity,
            count,
        )
        block.step(H * k, H)
        yield sample, force, flight.planned_velocity


@pytest.mark.parametrize("far", either([False, True], [True]))
@pytest.mark.parametrize("force_error", [0.0, 0.05])
def test_kalman_filter_follows_filterpy(far, force_error):
    density = 1e-10
    block = TranslationFilter(process_noise=density, force_error=force_error)
    flight = Flight(1, far)
    axes = [KalmanFilter(dim_x=2, dim_z=1) for _ in range(3)]
    before = np.zeros(3)
    for n, (sample, force, planned) in enumerate(fly(block, flight, 1200)):
        for i, axis in enumerate(axes):
            if n == 0:
                axis.x = np.array([[flight.relative[i] - sample[i]], [0.0]])
                axis.P = np.diag([flight.sigma**2, 0.02**2])
                axis.H = np.array([[1.0, 0.0]])
                continue
            white = density + 10.0 * (force_error * np.linalg.norm(force) / MASS) ** 2
            axis.B = np.array([[0.5 * H], [1.0]])
            axis.predict(
                u=np.array([[force[i] / MASS * H - (planned - before)[i]]]),
                F=np.array([[1.0, H], [0.0, 1.0]]),
                Q=Q_continuous_white_noise(dim=2, dt=H, spectral_density=white),
            )
            if sample is not None:
                axis.update(flight.relative[i] - sample[i], R=flight.sigma**2)
        before = planned
        assert block.position_error == pytest.approx([axis.x[0, 0] for axis in axes], abs=1e-12)
        assert block.velocity_error == pytest.approx([axis.x[1, 0] for axis in axes], abs=1e-12)
        assert block.position_error_sigma == pytest.approx(np.sqrt(axes[0].P[0, 0]), rel=1e-9)
        assert block.velocity_error_sigma == pytest.approx(np.sqrt(axes[0].P[1, 1]), rel=1e-9)
    assert block.samples_taken == 151


def test_errors_and_innovations_are_as_large_as_the_covariance_says():
    density, flights = 1e-9, either(60, 12)
    position, velocity, innovations = 0.0, 0.0, []
    for seed in range(flights):
        block = TranslationFilter(process_noise=density)
        flight = Flight(seed, noise=density)
        for n, (sample, _, _) in enumerate(fly(block, flight, 800)):
            if sample is not None and n > 0:
                innovations.append(block.innovation_square)
        position += ((np.array(block.position_error) - flight.position) ** 2).sum() / block.position_error_sigma**2
        velocity += ((np.array(block.velocity_error) - flight.velocity) ** 2).sum() / block.velocity_error_sigma**2
    low, high = stats.chi2.interval(0.998, 3 * flights)
    assert low < position < high
    assert low < velocity < high
    low, high = stats.chi2.interval(0.998, 3 * len(innovations))
    assert low < sum(innovations) < high


def test_known_force_leaves_a_small_error():
    """2000 s (`make test`: 1250) of samples of 1 cm with the force known: below 2 mm, which no mean of eight gives."""
    block = TranslationFilter()
    flight = Flight(4)
    worst = 0.0
    for n, _ in enumerate(fly(block, flight, either(16000, 8000))):
        if n > 8000:
            worst = max(worst, abs(np.array(block.position_error) - flight.position).max())
    assert worst < 0.0025


def mean_flight(block, ticks, periods):
    """Return samples, and means put out at ticks every ``periods`` seconds in turn."""
    random = np.random.default_rng(9)
    offsets = [random.normal(size=3)]
    block.translation_count = 1
    start(block, RELATIVE - offsets[0])
    actual = [(0.0, list(block.position_error), list(block.velocity_error))]
    count, second, due = 1, 0, 0
    for tick in range(ticks):
        due += periods[tick % len(periods)]
        while second < due:
            second += 1
            offsets.append(random.normal(size=3))
            for part in range(8):
                if part == 7:
                    count += 1
                    feed(block, RELATIVE - offsets[-1], RELATIVE, [0.0] * 3, count)
                    if second == due:
                        block.translation_count += 1
                held = list(block.position_error)
                block.step(second - 1 + part * H, H)
                if part < 7 or second < due:
                    assert block.position_error == held  # until the next tick
        actual.append((float(due), list(block.position_error), list(block.velocity_error)))
    return np.array(offsets), actual


@pytest.mark.parametrize("periods", [(8,), (4,), (8, 4)], ids=str)
def test_mean_is_that_of_the_samples_since_the_last_tick(periods):
    offsets, actual = mean_flight(TranslationFilter(method=0), 6, periods)
    means = [offsets[0]]
    for (before, *_), (time, position, velocity) in itertools.pairwise(actual):
        means.append(offsets[int(before) + 1 : int(time) + 1].mean(axis=0))
        assert position == pytest.approx(means[-1], abs=1e-12)
        assert velocity == pytest.approx((means[-1] - means[-2]) / (time - before), abs=1e-12)


def test_mean_without_samples_is_held():
    block = TranslationFilter(method=0)
    start(block, RELATIVE - [0.3, 0.0, 0.0])
    assert block.position_error == pytest.approx([0.3, 0.0, 0.0])
    block.translation_count = 5
    block.step(0.0, 8.0)
    assert block.position_error == pytest.approx([0.3, 0.0, 0.0])


@pytest.mark.parametrize("method", [0, 1])
@pytest.mark.parametrize("wrong", [float("nan"), float("inf")])
def test_samples_that_are_not_finite_are_left_out(method, wrong):
    faulty, sound = (TranslationFilter(method=method) for _ in range(2))
    for block in (faulty, sound):
        start(block, RELATIVE)
    feed(faulty, [wrong, 0.0, 0.0], RELATIVE, [0.0] * 3, 2)
    faulty.step(0.0, 1.0)
    sound.step(0.0, 1.0)
    assert (faulty.status, faulty.samples_taken) == (1, 1)
    for count, block in ((3, faulty), (2, sound)):
        feed(block, RELATIVE - 0.1, RELATIVE, [0.0] * 3, count)
        block.translation_count = 1
        block.step(1.0, 1.0)
    assert faulty.status == 0
    assert faulty.position_error == sound.position_error
    assert faulty.velocity_error == sound.velocity_error


def test_force_is_turned_by_the_mean_attitude_of_the_step():
    """A robot that turns by 0.2 rad while its jets push along its x axis."""
    block = TranslationFilter()
    start(block, RELATIVE)
    block.quaternion = (ATTITUDE * Rotation.from_rotvec([0.0, 0.2, 0.0])).as_quat(scalar_first=True).tolist()
    block.allocated_force = [2.0, 0.0, 0.0]
    block.step(0.0, 1.0)
    middle = ATTITUDE * Rotation.from_rotvec([0.0, 0.1, 0.0])
    assert block.velocity_error == pytest.approx(middle.apply([2.0, 0.0, 0.0]) / MASS, abs=1e-15)
