"""A velocity sensor with noise."""

from perilune import Block, Input, Output, Parameter, State
from perilune.fmus_src.mathlib.rng import normals, seed_streams


class NoisyVelocity(Block):
    """Velocity sensor with white normal errors."""

    sigma = Parameter(0.1, unit="m/s", minimum=0.0, description="error, 1 sigma per axis")
    sample_period = Parameter(0.1, unit="s", minimum=0.0, description="between samples")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    velocity = Input([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="true velocity")
    measured_velocity = Output(
        [0.0, 0.0, 0.0], unit="m/s", frame="landing site", direct=True, description="measured velocity"
    )
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

    def measure(self) -> None:
        error = normals(self.generator)
        self.measured_velocity = self.velocity + self.sigma * error

    def step(self, t: float, h: float) -> None:
        self.measure()
