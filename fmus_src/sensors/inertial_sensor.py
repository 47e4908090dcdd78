"""Accelerometers that measure increments of integrated specific force."""

import math

from ..block import Block, Parameter, State
from ..interfaces.ports import landing, sampling
from ..mathlib.estimation.sensor_errors import add_cross
from ..mathlib.rng import normals, seed_streams
from ..mathlib.vectors import vector


class InertialSensor(Block):
    """Three accelerometers that give the integrated specific force in landing-site axes.

    With the true increment Δv since the last sample, a time T earlier:

        Δv_m = (1 + w ×) (1 + diag(k)) Δv + b T + σ sqrt(T) n

    Bias b, scale factors k and misalignment w (an attitude error, rad) are drawn per axis at the start and then
    constant; σ is velocity_random_walk. The start gives no increment and does not count as a sample. Random numbers
    depend on seed, stream and sample number only.

    Frame: landing site.

    Assumes accelerometers at the centre of mass, and a constant attitude error.

    Source: Groves 2013, section 4.4 (error model of inertial sensors). See docs/systems/lunar_landing.md.
    """

    bias_sigma = landing.BIAS_SIGMA.parameter(description="constant bias of each accelerometer, 1 sigma")
    scale_factor_sigma = landing.SCALE_FACTOR_SIGMA.parameter(
        description="constant scale factor error of each accelerometer, 1 sigma"
    )
    velocity_random_walk = landing.VELOCITY_RANDOM_WALK.parameter(
        description="velocity random walk of each accelerometer, m/s per square root of s, 1 sigma"
    )
    attitude_sigma = Parameter(
        3.490658503988659e-4,
        unit="rad",
        minimum=0.0,
        description="constant attitude error of the accelerometer triad, 1 sigma per axis",
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.1)
    seed, stream = sampling.random_stream()
    sensed_velocity = landing.VELOCITY.input("true time integral of specific force since the start")
    velocity_increment = landing.VELOCITY.output(
        "measured time integral of specific force between the last two samples", direct=True
    )
    sample_count = sampling.SAMPLE_COUNT.output(
        "number of samples with a velocity increment since the start; a change signals a new sample"
    )
    generator = sampling.GENERATOR.state()
    bias = landing.ACCELERATION.state("constant bias of measured specific force")
    scale_factor = landing.DIRECTION.state("constant scale factor errors of measured specific force", start=[0.0] * 3)
    misalignment = State(
        [0.0] * 3,
        unit="rad",
        frame="landing site",
        description="rotation vector of the constant attitude error of the accelerometers",
    )
    last_sensed = landing.VELOCITY.state("true time integral of specific force at the last sample")
    last_time = State(0.0, unit="s", description="time of the last sample")
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        x = normals(self.generator)  # for one axis: bias, scale factor, misalignment
        y = normals(self.generator)
        z = normals(self.generator)
        self.bias = self.bias_sigma * vector(x[0], y[0], z[0])
        self.scale_factor = self.scale_factor_sigma * vector(x[1], y[1], z[1])
        self.misalignment = self.attitude_sigma * vector(x[2], y[2], z[2])
        self.last_sensed = self.sensed_velocity
        self.last_time = self.start_time

    def step(self, t: float, h: float) -> None:
        elapsed = t + h - self.last_time
        walk = self.velocity_random_walk * math.sqrt(abs(elapsed))
        s = (vector(1.0, 1.0, 1.0) + self.scale_factor) * (self.sensed_velocity - self.last_sensed)
        turned = add_cross(s, self.misalignment, s)
        error = normals(self.generator)
        self.velocity_increment = turned + elapsed * self.bias + walk * error
        self.last_sensed = self.sensed_velocity
        self.last_time = t + h
        self.sample_count = self.sample_count + 1
