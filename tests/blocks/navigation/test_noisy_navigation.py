"""Noisy navigation compared with chi-square theory, an independent filter and the fix rates.

Truth: motion with white acceleration noise of the density that the filter assumes, made by numpy (exact
discretisation); the covariance of filterpy at the same fixes and of the Riccati equation by scipy, to 1e-9. Over 200
seeds the mean squared normalised estimation error (6 degrees of freedom) and innovation (1 each) lie
within the two-sided 99.9 % chi-square interval of 200 x 6 and 200 x fixes degrees of freedom.
"""

import math

import numpy as np
import pytest
from filterpy.kalman import KalmanFilter
from scipy import stats
from scipy.linalg import solve_discrete_are

from perilune.fmus_src.navigation.ideal import IdealNavigation
from perilune.fmus_src.navigation.noisy import NoisyNavigation
from tests.support.lengths import either

SEEDS = either(200, 80)
STEP = 0.2
GRAVITY = 1.62
DENSITY = 0.05  # m2/s3
POSITION = np.array([1.0e5, -2.0e3, 1.05e4])
VELOCITY = np.array([-930.0, 20.0, -40.0])
SPECIFIC_FORCE = np.array([4.6, 0.1, 1.4])


def transition(h):
    """Return F and Q of a double integrator per axis, positions first."""
    one = np.eye(3)
    f = np.block([[one, h * one], [0 * one, one]])
    q = DENSITY * np.block([[h**3 / 3 * one, h**2 / 2 * one], [h**2 / 2 * one, h * one]])
    return f, q


def gain(h):
    """Return the increment by a constant specific force and gravity."""
    acceleration = SPECIFIC_FORCE - [0.0, 0.0, GRAVITY]
    return np.concatenate([0.5 * h * h * acceleration, h * acceleration])


def navigation(**settings):
    """Return the block with errors of ordinary size, unless set otherwise."""
    errors = {
        "position_sigma": 20.0,
        "velocity_sigma": 0.2,
        "first_position_sigma": 100.0,
        "first_velocity_sigma": 1.0,
        "process_noise": 1e-6,
    }
    block = NoisyNavigation(
        position=POSITION.tolist(),
        velocity=VELOCITY.tolist(),
        specific_force=SPECIFIC_FORCE.tolist(),
        **(errors | settings),
    )
    block.initialize()
    return block


def estimate_of(block):
    return np.array([*block.estimated_position, *block.estimated_velocity])


def flight(seed, steps):
    """Yield (k, block, truth) at the start and after every step."""
    generator = np.random.default_rng(seed)
    f, q = transition(STEP)
    root = np.linalg.cholesky(q)
    truth = np.concatenate([POSITION, VELOCITY])
    block = navigation(seed=17, stream=seed, process_noise=DENSITY, position_sigma=5.0, first_position_sigma=30.0)
    yield 0, block, truth
    for k in range(1, steps + 1):
        truth = f @ truth + gain(STEP) + root @ generator.normal(size=6)
        block.position, block.velocity = truth[:3].tolist(), truth[3:].tolist()
        block.step((k - 1) * STEP, STEP)
        yield k, block, truth


@pytest.fixture(scope="module")
def ensemble():
    """Return normalised errors squared at chosen points, and every innovation squared, of all seeds."""
    steps, at = 26, (0, 1, 4, 5, 12, 26)
    errors: dict[int, list[float]] = {k: [] for k in at}
    innovations = []
    for seed in range(SEEDS):
        for k, block, truth in flight(seed, steps):
            if k in errors:
                error = estimate_of(block) - truth
                errors[k].append(error @ np.linalg.solve(np.reshape(block.covariance, (6, 6)), error))
            if k > 0:
                innovations.append(block.innovation_square)
    return errors, np.reshape(innovations, (SEEDS, steps))


def interval(freedom):
    return stats.chi2.ppf([0.0005, 0.9995], freedom)


def test_estimation_errors_are_as_large_as_the_filter_says(ensemble):
    low, high = interval(SEEDS * 6)
    for squares in ensemble[0].values():
        assert low < sum(squares) < high
        assert stats.kstest(squares, "chi2", args=(6,)).pvalue > 1e-3


def test_innovations_are_as_large_as_the_filter_says(ensemble):
    squares = ensemble[1]
    low, high = interval(squares.size)
    assert low < squares.sum() < high
    assert stats.kstest(squares.ravel(), "chi2", args=(1,)).pvalue > 1e-3


def test_innovations_are_white(ensemble):
    squares = ensemble[1] - 1.0
    for lag in (1, 2, 5):
        pairs = squares[:, :-lag] * squares[:, lag:]
        assert abs(pairs.mean()) < 4.0 * 2.0 / math.sqrt(pairs.size)  # variance of a square is 2


def test_covariance_is_that_of_filterpy():
    """The covariance does not depend on the numbers measured: predicted and updated by filterpy at the fix times."""
    reference = KalmanFilter(dim_x=6, dim_z=3)
    reference.P = np.diag([30.0**2] * 3 + [1.0] * 3)
    reference.F, reference.Q = transition(STEP)
    for k, block, _ in flight(4, 26):
        if k > 0:
            reference.predict()
            if k % 5 == 0:
                reference.update(np.zeros(3), R=25.0 * np.eye(3), H=np.eye(3, 6))
            reference.update(np.zeros(3), R=0.04 * np.eye(3), H=np.eye(3, 6, 3))
        actual = np.reshape(block.covariance, (6, 6))
        assert actual == pytest.approx(reference.P, rel=1e-10, abs=1e-12)
        assert block.position_estimate_sigma == pytest.approx(np.sqrt(np.diag(reference.P))[:3], rel=1e-10)
        assert block.velocity_estimate_sigma == pytest.approx(np.sqrt(np.diag(reference.P))[3:], rel=1e-10)


