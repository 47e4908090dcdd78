"""Reference attitude on an orbit: nadir, Sun, inertially fixed, and conditions under which the last reference is held.

Truth: a value computed outside this package; an orbit with J2 by scipy's DOP853, with numerical derivatives of its
attitudes; scipy's Rotation.align_vectors.
"""

import functools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.guidance.pointing_guidance import PointingGuidance, PointingStatus
from perilune.fmus_src.interfaces.ports.space import PointingMode

MU, J2, RADIUS = 3.986004415e14, 1.0826356e-3, 6378136.3
components = st.floats(-1.0, 1.0, allow_subnormal=False)
vectors = st.tuples(components, components, components).map(np.array)


def slope(_, y):
    """Return gravity of a point and of J2, in components."""
    x, distance = y[:3], np.linalg.norm(y[:3])
    shape = np.array([1.0, 1.0, 3.0]) - 5.0 * (x[2] / distance) ** 2
    return [*y[3:], *(-MU / distance**3 * (1.0 + 1.5 * J2 * (RADIUS / distance) ** 2 * shape) * x)]


@functools.cache
def orbit():
    """Return position and velocity over time, of an orbit with an eccentricity of 0.06 at 63 deg."""
    start = [6.7e6, 1e6, 0.0, -800.0, 3.5e3, 7.0e3]
    return solve_ivp(slope, (-5.0, 6000.0), start, method="DOP853", rtol=1e-12, atol=1e-6, dense_output=True).sol


def guidance_of(r, v, sun=(0.6, 0.0, 0.8), **parameters):
    guidance = PointingGuidance(
        estimated_position=list(r), estimated_velocity=list(v), sun_direction=list(sun), **parameters
    )
    guidance.initialize()
    return guidance


def local_axes(t):
    """Return rotation from the local vertical and horizontal to inertial axes, by definition."""
    r, v = np.split(orbit()(t), 2)
    z, y = -r / np.linalg.norm(r), -np.cross(r, v) / np.linalg.norm(np.cross(r, v))
    return Rotation.from_matrix(np.column_stack([np.cross(y, z), y, z]))


def angular_velocity(t, half=0.5):
    """Return the angular velocity of the local axes, in themselves, by a central difference."""
    return local_axes(t).inv().apply((local_axes(t + half) * local_axes(t - half).inv()).as_rotvec()) / (2.0 * half)


def attitude_of(guidance):
    return Rotation.from_quat([*guidance.reference.reference_quaternion], scalar_first=True)


def test_nadir_of_a_sample():
    guidance = guidance_of([6.0e6, 2.0e6, 2.6e6], [-3200.0, 1000.0, 6600.0], oblateness=0.0)
    expected = (0.5326461237771043, 0.022302888477669043, -0.8304294550725806, 0.1617949570865406)
    np.testing.assert_allclose(guidance.reference.reference_quaternion, expected, atol=1e-15)
    np.testing.assert_allclose(
        guidance.reference.reference_angular_velocity, (0.0, -0.0010825622840560125, 0.0), atol=1e-18
    )


@pytest.mark.parametrize("turn", [[0.0, 0.0, 0.0], [0.3, -1.0, 0.8]])
def test_attitude_and_rate_are_those_of_the_orbit(turn):
    """Without J2 the rate is off by up to 1e-6 rad/s; the acceleration leaves the change of that out, 4e-9 rad/s2."""
    offset = Rotation.from_rotvec(turn)
    errors = []
    for t in np.linspace(10.0, 5900.0, 40):
        r, v = np.split(orbit()(t), 2)
        guidance = guidance_of(r, v, offset=(-2.0 * offset.as_quat(scalar_first=True)).tolist())
        assert (attitude_of(guidance).inv() * local_axes(t) * offset).magnitude() < 1e-14
        assert guidance.reference.reference_quaternion[0] >= 0.0
        rate = offset.apply(guidance.reference.reference_angular_velocity)
        np.testing.assert_allclose(rate, angular_velocity(t), atol=1e-10)
        acceleration = angular_velocity(t + 5.0) - angular_velocity(t - 5.0)
        errors.append(offset.apply(guidance.reference.reference_angular_acceleration) - acceleration / 10.0)
        plain = guidance_of(r, v, oblateness=0.0)
        errors[-1] = [*errors[-1], *(plain.reference.reference_angular_velocity - angular_velocity(t))]
    acceleration, rate = np.abs(errors).reshape(-1, 2, 3).max(axis=(0, 2))
    assert acceleration < 4e-9
    assert 2e-7 < rate < 2e-6


def errors_of(seconds, last_sample):
    """Return attitude errors (rad) at each cycle, with a sample each second, 1 s old, until the last one."""
    guidance = PointingGuidance()
    guidance.sun_direction, errors, statuses = [0.6, 0.0, 0.8], [], []
    for n in range(round(seconds / 0.25) + 1):
        t = 0.25 * n
        if n % 4 == 0 and t <= last_sample:
            y = orbit()(t - 1.0)
            guidance.estimated_position, guidance.estimated_velocity = y[:3].tolist(), y[3:].tolist()
            guidance.sample_time, guidance.orbit_count = t - 1.0, guidance.orbit_count + 1
        if n == 0:
            guidance.initialize()
        else:
            guidance.step(t - 0.25, 0.25)
        errors.append((attitude_of(guidance).inv() * local_axes(t)).magnitude())
        statuses.append(guidance.status)
    return np.array(errors), statuses


