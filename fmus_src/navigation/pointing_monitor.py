"""Monitor of a satellite's pointing accuracy, which ends the simulation."""

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, landing, robot, sampling
from ..kernel.functions import atan2
from ..mathlib.attitude.quaternion import difference, to_reference, to_rotation_vector
from ..mathlib.vectors import cross, dot, norm


class PointingMonitor(Block):
    """Monitor of attitude errors relative to reference and target; ends the simulation after sufficient pointing.

    half_cone is the angle between the boresight and the boresight of the reference attitude; knowledge_error is the
    rotation from the true to the estimated attitude. The satellite is pointing while pointing_error is within
    angle_limit and the angular velocity within rate_limit. settling_time is the start of the present pointing interval,
    or the present time outside such an interval; finished becomes true after hold_time of pointing.

    Frame: body.

    Assumes the true motion as input.

    See docs/systems/satellite_pointing.md.
    """

    default_step = 0.125

    target_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="target attitude quaternion from body to inertial, scalar first"
    )
    angle_limit = Parameter(
        4.84813681109536e-5,
        unit="rad",
        minimum=0.0,
        description="largest pointing error for which the attitude counts as pointing",
    )
    rate_limit = Parameter(
        1e-5, unit="rad/s", minimum=0.0, description="largest angular rate for which the attitude counts as pointing"
    )
    hold_time = Parameter(
        60.0, unit="s", minimum=0.0, description="duration of uninterrupted pointing after which the simulation ends"
    )
    boresight = Parameter(
        [0.0, 0.0, 1.0],
        unit="1",
        frame="body",
        description="boresight whose deviation is half_cone, normalised by the block",
    )
    quaternion = robot.QUATERNION.input("true attitude quaternion from body to inertial, scalar first")
    angular_velocity = body.ANGULAR_VELOCITY.input("true angular velocity of the body relative to the inertial frame")
    reference_quaternion = robot.PLANNED_QUATERNION.input(
        "reference attitude quaternion from body to inertial, scalar first"
    )
    estimated_quaternion = robot.QUATERNION.input()
    attitude_error = body.ROTATION.output("rotation vector from the reference to the true attitude", direct=True)
    pointing_error = Output(
        0.0, unit="rad", direct=True, description="rotation angle from the target to the true attitude"
    )
    half_cone = Output(
        0.0,
        unit="rad",
        direct=True,
        description="angle between the boresight in the true and in the reference attitude",
    )
    knowledge_error = body.ROTATION.output("rotation vector from the true to the estimated attitude", direct=True)
    rate = Output(0.0, unit="rad/s", direct=True, description="magnitude of the true angular velocity")
    settling_time = Output(
        0.0,
        unit="s",
        direct=True,
        description="time from the start of the simulation to the start of the current pointing interval",
    )
    finished = landing.FINISHED.output(direct=True)
    start_time = sampling.START_TIME.state()
    pointing = State(False, description="true: pointing error and angular rate within their limits")

    def initialize(self) -> None:
        self.compare(self.start_time)

    def compare(self, time: float) -> None:
        """Compare the true motion at ``time`` (s) with reference and target."""
        self.attitude_error = to_rotation_vector(difference(self.reference_quaternion, self.quaternion))
        self.pointing_error = norm(to_rotation_vector(difference(self.target_quaternion, self.quaternion)))
        self.knowledge_error = to_rotation_vector(difference(self.quaternion, self.estimated_quaternion))
        aim_inertial = to_reference(self.quaternion, self.boresight)
        reference_aim_inertial = to_reference(self.reference_quaternion, self.boresight)
        self.half_cone = atan2(
            norm(cross(aim_inertial, reference_aim_inertial)), dot(aim_inertial, reference_aim_inertial)
        )
        self.rate = norm(self.angular_velocity)
        within = self.pointing_error <= self.angle_limit and self.rate <= self.rate_limit
        if not (within and self.pointing):
            self.settling_time = time - self.start_time
        self.pointing = within
        if within and time - self.start_time - self.settling_time >= self.hold_time:
            self.finished = True

    def step(self, t: float, h: float) -> None:
        self.compare(t + h)
