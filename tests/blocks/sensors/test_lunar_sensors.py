"""Inertial sensor, radar altimeter, Doppler velocimeter and terrain camera.

Truth: the true motion if all sigmas are 0; for the errors, sums of squares within two-sided 99.9 % chi-square
intervals, Kolmogorov-Smirnov tests and correlations, at fixed seeds; scipy's rotations for the misalignment; exact
sample instants and altitude limits.
"""

import math

import numpy as np
import pytest
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.runtime import BlockInstance
from perilune.fmus_src.sensors.doppler_velocimeter import DopplerVelocimeter
from perilune.fmus_src.sensors.inertial_sensor import InertialSensor
from perilune.fmus_src.sensors.radar_altimeter import RadarAltimeter
from perilune.fmus_src.sensors.terrain_camera import TerrainCamera

RADIUS = 1.7374e6
VELOCITY = [-40.0, 3.0, -12.0]
INERTIAL_ERRORS = ("bias_sigma", "scale_factor_sigma", "velocity_random_walk", "attitude_sigma")
# errors of a range sensor, its output, and altitudes just inside and outside of its gates
RANGED = {
    RadarAltimeter: (("range_error", "noise_sigma"), "measured_altitude", [2e4, 1.0, 0.0], [20000.001, 5e4]),
    DopplerVelocimeter: (("speed_error", "noise_sigma"), "measured_velocity", [5e3, 0.0], [5000.001, 2e4]),
    TerrainCamera: (
        ("altitude_error", "noise_sigma"),
        "measured_position",
        [500.0, 2e4, 3e3],
        [499.999, 20000.001, 0.0],
    ),
}


def sensor(block_class, altitude=1000.0, **settings_):
    """Return a range sensor above the site, initialised."""
    block = block_class(position=[0.0, 0.0, altitude], **settings_)
    if block_class is DopplerVelocimeter:
        block.velocity = VELOCITY
    block.initialize()
    return block


def perfect(names):
    return dict.fromkeys(names, 0.0)


def output(block):
    value = getattr(block, RANGED[type(block)][1])
    return [value] if isinstance(value, float) else list(value)


def truth(block):
    """Return the measurement of a perfect range sensor."""
    if isinstance(block, RadarAltimeter):
        return [np.linalg.norm(np.add(block.position, [0.0, 0.0, RADIUS])) - RADIUS]
    return list(block.velocity if isinstance(block, DopplerVelocimeter) else block.position)


def sigma_of(block, altitude):
    """Return 1 sigma of each axis, from the specification of the sensors."""
    if isinstance(block, RadarAltimeter):
        return 0.005 * altitude + 1.0
    if isinstance(block, DopplerVelocimeter):
        return 0.001 * math.sqrt(40.0**2 + 3.0**2 + 12.0**2) + 0.05
    return 0.0015 * altitude + 2.0


def interval(freedom):
    return stats.chi2.ppf([0.0005, 0.9995], freedom)


def assert_standard_normal(numbers):
    low, high = interval(len(numbers))
    assert low < np.sum(np.square(numbers)) < high
    assert abs(np.mean(numbers)) < 3.29 / math.sqrt(len(numbers))
    assert stats.kstest(numbers, "norm").pvalue > 1e-3


@pytest.mark.parametrize("block_class", RANGED)
def test_without_sigmas_the_measurement_is_the_truth(block_class):
    block = sensor(block_class, **perfect(RANGED[block_class][0]))
    for k in range(5):
        assert output(block) == pytest.approx(truth(block), abs=1e-9)
        assert block.sample_count == k + 1
        block.position = [100.0 * k, -50.0 * k, 800.0 + k]
        if block_class is DopplerVelocimeter:
            block.velocity = [x + k for x in VELOCITY]
        block.step(0.1 * k, 0.1)


@pytest.mark.parametrize("block_class", RANGED)
def test_gates_include_their_altitudes(block_class):
    names, _, inside, outside = RANGED[block_class]
    for altitude in inside:
        assert sensor(block_class, altitude).sample_count == 1
    for altitude in outside:
        block = sensor(block_class, altitude, **perfect(names))
        assert block.sample_count == 0
        assert output(block) == [0.0] * len(output(block))


@pytest.mark.parametrize("block_class", RANGED)
def test_altitude_is_that_above_the_sphere(block_class):
    """At the height of the site but 300 km away the ground is 26 km below."""
    block = sensor(block_class)
    block.position = [0.0, 3e5, 0.0]
    block.step(0.0, 0.1)
    assert block.sample_count == 1
    x = RADIUS + 1000.0  # a quarter of the way round
    block.position = [x, 0.0, -RADIUS]
    block.step(0.1, 0.1)
    assert block.sample_count == 2


