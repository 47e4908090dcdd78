"""The slot of observers of the orbital attitude: from roll, pitch and rates measured to all angles and rates."""

import math

from ..block import Input, Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.enumerations import Enumeration, member
from ..kernel.integrators import runge_kutta_4
from ..kernel.records import replace
from ..mathlib.orbits.attitude import AttitudeState
from ..mathlib.vectors import Vector3, clip, is_finite, vector
from ..models.orbital_body import OrbitalBody
from ..units import deg


class ObserverStatus(Enumeration):
    """Basis of the estimate."""

    GOOD = member("good")
    HELD = member("no new sample")
    NOT_FINITE = member("not finite")
    YAW_LIMITED = member("yaw at its bound")
    NO_GAIN = member("no gain")
    NOT_POSITIVE = member("variance not positive")


class AttitudeObserver(OrbitalBody, interface=True):
    """Estimates roll, yaw, pitch and angular velocity where yaw is not measured.

    Yaw acts on the roll rate through the orbit's turn only, by -w0 yaw. At each tick an observer is given a sample of
    roll, pitch and angular velocity, and what the jets did over the tick that has passed. It starts from the first
    sample with yaw 0. A tick without a new sample of both sensors, or with one that is not finite, carries the estimate
    on by the observer's own equations of motion. The parameters are those that any observer of the slot may need, so
    that one set of them serves all; the jets and the inertia are those known on board.

    An observer writes `begin`, which may make gains, and `observe`, which sets angles_now and rates_now from the sample
    (roll, pitch, rates), those of the tick before and the pulses between. Frames: orbital, body.
    Equations: docs/systems/orbital_attitude.md. Source: Lapin, thesis, chapter 3.1.
    Assumes a circular orbit, and inertia and jets as known on board.
    """

    yaw_pole = Parameter(0.1, unit="1/s", minimum=1e-6, description="decay of a full observer's error of yaw")
    measured_pole = Parameter(1.0, unit="1/s", minimum=1e-6, description="decay of its errors of what is measured")
    reduced_yaw_pole = Parameter(
        0.1, unit="1/s", minimum=1e-6, description="decay of a reduced observer's error of yaw"
    )
    largest_yaw = Parameter(0.9, unit="rad", minimum=0.0, description="bound of the estimated yaw, but for a filter")
    vertical_sigma = Parameter(
        deg(0.001),
        unit="rad",
        minimum=1e-12,
        description="of roll and pitch measured, 1 sigma, for a filter",
    )
    gyro_sigma = Parameter(
        1.7453292519943296e-06, unit="rad/s", minimum=1e-12, description="of a rate measured, 1 sigma, for a filter"
    )
    gyro_bias_sigma = Parameter(
        4.84813681109536e-09, unit="rad/s", minimum=1e-12, description="of a gyro's bias, 1 sigma, for a filter"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="tick", minimum=1e-3)
    measured_roll = body.MEASURED_ROLL.input()
    measured_pitch = body.MEASURED_PITCH.input()
    vertical_count = Input(0, description="samples of roll and pitch so far; a change tells a new one")
    measured_angular_velocity = body.ANGULAR_VELOCITY.input()
    gyro_count = Input(0, description="samples of the gyros so far; a change tells a new one")
    fired_pulses = body.PULSES.input("pulses of the tick that has passed, with their sign")
    held_torque = body.TORQUE.input("torque beside the pulses over that tick")
    true_angles = Input([0.0, 0.0, 0.0], unit="rad", description="for the observer that is told")
    true_angular_velocity = body.ANGULAR_VELOCITY.input("likewise, absolute")
    estimated_angles = body.ESTIMATED_ANGLES.output(direct=True)
    estimated_angular_velocity = body.ANGULAR_VELOCITY.output(direct=True)
    estimated_gyro_bias = body.ANGULAR_VELOCITY.output("bias of the gyros; 0 where it is not sought", direct=True)
    yaw_sigma = Output(0.0, unit="rad", direct=True, description="of the estimated yaw, 1 sigma; 0 where there is none")
    status = Output(ObserverStatus, direct=True)
    estimate = State(AttitudeState, description="estimate of now")
    last_roll = State(0.0, unit="rad", description="roll measured at the tick before")
    last_pitch = State(0.0, unit="rad", description="pitch measured at the tick before")
    last_rates = body.ANGULAR_VELOCITY.state("rates measured at the tick before")
    vertical_counted = State(0, description="vertical_count of the last sample")
    gyro_counted = State(0, description="gyro_count of the last sample")
    ticks = State(0, description="ticks since the start")
    usable = State(True, description="the gain could be made")

    def begin(self) -> bool:
        """Make what the observer needs from the parameters; whether that could be done."""
        return True

    def observe(self) -> None:
        """Set the estimate for the present sample."""

    def mean_torque(self, pulses: Vector3) -> Vector3:
        """Return the mean torque (N m, body) over the tick."""
        return self.jet_torque * pulses / self.sample_period + self.held_torque

    def carry(self, split: bool) -> AttitudeState:
        """Propagate the estimate of a tick ago, under its pulses: each one as it was, or all in the mean."""
        if split:
            return self.fire(self.estimate, self.fired_pulses, self.held_torque, self.sample_period, math.inf)
        torque = self.mean_torque(self.fired_pulses)
        return runge_kutta_4(self.derivatives, 0.0, self.estimate, self.sample_period, torque)

    def take_measured(self, yaw: float) -> None:
        """Take roll, pitch and rates as measured, with an estimated yaw (rad)."""
        self.estimate = AttitudeState(
            angles=vector(self.measured_roll, yaw, self.measured_pitch), angular_velocity=self.measured_angular_velocity
        )

    def finite(self) -> bool:
        """Return True if the sample is finite."""
        angles = math.isfinite(self.measured_roll) and math.isfinite(self.measured_pitch)
        return angles and is_finite(self.measured_angular_velocity)

    def judge(self) -> None:
        """Set the status from the sample."""
        self.status = ObserverStatus.GOOD
        if not self.finite():
            self.status = ObserverStatus.NOT_FINITE
        elif self.vertical_count == self.vertical_counted or self.gyro_count == self.gyro_counted:
            self.status = ObserverStatus.HELD
        if not self.usable:
            self.status = ObserverStatus.NO_GAIN

    def remember(self) -> None:
        """Keep the sample for the next tick."""
        self.last_roll = self.measured_roll
        self.last_pitch = self.measured_pitch
        self.last_rates = self.measured_angular_velocity
        self.vertical_counted = self.vertical_count
        self.gyro_counted = self.gyro_count

    def coast(self) -> None:
        """Set the estimate without a sample."""
        self.estimate = self.carry(True)

    def bound(self) -> None:
        """Keep yaw within largest_yaw."""
        angles = self.estimate.angles
        yaw = clip(angles.y, -self.largest_yaw, self.largest_yaw)
        if yaw != angles.y:
            self.status = ObserverStatus.YAW_LIMITED
            self.estimate = replace(self.estimate, angles=vector(angles.x, yaw, angles.z))

    def publish(self) -> None:
        """Put the estimate out."""
        self.bound()
        self.estimated_angles = self.estimate.angles
        self.estimated_angular_velocity = self.estimate.angular_velocity

    def initialize(self) -> None:
        self.usable = self.weigh()
        if self.usable:
            self.usable = self.begin()
        self.status = ObserverStatus.GOOD
        if not self.finite():
            self.status = ObserverStatus.NOT_FINITE
        else:
            self.take_measured(0.0)
            self.remember()
        if not self.usable:
            self.status = ObserverStatus.NO_GAIN
        self.publish()

    def step(self, t: float, h: float) -> None:
        self.ticks = self.ticks + 1
        self.judge()
        if self.status == ObserverStatus.GOOD:
            self.observe()
            self.remember()
        elif self.usable:
            self.coast()
        self.publish()
