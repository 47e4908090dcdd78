"""Navigation with correlated errors, like the errors of a filter."""

import math

from ..block import Parameter, State
from ..interfaces.navigation import Navigation
from ..interfaces.ports import landing, sampling
from ..kernel.functions import exp, expm1
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import vector


class ColouredNavigation(Navigation):
    """True position and velocity with first-order Gauss-Markov and white errors per axis.

        e^+ = f e + σ sqrt(1 - f^2) n    f = exp(-h/correlation_time)    error = e + white_share σ n

    The block gives guidance an estimate with the error magnitude and bandwidth of a filter, without a filter. The
    process starts in its stationary state; errors of position and velocity are independent. Sensors are not used.
    Random numbers depend on seed, stream and the number of the communication point only.

    Frame: landing site.

    Assumes errors independent of the motion and between axes.

    Source: Gillespie 1996 (exact updating formula of the Ornstein-Uhlenbeck process).
    """

    position_sigma = landing.POSITION_SIGMA.parameter(
        description="Gauss-Markov error of the estimated position, 1 sigma per axis"
    )
    velocity_sigma = landing.VELOCITY_SIGMA.parameter(
        0.1, "Gauss-Markov error of the estimated velocity, 1 sigma per axis"
    )
    correlation_time = Parameter(
        10.0, unit="s", minimum=1e-3, description="correlation time of the Gauss-Markov errors"
    )
    white_share = Parameter(
        0.3,
        unit="1",
        minimum=0.0,
        description="standard deviation of the white errors over that of the Gauss-Markov errors",
    )
    seed, stream = sampling.random_stream()
    generator = sampling.GENERATOR.state()
    wandering = State(
        [0.0] * 6, frozen=True, description="Gauss-Markov errors of position and velocity, in units of their sigmas"
    )

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
        """Set the estimate to the true motion plus errors."""
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
