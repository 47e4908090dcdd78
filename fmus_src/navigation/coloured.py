"""Navigation whose errors wander, as a filter's do."""

import math

from ..block import Parameter, State
from ..interfaces.navigation import Navigation
from ..interfaces.ports import landing, sampling
from ..kernel.functions import exp, expm1
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import vector


class ColouredNavigation(Navigation):
    """The truth with errors of a first-order Gauss-Markov process and white ones, per axis.

    Position and velocity have errors of their own: e(t + h) = f e(t) + sigma sqrt(1 - f^2) n with
    f = exp(-h/correlation_time), which starts in its stationary state, and white_share sigma n besides, new at
    every communication point. So a guidance is tried against errors of a filter's size and pace, without one. Sensors
    are not used; errors of position do not follow from those of velocity. Which normal numbers a flight uses depends
    on seed, stream and the point's number only. Frame: landing site.
    Source: Gillespie 1996 (exact updating formula of the Ornstein-Uhlenbeck process).
    Assumes errors that do not depend on the motion, nor one axis on another.
    """

    position_sigma = landing.POSITION_SIGMA.parameter(description="wandering error, 1 sigma per axis")
    velocity_sigma = landing.VELOCITY_SIGMA.parameter(0.1, "wandering error, 1 sigma per axis")
    correlation_time = Parameter(10.0, unit="s", minimum=1e-3, description="after which 1/e of an error is left")
    white_share = Parameter(0.3, unit="1", minimum=0.0, description="white error over sigma")
    seed, stream = sampling.random_stream()
    generator = sampling.GENERATOR.state()
    wandering = State([0.0] * 6, frozen=True, description="errors of position and velocity over their sigmas")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        for i in range(6):
            self.wandering[i] = normal(self.generator)
        fraction = 1.0 + self.white_share * self.white_share
        position_sigma = math.sqrt(fraction) * self.position_sigma
        velocity_sigma = math.sqrt(fraction) * self.velocity_sigma
        self.position_estimate_sigma = vector(position_sigma, position_sigma, position_sigma)
        self.velocity_estimate_sigma = vector(velocity_sigma, velocity_sigma, velocity_sigma)
        k = 0
        for i in range(6):
            self.estimate_covariance[k] = fraction * self.position_sigma * self.position_sigma
            if i > 2:
                self.estimate_covariance[k] = fraction * self.velocity_sigma * self.velocity_sigma
            k = k + 6 - i
        self.measure()

    def measure(self) -> None:
        """Set the estimate from the truth and its errors."""
        errors = [0.0] * 6
        for i in range(6):
            error = normal(self.generator)
            errors[i] = self.wandering[i] + self.white_share * error
        self.estimated_position = self.position + self.position_sigma * vector(*errors[0:3])
        self.estimated_velocity = self.velocity + self.velocity_sigma * vector(*errors[3:6])
        self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        retained = exp(-h / self.correlation_time)
        fresh = math.sqrt(-expm1(-2.0 * h / self.correlation_time))
        for i in range(6):
            error = normal(self.generator)
            self.wandering[i] = retained * self.wandering[i] + fresh * error
        self.measure()
