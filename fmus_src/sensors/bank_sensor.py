"""Sensor of the bank angle."""

from ..block import Parameter
from ..interfaces.ports import entry, sampling
from ..mathlib.rng import normal
from .random_sensor import RandomSensor


class BankSensor(RandomSensor):
    """Bank sensor with a bias and white normal errors.

        γ_m = γ + bias + sigma n

    The first sample is at the start. Random numbers depend on seed, stream and sample number only.

    Assumes errors independent of the motion.

    See docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad", minimum=0.0, description="white noise of the measured bank angle, 1 sigma")
    bias = Parameter(0.0, unit="rad", description="constant error of the measured bank angle")
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    bank = entry.BANK.input("true bank angle of the capsule")
    measured_bank = entry.BANK.output("measured bank angle of the capsule", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()

    def measure(self) -> None:
        """Take a sample."""
        error = normal(self.generator)
        self.measured_bank = self.bank + self.bias + self.sigma * error
        self.sample_count = self.sample_count + 1
