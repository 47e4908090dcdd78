"""Relative position from laser range finders."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.rng import normals, seed_streams
from ..mathlib.vectors import norm


class LaserRanger(Block):
    """Measures the vector from the robot to the object with errors that are new in every sample.

    Each inertial component has an independent normal error: far_sigma at a true range of near_range and
    beyond, near_sigma below. All three components are taken, as the ranges alone would not tell where the robot
    is. The first sample is at the start. Which normal numbers a flight uses depends on seed, stream and
    the sample's number only. Source: Somov, Butyrin, Somov and Somova, see docs/systems/robot_rendezvous.md.
    Assumes that the object's centre is what is measured, from any side.
    """

    default_step = 0.125

    far_sigma = Parameter(0.025, unit="m", minimum=0.0, description="error far away, 1 sigma per axis")
    near_sigma = Parameter(0.01, unit="m", minimum=0.0, description="error nearby, 1 sigma per axis")
    near_range = Parameter(300.0, unit="m", minimum=0.0, description="nearby is below this range")
    sample_period = Parameter(1.0, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    robot_position = Input([0.0, 0.0, 0.0], unit="m", frame="inertial", description="true position of the robot")
    target_position = Input([0.0, 0.0, 0.0], unit="m", frame="inertial", description="true position of the object")
    relative_position = Output(
        [0.0, 0.0, 0.0], unit="m", frame="inertial", direct=True, description="measured, from the robot to the object"
    )
    range = Output(0.0, unit="m", direct=True, description="length of relative_position")
    sample_count = Output(0, description="samples taken; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

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

    def step(self, t: float, h: float) -> None:
        self.measure()