def test_first_estimates_scatter_as_declared():
    errors = np.array(
        [
            estimate_of(navigation(seed=5, stream=stream)) - np.concatenate([POSITION, VELOCITY])
            for stream in range(SEEDS)
        ]
    )
    errors /= np.array([100.0] * 3 + [1.0] * 3)
    low, high = interval(errors.size)
    assert low < (errors**2).sum() < high
    assert abs(np.corrcoef(errors.T)[np.triu_indices(6, 1)]).max() < 4.0 / math.sqrt(SEEDS)


def test_between_fixes_the_estimate_moves_with_the_specific_force():
    block = navigation(position_period=1e3, velocity_period=1e3)
    first = estimate_of(block)
    for k in range(10):
        block.step(0.1 * k, 0.1)
    f, _ = transition(1.0)
    assert estimate_of(block) == pytest.approx(f @ first + gain(1.0), rel=1e-13)
    assert block.sample_count == 0


@pytest.mark.parametrize(
    ("step", "start", "steps", "position_fixes", "velocity_fixes"),
    [
        (0.1, 0.0, 100, 10, 50),
        (0.1, 1234.5, 100, 10, 50),
        (0.05, 0.0, 199, 9, 49),
        (0.2, 0.3, 50, 10, 50),
        (0.025, 7.0, 400, 10, 50),
        (1.0 / 3.0, 0.0, 30, 10, 30),  # steps longer than a period: one velocity fix each
        (1.0, 0.0, 10, 10, 10),
    ],
)
def test_fixes_come_at_their_periods(step, start, steps, position_fixes, velocity_fixes):
    block = navigation()
    block.start_time = start
    for k in range(steps):
        block.step(start + k * step, step)
    assert (block.position_fixes, block.velocity_fixes) == (position_fixes, velocity_fixes)
    assert block.sample_count == position_fixes + velocity_fixes


def test_fixes_fall_on_the_first_communication_point_at_or_after_their_time():
    block = navigation(position_period=0.35, velocity_period=1e3)
    actual = []
    for k in range(40):
        before = block.position_fixes
        block.step(0.1 * k, 0.1)
        if block.position_fixes > before:
            actual.append(k + 1)
    assert actual == [-(-35 * n // 10) for n in range(1, 12)]


def test_fix_errors_have_the_declared_size_and_mean():
    """With an almost useless prior the estimate after one fix of each kind is the fix itself."""
    fixes = []
    for stream in range(SEEDS):
        block = navigation(
            seed=6,
            stream=stream,
            position_period=0.1,
            velocity_period=0.1,
            first_position_sigma=1e7,
            first_velocity_sigma=1e6,
            process_noise=0.0,
        )
        block.step(0.0, 0.1)
        fixes.append(estimate_of(block) - np.concatenate([POSITION, VELOCITY]))
    errors = np.array(fixes) / np.array([20.0] * 3 + [0.2] * 3)
    low, high = interval(errors.size)
    assert low < (errors**2).sum() < high
    assert stats.kstest(errors.ravel(), "norm").pvalue > 1e-3


def test_covariance_settles_on_the_solution_of_the_riccati_equation():
    block = navigation(position_period=STEP, velocity_period=STEP, process_noise=DENSITY, position_sigma=5.0)
    for k in range(1500):
        block.step(k * STEP, STEP)
    f, q = transition(STEP)
    error = np.diag([25.0] * 3 + [0.04] * 3)
    predicted = solve_discrete_are(f.T, np.eye(6), q, error)
    settled = predicted - predicted @ np.linalg.solve(predicted + error, predicted)
    assert np.reshape(block.covariance, (6, 6)) == pytest.approx(settled, rel=1e-9, abs=1e-12)


def test_a_perfect_start_is_possible():
    block = navigation(first_position_sigma=0.0, first_velocity_sigma=0.0, process_noise=0.0)
    assert block.estimated_position == POSITION.tolist()
    block.step(0.0, 0.2)
    assert block.innovation_square >= 0.0
    assert all(math.isfinite(value) for value in estimate_of(block))


def test_without_sensors_the_estimate_is_the_truth():
    block = NoisyNavigation(position=POSITION.tolist(), velocity=VELOCITY.tolist())
    block.initialize()
    assert estimate_of(block).tolist() == [*POSITION, *VELOCITY]
    for k in range(3):
        block.position = (POSITION + k).tolist()
        block.step(0.1 * k, 0.1)
        assert estimate_of(block).tolist() == [*(POSITION + k), *VELOCITY]


@pytest.mark.parametrize(("off", "kept"), [("position_sigma", "velocity_fixes"), ("velocity_sigma", "position_fixes")])
def test_a_sigma_of_zero_switches_its_sensor_off(off, kept):
    block = navigation(**{off: 0.0})
    for k in range(100):
        block.step(0.1 * k, 0.1)
    assert block.sample_count == getattr(block, kept) > 0


def test_ideal_navigation_is_the_truth():
    block = IdealNavigation(position=POSITION.tolist(), velocity=VELOCITY.tolist())
    block.initialize()
    assert block.sample_count == 1
    for k in range(3):
        block.position = (POSITION + k).tolist()
        block.step(0.1 * k, 0.1)
        assert block.estimated_position == (POSITION + k).tolist()
        assert block.estimated_velocity == VELOCITY.tolist()
        assert block.sample_count == k + 2
        assert block.status == 0


def test_declared_starts_alone_run():
    for block_class in (NoisyNavigation, IdealNavigation):
        block = block_class()
        block.initialize()
        block.step(0.0, 0.1)
        assert block.status == 0
