"""Navigation from noisy position and velocity fixes with a Kalman filter."""

import math

from ..block import Parameter, State
from ..interfaces.navigation import Navigation
from ..interfaces.ports import landing, sampling
from ..kernel.matrices import block, identity, zeros
from ..mathlib.estimation.kalman import predict, update
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import Vector3, vector

# The states of the filter.
POSITION = block(0, 3)
VELOCITY = block(3, 3)


class NoisyNavigation(Navigation):
    """Position and velocity fixes with white errors at separate rates, filtered by a six-state Kalman filter.

    Between fixes the filter is propagated with the true mean specific force, constant gravity and white noise of
    density process_noise on each axis:

        v^+ = v + (f + g) h    r^+ = r + v h + (f + g) h^2/2

    Fixes are due at multiples of their periods after the start, with at most one of each kind at a communication point.
    The initial estimate is the truth with errors of first_position_sigma and first_velocity_sigma. A sigma of 0
    switches its sensor off; with both off the estimate is the truth. The sensor inputs of the slot and central gravity
    are not used. In free flight the specific force is 0.

    Frame: landing site.

    Assumes a flat Moon, specific force measured without error, and steps no longer than both periods.

    Source: Bar-Shalom, Li and Kirubarajan 2001, section 6.2.2 (discretised white acceleration noise).
    """

    gravity = landing.GRAVITY.parameter(
        description="constant gravitational acceleration along -z in the filter's model"
    )
    position_period = Parameter(1.0, unit="s", minimum=1e-3, description="time between two position fixes")
    position_sigma = landing.POSITION_SIGMA.parameter(
        0.0, "white error of a position fix, 1 sigma per axis; 0: no position fixes"
    )
    velocity_period = Parameter(0.2, unit="s", minimum=1e-3, description="time between two velocity fixes")
    velocity_sigma = landing.VELOCITY_SIGMA.parameter(
        0.0, "white error of a velocity fix, 1 sigma per axis; 0: no velocity fixes"
    )
    first_position_sigma = Navigation.first_position_sigma.with_start(0.0)
    first_velocity_sigma = Navigation.first_velocity_sigma.with_start(0.0)
    process_noise = Parameter(
        1e-6, unit="m2/s3", minimum=0.0, description="spectral density of the filter's white acceleration noise"
    )
    seed, stream = sampling.random_stream()
    innovation_square = sampling.INNOVATION_SQUARE.output(
        "normalised innovation squared of the last component of a fix", direct=True
    )
    generator = sampling.GENERATOR.state()
    estimate = State(
        zeros(6, 1), description="estimated position (m) and velocity (m/s) of the lander, landing-site axes"
    )
    covariance = State(
        zeros(6, 6),
        frozen=True,
        description="covariance matrix of estimated position and velocity, SI units (landing site frame)",
    )
    start_time = sampling.START_TIME.state()
    position_fixes = State(0, description="number of position fixes since the start")
    velocity_fixes = State(0, description="number of velocity fixes since the start")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        for i in range(3):
            error = normal(self.generator)
            self.estimate[i, 0] = self.position[i] + self.first_position_sigma * error
            error = normal(self.generator)
            self.estimate[3 + i, 0] = self.velocity[i] + self.first_velocity_sigma * error
        self.covariance[POSITION, POSITION] = self.first_position_sigma * self.first_position_sigma * identity(3)
        self.covariance[VELOCITY, VELOCITY] = self.first_velocity_sigma * self.first_velocity_sigma * identity(3)
        if self.position_sigma > 0.0 or self.velocity_sigma > 0.0:
            self.publish()
        else:
            self.pass_truth()

    def move(self, h: float) -> None:
        """Propagate the estimate by h (s)."""
        f = identity(6)
        f[POSITION, VELOCITY] = h * identity(3)
        q = zeros(6, 6)
        q[POSITION, POSITION] = self.process_noise * h * h * h / 3.0 * identity(3)
        q[POSITION, VELOCITY] = self.process_noise * h * h / 2.0 * identity(3)
        q[VELOCITY, POSITION] = q[POSITION, VELOCITY]
        q[VELOCITY, VELOCITY] = self.process_noise * h * identity(3)
        self.estimate = f @ self.estimate
        self.covariance = predict(self.covariance, f, q)
        force = self.specific_force
        if self.free_flight:
            force = vector(0.0, 0.0, 0.0)
        acceleration = vector(force.x, force.y, force.z - self.gravity)
        self.estimate[POSITION, 0] += 0.5 * acceleration * h * h
        self.estimate[VELOCITY, 0] += acceleration * h

    def fix(self, first: int, truth: Vector3, sigma: float) -> None:
        """Measure three states from index ``first`` on, with standard deviation sigma, and update the estimate."""
        for i in range(3):
            row = zeros(1, 6)
            row[0, first + i] = 1.0
            error = normal(self.generator)
            self.estimate, self.covariance, self.innovation_square = update(
                self.estimate, self.covariance, row, sigma * sigma, truth[i] + sigma * error
            )
        self.sample_count = self.sample_count + 1

    def publish(self) -> None:
        """Output estimate and standard deviations."""
        self.estimated_position = self.estimate[POSITION, 0]
        self.estimated_velocity = self.estimate[VELOCITY, 0]
        sigmas = [0.0] * 6
        for i in range(6):
            sigmas[i] = math.sqrt(self.covariance[i, i])
        self.position_estimate_sigma = vector(*sigmas[0:3])
        self.velocity_estimate_sigma = vector(*sigmas[3:6])
        k = 0
        for i in range(6):
            for j in range(i, 6):
                self.estimate_covariance[k] = self.covariance[i, j]
                k = k + 1

    def pass_truth(self) -> None:
        """Set the estimate to the true motion, for both sensors switched off."""
        self.sample_count = self.sample_count + 1
        self.estimated_position = self.position
        self.estimated_velocity = self.velocity

    def step(self, t: float, h: float) -> None:
        if self.position_sigma > 0.0 or self.velocity_sigma > 0.0:
            self.move(h)
            elapsed = t + h - self.start_time
            if (
                self.position_sigma > 0.0
                and elapsed > (self.position_fixes + 1) * self.position_period - sampling.TIME_ROUNDING
            ):
                self.position_fixes = self.position_fixes + 1
                self.fix(0, self.position, self.position_sigma)
            if (
                self.velocity_sigma > 0.0
                and elapsed > (self.velocity_fixes + 1) * self.velocity_period - sampling.TIME_ROUNDING
            ):
                self.velocity_fixes = self.velocity_fixes + 1
                self.fix(3, self.velocity, self.velocity_sigma)
            self.publish()
        else:
            self.pass_truth()
