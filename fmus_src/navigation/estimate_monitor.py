"""Monitor of the consistency of an estimate's errors with its covariance."""

import math

from ..block import Block, Output
from ..interfaces.ports import landing
from ..kernel.matrices import inverse_quadratic_form, zeros
from ..mathlib.vectors import vector


class EstimateMonitor(Block):
    """Monitor of position and velocity errors relative to the estimate's covariance P.

        NEES = e^T P^-1 e

    The normalised estimation error squared (NEES) is chi-square distributed with six degrees of freedom if the errors e
    are normal with covariance P.

    Frame: landing site.

    Source: Bar-Shalom, Li and Kirubarajan 2001, section 5.4.2.
    """

    position = landing.POSITION.input("true position of the lander relative to the landing site")
    velocity = landing.VELOCITY.input("true velocity of the lander relative to the landing site")
    estimated_position = landing.POSITION.input("estimated position of the lander relative to the landing site")
    estimated_velocity = landing.VELOCITY.input("estimated velocity of the lander relative to the landing site")
    estimate_covariance = landing.ESTIMATE_COVARIANCE.input(
        "covariance of the errors of estimated position and velocity, SI units, upper triangle by rows (6 x 6)"
    )
    normalised_error_square = Output(
        0.0,
        unit="1",
        direct=True,
        description=(
            "normalised estimation error squared (NEES) of position and velocity; 0: covariance not positive definite"
        ),
    )
    position_error_ratio = landing.DIRECTION.output(
        "position error over its standard deviation per axis; 0: standard deviation 0",
        start=[0.0, 0.0, 0.0],
        direct=True,
    )
    velocity_error_ratio = landing.DIRECTION.output(
        "velocity error over its standard deviation per axis; 0: standard deviation 0",
        start=[0.0, 0.0, 0.0],
        direct=True,
    )

    def initialize(self) -> None:
        self.compare()

    def compare(self) -> None:
        """Compare the estimate with the true motion."""
        position_error = self.estimated_position - self.position
        velocity_error = self.estimated_velocity - self.velocity
        error = zeros(6, 1)
        error[0:3, 0] = position_error
        error[3:6, 0] = velocity_error
        covariance = zeros(6, 6)
        k = 0
        for i in range(6):
            for j in range(i, 6):
                covariance[j, i] = self.estimate_covariance[k]
                k = k + 1
        ratio = [0.0] * 6
        for i in range(6):
            variance = covariance[i, i]
            if variance > 0.0:
                ratio[i] = error[i, 0] / math.sqrt(variance)
        self.position_error_ratio = vector(*ratio[0:3])
        self.velocity_error_ratio = vector(*ratio[3:6])
        self.normalised_error_square = inverse_quadratic_form(covariance, error)
        if self.normalised_error_square < 0.0:
            self.normalised_error_square = 0.0

    def step(self, t: float, h: float) -> None:
        self.compare()
