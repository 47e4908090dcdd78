"""Sun and field directions in the attitude filter: one direction, both at the start (TRIAD), and rejected samples.

Truth: variance P s/(P + s) perpendicular to a direction and P along it for an isotropic prior; numpy's inverse for the
innovation; scipy's rotations; a chi-square test of the normalised error of simulations.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.navigation.attitude_navigation import AttitudeNavigationStatus as Status
from perilune.fmus_src.navigation.attitude_navigation_filter import AttitudeNavigationFilter
from tests.support.lengths import either

SUN, FIELD = np.array([0.36, -0.48, 0.8]), np.array([1e-5, 4e-5, -2e-5])  # inertial
TRUTH = Rotation.from_rotvec([0.4, -1.1, 0.7])
STEP = 1.0
seeds = st.integers(0, 2**32 - 1)


def navigation(star=None, **settings):
    """Return a filter that knows the inertial directions, begun with a star sample or without an attitude."""
    block = AttitudeNavigationFilter(**{"gyro_random_walk": 1e-9, "bias_random_walk": 1e-12} | settings)
    block.sun_direction, block.magnetic_field = SUN.tolist(), FIELD.tolist()
    if star is not None:
        block.measured_quaternion, block.star_count = star.as_quat(scalar_first=True).tolist(), 1
    block.initialize()
    return block


def tick(block, time=0.0, sun=None, field=None, star=None, gyros=(0.0, 0.0, 0.0)):
    """Simulate a cycle with new samples of those that are not None."""
    block.measured_angular_velocity, block.gyro_count = list(gyros), block.gyro_count + 1
    if sun is not None:
        block.measured_sun, block.sun_count = list(sun), block.sun_count + 1
    if field is not None:
        block.measured_field, block.field_count = list(field), block.field_count + 1
    if star is not None:
        block.measured_quaternion = star.as_quat(scalar_first=True).tolist()
        block.star_count += 1
    block.step(time, STEP)
    return block.status


def error(block, truth=TRUTH):
    """Return rotation vector from the estimated to the true attitude, body."""
    return (Rotation.from_quat([*block.estimated_quaternion], scalar_first=True).inv() * truth).as_rotvec()


def body(direction, truth=TRUTH):
    return truth.inv().apply(direction)


@pytest.mark.parametrize("sensor", ["sun", "field"])
def test_a_direction_corrects_across_itself(sensor):
    """An isotropic prior: across P s/(P + s), along P."""
    sigma = 0.03
    block = navigation(TRUTH, star_sigma=0.1, first_bias_sigma=0.0, **{f"{sensor}_sigma": sigma})
    direction = SUN if sensor == "sun" else FIELD / np.linalg.norm(FIELD)
    tick(block, **{sensor: 7.0 * body(direction)})
    along = np.outer(body(direction), body(direction))
    prior = 0.1**2
    expected = prior * along + prior * sigma**2 / (prior + sigma**2) * (np.eye(3) - along)
    assert np.array(block.covariance.rows)[:3, :3] == pytest.approx(expected, rel=1e-9, abs=1e-14)
    assert np.abs(error(block)).max() < 1e-15


@given(seeds, st.floats(1e-4, 1e-2))
def test_a_small_error_across_is_corrected_by_the_gain(seed, angle):
    """To first order by P/(P + s) across, not at all along."""
    turn = angle * Rotation.random(rng=np.random.default_rng(seed)).apply([1.0, 0.0, 0.0])
    block = navigation(TRUTH * Rotation.from_rotvec(-turn), star_sigma=0.1, first_bias_sigma=0.0, sun_sigma=0.05)
    tick(block, sun=body(SUN))
    along = np.dot(turn, body(SUN)) * body(SUN)
    expected = along + (turn - along) * 0.05**2 / (0.1**2 + 0.05**2)
    assert error(block) == pytest.approx(expected, abs=2.0 * angle**2)


@given(seeds)
def test_both_directions_make_the_first_attitude(seed):
    truth = Rotation.random(rng=np.random.default_rng(seed))
    block = navigation()
    assert (block.status, block.attitude_known) == (Status.UNKNOWN, False)
    assert tick(block, sun=body(SUN, truth)) == Status.UNKNOWN
    assert tick(block, field=body(FIELD, truth)) == Status.UNKNOWN
    assert tick(block, sun=body(SUN, truth), field=body(FIELD, truth)) == Status.GOOD
    assert block.attitude_known
    assert np.abs(error(block, truth)).max() < 1e-13
    assert [*block.attitude_sigma] == pytest.approx([0.02 * math.sqrt(2.0) / 0.17] * 3, rel=1e-12)


@pytest.mark.parametrize(("sine", "known"), [(0.16, False), (0.18, True)])
def test_directions_that_are_nearly_parallel_make_no_attitude(sine, known):
    side = np.cross(SUN, [1.0, 0.0, 0.0])
    near = math.sqrt(1.0 - sine**2) * SUN + sine * side / np.linalg.norm(side)
    block = navigation()
    block.magnetic_field = near.tolist()
    tick(block, sun=body(SUN), field=body(near))
    assert block.attitude_known == known


@pytest.mark.parametrize("wrong", [[math.nan, 0.0, 0.0], [math.inf, 0.0, 0.0], [0.0, 0.0, 0.0]])
@pytest.mark.parametrize("name", ["sun", "field", "sun_direction", "magnetic_field"])
def test_a_direction_that_is_not_finite_or_zero_is_left_out(name, wrong):
    block, without = navigation(TRUTH), navigation(TRUTH)
    tick(without)
    if name in ("sun", "field"):
        status = tick(block, **{name: wrong})
    else:
        setattr(block, name, wrong)
        status = tick(block, sun=body(SUN)) if name == "sun_direction" else tick(block, field=body(FIELD))
    assert status == Status.NO_DIRECTION
    assert block.covariance.rows == without.covariance.rows
    assert tick(block) == Status.GOOD


def test_a_direction_without_a_reference_is_left_out():
    """Inputs of the inertial directions are not connected."""
    block = AttitudeNavigationFilter()
    block.initialize()
    assert tick(block, sun=body(SUN), field=body(FIELD)) == Status.NO_DIRECTION
    assert not block.attitude_known


def test_a_spike_is_left_out_and_counted():
    """On either side of the gate, by the innovation's own covariance; and of each sensor."""
    prior, gate = 0.01, 16.27
    sigma = math.sqrt(prior**2 + 0.02**2)
    for factor, status in ((0.99, Status.GOOD), (1.01, Status.REJECTED)):
        angle = 2.0 * math.asin(0.5 * factor * math.sqrt(gate) * sigma)  # of a chord that long
        side = np.cross(body(SUN), [1.0, 0.0, 0.0])
        spike = Rotation.from_rotvec(angle * side / np.linalg.norm(side)).apply(body(SUN))
        block = navigation(TRUTH, star_sigma=prior, first_bias_sigma=0.0, gate=gate)
        p = block.covariance.rows[0][0]
        z = np.subtract(spike, body(SUN))
        s = p * (np.eye(3) - np.outer(body(SUN), body(SUN))) + 0.02**2 * np.eye(3)
        distance = z @ np.linalg.inv(s) @ z
        assert (distance > gate) == (status == Status.REJECTED)
        assert tick(block, sun=spike) == status
        assert block.rejected == (status == Status.REJECTED)
        assert (np.abs(error(block)).max() > 0.0) == (status == Status.GOOD)
    off = Rotation.from_rotvec([1.0, 0.0, 0.0])
    assert tick(block, field=off.apply(body(FIELD))) == Status.REJECTED
    assert tick(block, star=TRUTH * off) == Status.REJECTED
    assert block.rejected == 3
    assert np.abs(error(block)).max() < 1e-15
    assert tick(block, star=TRUTH) == Status.GOOD


