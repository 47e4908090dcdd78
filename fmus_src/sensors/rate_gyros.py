"""Angular velocity from three rate gyros."""

from ..block import Parameter
from ..interfaces.ports import body, sampling
from ..mathlib.rng import normals, uniform
from ..mathlib.vectors import vector
from .random_sensor import RandomSensor


class RateGyros(RandomSensor):
    """Angular velocity about three axes, each with a bias and white normal errors.

    measured = true + bias + drawn bias + sigma n; the drawn bias is uniform within +- bias_limit per axis and constant
    over a flight. The first sample is at the start. Which numbers a flight uses depends on seed, stream and the
    sample's number only. Frame: body.
    Assumes gyros without scale factors or misalignment. Errors are ours: docs/systems/orbital_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad/s", minimum=0.0, description="error, 1 sigma per axis")
    bias = body.ANGULAR_VELOCITY.parameter(description="constant error beside the drawn one")
    bias_limit = Parameter(0.0, unit="rad/s", minimum=0.0, description="largest drawn bias per axis")
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    angular_velocity = body.ANGULAR_VELOCITY.input("true angular velocity, absolute")
    measured_angular_velocity = body.ANGULAR_VELOCITY.output("measured angular velocity, absolute", direct=True)
    true_bias = body.ANGULAR_VELOCITY.output("whole bias of this flight")
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()

    def draw_constants(self) -> None:
        x = uniform(self.generator)
        y = uniform(self.generator)
        z = uniform(self.generator)
        self.true_bias = self.bias + self.bias_limit * (2.0 * vector(x, y, z) - vector(1.0, 1.0, 1.0))

    def measure(self) -> None:
        """Take a sample."""
        numbers = normals(self.generator)
        self.measured_angular_velocity = self.angular_velocity + self.true_bias + self.sigma * numbers
        self.sample_count = self.sample_count + 1
