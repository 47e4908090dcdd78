"""The slot of wheel allocation: from the demanded torque of four reaction wheels to the torques of their motors."""

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
    """Outcome of the last command."""

    GOOD = member("good")
    LIMITED = member("torque limited")
    NOT_FINITE = member("command not finite, motors off")
    NO_INVERSE = member("available wheels lie in a plane, motors off")


class WheelAllocation(Block, interface=True):
    """Motor torques of four reaction wheels that give the body a torque, and move their speeds to where they serve.

    torque_command is the torque that the wheels are to exert on the body, -A u with the unit spin axes as columns of A.
    An allocation writes `distribute`, which sets wheel_torques to torques u that give it, and speed_change to the
    wanted change of speeds. Of that its part along the null direction n, A n = 0, which does not turn the body, gets
    the torque null_gain wheel_inertia n n' speed_change as far as the motors have torque left. Where u is beyond
    motor_torque_limit it is scaled, which keeps its direction. Wheels that are not available get no torque; then
    there is no null direction.
    Equations: docs/systems/satellite_pointing.md. Assumes wheels that are where they are declared to be.
    """

    to_write = ("distribute",)

    default_step = 0.125

    wheel_axes = satellite.WHEEL_AXES.parameter()
    wheel_inertia = satellite.WHEEL_INERTIA.parameter()
    motor_torque_limit = satellite.MOTOR_TORQUE_LIMIT.parameter()
    available = Parameter([True] * 4, description="which wheels get torque")
    null_gain = Parameter(0.02, unit="1/s", minimum=0.0, description="rate at which null motion approaches its goal")
    null_speed = Parameter(
        100.0, unit="rad/s", description="of the wheels along the null direction, over four; not for every allocation"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.125, "allocation cycle; 0: every communication point")
    torque_command = body.TORQUE.input("torque wanted of the wheels on the body")
    wheel_speeds = satellite.WHEEL_SPEEDS.input()
    motor_torques = satellite.MOTOR_TORQUES.output(direct=True)
    allocated_torque = body.TORQUE.output("torque of motor_torques on the body", direct=True)
    status = Output(WheelAllocationStatus, direct=True)
    axes = State(zeros(3, WHEELS), unit="1", frame="body", description="unit spin axes of available wheels, by column")
    inverse_axes = State(zeros(WHEELS, 3), unit="1", description="A' (A A')^-1")
    null = State([0.0] * 4, unit="1", description="unit vector along which motor torques do not turn the body, or 0")
    wheel_torques = State([0.0] * 4, unit="N.m", description="torques without null motion")
    speed_change = State([0.0] * 4, unit="rad/s", description="wanted change of the wheels' speeds")
    invertible = State(False, description="any torque can be given")

    def distribute(self) -> None:
        """Set wheel_torques (N m) for torque_command, and speed_change (rad/s)."""

    def initialize(self) -> None:
        self.axes = unit_axes(self.wheel_axes)
        for j in range(WHEELS):
            if not self.available[j]:
                self.axes[0:3, j] = vector(0.0, 0.0, 0.0)
        self.inverse_axes, self.invertible = pseudo_inverse(self.axes)
        self.null = null_direction(self.axes)
        self.allocate()

    def null_torque(self) -> Vector4:
        """Return torque (N m) along the null direction, within the rest of every motor's limit."""
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
        """Set motor torques for the present command."""
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