def test_without_a_gate_nothing_is_rejected():
    block = navigation(TRUTH, star_sigma=0.01)
    assert tick(block, sun=-body(SUN)) == Status.GOOD
    assert block.rejected == 0


def test_many_rejected_in_a_row_open_the_attitude():
    """Rejections of one sensor; a good one restarts the count."""
    other = TRUTH * Rotation.from_rotvec([0.3, 0.2, -0.1])
    block = navigation(TRUTH, star_sigma=1e-4, gate=16.27, rejects_to_restart=4)
    for star in (other, other, other, TRUTH):
        assert tick(block, star=star) == (Status.GOOD if star is TRUTH else Status.REJECTED)
    for star in (other, other, other):
        assert tick(block, sun=body(SUN), star=star) == Status.REJECTED
        assert block.attitude_sigma.x < 1e-3
    tick(block, star=other)
    assert [*block.attitude_sigma] == [1.0] * 3
    assert block.rejected == 7
    assert tick(block, star=other) == Status.GOOD
    assert np.abs(error(block, other)).max() < 1e-8


def test_without_a_star_for_thirty_seconds_it_says_so():
    block = navigation(TRUTH)
    statuses = [tick(block, float(k), sun=body(SUN)) for k in range(31)]
    assert statuses == [Status.GOOD] * 30 + [Status.NO_RECENT_STAR]
    assert tick(block, 31.0, star=TRUTH) == Status.GOOD


