"""Modes of an attitude and orbit control system: detumbling, Sun, nadir."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..interfaces.ports import body, robot, sampling
from ..interfaces.ports.space import MagneticMode, PointingMode, SpaceEnvironment
from ..kernel.enumerations import Enumeration, member
from ..kernel.functions import atan2
from ..mathlib.attitude.quaternion import is_attitude, normalise, to_body
from ..mathlib.vectors import cross, dot, is_finite, norm
from ..units import deg


class AocsMode(Enumeration):
    """Mode of the satellite."""

    DETUMBLE = member("detumble by torquers")
    SUN = member("panel towards the Sun")
    NADIR = member("nadir")


class AocsModesStatus(Enumeration):
    """Validity of the last decision."""

    GOOD = member("good")
    NOT_FINITE = member("an input not finite, mode held")


class AocsModes(Block):
    """Mode sequence from separation to nadir pointing, with recovery.

    DETUMBLE to SUN: rate below calm_rate for settle_time. SUN to NADIR: attitude known and panel_normal within
    sun_error of the Sun for settle_time. Any mode to DETUMBLE: rate above lost_rate for lost_time. NADIR to SUN: no
    attitude for blind_time; a quaternion shorter than 0.5 counts as no attitude. Transitions are decided at this
    block's samples; a sample that is not finite leaves the mode unchanged and restarts settle_time and lost_time. In
    DETUMBLE the wheels are off and the torquers reduce the rate; in the other modes the wheels are on and the torquers
    unload them.

    Frame: body.

    Assumes that no other block commands modes.

    See docs/systems/earth_pointing.md.
    """

    default_step = 0.25

    calm_rate = Parameter(deg(0.3), unit="rad/s", minimum=0.0, description="angular rate below which DETUMBLE can end")
    lost_rate = Parameter(
        deg(2.0), unit="rad/s", minimum=0.0, description="angular rate above which DETUMBLE is resumed"
    )
    sun_error = Parameter(
        deg(10.0),
        unit="rad",
        minimum=0.0,
        description="largest angle between panel_normal and the Sun at which SUN can end",
    )
    panel_normal = Parameter(
        [0.0, -1.0, 0.0], unit="1", frame="body", description="body axis pointed to the Sun in mode SUN"
    )
    settle_time = Parameter(
        60.0,
        unit="s",
        minimum=0.0,
        description="time for which the conditions of a transition must hold without interruption",
    )
    lost_time = Parameter(
        5.0, unit="s", minimum=0.0, description="time above lost_rate after which DETUMBLE is resumed"
    )
    blind_time = Parameter(
        300.0, unit="s", minimum=0.0, description="time without a known attitude after which SUN is resumed"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.25, "sample period of the mode decisions; 0: a decision at every communication point"
    )
    estimated_angular_velocity = body.ANGULAR_VELOCITY.input(
        "estimated or measured angular velocity of the body relative to the inertial frame"
    )
    estimated_quaternion = robot.QUATERNION.input()
    sun_direction = SpaceEnvironment.sun_direction.input("modelled direction to the Sun, unit vector")
    attitude_known = Input(False, description="true: estimated attitude valid")
    mode = Output(AocsMode, direct=True)
    pointing_mode = Output(PointingMode, start=PointingMode.SUN, direct=True)
    magnetic_mode = Output(MagneticMode, start=MagneticMode.DETUMBLE, direct=True)
    wheels_on = Output(False, direct=True, description="true: reaction wheels active, attitude reference followed")
    time_in_mode = Output(0.0, unit="s", direct=True, description="time since the start of the current mode")
    status = Output(AocsModesStatus, direct=True)
    begun = State(0.0, unit="s", description="start time of the current mode")
    settled_since = State(
        0.0, unit="s", description="last time at which the conditions of the next transition did not hold"
    )
    fast_since = State(0.0, unit="s", description="last time at which the angular rate was within lost_rate")
    blind_since = State(
        0.0, unit="s", description="last time at which the attitude was known; initially the start time"
    )
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.begun = self.start_time
        self.settled_since = self.start_time
        self.fast_since = self.start_time
        self.blind_since = self.start_time
        self.set_mode(self.start_time)

    def enter(self, mode: int, t: float) -> None:
        """Enter a mode at t (s)."""
        self.mode = mode
        self.begun = t
        self.settled_since = t
        self.wheels_on = mode != AocsMode.DETUMBLE
        self.magnetic_mode = MagneticMode.UNLOAD
        self.pointing_mode = PointingMode.SUN
        if mode == AocsMode.DETUMBLE:
            self.magnetic_mode = MagneticMode.DETUMBLE
        if mode == AocsMode.NADIR:
            self.pointing_mode = PointingMode.NADIR

    def knows_attitude(self) -> bool:
        """Return True if the attitude is known; a quaternion shorter than 0.5 counts as unknown."""
        return self.attitude_known and is_attitude(self.estimated_quaternion)

    def ready(self) -> bool:
        """Return True if the condition for the next mode holds."""
        if self.mode == AocsMode.DETUMBLE:
            return norm(self.estimated_angular_velocity) < self.calm_rate
        sun_body = to_body(normalise(self.estimated_quaternion), self.sun_direction)
        sine = norm(cross(self.panel_normal, sun_body))
        cosine = dot(self.panel_normal, sun_body)
        return self.knows_attitude() and sine + abs(cosine) > 0.0 and atan2(sine, cosine) < self.sun_error

    def set_mode(self, t: float) -> None:
        """Decide the mode at t (s)."""
        self.status = AocsModesStatus.NOT_FINITE
        q = self.estimated_quaternion
        finite = is_finite(self.estimated_angular_velocity) and is_finite(self.sun_direction)
        if not (finite and math.isfinite(q.w) and is_finite(q[1:4])):
            self.settled_since = t
            self.fast_since = t
        else:
            self.status = AocsModesStatus.GOOD
            ready = self.ready()
            if not ready:
                self.settled_since = t
            fast = norm(self.estimated_angular_velocity) > self.lost_rate
            if not fast:
                self.fast_since = t
            known = self.knows_attitude()
            if known:
                self.blind_since = t
            settled = ready and t - self.settled_since >= self.settle_time
            lost = fast and t - self.fast_since >= self.lost_time
            blind = not known and t - self.blind_since >= self.blind_time
            if self.mode == AocsMode.DETUMBLE:
                if settled:
                    self.enter(AocsMode.SUN, t)
            elif lost:
                self.enter(AocsMode.DETUMBLE, t)
            elif self.mode == AocsMode.SUN:
                if settled:
                    self.enter(AocsMode.NADIR, t)
            elif blind:
                self.enter(AocsMode.SUN, t)
        self.time_in_mode = t - self.begun

    def step(self, t: float, h: float) -> None:
        self.set_mode(t + h)
