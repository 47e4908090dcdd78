"""Modes of a satellite from separation to nadir: every transition at its exact sample, and the outputs of each mode.

Truth: the rules and times of docs/systems/earth_pointing.md written out; attitudes by scipy.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.interfaces.ports.space import MagneticMode, PointingMode
from perilune.fmus_src.sequencing.aocs_modes import AocsMode, AocsModes, AocsModesStatus

CALM, LOST, OFF_SUN = math.radians(0.3), math.radians(2.0), math.radians(10.0)
ORDERS = {
    AocsMode.DETUMBLE: (PointingMode.SUN, MagneticMode.DETUMBLE, False),
    AocsMode.SUN: (PointingMode.SUN, MagneticMode.UNLOAD, True),
    AocsMode.NADIR: (PointingMode.NADIR, MagneticMode.UNLOAD, True),
}


class Flight:
    """Modes over time; ``fly`` ends with the mode after some seconds of the same inputs."""

    def __init__(self, period=0.25):
        self.modes, self.period, self.cycle = AocsModes(sample_period=period), period, 0
        self.set(rate=0.0, angle=0.0, known=True)
        self.modes.estimated_angular_velocity = [1.0, 0.0, 0.0]
        self.modes.initialize()

    def set(self, rate=None, angle=None, known=None):
        """Set size of the rate (rad/s), angle of the panel from the Sun (rad), and knowledge of the attitude."""
        if rate is not None:
            self.modes.estimated_angular_velocity = [0.0, -0.6 * rate, 0.8 * rate]
        if known is not None:
            self.modes.attitude_known = known
        if angle is not None:
            attitude = Rotation.from_rotvec([0.4, -1.0, 0.3])
            sun = attitude.apply([math.sin(angle) * 0.6, -math.cos(angle), math.sin(angle) * 0.8])
            self.modes.estimated_quaternion = attitude.as_quat(scalar_first=True).tolist()
            self.modes.sun_direction = sun.tolist()

    def fly(self, seconds):
        for _ in range(round(seconds / self.period)):
            self.modes.step(self.cycle * self.period, self.period)
            self.cycle += 1
        orders = (self.modes.pointing_mode, self.modes.magnetic_mode, self.modes.wheels_on)
        assert orders == ORDERS[self.modes.mode]
        return self.modes.mode

    def changes_after(self, seconds, mode):
        """Return True if the mode changes to this one exactly at the sample after some seconds of the same inputs."""
        before = self.modes.mode
        stays = self.fly(seconds - self.period) == before != mode
        return stays and self.fly(self.period) == mode and self.modes.time_in_mode == 0.0


def flight_in(mode, period=0.25):
    flight = Flight(period)
    if mode != AocsMode.DETUMBLE:
        flight.set(rate=0.99 * CALM)
        flight.fly(60.0)
    if mode == AocsMode.NADIR:
        flight.fly(60.0)
    assert flight.modes.mode == mode
    return flight


@pytest.mark.parametrize("period", [0.25, 0.5, 1.0])
def test_every_transition_is_at_its_sample(period):
    flight = Flight(period)
    flight.set(rate=1.01 * CALM)
    assert flight.fly(100.0) == AocsMode.DETUMBLE
    flight.set(rate=0.99 * CALM, known=False)
    assert flight.changes_after(60.0, AocsMode.SUN)
    assert flight.fly(400.0) == AocsMode.SUN
    flight.set(known=True, angle=1.01 * OFF_SUN)
    assert flight.fly(100.0) == AocsMode.SUN
    flight.set(angle=0.99 * OFF_SUN)
    assert flight.changes_after(60.0, AocsMode.NADIR)
    flight.set(angle=math.pi)
    assert flight.fly(400.0) == AocsMode.NADIR
    assert flight.modes.time_in_mode == 400.0
    flight.set(known=False)
    assert flight.changes_after(300.0, AocsMode.SUN)
    flight.set(rate=1.01 * LOST)
    assert flight.changes_after(5.0, AocsMode.DETUMBLE)


@pytest.mark.parametrize("mode", [AocsMode.SUN, AocsMode.NADIR])
def test_a_rate_that_is_lost_in_any_mode_is_braked(mode):
    flight = flight_in(mode)
    flight.set(rate=0.99 * LOST, angle=math.pi)
    assert flight.fly(100.0) == mode
    flight.set(rate=1.01 * LOST)
    assert flight.changes_after(5.0, AocsMode.DETUMBLE)


@pytest.mark.parametrize(
    ("mode", "good", "bad", "seconds", "after"),
    [
        (AocsMode.DETUMBLE, {"rate": 0.5 * CALM}, {"rate": 1.1 * CALM}, 60.0, AocsMode.SUN),
        (AocsMode.SUN, {"angle": 0.1}, {"angle": 0.2}, 60.0, AocsMode.NADIR),
        (AocsMode.SUN, {"known": True}, {"known": False}, 60.0, AocsMode.NADIR),
        (AocsMode.NADIR, {"known": False}, {"known": True}, 300.0, AocsMode.SUN),
        (AocsMode.NADIR, {"rate": 1.1 * LOST}, {"rate": 0.9 * LOST}, 5.0, AocsMode.DETUMBLE),
    ],
)
def test_a_single_sample_against_it_begins_the_time_again(mode, good, bad, seconds, after):
    flight = flight_in(mode)
    for _ in range(2):
        flight.set(**good)
        assert flight.fly(seconds - 0.25) == mode
        flight.set(**bad)
        assert flight.fly(0.25) == mode
    flight.set(**good)
    assert flight.changes_after(seconds, after)


@pytest.mark.parametrize("wrong", [math.nan, math.inf])
@pytest.mark.parametrize("name", ["estimated_angular_velocity", "estimated_quaternion", "sun_direction"])
@pytest.mark.parametrize(
    ("mode", "inputs", "seconds", "after"),
    [
        (AocsMode.DETUMBLE, {"rate": 0.5 * CALM}, 60.0, AocsMode.SUN),
        (AocsMode.SUN, {"angle": 0.1}, 60.0, AocsMode.NADIR),
        (AocsMode.NADIR, {"rate": 1.1 * LOST}, 5.0, AocsMode.DETUMBLE),
    ],
)
def test_what_is_not_finite_keeps_the_mode_and_is_neither_calm_nor_fast(name, wrong, mode, inputs, seconds, after):
    flight = flight_in(mode)
    flight.set(**inputs)
    assert flight.fly(seconds - 0.25) == mode
    good = list(getattr(flight.modes, name))
    setattr(flight.modes, name, [*good[:-1], wrong])
    assert flight.fly(2.0 * seconds) == mode
    assert flight.modes.status == AocsModesStatus.NOT_FINITE
    setattr(flight.modes, name, good)
    assert flight.changes_after(seconds, after)
    assert flight.modes.status == AocsModesStatus.GOOD


@given(st.integers(0, 2**32 - 1), st.floats(0.0, math.pi), st.sampled_from([-1.0, 1.0, 2.5]))
def test_the_angle_to_the_sun_is_that_of_the_panel_in_any_attitude(seed, angle, scale):
    """panel_normal and the direction of any length, the quaternion of either sign."""
    random = np.random.default_rng(seed)
    panel, attitude = random.normal(size=3), Rotation.random(rng=random)
    axis = np.cross(panel, random.normal(size=3))
    off_panel = Rotation.from_rotvec(angle * axis / np.linalg.norm(axis)).apply(panel)
    modes = AocsModes(panel_normal=panel.tolist(), settle_time=0.0, sun_error=1.0, attitude_known=True)
    modes.estimated_quaternion = (scale * attitude.as_quat(scalar_first=True)).tolist()
    modes.sun_direction = (3.0 * attitude.apply(off_panel)).tolist()
    modes.initialize()
    assert modes.mode == AocsMode.SUN  # at rest
    modes.step(0.0, 0.25)
    if abs(angle - 1.0) > 1e-12:
        assert modes.mode == (AocsMode.NADIR if angle < 1.0 else AocsMode.SUN)


@pytest.mark.parametrize("quaternion", [[0.0] * 4, [0.0, 0.3, -0.2, 0.3]])
def test_a_quaternion_shorter_than_a_half_is_no_attitude(quaternion):
    for mode, seconds in ((AocsMode.SUN, 400.0), (AocsMode.NADIR, 299.75)):
        flight = flight_in(mode)
        flight.modes.estimated_quaternion = quaternion
        assert flight.fly(seconds) == mode
    assert flight.fly(0.25) == AocsMode.SUN


def test_no_direction_to_the_sun_is_not_on_it():
    flight = flight_in(AocsMode.SUN)
    flight.modes.sun_direction = [0.0, 0.0, 0.0]
    assert flight.fly(400.0) == AocsMode.SUN


def test_times_of_0_need_the_condition_nonetheless():
    modes = AocsModes(settle_time=0.0, lost_time=0.0, blind_time=0.0, attitude_known=True)
    modes.initialize()
    modes.sun_direction = [0.0, -1.0, 0.0]
    observed = [modes.mode]
    for n, rate in enumerate([CALM, 1.5 * CALM, 1.01 * LOST, 1.01 * LOST, 0.9 * CALM, CALM]):
        modes.estimated_angular_velocity = [rate, 0.0, 0.0]
        modes.attitude_known = n != 1
        modes.step(0.25 * n, 0.25)
        observed.append(modes.mode)
    detumble, sun, nadir = AocsMode.DETUMBLE, AocsMode.SUN, AocsMode.NADIR
    assert observed == [sun, nadir, sun, detumble, detumble, sun, nadir]


def test_the_flight_may_begin_at_any_time():
    modes = AocsModes()
    modes.start_time = 5000.0
    modes.initialize()
    assert (modes.mode, modes.time_in_mode) == (AocsMode.DETUMBLE, 0.0)
    for n in range(240):
        modes.step(5000.0 + 0.25 * n, 0.25)
        assert modes.mode == (AocsMode.SUN if n == 239 else AocsMode.DETUMBLE)
