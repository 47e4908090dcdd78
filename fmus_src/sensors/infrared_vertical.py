"""Roll and pitch from an infrared vertical."""

import math

from ..block import Block, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.functions import exp
from ..mathlib.rng import normals, seed_streams
from ..mathlib.vectors import vector


class InfraredVertical(Block):
    """Roll and pitch against the horizon, each with a bias and a normal error; yaw is not seen.

    measured = true + bias + sigma n. The errors n are white, or with a correlation_time those of a first-order
    Gauss-Markov process with the same sigma, which is what real horizons do. The first sample is at the start; which
    numbers a flight uses depends on seed, stream and the sample's number only.
    Assumes a horizon that is alike all around. Errors are ours: docs/systems/orbital_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad", minimum=0.0, description="error, 1 sigma per angle")
    bias = Parameter([0.0, 0.0], unit="rad", description="constant error of roll and pitch")
    correlation_time = Parameter(0.0, unit="s", minimum=0.0, description="of the errors; 0: white")
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    angles = body.ANGLES.input("true roll, yaw, pitch")
    measured_roll = body.MEASURED_ROLL.output("measured roll", direct=True)
    measured_pitch = body.MEASURED_PITCH.output("measured pitch", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()
    error = State([0.0, 0.0], unit="1", frozen=True, description="errors of roll and pitch, in sigmas")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure(0.0)

    def measure(self, kept: float) -> None:
        """Take a sample, whose errors keep a share of the last one's."""
        numbers = normals(self.generator)
        self.error = kept * self.error + math.sqrt(1.0 - kept * kept) * vector(numbers.x, numbers.y)
        self.measured_roll = self.angles.x + self.bias.x + self.sigma * self.error.x
        self.measured_pitch = self.angles.z + self.bias.y + self.sigma * self.error.y
        self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        retained = 0.0
        if self.correlation_time > 0.0:
            period = self.sample_period
            if period <= 0.0:
                period = h
            retained = exp(-period / self.correlation_time)
        self.measure(retained)
