"""Interface of observers of the orbital attitude, which estimate angles and rates from roll, pitch and gyro samples."""

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
    """Status of the estimate."""

    GOOD = member("good")
    HELD = member("no new sample")
    NOT_FINITE = member("not finite")
    YAW_LIMITED = member("yaw at its bound")
    NO_GAIN = member("no gain")
    NOT_POSITIVE = member("variance not positive")


class AttitudeObserver(OrbitalBody, interface=True):
    """Observer of roll, yaw, pitch and angular velocity without a measurement of yaw.

    Yaw affects the roll rate only by -ω_0 ψ, through the rotation of the orbital frame. At each sample an observer
    receives roll, pitch and angular velocity, and the pulses of the previous sample period. The first estimate is the
    first sample with yaw 0. Without new finite samples of both sensors an observer propagates the estimate by the
    equations of motion. All observers of the slot have the same parameters; jets and inertia have the values known on
    board.

    An observer defines `begin`, which may compute gains, and `observe`, which sets the estimate from the sample, the
    previous sample and the pulses between them.

    Frames: orbital; body.

    Assumes a circular orbit.

    Source: Lapin, thesis, chapter 3.1. See docs/systems/orbital_attitude.md.
    """

    yaw_pole = Parameter(
        0.1, unit="1/s", minimum=1e-6, description="decay rate of the yaw error of a full-order observer"
    )
    measured_pole = Parameter(
        1.0,
        unit="1/s",
        minimum=1e-6,
        description="decay rate of the errors of measured quantities of a full-order observer",
    )
    reduced_yaw_pole = Parameter(
        0.1, unit="1/s", minimum=1e-6, description="decay rate of the yaw error of a reduced-order observer"
    )
    largest_yaw = Parameter(
        0.9, unit="rad", minimum=0.0, description="largest magnitude of the estimated yaw; ignored by the Kalman filter"
    )
    vertical_sigma = Parameter(
        deg(0.001),
        unit="rad",
        minimum=1e-12,
        description="error of measured roll and pitch assumed by the Kalman filter, 1 sigma",
    )
    gyro_sigma = Parameter(
        1.7453292519943296e-06,
        unit="rad/s",
        minimum=1e-12,
        description="error of measured angular velocity assumed by the Kalman filter, 1 sigma per axis",
    )
    gyro_bias_sigma = Parameter(
        4.84813681109536e-09,
        unit="rad/s",
        minimum=1e-12,
        description="gyro bias assumed by the Kalman filter, 1 sigma per axis",
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="sample period of the observer", minimum=1e-3)
    measured_roll = body.MEASURED_ROLL.input()
    measured_pitch = body.MEASURED_PITCH.input()
    vertical_count = Input(
        0, description="number of roll and pitch samples since the start; a change signals a new sample"
    )
    measured_angular_velocity = body.ANGULAR_VELOCITY.input(
        "measured angular velocity of the body relative to the inertial frame"
    )
    gyro_count = Input(0, description="number of gyro samples since the start; a change signals a new sample")
    fired_pulses = body.PULSES.input("pulse lengths of the jets in the previous sample period, signed as the torque")
    held_torque = body.TORQUE.input("torque in addition to the pulses, over the previous sample period")
    true_angles = Input(
        [0.0, 0.0, 0.0],
        unit="rad",
        description="true roll, yaw and pitch relative to the orbital frame, used by the ideal observer only",
    )
    true_angular_velocity = body.ANGULAR_VELOCITY.input(
        "true angular velocity relative to the inertial frame, used by the ideal observer only"
    )
    estimated_angles = body.ESTIMATED_ANGLES.output(direct=True)
    estimated_angular_velocity = body.ANGULAR_VELOCITY.output(
        "estimated angular velocity of the body relative to the inertial frame", direct=True
    )
    estimated_gyro_bias = body.ANGULAR_VELOCITY.output("estimated bias of the gyros; 0: not estimated", direct=True)
    yaw_sigma = Output(0.0, unit="rad", direct=True, description="standard deviation of the estimated yaw; 0: unknown")
    status = Output(ObserverStatus, direct=True)
    estimate = State(AttitudeState, description="estimate at the last sample")
    last_roll = State(0.0, unit="rad", description="roll measured at the previous sample")
    last_pitch = State(0.0, unit="rad", description="pitch measured at the previous sample")
    last_rates = body.ANGULAR_VELOCITY.state("angular velocity measured at the previous sample")
    vertical_counted = State(0, description="vertical_count of the last sample used")
    gyro_counted = State(0, description="gyro_count of the last sample used")
    ticks = State(0, description="number of samples since the start")
    usable = State(True, description="true: observer gains computed")

    def begin(self) -> bool:
        """Compute gains from the parameters; return True if they exist."""
        return True

    def observe(self) -> None:
        """Set the estimate for the present sample."""

    def mean_torque(self, pulses: Vector3) -> Vector3:
        """Return the mean torque (N m, body) over the sample period of ``pulses`` (s) and the constant torque."""
        return self.jet_torque * pulses / self.sample_period + self.held_torque

    def propagate_estimate(self, split: bool) -> AttitudeState:
        """Return the previous estimate propagated over a sample period: with ``split`` pulse by pulse, otherwise
        under the mean torque.
        """
        if split:
            return self.fire(self.estimate, self.fired_pulses, self.held_torque, self.sample_period, math.inf)
        torque = self.mean_torque(self.fired_pulses)
        return runge_kutta_4(self.derivatives, 0.0, self.estimate, self.sample_period, torque)

    def take_measured(self, yaw: float) -> None:
        """Set the estimate to measured roll, pitch and rates with an estimated yaw (rad)."""
        self.estimate = AttitudeState(
            angles=vector(self.measured_roll, yaw, self.measured_pitch), angular_velocity=self.measured_angular_velocity
        )

    def finite(self) -> bool:
        """Return True if the sample is finite."""
        angles = math.isfinite(self.measured_roll) and math.isfinite(self.measured_pitch)
        return angles and is_finite(self.measured_angular_velocity)

    def update_status(self) -> None:
        """Set the status according to the sample."""
        self.status = ObserverStatus.GOOD
        if not self.finite():
            self.status = ObserverStatus.NOT_FINITE
        elif self.vertical_count == self.vertical_counted or self.gyro_count == self.gyro_counted:
            self.status = ObserverStatus.HELD
        if not self.usable:
            self.status = ObserverStatus.NO_GAIN

    def remember(self) -> None:
        """Store the sample as the previous one."""
        self.last_roll = self.measured_roll
        self.last_pitch = self.measured_pitch
        self.last_rates = self.measured_angular_velocity
        self.vertical_counted = self.vertical_count
        self.gyro_counted = self.gyro_count

    def coast(self) -> None:
        """Propagate the estimate without a sample."""
        self.estimate = self.propagate_estimate(True)

    def bound(self) -> None:
        """Limit yaw to largest_yaw."""
        angles = self.estimate.angles
        yaw = clip(angles.y, -self.largest_yaw, self.largest_yaw)
        if yaw != angles.y:
            self.status = ObserverStatus.YAW_LIMITED
            self.estimate = replace(self.estimate, angles=vector(angles.x, yaw, angles.z))

    def publish(self) -> None:
        """Output the estimate."""
        self.bound()
        self.estimated_angles = self.estimate.angles
        self.estimated_angular_velocity = self.estimate.angular_velocity

    def initialize(self) -> None:
        self.usable = self.invert_inertia()
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
        self.update_status()
        if self.status == ObserverStatus.GOOD:
            self.observe()
            self.remember()
        elif self.usable:
            self.coast()
        self.publish()
