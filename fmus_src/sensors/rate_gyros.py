"""Three rate gyros that measure angular velocity."""

import math

from ..block import Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.enumerations import Enumeration, member
from ..kernel.matrices import zeros
from ..mathlib.estimation.sensor_errors import LATEST, make_room, next_markov, quantise, saturate
from ..mathlib.rng import normals, uniform
from ..mathlib.vectors import is_finite, norm, vector
from .random_sensor import RandomSensor


class RateGyrosStatus(Enumeration):
    """Status of the last sample."""

    GOOD = member("good")
    SATURATED = member("saturated")
    NOT_FINITE = member("sample not finite")


class RateGyros(RandomSensor):
    """Three rate gyros with scale factors, misalignment, bias, noise, bias instability, range, rounding and latency.

        ω_m = (1 + S) ω + bias + b + e + sigma n    b^+ = b + bias_walk sqrt(h) n

    ω_m is limited to ±range and rounded to a multiple of quantum. The random bias b is uniform within ±bias_limit per
    axis at the start and performs a random walk; a sample contains the mean of the biases before and after the step. An
    angle random walk of N rad/sqrt(s) corresponds to sigma = N/sqrt(sample_period). The bias instability e is a
    first-order Gauss-Markov process that starts in its stationary state. A sample arrives ``latency`` sample periods
    later. The first sample is at the start. Random numbers depend on seed, stream and sample number, and on whether a
    bias walk and a bias instability are present.

    Frame: body.

    Assumes errors independent of temperature.

    Source: Farrenkopf 1978; Crassidis and Junkins 2012, section 7.1; IEEE Std 952. Magnitudes:
    docs/systems/earth_pointing.md.
    """

    default_step = 0.2

    sigma = Parameter(
        0.0, unit="rad/s", minimum=0.0, description="white noise of measured angular velocity, 1 sigma per axis"
    )
    bias = body.ANGULAR_VELOCITY.parameter(
        description="constant bias of measured angular velocity, added to the random bias"
    )
    bias_limit = Parameter(
        0.0, unit="rad/s", minimum=0.0, description="largest magnitude of the random bias about each axis"
    )
    bias_walk = Parameter(
        0.0, minimum=0.0, description="rate random walk of the bias, rad/s per square root of s, 1 sigma per axis"
    )
    scale = Parameter(
        [0.0] * 9,
        unit="1",
        frame="body",
        columns=3,
        description="matrix S of scale factor errors (diagonal) and misalignments",
    )
    instability_sigma = Parameter(0.0, unit="rad/s", minimum=0.0, description="bias instability of each gyro, 1 sigma")
    instability_time = Parameter(300.0, unit="s", minimum=1e-3, description="correlation time of the bias instability")
    range = Parameter(
        0.0, unit="rad/s", minimum=0.0, description="largest magnitude of each measured component; 0: no limit"
    )
    quantum = Parameter(
        0.0, unit="rad/s", minimum=0.0, description="quantisation step of each measured component; 0: none"
    )
    latency = Parameter(0, minimum=0, maximum=LATEST, description="delay from measurement to output, in sample periods")
    sample_period = sampling.SAMPLE_PERIOD.parameter()
    seed, stream = sampling.random_stream()
    angular_velocity = body.ANGULAR_VELOCITY.input("true angular velocity of the body relative to the inertial frame")
    measured_angular_velocity = body.ANGULAR_VELOCITY.output(
        "measured angular velocity of the body relative to the inertial frame", direct=True
    )
    true_bias = body.ANGULAR_VELOCITY.output("true bias of measured angular velocity, without bias instability")
    sample_count = sampling.SAMPLE_COUNT.output()
    status = Output(RateGyrosStatus, direct=True)
    instability = body.ANGULAR_VELOCITY.state("current bias instability of measured angular velocity")
    samples = State(
        zeros(LATEST + 1, 3),
        unit="rad/s",
        frame="body",
        description="delayed samples of angular velocity, one per row, newest first",
    )
    measurements = State(0, description="number of measurements since the start, delayed ones included")
    has_scale = State(False, description="true: matrix S of scale factor errors and misalignments differs from 0")
    generator = sampling.GENERATOR.state()

    def draw_constants(self) -> None:
        x = uniform(self.generator)
        y = uniform(self.generator)
        z = uniform(self.generator)
        self.true_bias = self.bias + self.bias_limit * (2.0 * vector(x, y, z) - vector(1.0, 1.0, 1.0))
        if self.instability_sigma > 0.0:
            numbers = normals(self.generator)
            self.instability = self.instability_sigma * numbers
        for i in range(3):
            for j in range(3):
                if self.scale[i, j] != 0.0:
                    self.has_scale = True

    def walk(self, h: float) -> None:
        """Advance the biases by h (s), and take a sample."""
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
        w = self.angular_velocity
        if self.has_scale:
            w = w + self.scale @ w
        if self.instability_sigma > 0.0:
            w = w + self.instability
        y = w + self.true_bias + self.sigma * numbers
        self.status = RateGyrosStatus.GOOD
        if not is_finite(y):
            self.status = RateGyrosStatus.NOT_FINITE
        elif self.range > 0.0:
            within = saturate(y, self.range)
            if norm(within - y) > 0.0:
                self.status = RateGyrosStatus.SATURATED
            y = within
        if self.status != RateGyrosStatus.NOT_FINITE:
            y = quantise(y, self.quantum)
        make_room(self.samples, 3)
        self.samples[0, 0:3] = y
        self.measurements = self.measurements + 1
        if self.measurements > self.latency:
            self.measured_angular_velocity = self.samples[self.latency, 0:3]
            self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        period = self.sample_period
        if period <= 0.0:
            period = h
        if self.instability_sigma > 0.0:
            numbers = normals(self.generator)
            self.instability = next_markov(
                self.instability, period, self.instability_time, self.instability_sigma, numbers
            )
        self.walk(period)
