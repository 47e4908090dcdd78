"""Laser range finders that measure relative position."""

from ..interfaces.ports import inertial, robot, sampling
from ..mathlib.rng import normals
from ..mathlib.vectors import norm
from .random_sensor import RandomSensor


class LaserRanger(RandomSensor):
    """Laser ranger that measures the vector from a robot to an object, with white errors.

        ρ_m = r_target - r_robot + σ n

    The standard deviation σ per inertial axis is far_sigma at true ranges from near_range on and near_sigma at shorter
    ranges. The first sample is at the start. Random numbers depend on seed, stream and sample number only.

    Frame: inertial.

    Assumes that all three components of the vector to the object's centre are measured from any side.

    Source: Somov, Butyrin, Somov and Somova. See docs/systems/robot_rendezvous.md.
    """

    default_step = 0.125

    far_sigma = robot.FAR_SIGMA.parameter(
        description="error of measured relative position beyond near_range, 1 sigma per axis", minimum=0.0
    )
    near_sigma = robot.NEAR_SIGMA.parameter(
        description="error of measured relative position within near_range, 1 sigma per axis", minimum=0.0
    )
    near_range = robot.NEAR_RANGE.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(1.0)
    seed, stream = sampling.random_stream()
    robot_position = inertial.POSITION.input("true position of the robot's centre of mass")
    target_position = inertial.POSITION.input("true position of the object's centre of mass")
    relative_position = inertial.POSITION.output("measured position of the object relative to the robot", direct=True)
    range = robot.RANGE.output("measured distance from the robot to the object", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample."""
        true = self.target_position - self.robot_position
        sigma = self.far_sigma
        if norm(true) < self.near_range:
            sigma = self.near_sigma
        error = normals(self.generator)
        self.relative_position = true + sigma * error
        self.range = norm(self.relative_position)
        self.sample_count = self.sample_count + 1