@pytest.mark.parametrize("block_class", RANGED)
def test_output_is_held_out_of_range_and_the_count_stands(block_class):
    block = sensor(block_class)
    held = output(block)
    for k in range(3):
        block.position = [*block.position[0:2], RANGED[block_class][3][0]]
        block.step(0.1 * k, 0.1)
        assert output(block) == held
        assert block.sample_count == 1
    block.position = [*block.position[0:2], 1000.0]
    block.step(0.3, 0.1)
    assert block.sample_count == 2
    assert output(block) != held


@pytest.mark.parametrize("block_class", RANGED)
@pytest.mark.parametrize("altitude", [600.0, 4900.0])
def test_errors_are_white_and_of_the_declared_size(block_class, altitude):
    block = sensor(block_class, altitude, seed=11)
    errors = []
    for k in range(2000):
        errors.append((np.array(output(block)) - truth(block)) / sigma_of(block, altitude))
        block.step(0.1 * k, 0.1)
    errors = np.array(errors)
    for axis in errors.T:
        assert_standard_normal(axis)
        for lag in (1, 2, 5):
            assert abs(np.mean(axis[:-lag] * axis[lag:])) < 3.29 / math.sqrt(len(axis) - lag)
    across = np.corrcoef(errors.T) if errors.shape[1] > 1 else np.eye(1)
    assert abs(across - np.eye(len(across))).max() < 3.29 / math.sqrt(len(errors))


@pytest.mark.parametrize("block_class", RANGED)
def test_errors_do_not_depend_on_the_path_before(block_class):
    """Two flights, one of them out of range for a while: sample k has the same standard normal errors in both."""
    low, other = sensor(block_class, seed=3, stream=4), sensor(block_class, 800.0, seed=3, stream=4)
    for k in range(12):
        other.position = [*other.position[0:2], 3e4 if 3 <= k < 8 else 800.0 + 50.0 * k]
        for block in (low, other):
            block.step(0.1 * k, 0.1)
        if not 3 <= k < 8:
            actual = [
                (np.array(output(block)) - truth(block)) / sigma_of(block, block.position[2]) for block in (low, other)
            ]
            assert actual[0] == pytest.approx(actual[1], abs=1e-6)
    assert other.sample_count == low.sample_count - 5


@pytest.mark.parametrize("block_class", [*RANGED, InertialSensor])
def test_seeds_and_streams_differ_and_repeat(block_class):
    def first(**settings_):
        if block_class is InertialSensor:
            block = block_class(**settings_)
            block.initialize()
            block.step(0.0, 0.1)
            return block.velocity_increment[0]
        return output(sensor(block_class, **settings_))[0]

    assert first(seed=1, stream=2) == first(seed=1, stream=2)
    assert len({first(seed=1, stream=2), first(seed=2, stream=2), first(seed=1, stream=3)}) == 3


@pytest.mark.parametrize(
    ("block_class", "period"),
    [(RadarAltimeter, 1.0), (DopplerVelocimeter, 0.2), (TerrainCamera, 5.0), (InertialSensor, 0.1)],
)
def test_samples_come_at_the_declared_rate_whatever_the_steps(block_class, period):
    """A sample at the start (the inertial sensor: none) and one per period; the same numbers for all steps."""
    runs = []
    for step in (period / 4.0, period / 2.0, period):
        component = BlockInstance(block_class)
        component.start_time = 3.0
        block = component.block
        component.settle()
        component.start()
        rows = []
        for k in range(round(10.0 * period / step)):
            time = 3.0 + (k + 1) * step
            if block_class is InertialSensor:
                block.sensed_velocity = [2.0 * time, 0.0, time * time]
            else:
                block.position = [10.0 * time, 0.0, 1000.0]
            before = block.sample_count
            component.do_step(3.0 + k * step, step)
            if block.sample_count > before:
                value = block.velocity_increment if block_class is InertialSensor else output(block)
                rows.append([time, *value])
        times = [3.0 + period * n for n in range(1, 11)]
        in_range = 0 if block_class in (InertialSensor, TerrainCamera) else 1  # the declared position is on the ground
        assert [row[0] for row in rows] == pytest.approx(times, abs=1e-9)
        assert block.sample_count == 10 + in_range
        runs.append(np.array(rows))
    assert runs[0] == pytest.approx(runs[1], abs=1e-9)
    assert runs[1] == pytest.approx(runs[2], abs=1e-9)


def inertial(**settings_):
    block = InertialSensor(**settings_)
    block.initialize()
    return block


def moving(block, motion, steps, step=0.1):
    """Return increments over ``steps`` steps of a sensed velocity, a function of time."""
    rows = []
    for k in range(steps):
        block.sensed_velocity = np.asarray(motion(step * (k + 1)), dtype=float).tolist()
        block.step(step * k, step)
        rows.append(list(block.velocity_increment))
    return np.array(rows)


