"""A block as a user writes it, with every integrator."""

from __future__ import annotations

from perilune import (
    Block,
    Forcing,
    Input,
    State,
    Translation,
    Vector3,
    cos,
    exp,
    norm,
    runge_kutta_4,
    runge_kutta_nystrom,
    simpson,
    sin,
    vector,
)


class Integrators(Block):
    """Two bodies about a centre of attraction, and a third under an acceleration over time."""

    thrust = Input([0.0, 0.0, 0.0], unit="m/s2", frame="inertial", description="of the first two bodies")
    first = State(Translation, description="by Kutta's method")
    second = State(Translation, description="by Nystrom's method")
    third = State(Translation, description="by Simpson's rule")

    def initialize(self) -> None:
        circle = Translation(position=vector(1.0, 0.0, 0.0), velocity=vector(0.0, 1.0, 0.0))
        self.first = circle
        self.second = circle
        self.third = circle

    def gravity(self, position: Vector3) -> Vector3:
        """Attraction (m/s2) of the centre, 1 at 1 m."""
        distance = norm(position)
        return -position / (distance * distance * distance)

    def derivatives(self, t: float, s: Translation, thrust: Vector3) -> Translation:
        """Rates."""
        return Translation(position=s.velocity, velocity=self.gravity(s.position) + cos(t) * thrust)

    def acceleration(self, t: float) -> Vector3:
        """Of the third body (m/s2)."""
        return vector(-cos(t), -sin(t), exp(-t))

    def step(self, t: float, h: float) -> None:
        self.first = runge_kutta_4(self.derivatives, t, self.first, h, self.thrust)
        forcing = Forcing(
            start=cos(t) * self.thrust, middle=cos(t + 0.5 * h) * self.thrust, end=cos(t + h) * self.thrust
        )
        self.second = runge_kutta_nystrom(self.gravity, self.second, forcing, h)
        self.third = simpson(self.acceleration, t, self.third, h)
