"""Bank from the navigation system."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.rng import normal, seed_streams


class BankSensor(Block):
    """Bank with a bias and white normal errors: measured = true + bias + sigma n.

    The first sample is at the start. Which numbers a flight uses depends on seed, stream and the sample's number only.
    Assumes errors that do not depend on the motion. They are ours: docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad", minimum=0.0, description="error, 1 sigma")
    bias = Parameter(0.0, unit="rad", description="constant error")
    sample_period = Parameter(0.2, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    bank = Input(0.0, unit="rad", description="true bank")
    measured_bank = Output(0.0, unit="rad", direct=True, description="measured bank")
    sample_count = Output(0, description="samples taken; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure()

    def measure(self) -> None:
        """Take a sample."""
        error = normal(self.generator)
        self.measured_bank = self.bank + self.bias + self.sigma * error
        self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        self.measure()
