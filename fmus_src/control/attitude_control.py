"""From the error of attitude and angular velocity to the torque wanted."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.lead import advance_lead, lead_output, tustin_lead
from ..mathlib.quaternion import to_body
from ..mathlib.rigid_body import total_momentum
from ..mathlib.vectors import cross

LEAD = 0
GOOD = 0
NOT_FINITE = 1


class AttitudeControl(Block):
    """Torque for the gyros: what the planned turn needs, what couples the axes, and a correction.

    torque = w x G + J (C ep + (C wp) x w - m) - jets: angular velocity w = C wp + rate_error, C the rotation
    from the plan's body axes to the true ones, wp and ep planned; w and G = J w + gyro_momentum of the first term
    are those of the middle of the sample_period that follows. With feed_forward, jets = jet_torque +
    J disturbance, else 0. law 0 (the paper's): m = attitude_error through a lead compensator
    gain (lead s + 1)/(lag s + 1), discretised by Tustin's rule at sample_period. law 1: m = w0^2 attitude_error
    + 2 damping w0 rate_error with the natural frequency w0. The torque is held until the next sample. Inputs that
    are not finite leave it as it is.
    Frame: body. Equations, gains and margins: docs/robot_rendezvous.md.
    Source: Somov, Butyrin, Somov and Somova, see there; m has the opposite sign there.
    """

    default_step = 0.125

    law = Parameter(1, minimum=0, maximum=1, description="0 lead compensator, 1 attitude and rate")
    inertia = Parameter([812.0, 587.0, 910.0], unit="kg.m2", minimum=1e-3, description="of the robot, about x, y, z")
    lead_gain = Parameter(0.16, minimum=0.0, description="of the lead at rest, 1/s2")
    lead_time = Parameter(5.0, unit="s", minimum=0.0, description="lead")
    lag_time = Parameter(0.417, unit="s", minimum=1e-6, description="lag")
    natural_frequency = Parameter(1.0, unit="rad/s", minimum=0.0, description="of law 1")
    damping = Parameter(0.9, unit="1", minimum=0.0, description="of law 1")
    feed_forward = Parameter(True, description="take jet_torque and disturbance off")
    sample_period = Parameter(0.25, unit="s", minimum=0.0, description="between ticks; 0: every communication point")
    attitude_error = Input(
        [0.0, 0.0, 0.0], unit="rad", frame="body", description="from planned to true: axis times sine of the angle"
    )
    rate_error = Input(
        [0.0, 0.0, 0.0], unit="rad/s", frame="body", description="true angular velocity less the planned"
    )
    planned_angular_velocity = Input([0.0, 0.0, 0.0], unit="rad/s", frame="body of the plan", description="now")
    planned_angular_acceleration = Input(
        [0.0, 0.0, 0.0], unit="rad/s2", frame="body of the plan", description="half a sample_period from now"
    )
    gyro_momentum = Input([0.0, 0.0, 0.0], unit="N.m.s", frame="body", description="of the gyro cluster")
    jet_torque = Input([0.0, 0.0, 0.0], unit="N.m", frame="body", description="of the jets from now on")
    disturbance = Input(
        [0.0, 0.0, 0.0], unit="rad/s2", frame="body", description="angular acceleration by neither gyros nor jet_torque"
    )
    torque_command = Output(
        [0.0, 0.0, 0.0], unit="N.m", frame="body", direct=True, description="torque on the body wanted from the gyros"
    )
    status = Output(0, minimum=0, maximum=1, direct=True, description="0 good, 1 last inputs not finite, torque held")
    period = State(0.0, unit="s", description="to the next tick")
    lead_state = State([0.0, 0.0, 0.0], unit="rad", frame="body", description="of the lead compensator")

    def initialize(self) -> None:
        self.period = self.sample_period
        self.command()

    def correction(self, m: list) -> None:
        """m[3] = what to take off the angular acceleration (rad/s2); moves the lead to the next tick."""
        if self.law == LEAD:
            law = [0.0] * 3
            tustin_lead(self.lead_gain, self.lead_time, self.lag_time, self.period, law)
            lead_output(law, self.lead_state, self.attitude_error, m)
            advance_lead(law, self.lead_state, self.attitude_error)
        else:
            w = self.natural_frequency
            for i in range(3):
                m[i] = w * (w * self.attitude_error[i] + 2.0 * self.damping * self.rate_error[i])

    def to_true_axes(self, v: list, result: list) -> None:
        """result = v, given in the plan's body axes, in the true ones."""
        e = [0.0] * 4
        square = 0.0
        for i in range(3):
            square = square + self.attitude_error[i] * self.attitude_error[i]
        if square > 1.0:
            square = 1.0  # the sine of an angle; angles beyond 90 deg look smaller
        e[0] = math.sqrt(0.5 * (1.0 + math.sqrt(1.0 - square)))
        for i in range(3):
            e[i + 1] = self.attitude_error[i] / (2.0 * e[0])
        to_body(e, v, result)

    def finite(self) -> bool:
        """Whether all inputs are."""
        fine = True
        for i in range(3):
            if not (math.isfinite(self.attitude_error[i]) and math.isfinite(self.rate_error[i])):
                fine = False
            if not (math.isfinite(self.planned_angular_velocity[i]) and math.isfinite(self.gyro_momentum[i])):
                fine = False
            if not (math.isfinite(self.planned_angular_acceleration[i]) and math.isfinite(self.jet_torque[i])):
                fine = False
            if not math.isfinite(self.disturbance[i]):
                fine = False
        return fine

    def command(self) -> None:
        """Command a new torque."""
        if not self.finite():
            self.status = NOT_FINITE
            return
        self.status = GOOD
        planned = [0.0] * 3
        wanted = [0.0] * 3
        turning = [0.0] * 3
        m = [0.0] * 3
        jets = [0.0] * 3
        rate = [0.0] * 3
        momentum = [0.0] * 3
        half = 0.5 * self.period
        self.to_true_axes(self.planned_angular_velocity, planned)
        self.to_true_axes(self.planned_angular_acceleration, wanted)
        self.correction(m)
        for i in range(3):
            rate[i] = planned[i] + self.rate_error[i]
            if self.feed_forward:
                jets[i] = self.jet_torque[i] + self.inertia[i] * self.disturbance[i]
        cross(planned, rate, turning)
        for i in range(3):
            wanted[i] = wanted[i] + turning[i] - m[i]
        # half a period later: the momentum as seen from the turning body, and its angular velocity
        total_momentum(self.inertia, rate, self.gyro_momentum, momentum)
        cross(rate, momentum, turning)
        for i in range(3):
            momentum[i] = momentum[i] + half * (jets[i] - turning[i])
            rate[i] = rate[i] + half * wanted[i]
        cross(rate, momentum, turning)
        for i in range(3):
            self.torque_command[i] = turning[i] + self.inertia[i] * wanted[i] - jets[i]

    def step(self, t: float, h: float) -> None:
        self.period = self.sample_period
        if self.period <= 0.0:
            self.period = h
        self.command()
