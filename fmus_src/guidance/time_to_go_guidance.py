"""Choice of a time to go for every start, shared by two guidance laws."""

from ..block import State
from ..mathlib.lunar.terminal import cubic_time, effort_rises, keeps_direction, least_effort_time, linear_thrust
from ..mathlib.vectors import Vector3
from .terminal_guidance import TerminalGuidance

AGREEMENT = 0.05  # relative difference of the two times below which a least-effort flight changes to braking
# With less than ENDING (s) to go and no root, a time of least effort of more than CHASE times the expected time would
# only follow errors of the estimate, so the flight ends.
ENDING = 5.0
CHASE = 1.5


class TimeToGoGuidance(TerminalGuidance, interface=True):
    """Time to go for every start: from |A| T = 2 |B| for braking starts, otherwise of least effort.

    With the upward unit vector k, the thrust acceleration a_0 + a_1 t meets position and velocity at the target:

        A = ΔV + g T k    B = Δr - V T + g T^2 k/2
        a_0 = -(2/T^2) (A T - 3 B)    a_1 = (6/T^3) (A T - 2 B)

    The condition |A| T = 2 |B| gives thrust of nearly constant magnitude. It has no suitable root for starts at rest,
    moving away from the target or passing it, and for slow approaches its root is far too long. These starts use the T
    of least effort, which minimises the integral of |a_0 + a_1 t|^2 and exists for any gravity and distance other than
    0. The choice is made at the first command; a flight of least effort changes to braking once both times agree. With
    frozen_time_to_go the law is a_0 + a_1 t.

    Limits: the law does not know the ground; a start too fast for its distance passes the target and returns, possibly
    from below; without gravity there is no time for a start at rest.

    Source: D'Souza 1997, "An optimal guidance law for planetary landing"; choice between the times: this repository.
    """

    braking = State(False, description="true: time to go from the braking equation |A| T = 2 |B|")
    least_effort = State(False, description="true: time to go of the last command minimises the control effort")

    def reset_law(self) -> None:
        self.braking = False
        self.least_effort = False

    def time_left(self, dr: Vector3, dv: Vector3) -> float:
        """Set least_effort and return the time to go (s), or 0 if no time exists."""
        if self.plan_frozen():
            self.least_effort = True
            return self.frozen_time_to_go
        g = self.gravity
        time = cubic_time(dr, self.velocity, dv, g)
        minimum = 0.0
        if not self.started or self.least_effort or time <= 0.0:
            minimum = least_effort_time(dr, self.velocity, dv, g)
            close = abs(time - minimum) < AGREEMENT * minimum
            suits = time > 0.0 and keeps_direction(dr, self.velocity, dv, g, time)
            brakes = suits and not effort_rises(dr, self.velocity, dv, g, time)
            if not self.started:
                self.braking = brakes
            elif suits and close:
                self.braking = True
            self.least_effort = not (self.braking and suits and (brakes or close))
        if self.least_effort:
            time = minimum
            if self.started and self.expected_time < ENDING and minimum > CHASE * self.expected_time:
                time = 0.0
        return time

    def thrust_linearly(self, a: Vector3, b: Vector3, time: float) -> None:
        """Command the mean of a_0 + a_1 t over the next burn, from A (m/s), B (m) and the time to go (s)."""
        thrust = linear_thrust(
            a, b, time, self.burn_span(time), self.command.thrust_direction, self.command.thrust_direction_rate
        )
        self.command.thrust_acceleration = thrust.size
        self.command.thrust_direction = thrust.direction
        self.command.thrust_direction_rate = thrust.rate
