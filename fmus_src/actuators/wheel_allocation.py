"""Interface of wheel allocations, which convert the torque demanded of four reaction wheels into motor torques."""

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, sampling, satellite
from ..interfaces.ports.robot import LARGEST
from ..kernel.enumerations import Enumeration, member
from ..kernel.matrices import zeros
from ..mathlib.actuators.wheels import (
    WHEELS,
    body_torque,
    largest_size,
    null_direction,
    pseudo_inverse,
    unit_axes,
)
from ..mathlib.vectors import Vector4, all_below, vector


class WheelAllocationStatus(Enumeration):
    """Status of the last command."""

    GOOD = member("good")
    LIMITED = member("torque limited")
    NOT_FINITE = member("command not finite, motors off")
    NO_INVERSE = member("available wheels coplanar, motors off")


class WheelAllocation(Block, interface=True):
    """Motor torques of four reaction wheels for a torque on the body, with null motion of the wheel speeds.

    With unit spin axes as columns of A, motor torques u, null direction n and target change ΔΩ of the wheel speeds:

        -A u = torque_command    A n = 0    u_null = k_null J_s n n^T ΔΩ

    Null motion uses the motor torque that the command leaves. Torques beyond motor_torque_limit are scaled together.
    Unavailable wheels receive no torque; with one of them unavailable there is no null direction. An allocation defines
    `distribute`, which sets wheel_torques and speed_change.

    Frame: body.

    Assumes wheels at their declared axes.

    See docs/systems/satellite_pointing.md.
    """

    to_write = ("distribute",)

    default_step = 0.125

    wheel_axes = satellite.WHEEL_AXES.parameter()
    wheel_inertia = satellite.WHEEL_INERTIA.parameter()
    motor_torque_limit = satellite.MOTOR_TORQUE_LIMIT.parameter()
    available = Parameter([True] * 4, description="true for each wheel available to the allocation")
    null_gain = Parameter(
        0.02, unit="1/s", minimum=0.0, description="rate at which null motion brings the wheel speeds to their target"
    )
    null_speed = Parameter(
        100.0,
        unit="rad/s",
        description="wheel speed to which null motion leads at zero wheel momentum; ignored by the minimax allocation",
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.125, "sample period of the allocation; 0: a sample at every communication point"
    )
    torque_command = body.TORQUE.input("commanded torque of the wheels on the body")
    wheel_speeds = satellite.WHEEL_SPEEDS.input()
    motor_torques = satellite.MOTOR_TORQUES.output(direct=True)
    allocated_torque = body.TORQUE.output("torque on the body produced by motor_torques", direct=True)
    status = Output(WheelAllocationStatus, direct=True)
    axes = State(
        zeros(3, WHEELS),
        unit="1",
        frame="body",
        description="unit spin axes of the available wheels, one per column; 0 for unavailable wheels",
    )
    inverse_axes = State(
        zeros(WHEELS, 3), unit="1", description="pseudo-inverse of the matrix of spin axes, one row per wheel"
    )
    null = State(
        [0.0] * 4,
        unit="1",
        description="unit vector of motor torques that produce no torque on the body; 0: no such vector",
    )
    wheel_torques = State(
        [0.0] * 4, unit="N.m", description="motor torques that produce the commanded torque, without null motion"
    )
    speed_change = State([0.0] * 4, unit="rad/s", description="change of the wheel speeds to which null motion leads")
    invertible = State(False, description="true: spin axes of the available wheels span three axes")

    def distribute(self) -> None:
        """Set wheel_torques (N m) and speed_change (rad/s) for torque_command."""

    def initialize(self) -> None:
        self.axes = unit_axes(self.wheel_axes)
        for j in range(WHEELS):
            if not self.available[j]:
                self.axes[0:3, j] = vector(0.0, 0.0, 0.0)
        self.inverse_axes, self.invertible = pseudo_inverse(self.axes)
        self.null = null_direction(self.axes)
        self.allocate()

    def null_torque(self) -> Vector4:
        """Return the motor torques (N m) of the null motion towards ``speed_change``, within the remaining margins."""
        amount = 0.0
        for j in range(WHEELS):
            amount = amount + self.null[j] * self.speed_change[j]
        amount = self.null_gain * self.wheel_inertia * amount
        sign = 1.0
        if amount < 0.0:
            sign = -1.0
        for j in range(WHEELS):
            direction = sign * self.null[j]
            left = self.motor_torque_limit - self.wheel_torques[j]
            if direction < 0.0:
                left = self.motor_torque_limit + self.wheel_torques[j]
            if left < 0.0:
                left = 0.0
            if abs(amount * direction) > left:
                amount = sign * left / abs(direction)
        return amount * self.null

    def allocate(self) -> None:
        """Set the motor torques for the present command."""
        self.motor_torques = vector(0.0, 0.0, 0.0, 0.0)
        if not self.invertible:
            self.status = WheelAllocationStatus.NO_INVERSE
        elif not (all_below(self.torque_command, LARGEST) and all_below(self.wheel_speeds, LARGEST)):
            self.status = WheelAllocationStatus.NOT_FINITE
        else:
            self.status = WheelAllocationStatus.GOOD
            self.distribute()
            largest = largest_size(self.wheel_torques)
            if largest > self.motor_torque_limit:
                self.status = WheelAllocationStatus.LIMITED
                self.motor_torques = self.motor_torque_limit / largest * self.wheel_torques
            else:
                self.motor_torques = self.wheel_torques + self.null_torque()
        self.allocated_torque = body_torque(self.axes, self.motor_torques)

    def step(self, t: float, h: float) -> None:
        self.allocate()