def test_late_samples_are_carried_to_now():
    """For up to 1.75 s: J2, 0.014 m/s2, is left out of it."""
    errors, statuses = errors_of(20.0, 20.0)
    assert errors.max() < 0.014 * 1.75 / 7.5e3
    assert set(statuses) == {PointingStatus.GOOD}


def test_an_orbit_without_new_samples_goes_on():
    """After a minute J2 has changed the velocity by less than 0.014 m/s2 times that; the status says so after 5 s."""
    errors, statuses = errors_of(60.0, 2.0)
    assert errors[-1] < 2.0 * 0.014 * 59.0 / 7.5e3
    old = [status == PointingStatus.OLD_ORBIT for status in statuses]
    assert old == [0.25 * n > 1.0 + 5.0 for n in range(241)]


@given(vectors, vectors, vectors)
def test_attitude_in_the_sun(panel, secondary, sun):
    r, v = np.split(orbit()(700.0), 2)
    normal = np.cross(r, v) / np.linalg.norm(np.cross(r, v))
    for a, b in ((panel, secondary), (sun, normal)):
        assume(min(np.linalg.norm(a), np.linalg.norm(b)) > 1e-3)
        assume(np.linalg.norm(np.cross(a, b)) > 0.01 * np.linalg.norm(a) * np.linalg.norm(b))
    guidance = guidance_of(r, v, sun, mode=PointingMode.SUN, panel_normal=panel.tolist(), secondary=secondary.tolist())
    a, b = panel / np.linalg.norm(panel), secondary / np.linalg.norm(secondary)
    expected, _ = Rotation.align_vectors([sun / np.linalg.norm(sun), normal], [a, b], weights=[np.inf, 1.0])
    assert (attitude_of(guidance).inv() * expected).magnitude() < 1e-12
    np.testing.assert_allclose(attitude_of(guidance).apply(a), sun / np.linalg.norm(sun), atol=1e-14)
    assert guidance.status == PointingStatus.GOOD
    assert not any(guidance.reference.reference_angular_velocity)
    assert not any(guidance.reference.reference_angular_acceleration)


def test_a_fixed_attitude():
    fixed = Rotation.from_rotvec([0.4, 0.2, -1.0])
    guidance = guidance_of(
        [7e6, 0.0, 0.0], [0.0, 7.5e3, 0.0], mode=PointingMode.INERTIAL,
        inertial_quaternion=(3.0 * fixed.as_quat(scalar_first=True)).tolist(),
    )  # fmt: skip
    assert (attitude_of(guidance).inv() * fixed).magnitude() < 1e-15
    assert not any(guidance.reference.reference_angular_velocity)


def change(guidance, **inputs):
    """Return the reference after a cycle with these inputs and a new sample of the orbit."""
    for name, setting in inputs.items():
        setattr(guidance, name, setting)
    guidance.orbit_count += 1
    guidance.step(0.0, 0.0)
    reference = guidance.reference
    return (*reference.reference_quaternion, *reference.reference_angular_velocity)


@pytest.mark.parametrize("wrong", [math.nan, math.inf])
@pytest.mark.parametrize("name", ["estimated_position", "estimated_velocity", "sun_direction", "sample_time"])
def test_what_is_not_finite_leaves_the_reference(name, wrong):
    guidance = guidance_of([7e6, 0.0, 0.0], [0.0, 5e3, 5e3])
    first, good = change(guidance), getattr(guidance, name)
    other = {"estimated_velocity": [0.0, 5e3, 6e3]}
    assert change(guidance, **(other | {name: wrong if name == "sample_time" else [0.0, wrong, 0.0]})) == first
    assert guidance.status == PointingStatus.NOT_FINITE
    assert change(guidance, **({name: good} | other)) != first
    assert guidance.status == PointingStatus.GOOD


def test_no_position_leaves_the_reference_of_the_start():
    guidance = guidance_of([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    assert guidance.status == PointingStatus.NOT_FINITE
    assert (*guidance.reference.reference_quaternion,) == (1.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("sine", [0.9e-3, 1.1e-3])
@pytest.mark.parametrize("mode", [PointingMode.NADIR, PointingMode.SUN])
def test_directions_that_are_parallel_leave_the_reference(mode, sine):
    """A fall straight down has no orbit normal; a Sun along the normal leaves the turn about it open."""
    guidance = guidance_of([7e6, 0.0, 0.0], [0.0, 5e3, 5e3], mode=mode)
    first = change(guidance)
    cosine = math.sqrt(1.0 - sine * sine)
    if mode == PointingMode.NADIR:
        second = change(guidance, estimated_velocity=[-5e3 * cosine, 0.0, 5e3 * sine])
    else:
        second = change(guidance, sun_direction=[-sine, -math.sqrt(0.5) * cosine, math.sqrt(0.5) * cosine])
    degenerate = guidance.status == PointingStatus.DEGENERATE
    assert degenerate == (sine < 1e-3) == (second == first)
