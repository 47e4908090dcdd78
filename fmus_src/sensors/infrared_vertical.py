"""Infrared sensor of roll and pitch."""

import math

from ..block import Block, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.functions import exp
from ..mathlib.rng import normals, seed_streams
from ..mathlib.vectors import vector


class InfraredVertical(Block):
    """Infrared horizon sensor of roll and pitch with biases and normal errors; yaw is not measured.

        γ_m = γ + bias_1 + sigma n    θ_m = θ + bias_2 + sigma n

    The errors n are white or, with a correlation_time, a first-order Gauss-Markov process of the same sigma. The first
    sample is at the start. Random numbers depend on seed, stream and sample number only.

    Frame: orbital.

    Assumes a uniform horizon.

    See docs/systems/orbital_attitude.md.
    """

    default_step = 0.2

    sigma = Parameter(0.0, unit="rad", minimum=0.0, description="random error of measured roll and pitch, 1 sigma")
    bias = Parameter([0.0, 0.0], unit="rad", description="constant errors of measured roll and pitch")
    correlation_time = Parameter(
        0.0, unit="s", minimum=0.0, description="correlation time of the roll and pitch errors; 0: white noise"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    angles = body.ANGLES.input("true roll, yaw and pitch of the body relative to the orbital frame")
    measured_roll = body.MEASURED_ROLL.output("measured roll of the body relative to the orbital frame", direct=True)
    measured_pitch = body.MEASURED_PITCH.output("measured pitch of the body relative to the orbital frame", direct=True)
    sample_count = sampling.SAMPLE_COUNT.output()
    generator = sampling.GENERATOR.state()
    error = State(
        [0.0, 0.0], unit="1", frozen=True, description="current errors of measured roll and pitch, in units of sigma"
    )

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        self.measure(0.0)

    def measure(self, kept: float) -> None:
        """Take a sample, with errors correlated with the previous errors."""
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