def test_star_errors_about_the_boresight():
    """Roll and the others take their own variance in."""
    boresight = np.array([2.0, -1.0, 2.0])
    settings = {"star_sigma": 1e-3, "roll_sigma": 5e-3, "boresight": boresight.tolist(), "first_bias_sigma": 0.0}
    block = navigation(TRUTH, **settings)
    assert [*block.attitude_sigma] == pytest.approx([5e-3] * 3, rel=1e-12)
    block.covariance[0:3, 0:3] = Matrix((0.01**2 * np.eye(3)).tolist())
    tick(block, star=TRUTH)
    along = np.outer(boresight, boresight) / 9.0
    expected = stats.hmean([0.01**2, 5e-3**2]) / 2.0 * along + stats.hmean([0.01**2, 1e-3**2]) / 2.0 * (
        np.eye(3) - along
    )
    assert np.array(block.covariance.rows)[:3, :3] == pytest.approx(expected, rel=1e-9, abs=1e-15)


def test_errors_have_the_covariance_that_the_filter_states():
    """TRIAD, then directions alone; the normalised errors of attitude and bias are chi-square of six each."""
    random, rate, squares = np.random.default_rng(1964), np.array([0.02, -0.03, 0.01]), []
    walk, drift, sigma = 1e-4, 1e-6, 0.02
    field = FIELD / np.linalg.norm(FIELD)
    for _ in range(either(60, 20)):
        bias, truth = 1e-4 * random.normal(size=3), Rotation.random(rng=random)
        block = navigation(gyro_random_walk=walk, bias_random_walk=drift, first_bias_sigma=1e-4)
        block.rate = (rate + bias).tolist()
        for n in range(60):
            truth = truth * Rotation.from_rotvec(STEP * rate)
            bias = bias + drift * math.sqrt(STEP) * random.normal(size=3)
            noise = walk / math.sqrt(STEP) * random.normal(size=3)
            samples = [body(u, truth) + sigma * random.normal(size=3) for u in (SUN, field)]
            tick(block, n * STEP, *samples, gyros=rate + bias + noise)
        difference = np.concatenate([error(block, truth), bias - np.array([*block.estimated_bias])])
        squares.append(difference @ np.linalg.solve(np.array(block.covariance.rows), difference))
    low, high = stats.chi2.ppf([1e-4, 1.0 - 1e-4], 6 * len(squares))
    assert low < sum(squares) < high
