"""Accelerometers: increments of the integral of specific force."""

import math

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.rng import normal, normals, seed_streams
from ..mathlib.vectors import vector


class InertialSensor(Block):
    """Three accelerometers whose specific force, summed over a sample, is turned into the landing-site frame.

    With dv the true increment since the last sample, T (s) before:

        velocity_increment = dv + scale dv + misalignment x (dv + scale dv) + bias T + random walk

    Bias, scale factors and misalignment (rad, what is not known of the attitude) are drawn per axis
    at the start and stay; the random walk is velocity_random_walk sqrt(T) times a normal number per
    axis and sample. The start has no increment, so it is not counted. Which normal numbers a flight
    uses depends on seed, stream and the sample's number only, not on the sizes of the errors.
    Source: Groves 2013, section 4.4 (error model of inertial sensors).
    Assumes accelerometers at the centre of mass, and an attitude error that is constant over a flight.
    """

    bias_sigma = Parameter(1e-3, unit="m/s2", minimum=0.0, description="bias, 1 sigma per axis, constant")
    scale_factor_sigma = Parameter(
        3e-4, unit="1", minimum=0.0, description="relative error, 1 sigma per axis, constant"
    )
    velocity_random_walk = Parameter(1e-4, minimum=0.0, description="in m/s per square root of s, 1 sigma per axis")
    attitude_sigma = Parameter(
        3.490658503988659e-4, unit="rad", minimum=0.0, description="error of attitude, 1 sigma per axis, constant"
    )
    sample_period = Parameter(0.1, unit="s", minimum=0.0, description="between samples; 0: every communication point")
    seed = Parameter(1, minimum=0, description="random numbers: seed")
    stream = Parameter(0, minimum=0, description="random numbers: stream within the seed")
    sensed_velocity = Input(
        [0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="true integral of specific force"
    )
    velocity_increment = Output(
        [0.0, 0.0, 0.0],
        unit="m/s",
        frame="landing site",
        direct=True,
        description="measured integral of specific force between the last two samples",
    )
    sample_count = Output(0, description="samples with an increment; tells a new one from a held one")
    generator = State([0.0] * 6, frozen=True, description="random number generator")
    bias = State([0.0] * 3, unit="m/s2", frame="landing site", description="error of specific force")
    scale_factor = State([0.0] * 3, unit="1", frame="landing site", description="relative error of specific force")
    misalignment = State(
        [0.0] * 3, unit="rad", frame="landing site", description="rotation vector of the attitude error"
    )
    last_sensed = State([0.0] * 3, unit="m/s", frame="landing site", description="sensed_velocity at the last sample")
    last_time = State(0.0, unit="s", description="time of the last sample")
    start_time = State(0.0, unit="s", description="start of the flight")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        errors = [0.0] * 9
        for i in range(3):
            for kind in range(3):
                errors[3 * kind + i] = normal(self.generator)
        self.bias = self.bias_sigma * vector(*errors[0:3])
        self.scale_factor = self.scale_factor_sigma * vector(*errors[3:6])
        self.misalignment = self.attitude_sigma * vector(*errors[6:9])
        self.last_sensed = self.sensed_velocity
        self.last_time = self.start_time

    def step(self, t: float, h: float) -> None:
        elapsed = t + h - self.last_time
        walk = self.velocity_random_walk * math.sqrt(abs(elapsed))
        m = self.misalignment
        s = (vector(1.0, 1.0, 1.0) + self.scale_factor) * (self.sensed_velocity - self.last_sensed)
        turned = vector(
            s.x + m.y * s.z - m.z * s.y,
            s.y + m.z * s.x - m.x * s.z,
            s.z + m.x * s.y - m.y * s.x,
        )
        error = normals(self.generator)
        self.velocity_increment = turned + elapsed * self.bias + walk * error
        self.last_sensed = self.sensed_velocity
        self.last_time = t + h
        self.sample_count = self.sample_count + 1