def test_perfect_inertial_sensor_gives_the_increments():
    block = inertial(**perfect(INERTIAL_ERRORS))
    assert block.sample_count == 0
    assert block.velocity_increment == [0.0, 0.0, 0.0]
    rows = moving(block, lambda t: [3.0 * t, -t * t, math.sin(t)], 50)
    assert block.sample_count == 50
    assert rows.sum(axis=0) == pytest.approx(block.sensed_velocity, abs=1e-13)
    times = 0.1 * np.arange(51)
    expected = np.diff(np.transpose([3.0 * times, -times * times, np.sin(times)]), axis=0)
    assert rows == pytest.approx(expected, abs=1e-13)


def test_first_increment_counts_from_the_start():
    block = InertialSensor(sensed_velocity=[100.0, 0.0, 0.0], **perfect(INERTIAL_ERRORS))
    block.initialize()
    assert moving(block, lambda t: [100.0 + t, 0.0, 0.0], 1)[0] == pytest.approx([0.1, 0.0, 0.0], abs=1e-13)


def test_bias_grows_with_time_alone():
    """Equal sums of increments whether samples are 0.1 s or 0.25 s apart; nothing else is sensed."""
    only = perfect(INERTIAL_ERRORS) | {"bias_sigma": 1e-3, "seed": 8}
    for step in (0.1, 0.25):
        block = inertial(**only)
        rows = moving(block, lambda t: [0.0, 0.0, 0.0], round(5.0 / step), step)
        assert rows.sum(axis=0) == pytest.approx(np.multiply(block.bias, 5.0), abs=1e-15)
        assert rows == pytest.approx(np.tile(np.multiply(block.bias, step), (len(rows), 1)), abs=1e-16)


def test_scale_factor_and_misalignment_act_on_the_increment():
    only = perfect(INERTIAL_ERRORS) | {"seed": 8}
    scaled = inertial(**(only | {"scale_factor_sigma": 3e-4}))
    rows = moving(scaled, lambda t: [3.0 * t, -2.0 * t, t], 20)
    assert rows == pytest.approx(
        np.tile(0.1 * np.array([3.0, -2.0, 1.0]) * (1 + np.array(scaled.scale_factor)), (20, 1))
    )
    turned = inertial(**(only | {"attitude_sigma": 1e-4}))
    rows = moving(turned, lambda t: [3.0 * t, -2.0 * t, t], 20)
    expected = Rotation.from_rotvec(turned.misalignment).apply([0.3, -0.2, 0.1])
    assert rows == pytest.approx(np.tile(expected, (20, 1)), abs=1e-8)  # second order in the angle
    assert np.linalg.norm(rows[0] - [0.3, -0.2, 0.1]) > 1e-5
    both = inertial(**(only | {"scale_factor_sigma": 0.1, "attitude_sigma": 0.1}))
    scaled = [0.3, -0.2, 0.1] * (1.0 + np.array(both.scale_factor))
    expected = scaled + np.cross(both.misalignment, scaled)
    assert moving(both, lambda t: [3.0 * t, -2.0 * t, t], 1)[0] == pytest.approx(expected, abs=1e-15)


def test_constant_errors_scatter_as_declared_and_are_independent():
    count = 500
    rows = []
    for seed in range(count):
        block = inertial(seed=seed, stream=2)
        rows.append([*block.bias, *block.scale_factor, *block.misalignment])
    normal = np.array(rows) / np.repeat([1e-3, 3e-4, math.radians(0.02)], 3)
    for column in normal.T:
        assert_standard_normal(column)
    assert abs(np.corrcoef(normal.T) - np.eye(9)).max() < 4.0 / math.sqrt(count)


@pytest.mark.parametrize("step", [0.1, 1.0])
def test_random_walk_is_white_and_grows_with_the_root_of_time(step):
    only = perfect(INERTIAL_ERRORS) | {"velocity_random_walk": 1e-4, "seed": 5}
    rows = moving(inertial(**only), lambda t: [0.0, 0.0, 0.0], 2000, step) / (1e-4 * math.sqrt(step))
    for axis in rows.T:
        assert_standard_normal(axis)
        assert abs(np.mean(axis[:-1] * axis[1:])) < 3.29 / math.sqrt(len(axis) - 1)
    assert abs(np.corrcoef(rows.T) - np.eye(3)).max() < 3.29 / math.sqrt(len(rows))


def test_errors_of_one_kind_do_not_change_with_those_of_another():
    alone = inertial(seed=4, **(perfect(INERTIAL_ERRORS) | {"velocity_random_walk": 1e-4}))
    together = inertial(seed=4)
    first = moving(alone, lambda t: [t, 0.0, 0.0], 5)
    second = moving(together, lambda t: [t, 0.0, 0.0], 5)
    assert np.diff(first - second, axis=0) == pytest.approx(np.zeros((4, 3)), abs=1e-15)  # the rest is constant


@pytest.mark.parametrize("block_class", [*RANGED, InertialSensor])
def test_declared_starts_alone_run(block_class):
    block = block_class()
    block.initialize()
    block.step(0.0, 0.1)
    block.initialize()
