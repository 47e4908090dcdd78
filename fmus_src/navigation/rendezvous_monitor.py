"""Monitor of an approach: errors of the true motion relative to the plan."""

from ..block import Block, Output, Parameter
from ..interfaces.ports import body, inertial, robot
from ..kernel.enumerations import Enumeration, member
from ..kernel.functions import atan2
from ..mathlib.attitude.quaternion import difference, to_rodrigues, to_rotation_vector
from ..mathlib.vectors import Vector3, cross, dot, norm
from ..units import deg


class ClosingStart(Enumeration):
    """Position of the robot relative to the approach cone at the start of closing."""

    AWAITED = member("closing not begun")
    WITHIN_CONE = member("within the cone")
    OUTSIDE_CONE = member("outside the cone")
    NO_DIRECTION = member("direction undefined: object at rest, or robot at its centre")


class RendezvousMonitor(Block):
    """Monitor of relative position, range and attitude errors against the plan, with modified Rodrigues parameters.

    position_error is the planned minus the true relative position. Closing begins when the range first falls to
    closing_range; the robot shall then be in a cone with its apex at the object's centre and its axis opposite to the
    object's velocity.

    Frames: inertial; body for attitude errors.

    See docs/systems/robot_rendezvous.md.
    """

    default_step = 0.125

    cone_half_angle = Parameter(
        deg(60.0),
        unit="rad",
        minimum=0.0,
        maximum=deg(180.0),
        description="half-angle of the approach cone at the object's centre",
    )
    closing_range = Parameter(
        501.0, unit="m", minimum=0.0, description="distance from the robot to the object at which closing begins"
    )
    robot_position = inertial.POSITION.input("true position of the robot's centre of mass")
    target_position = inertial.POSITION.input("true position of the object's centre of mass")
    target_velocity = inertial.VELOCITY.input("true velocity of the object's centre of mass")
    quaternion = robot.QUATERNION.input("true attitude quaternion from body to inertial, scalar first")
    planned_relative_position = inertial.POSITION.input("planned position of the object relative to the robot")
    planned_quaternion = robot.PLANNED_QUATERNION.input()
    position_error = inertial.POSITION.output(
        "planned minus true position of the object relative to the robot",
        direct=("robot_position", "target_position", "planned_relative_position"),
    )
    range = robot.RANGE.output(direct=("robot_position", "target_position"))
    range_error = Output(
        0.0,
        unit="m",
        direct=("robot_position", "target_position", "planned_relative_position"),
        description="true minus planned distance from the robot to the object's centre",
    )
    attitude_error = body.ROTATION.output(
        "rotation vector from the planned to the true attitude of the robot",
        direct=("quaternion", "planned_quaternion"),
    )
    attitude_error_angle = Output(
        0.0,
        unit="rad",
        direct=("quaternion", "planned_quaternion"),
        description="rotation angle from the planned to the true attitude of the robot",
    )
    rodrigues = Output(
        [0.0, 0.0, 0.0],
        unit="1",
        direct=("quaternion",),
        description="modified Rodrigues parameters of the attitude: rotation axis times tan(angle/4)",
    )

    cone_angle = Output(
        0.0,
        unit="rad",
        direct=("robot_position", "target_position", "target_velocity"),
        description=(
            "angle at the object's centre between its reversed velocity and the direction to the robot; 0: undefined"
        ),
    )
    closing_start = Output(ClosingStart, direct=("robot_position", "target_position", "target_velocity"))

    def initialize(self) -> None:
        self.closing_start = ClosingStart.AWAITED
        self.compare()

    def compare(self) -> None:
        """Compare the true motion with the plan."""
        relative = self.target_position - self.robot_position
        self.position_error = self.planned_relative_position - relative
        self.range = norm(relative)
        self.check_cone(relative)
        self.range_error = self.range - norm(self.planned_relative_position)
        self.attitude_error = to_rotation_vector(difference(self.planned_quaternion, self.quaternion))
        self.attitude_error_angle = norm(self.attitude_error)
        self.rodrigues = to_rodrigues(self.quaternion)

    def check_cone(self, relative: Vector3) -> None:
        """Set cone_angle for the robot's position (m, inertial) relative to the object, and latch closing_start."""
        self.cone_angle = atan2(norm(cross(relative, self.target_velocity)), dot(relative, self.target_velocity))
        if self.closing_start != ClosingStart.AWAITED or self.range > self.closing_range:
            return
        self.closing_start = ClosingStart.OUTSIDE_CONE
        if self.range <= 0.0 or norm(self.target_velocity) <= 0.0:
            self.closing_start = ClosingStart.NO_DIRECTION
        elif self.cone_angle <= self.cone_half_angle:
            self.closing_start = ClosingStart.WITHIN_CONE

    def step(self, t: float, h: float) -> None:
        self.compare()
