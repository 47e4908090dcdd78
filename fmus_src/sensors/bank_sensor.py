"""Bank from the navigation system."""

from ..block import Parameter
from ..interfaces.ports import entry, sampling
from ..mathlib.rng import normal
from .random_sensor import RandomSensor


class BankSensor(RandomSensor):
    """Bank with a bias and white normal errors: measured = true + bias + sigma n.

    The first sample is at the start. Which numbers a flight uses depends on seed, stream and the sample's number only.
    Assumes errors that do not depend on the motion. They are ours: docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad", minimum=0.0, description="error, 1 sigma")
    bias = Parameter(0.0, unit="rad", description="constant error")
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    bank = entry.BANK.input("true bank")
    measured_bank = entry.BANK.output("measured bank", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample."""
        error = normal(self.generator)
        self.measured_bank = self.bank + self.bias + self.sigma * error
        self.sample_count = self.sample_count + 1
