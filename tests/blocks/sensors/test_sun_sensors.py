"""Sun sensors: direction from the coarse heads and from the fine head, and samples without the Sun.

Truth: the true direction, rotations by scipy, cosines by hand, chi-square intervals (99.9 %) for errors.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.sensors.sun_sensors import SunSensors, SunSensorStatus

WIDE = {"field_of_view": math.pi / 2.0, "sigma": 0.0}
ATTITUDE = Rotation.from_rotvec([0.4, -1.1, 0.7])
seeds = st.integers(0, 2**32 - 1)


def directions(seed):
    vector = np.random.default_rng(seed).normal(size=3)
    return vector / np.linalg.norm(vector)


def sensors(sun, illumination=1.0, position=(0.0, 0.0, 0.0), attitude=ATTITUDE, **settings):
    """Return sensors with the Sun in a direction (body)."""
    block = SunSensors(**settings)
    block.quaternion = attitude.as_quat(scalar_first=True).tolist()
    block.sun_direction = attitude.apply(sun).tolist()
    block.illumination, block.position = illumination, list(position)
    block.initialize()
    return block


@given(seeds, seeds, st.floats(0.51, 1.0))
def test_heads_of_half_a_sphere_have_the_exact_direction(seed, axes, illumination):
    """Any perpendicular pairs; the currents are cosines times the visible share."""
    sun, turn = directions(seed), Rotation.random(rng=np.random.default_rng(axes)).as_matrix()
    heads = np.concatenate([turn, -turn])
    block = sensors(sun, illumination, normals_of_heads=heads.ravel().tolist(), **WIDE)
    assert [*block.measured_direction] == pytest.approx(sun, abs=1e-14)
    assert [*block.currents] == pytest.approx(illumination * np.maximum(heads @ sun, 0.0), abs=1e-15)
    assert (block.valid, block.status, block.sample_count) == (True, SunSensorStatus.GOOD, 1)


@given(seeds)
def test_a_smaller_field_of_view_cuts_small_components(seed):
    """Below cos 85 deg they are 0: the direction is at most asin(sqrt(2) cos 85 deg) off, 7.1 deg."""
    sun, limit = directions(seed), math.cos(math.radians(85.0))
    block = sensors(sun, sigma=0.0)
    cut = np.where(np.abs(sun) >= limit, sun, 0.0)
    assert [*block.measured_direction] == pytest.approx(cut / np.linalg.norm(cut), abs=1e-14)
    off = np.linalg.norm(np.cross(sun, [*block.measured_direction]))
    assert off <= math.sqrt(2.0) * limit + 1e-14


def test_light_from_the_body():
    """A head that looks down has albedo_factor, one aslant its cosine, without the Sun, too."""
    down = np.array([0.6, 0.0, -0.8])
    position = -7e6 * ATTITUDE.apply(down)
    block = sensors([1.0, 0.0, 0.0], 0.0, position, albedo_factor=0.3, **WIDE)
    assert [*block.currents] == pytest.approx([0.18, 0.0, 0.0, 0.0, 0.0, 0.24], abs=1e-15)
    assert block.status == SunSensorStatus.NO_SUN


def test_without_the_sun_the_last_direction_stays():
    sun = directions(5)
    block = sensors(sun, **WIDE)
    block.illumination = 0.49
    block.sun_direction = [1.0, 0.0, 0.0]
    block.step(0.0, 0.5)
    assert (block.valid, block.status, block.sample_count) == (False, SunSensorStatus.NO_SUN, 1)
    assert [*block.measured_direction] == pytest.approx(sun, abs=1e-14)
    block.illumination = 0.51
    block.step(0.5, 0.5)
    assert (block.valid, block.status, block.sample_count) == (True, SunSensorStatus.GOOD, 2)


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("sun_direction", [math.nan, 0.0, 0.0]),
        ("illumination", math.inf),
        ("position", [0.0, math.nan, 0.0]),
        ("quaternion", [math.nan, 0.0, 0.0, 0.0]),
        ("quaternion", [0.1, 0.1, 0.0, 0.0]),
    ],
)
def test_what_is_not_finite_or_no_attitude_is_no_sample(name, wrong):
    block = sensors(directions(5), **WIDE)
    before = [*block.currents], [*block.measured_direction]
    setattr(block, name, wrong)
    block.step(0.0, 0.5)
    assert (block.valid, block.status, block.sample_count) == (False, SunSensorStatus.NOT_FINITE, 1)
    assert ([*block.currents], [*block.measured_direction]) == before


@pytest.mark.parametrize(
    ("off", "illumination", "fine"), [(0.0, 1.0, True), (0.49, 0.51, True), (0.51, 1.0, False), (0.0, 0.5, False)]
)
def test_the_fine_head_has_a_small_field_and_needs_half_the_sun(off, illumination, fine):
    """Coarse heads without noise have the exact direction; the fine one an error of 1e-3."""
    boresight = np.array([2.0, -1.0, 2.0])
    sun = Rotation.from_rotvec(off * np.array([1.0, 0.0, -1.0]) / math.sqrt(2.0)).apply(boresight / 3.0)
    block = sensors(sun, illumination, boresight=boresight.tolist(), fine_sigma=1e-3, fine_field=0.5, **WIDE)
    error = np.linalg.norm(np.subtract(block.measured_direction, sun)) if block.valid else 0.0
    assert (error > 1e-6) == fine


def test_sizes_of_errors():
    """Errors across of the fine head; of currents, each on its head, and scales that stay for a flight."""
    sun, samples = np.array([0.0, 0.0, 1.0]), 500
    block, fine, coarse = sensors(sun, fine_sigma=1e-3, sigma=0.01, field_of_view=math.pi / 2.0), [], []
    for k in range(samples):
        block.step(0.5 * k, 0.5)
        fine.append([block.measured_direction.x, block.measured_direction.y])
        coarse.append(np.subtract(block.currents, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0]))
    for errors, sigma in ((fine, 1e-3), (coarse, 0.01)):
        low, high = stats.chi2.interval(0.999, np.size(errors))
        assert low < np.square(np.array(errors) / sigma).sum() < high
    scales = [sensors(sun, scale_sigma=0.1, stream=k, **WIDE).currents[4] - 1.0 for k in range(200)]
    low, high = stats.chi2.interval(0.999, len(scales))
    assert low < np.square(np.array(scales) / 0.1).sum() < high
