"""Attitude control by gyros: torque from errors of attitude and angular velocity."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..interfaces.ports.robot import ControlLaw
from ..kernel.enumerations import Enumeration, member
from ..mathlib.attitude.quaternion import quaternion, to_body
from ..mathlib.lead import advance_lead, lead_output, tustin_lead
from ..mathlib.vectors import Vector3, cross, dot, is_finite, vector


class AttitudeControlStatus(Enumeration):
    """Status of the torque command."""

    GOOD = member("good")
    NOT_FINITE = member("last inputs not finite, torque held")


class AttitudeControl(Block):
    """Torque of the gyros: feedforward of the planned turn, gyroscopic decoupling, and a correction of errors.

    With the rotation C from planned to true body axes, planned rate ω_p and acceleration ε_p:

        M = ω × G + J (C ε_p + (C ω_p) × ω - u) - M_jets    ω = C ω_p + rate_error

    In the first term ω and G = J ω + gyro_momentum are predicted for the middle of the next sample_period. M_jets is
    jet_torque + J disturbance with feed_forward, else 0.

    law 0: u is the output of a lead compensator for e = attitude_error, discretised by Tustin's rule at sample_period:

        u = k (t_1 s + 1)/(t_2 s + 1) e

    law 1, with natural_frequency and damping:

        u = ω_0^2 attitude_error + 2 ζ ω_0 rate_error

    The torque is held until the next sample; inputs that are not finite leave it unchanged.

    Frame: body.

    Assumes small errors and a known inertia.

    Source: Somov, Butyrin, Somov and Somova, with the sign of u corrected. See docs/theory/rendezvous.md.
    """

    default_step = 0.125

    law = Parameter(
        ControlLaw, start=ControlLaw.PROPORTIONAL_DERIVATIVE, description="control law of the attitude error"
    )
    inertia = Parameter(
        [812.0, 587.0, 910.0],
        unit="kg.m2",
        minimum=1e-3,
        description="principal moments of inertia of the robot about x, y and z",
    )
    lead_gain = Parameter(0.16, minimum=0.0, description="static gain of the lead compensator, 1/s2")
    lead_time = Parameter(5.0, unit="s", minimum=0.0, description="time constant of the lead compensator's zero")
    lag_time = Parameter(0.417, unit="s", minimum=1e-6, description="time constant of the lead compensator's pole")
    natural_frequency = Parameter(
        1.0, unit="rad/s", minimum=0.0, description="natural frequency of the closed attitude loop with the PD law"
    )
    damping = Parameter(
        0.9, unit="1", minimum=0.0, description="damping ratio of the closed attitude loop with the PD law"
    )
    feed_forward = Parameter(True, description="true: jet_torque and disturbance compensated by feedforward")
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.25, "sample period of the control; 0: a sample at every communication point"
    )
    attitude_error = body.ROTATION.input(
        "error of the attitude relative to the plan: rotation axis times sine of the angle"
    )
    rate_error = body.ANGULAR_VELOCITY.input("actual minus planned angular velocity")
    planned_angular_velocity = Input(
        [0.0, 0.0, 0.0],
        unit="rad/s",
        frame="planned body",
        description="planned angular velocity relative to the inertial frame",
    )
    planned_angular_acceleration = Input(
        [0.0, 0.0, 0.0],
        unit="rad/s2",
        frame="planned body",
        description="planned angular acceleration half a sample_period ahead",
    )
    gyro_momentum = body.ANGULAR_MOMENTUM.input("angular momentum of the gyro cluster")
    jet_torque = body.TORQUE.input("torque of the jets until the next sample")
    disturbance = body.ANGULAR_ACCELERATION.input("angular acceleration that neither gyros nor jet_torque cause")
    torque_command = body.TORQUE.output("commanded torque of the gyro cluster on the body", direct=True)
    status = Output(AttitudeControlStatus, direct=True)
    period = State(0.0, unit="s", description="time to the next control sample")
    lead_state = body.ROTATION.state("internal state of the lead compensator per axis")

    def initialize(self) -> None:
        self.period = self.sample_period
        self.command()

    def correction(self) -> Vector3:
        """Return the correction to subtract from the angular acceleration (rad/s2), and advance the compensator."""
        if self.law == ControlLaw.LEAD:
            law = tustin_lead(self.lead_gain, self.lead_time, self.lag_time, self.period)
            m = lead_output(law, self.lead_state, self.attitude_error)
            self.lead_state = advance_lead(law, self.lead_state, self.attitude_error)
            return m
        w = self.natural_frequency
        return w * (w * self.attitude_error + 2.0 * self.damping * self.rate_error)

    def to_true_axes(self, v: Vector3) -> Vector3:
        """Return a vector in planned body axes transformed to the true body axes."""
        square = dot(self.attitude_error, self.attitude_error)
        if square > 1.0:
            square = 1.0  # the error is the sine of an angle, so angles beyond 90 deg are taken as smaller ones
        scalar = math.sqrt(0.5 * (1.0 + math.sqrt(1.0 - square)))
        return to_body(quaternion(scalar, self.attitude_error / (2.0 * scalar)), v)

    def finite(self) -> bool:
        """Return True if all inputs are finite."""
        errors = is_finite(self.attitude_error) and is_finite(self.rate_error)
        plan = is_finite(self.planned_angular_velocity) and is_finite(self.planned_angular_acceleration)
        known = is_finite(self.gyro_momentum) and is_finite(self.jet_torque) and is_finite(self.disturbance)
        return errors and plan and known

    def command(self) -> None:
        """Compute a new torque command."""
        if not self.finite():
            self.status = AttitudeControlStatus.NOT_FINITE
            return
        self.status = AttitudeControlStatus.GOOD
        half = 0.5 * self.period
        planned = self.to_true_axes(self.planned_angular_velocity)
        acceleration = self.to_true_axes(self.planned_angular_acceleration)
        m = self.correction()
        jets = vector(0.0, 0.0, 0.0)
        if self.feed_forward:
            jets = self.jet_torque + self.inertia * self.disturbance
        rate = planned + self.rate_error
        acceleration = acceleration + cross(planned, rate) - m
        momentum = self.inertia * rate + self.gyro_momentum
        # angular momentum in the axes of the turning body, and angular velocity, half a period later
        momentum = momentum + half * (jets - cross(rate, momentum))
        rate = rate + half * acceleration
        self.torque_command = cross(rate, momentum) + self.inertia * acceleration - jets

    def step(self, t: float, h: float) -> None:
        self.period = self.sample_period
        if self.period <= 0.0:
            self.period = h
        self.command()
