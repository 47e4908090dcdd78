"""Interface of slew guidance, which generates the reference attitude while a satellite turns to a target attitude."""

from ..block import Block, Output, Outputs, Parameter, State
from ..interfaces.ports import robot, sampling
from ..interfaces.ports.satellite import AttitudeReference
from ..kernel.enumerations import Enumeration, member
from ..kernel.records import Field, Record
from ..mathlib.attitude.quaternion import (
    difference,
    from_rotation_vector,
    is_attitude,
    multiply,
    normalise,
    to_rotation_vector,
)
from ..mathlib.vectors import norm, vector


class SlewPhase(Enumeration):
    """Phase of the reference."""

    WAITING = member("waiting")
    SLEWING = member("slewing")
    HOLDING = member("holding")
    NO_ATTITUDE = member("no attitude: quaternion shorter than 0.5, nothing planned")


class SlewProgress(Record):
    """Progress of a slew."""

    angle = Field(unit="rad", description="angle turned since the start of the slew")
    rate = Field(unit="rad/s", description="angular rate of the slew")


class SlewGuidance(Block, interface=True):
    """Reference of a rest-to-rest turn about the eigenaxis, from the first estimated attitude to the target.

    With the eigenaxis e of the shorter rotation and the angle θ of the profile:

        q_r = q_0 (cos(θ/2), e sin(θ/2))    ω_r = θ' e

    The turn begins at slew_start. The angular acceleration is the mean over the next sample_period, so that piecewise
    constant torque reproduces the rate. There is no reference until the estimated and the target attitude are valid;
    times are measured from this instant. A guidance law defines `plan`, which sets duration from slew_angle, and
    `follow`, which sets progress.

    Frames: inertial; reference axes for the reference's rate and acceleration.

    Assumes a satellite at rest at the start.

    Source: Wie 1998, section 7. See docs/systems/satellite_pointing.md.
    """

    to_write = ("plan", "follow")

    default_step = 0.125

    target_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="target attitude quaternion from body to inertial, scalar first"
    )
    slew_start = Parameter(
        20.0, unit="s", minimum=0.0, description="time from the start of the simulation to the start of the slew"
    )
    rate_limit = Parameter(0.02, unit="rad/s", minimum=1e-9, description="largest angular rate of the slew")
    acceleration_limit = Parameter(
        1e-3, unit="rad/s2", minimum=1e-12, description="largest angular acceleration of the slew"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.125, "sample period of the guidance; 0: a sample at every communication point"
    )
    estimated_quaternion = robot.QUATERNION.input()
    reference = Outputs(AttitudeReference, direct=True)
    slew_angle = Output(0.0, unit="rad", direct=True, description="rotation angle of the slew")
    duration = Output(0.0, unit="s", direct=True, description="duration of the slew")
    phase = Output(SlewPhase, direct=True)
    start_time = sampling.START_TIME.state()
    start_quaternion = robot.QUATERNION.state(
        "reference attitude quaternion at the start of the slew, from body to inertial, scalar first"
    )
    eigenaxis = State(
        [0.0, 0.0, 0.0], unit="1", frame="body", description="eigenaxis of the slew, unit vector; 0: no rotation"
    )
    progress = State(SlewProgress)

    def plan(self) -> None:
        """Set duration (s) for slew_angle (rad)."""

    def follow(self, time: float) -> None:
        """Set progress at a time (s) between 0 and duration."""

    def proceed(self, time: float) -> None:
        """Set progress at any ``time`` (s) of the simulation."""
        elapsed = time - self.start_time - self.slew_start
        if elapsed <= sampling.TIME_ROUNDING:
            self.progress = SlewProgress(angle=0.0, rate=0.0)
        elif elapsed >= self.duration - sampling.TIME_ROUNDING:
            self.progress = SlewProgress(angle=self.slew_angle, rate=0.0)
        else:
            self.follow(elapsed)

    def set_phase(self, time: float) -> None:
        """Set the phase at ``time`` (s)."""
        elapsed = time - self.start_time - self.slew_start
        self.phase = SlewPhase.SLEWING
        if elapsed < -sampling.TIME_ROUNDING:
            self.phase = SlewPhase.WAITING
        elif elapsed >= self.duration - sampling.TIME_ROUNDING:
            self.phase = SlewPhase.HOLDING

    def set_attitude(self, time: float) -> None:
        """Set attitude and angular velocity of the reference at ``time`` (s)."""
        self.proceed(time)
        turn = from_rotation_vector(self.progress.angle * self.eigenaxis)
        self.reference.reference_quaternion = multiply(self.start_quaternion, turn)
        self.reference.reference_angular_velocity = self.progress.rate * self.eigenaxis

    def refer(self, time: float, period: float) -> None:
        """Set the reference at ``time`` (s); its acceleration applies until the next sample, a ``period`` (s) later."""
        self.set_phase(time)
        self.proceed(time + period)
        rate_later = self.progress.rate
        self.set_attitude(time)
        acceleration = 0.0
        if period > 0.0:
            acceleration = (rate_later - self.progress.rate) / period
        self.reference.reference_angular_acceleration = acceleration * self.eigenaxis

    def initialize(self) -> None:
        self.begin(self.start_time, self.sample_period)

    def begin(self, time: float, period: float) -> None:
        """Plan the turn at ``time`` (s), which becomes the start of all times, if both attitudes are valid;
        ``period`` is in s.
        """
        self.phase = SlewPhase.NO_ATTITUDE
        self.reference.reference_quaternion = vector(0.0, 0.0, 0.0, 0.0)
        if not (is_attitude(self.estimated_quaternion) and is_attitude(self.target_quaternion)):
            return
        self.start_time = time
        self.start_quaternion = normalise(self.estimated_quaternion)
        turn = to_rotation_vector(difference(self.start_quaternion, normalise(self.target_quaternion)))
        self.slew_angle = norm(turn)
        self.eigenaxis = vector(0.0, 0.0, 0.0)
        if self.slew_angle > 0.0:
            self.eigenaxis = turn / self.slew_angle
        self.plan()
        self.refer(time, period)

    def step(self, t: float, h: float) -> None:
        period = self.sample_period
        if period <= 0.0:
            period = h
        if self.phase == SlewPhase.NO_ATTITUDE:
            self.begin(t + h, period)
        else:
            self.refer(t + h, period)
