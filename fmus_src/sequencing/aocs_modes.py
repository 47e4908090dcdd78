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

    DETUMBLE = member("brake the rotation by torquers")
    SUN = member("panel towards the Sun")
    NADIR = member("nadir")


class AocsModesStatus(Enumeration):
    """Validity of the last decision."""

    GOOD = member("good")
    NOT_FINITE = member("an input not finite, the mode stays")


class AocsModes(Block):
    """Sequence of modes from separation to nadir pointing, and back where it is lost.

    DETUMBLE to SUN after the rate was below calm_rate for settle_time. SUN to NADIR after an attitude was known and
    panel_normal within sun_error of the Sun for settle_time. To DETUMBLE after the rate was above lost_rate for
    lost_time; to SUN from NADIR after no attitude for blind_time, and a quaternion shorter than 0.5 is none. Each is
    decided at this block's samples, of which one that is not finite keeps the mode and ends a spell of settling or of
    lost_rate. Wheels are off and torquers brake in DETUMBLE; wheels are on and torquers unload them in the other modes.
    Frame: body. Rules: docs/systems/earth_pointing.md. Assumes that nobody else orders a mode. Source: ours.
    """

    default_step = 0.25

    calm_rate = Parameter(deg(0.3), unit="rad/s", minimum=0.0, description="rate below which DETUMBLE may end")
    lost_rate = Parameter(deg(2.0), unit="rad/s", minimum=0.0, description="rate above which DETUMBLE begins again")
    sun_error = Parameter(deg(10.0), unit="rad", minimum=0.0, description="of panel_normal, below which SUN may end")
    panel_normal = Parameter([0.0, -1.0, 0.0], unit="1", frame="body", description="which SUN turns to the Sun")
    settle_time = Parameter(60.0, unit="s", minimum=0.0, description="for which both hold")
    lost_time = Parameter(5.0, unit="s", minimum=0.0, description="for which lost_rate is exceeded")
    blind_time = Parameter(300.0, unit="s", minimum=0.0, description="without attitude until SUN")
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.25, "between decisions; 0: every communication point")
    estimated_angular_velocity = body.ANGULAR_VELOCITY.input("angular velocity, estimated or measured")
    estimated_quaternion = robot.QUATERNION.input()
    sun_direction = SpaceEnvironment.sun_direction.input("to the Sun, as known on board")
    attitude_known = Input(False, description="true: the estimated attitude is usable")
    mode = Output(AocsMode, direct=True)
    pointing_mode = Output(PointingMode, start=PointingMode.SUN, direct=True)
    magnetic_mode = Output(MagneticMode, start=MagneticMode.DETUMBLE, direct=True)
    wheels_on = Output(False, direct=True, description="true: wheels follow the attitude reference")
    time_in_mode = Output(0.0, unit="s", direct=True, description="since the mode began")
    status = Output(AocsModesStatus, direct=True)
    begun = State(0.0, unit="s", description="when the mode began")
    settled_since = State(0.0, unit="s", description="since when the condition to go on holds")
    fast_since = State(0.0, unit="s", description="since when lost_rate is exceeded")
    blind_since = State(0.0, unit="s", description="since when no attitude is known")
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.begun = self.start_time
        self.settled_since = self.start_time
        self.fast_since = self.start_time
        self.blind_since = self.start_time
        self.set_mode(self.start_time)

    def enter(self, mode: int, t: float) -> None:
        """Begin a mode at t (s)."""
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
        """Return True if the attitude is usable; a quaternion shorter than 0.5 is none."""
        return self.attitude_known and is_attitude(self.estimated_quaternion)

    def ready(self) -> bool:
        """Return True if the condition for the next mode holds."""
        if self.mode == AocsMode.DETUMBLE:
            return norm(self.estimated_angular_velocity) < self.calm_rate
        sun = to_body(normalise(self.estimated_quaternion), self.sun_direction)
        sine = norm(cross(self.panel_normal, sun))
        cosine = dot(self.panel_normal, sun)
        return self.knows_attitude() and sine + abs(cosine) > 0.0 and atan2(sine, cosine) < self.sun_error

    def set_mode(self, t: float) -> None:
        """Set the mode at t (s)."""
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
