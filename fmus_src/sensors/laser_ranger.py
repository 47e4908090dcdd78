"""Relative position from laser range finders."""

from ..interfaces.ports import inertial, robot, sampling
from ..mathlib.rng import normals
from ..mathlib.vectors import norm
from .random_sensor import RandomSensor


class LaserRanger(RandomSensor):
    """Measures the vector from the robot to the object with errors that are new in every sample.

    Each inertial component has an independent normal error: far_sigma at a true range of near_range and
    beyond, near_sigma below. All three components are taken, as the ranges alone would not tell where the robot
    is. The first sample is at the start. Which normal numbers a flight uses depends on seed, stream and
    the sample's number only. Source: Somov, Butyrin, Somov and Somova, see docs/systems/robot_rendezvous.md.
    Assumes that the object's centre is what is measured, from any side.
    """

    default_step = 0.125

    far_sigma = robot.FAR_SIGMA.parameter(description="error far away, 1 sigma per axis", minimum=0.0)
    near_sigma = robot.NEAR_SIGMA.parameter(description="error nearby, 1 sigma per axis", minimum=0.0)
    near_range = robot.NEAR_RANGE.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(1.0)
    seed, stream = sampling.random_stream()
    robot_position = inertial.POSITION.input("true position of the robot")
    target_position = inertial.POSITION.input("true position of the object")
    relative_position = inertial.POSITION.output("measured, from the robot to the object", direct=True)
    range = robot.RANGE.output("length of relative_position", direct=True)
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
