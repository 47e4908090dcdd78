"""How well an approach is flown: true motion against the plan."""

from ..block import Block, Output
from ..interfaces.ports import body, inertial, robot
from ..mathlib.attitude.quaternion import difference, to_rodrigues, to_rotation_vector
from ..mathlib.vectors import norm


class RendezvousMonitor(Block):
    """Errors of relative position, range and attitude against the plan, and the attitude as Rodrigues parameters.

    position_error is the planned less the true relative position: the robot's distance from its place
    beside the object. Frames: inertial; body for errors of attitude.
    Equations: docs/systems/robot_rendezvous.md.
    """

    default_step = 0.125

    robot_position = inertial.POSITION.input("true position of the robot")
    target_position = inertial.POSITION.input("true position of the object")
    quaternion = robot.QUATERNION.input("true attitude, body to inertial, scalar first")
    planned_relative_position = inertial.POSITION.input("from the robot to the object")
    planned_quaternion = robot.PLANNED_QUATERNION.input()
    position_error = inertial.POSITION.output(
        "of the robot from its planned place beside the object",
        direct=("robot_position", "target_position", "planned_relative_position"),
    )
    range = robot.RANGE.output(direct=("robot_position", "target_position"))
    range_error = Output(
        0.0,
        unit="m",
        direct=("robot_position", "target_position", "planned_relative_position"),
        description="range less the planned one",
    )
    attitude_error = body.ROTATION.output(
        "rotation vector from the planned to the true attitude", direct=("quaternion", "planned_quaternion")
    )
    attitude_error_angle = Output(
        0.0, unit="rad", direct=("quaternion", "planned_quaternion"), description="length of attitude_error"
    )
    rodrigues = Output(
        [0.0, 0.0, 0.0],
        unit="1",
        direct=("quaternion",),
        description="modified Rodrigues parameters of the attitude: axis times tan(angle/4)",
    )

    def initialize(self) -> None:
        self.compare()

    def compare(self) -> None:
        """Compare the true motion with the plan."""
        relative = self.target_position - self.robot_position
        self.position_error = self.planned_relative_position - relative
        self.range = norm(relative)
        self.range_error = self.range - norm(self.planned_relative_position)
        self.attitude_error = to_rotation_vector(difference(self.planned_quaternion, self.quaternion))
        self.attitude_error_angle = norm(self.attitude_error)
        self.rodrigues = to_rodrigues(self.quaternion)

    def step(self, t: float, h: float) -> None:
        self.compare()
