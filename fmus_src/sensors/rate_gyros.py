"""Angular velocity from three rate gyros."""

import math

from ..block import Parameter
from ..interfaces.ports import body, sampling
from ..mathlib.rng import normals, uniform
from ..mathlib.vectors import vector
from .random_sensor import RandomSensor


class RateGyros(RandomSensor):
    """Angular velocity about three axes, each with a bias and white normal errors.

    measured = true + bias + drawn bias + sigma n; the drawn bias is uniform within +- bias_limit per axis and constant
    over a flight, but for a random walk of bias_walk sqrt(h) n per sample, h (s) after the last one; measured is the
    bias in the middle between both. An angle random walk of s rad/sqrt(s) is sigma = s/sqrt(sample_period). The first
    sample is at the start. Which numbers a flight uses depends on seed, stream and the sample's number only, and on
    whether there is a walk. Frame: body. Source of the walks: Farrenkopf 1978; Crassidis and Junkins 2012, section 7.1.
    Assumes gyros without scale factors or misalignment. Errors are ours: docs/systems/orbital_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad/s", minimum=0.0, description="error, 1 sigma per axis")
    bias = body.ANGULAR_VELOCITY.parameter(description="constant error beside the drawn one")
    bias_limit = Parameter(0.0, unit="rad/s", minimum=0.0, description="largest drawn bias per axis")
    bias_walk = Parameter(0.0, minimum=0.0, description="random walk of the bias, rad/s per square root of s")
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    angular_velocity = body.ANGULAR_VELOCITY.input("true angular velocity, absolute")
    measured_angular_velocity = body.ANGULAR_VELOCITY.output("measured angular velocity, absolute", direct=True)
    true_bias = body.ANGULAR_VELOCITY.output("whole bias")
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()

    def draw_constants(self) -> None:
        x = uniform(self.generator)
        y = uniform(self.generator)
        z = uniform(self.generator)
        self.true_bias = self.bias + self.bias_limit * (2.0 * vector(x, y, z) - vector(1.0, 1.0, 1.0))

    def walk(self, h: float) -> None:
        """Let the bias walk for h (s), and measure."""
        if self.bias_walk > 0.0:
            numbers = normals(self.generator)
            change = self.bias_walk * math.sqrt(h) * numbers
            self.true_bias = self.true_bias + 0.5 * change
            self.measure()
            self.true_bias = self.true_bias + 0.5 * change
        else:
            self.measure()

    def measure(self) -> None:
        """Take a sample."""
        numbers = normals(self.generator)
        self.measured_angular_velocity = self.angular_velocity + self.true_bias + self.sigma * numbers
        self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        period = self.sample_period
        if period <= 0.0:
            period = h
        self.walk(period)
