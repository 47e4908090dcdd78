"""Angular velocity from three rate gyros."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.rng import normals, seed_streams, uniform
from ..mathlib.vectors import vector


class RateGyros(Block):
    """Angular velocity about three axes, each with a bias and white normal errors.

    measured = true + bias + drawn bias + sigma n; the drawn bias is uniform within +- bias_limit per axis and constant
    over a flight. The first sample is at the start. Which numbers a flight uses depends on seed, stream and the
    sample's number only. Frame: body.
    Assumes gyros without scale factors or misalignment. Errors are ours: docs/systems/orbital_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad/s", minimum=0.0, description="error, 1 sigma per axis")
    bias = Parameter([0.0, 0.0, 0.0], unit="rad/s", frame="body", description="constant error beside the drawn one")
    bias_limit = Parameter(0.0, unit="rad/s", minimum=0.0, description="largest drawn bias per axis")
    sample_period = Parameter(0.2, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    angular_velocity = Input([0.0, 0.0, 0.0], unit="rad/s", frame="body", description="true angular velocity, absolute")
    measured_angular_velocity = Output(
        [0.0, 0.0, 0.0], unit="rad/s", frame="body", direct=True, description="measured angular velocity, absolute"
    )
    true_bias = Output([0.0, 0.0, 0.0], unit="rad/s", frame="body", description="whole bias of this flight")
    sample_count = Output(0, description="samples taken; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        x = uniform(self.generator)
        y = uniform(self.generator)
        z = uniform(self.generator)
        self.true_bias = self.bias + self.bias_limit * (2.0 * vector(x, y, z) - vector(1.0, 1.0, 1.0))
        self.measure()

    def measure(self) -> None:
        """Take a sample."""
        numbers = normals(self.generator)
        self.measured_angular_velocity = self.angular_velocity + self.true_bias + self.sigma * numbers
        self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        self.measure()
