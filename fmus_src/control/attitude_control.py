"""Torque demand from the error of attitude and angular velocity."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..interfaces.ports.robot import ControlLaw
from ..kernel.enumerations import Enumeration, member
from ..mathlib.attitude.quaternion import quaternion, to_body
from ..mathlib.lead import advance_lead, lead_output, tustin_lead
from ..mathlib.vectors import Vector3, cross, dot, is_finite, vector


class AttitudeControlStatus(Enumeration):
    """Age of the torque."""

    GOOD = member("good")
    NOT_FINITE = member("last inputs not finite, torque held")


class AttitudeControl(Block):
    """Torque for the gyros: what the planned turn needs, what couples the axes, and a correction.

    torque = w x G + J (C ep + (C wp) x w - m) - jets: angular velocity w = C wp + rate_error, C the rotation
    from the plan's body axes to the true ones, wp and ep planned; w and G = J w + gyro_momentum of the first term
    are those of the middle of the sample_period that follows. With feed_forward, jets = jet_torque +
    J disturbance, else 0. law 0 (the paper's): m = attitude_error through a lead compensator
    gain (lead s + 1)/(lag s + 1), discretised by Tustin's rule at sample_period. law 1: m = w0^2 attitude_error
    + 2 damping w0 rate_error with the natural frequency w0. The torque is held until the next sample. Inputs that
    are not finite leave it as it is.
    Frame: body. Equations, gains and margins: docs/systems/robot_rendezvous.md.
    Source: Somov, Butyrin, Somov and Somova, see there; m has the opposite sign there.
    Assumes small errors, and inertia as declared.
    """

    default_step = 0.125

    law = Parameter(ControlLaw, start=ControlLaw.PROPORTIONAL_DERIVATIVE)
    inertia = Parameter([812.0, 587.0, 910.0], unit="kg.m2", minimum=1e-3, description="of the robot, about x, y, z")
    lead_gain = Parameter(0.16, minimum=0.0, description="of the lead at rest, 1/s2")
    lead_time = Parameter(5.0, unit="s", minimum=0.0, description="lead")
    lag_time = Parameter(0.417, unit="s", minimum=1e-6, description="lag")
    natural_frequency = Parameter(1.0, unit="rad/s", minimum=0.0, description="of law 1")
    damping = Parameter(0.9, unit="1", minimum=0.0, description="of law 1")
    feed_forward = Parameter(True, description="take jet_torque and disturbance off")
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.25, "between ticks; 0: every communication point")
    attitude_error = body.ROTATION.input("from planned to true: axis times sine of the angle")
    rate_error = body.ANGULAR_VELOCITY.input("true angular velocity less the planned")
    planned_angular_velocity = Input([0.0, 0.0, 0.0], unit="rad/s", frame="body of the plan", description="now")
    planned_angular_acceleration = Input(
        [0.0, 0.0, 0.0], unit="rad/s2", frame="body of the plan", description="half a sample_period from now"
    )
    gyro_momentum = body.ANGULAR_MOMENTUM.input("of the gyro cluster")
    jet_torque = body.TORQUE.input("of the jets from now on")
    disturbance = body.ANGULAR_ACCELERATION.input("angular acceleration by neither gyros nor jet_torque")
    torque_command = body.TORQUE.output("torque on the body wanted from the gyros", direct=True)
    status = Output(AttitudeControlStatus, direct=True)
    period = State(0.0, unit="s", description="to the next tick")
    lead_state = body.ROTATION.state("of the lead compensator")

    def initialize(self) -> None:
        self.period = self.sample_period
        self.command()

    def correction(self) -> Vector3:
        """Return the correction to the angular acceleration (rad/s2), to be subtracted; move the lead to the next
        tick."""
        if self.law == ControlLaw.LEAD:
            law = tustin_lead(self.lead_gain, self.lead_time, self.lag_time, self.period)
            m = lead_output(law, self.lead_state, self.attitude_error)
            self.lead_state = advance_lead(law, self.lead_state, self.attitude_error)
            return m
        w = self.natural_frequency
        return w * (w * self.attitude_error + 2.0 * self.damping * self.rate_error)

    def to_true_axes(self, v: Vector3) -> Vector3:
        """Return a vector of the plan's body axes in the true ones."""
        square = dot(self.attitude_error, self.attitude_error)
        if square > 1.0:
            square = 1.0  # the sine of an angle; angles beyond 90 deg look smaller
        scalar = math.sqrt(0.5 * (1.0 + math.sqrt(1.0 - square)))
        return to_body(quaternion(scalar, self.attitude_error / (2.0 * scalar)), v)

    def finite(self) -> bool:
        """Return True if all inputs are finite."""
        errors = is_finite(self.attitude_error) and is_finite(self.rate_error)
        plan = is_finite(self.planned_angular_velocity) and is_finite(self.planned_angular_acceleration)
        known = is_finite(self.gyro_momentum) and is_finite(self.jet_torque) and is_finite(self.disturbance)
        return errors and plan and known

    def command(self) -> None:
        """Command a new torque."""
        if not self.finite():
            self.status = AttitudeControlStatus.NOT_FINITE
            return
        self.status = AttitudeControlStatus.GOOD
        half = 0.5 * self.period
        planned = self.to_true_axes(self.planned_angular_velocity)
        wanted = self.to_true_axes(self.planned_angular_acceleration)
        m = self.correction()
        jets = vector(0.0, 0.0, 0.0)
        if self.feed_forward:
            jets = self.jet_torque + self.inertia * self.disturbance
        rate = planned + self.rate_error
        wanted = wanted + cross(planned, rate) - m
        momentum = self.inertia * rate + self.gyro_momentum
        # half a period later: the momentum in axes of the turning body, and its angular velocity
        momentum = momentum + half * (jets - cross(rate, momentum))
        rate = rate + half * wanted
        self.torque_command = cross(rate, momentum) + self.inertia * wanted - jets

    def step(self, t: float, h: float) -> None:
        self.period = self.sample_period
        if self.period <= 0.0:
            self.period = h
        self.command()
