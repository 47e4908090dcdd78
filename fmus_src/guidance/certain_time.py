"""A time-to-go for every start, shared by the two guidances that have one."""

from ..block import State
from ..mathlib.lunar.terminal import cubic_time, effort_rises, least_effort_time, linear_thrust, steady
from ..mathlib.vectors import Vector3
from .terminal_guidance import TerminalGuidance

AGREEMENT = 0.05  # of the time; where the two times are this close, a flight of least effort goes over to braking
# With less than ENDING (s) to go and no root, a least effort of more than CHASE times that would only chase errors
# of knowledge about the target: time is up.
ENDING = 5.0
CHASE = 1.5


class CertainTime(TerminalGuidance, interface=True):
    """Time-to-go from |A| T = 2 |B| where that brakes, that of least effort where it does not.

    |A| T = 2 |B| is for fast approaches, with thrust of about constant size. It has no root, or
    only one whose thrust turns round, for starts at rest, receding or beside the target, and one
    far too long for slow approaches, which would hover down. Those fly the thrust acceleration
    a0 + a1 t whose square has the least integral; its time exists wherever there is gravity and a
    way to go. Which of the two it is, is decided with the first command; a flight of least effort
    brakes like the others once both times agree, and one that has lost its root in between takes
    the least effort meanwhile.
    Limits: the ground is not known, and a start that is too fast for its distance flies past the
    target and back, below it if need be; without gravity there is no time for a start at rest.
    |A| T = 2 |B| does not hold with a frozen time_to_go, with which the law is a0 + a1 t throughout.
    Source: D'Souza 1997, "An optimal guidance law for planetary landing"; the choice is ours.
    """

    braking = State(False, description="the flight takes its time from |A| T = 2 |B|")
    least_effort = State(False, description="the last command took the time of least effort")

    def forget(self) -> None:
        self.braking = False
        self.least_effort = False

    def time_left(self, dr: Vector3, dv: Vector3) -> float:
        """Return time-to-go (s) from the remaining gain, and set least_effort; 0 where there is none."""
        if self.plan_frozen():
            self.least_effort = True
            return self.frozen_time_to_go
        g = self.gravity
        time = cubic_time(dr, self.velocity, dv, g)
        minimum = 0.0
        if not self.started or self.least_effort or time <= 0.0:
            minimum = least_effort_time(dr, self.velocity, dv, g)
            close = abs(time - minimum) < AGREEMENT * minimum
            suits = time > 0.0 and steady(dr, self.velocity, dv, g, time)
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
        """Command the mean of a0 + a1 t over the next burn, with A (m/s), B (m) and the time-to-go (s)."""
        thrust = linear_thrust(
            a, b, time, self.burn_span(time), self.command.thrust_direction, self.command.thrust_direction_rate
        )
        self.command.thrust_acceleration = thrust.size
        self.command.thrust_direction = thrust.direction
        self.command.thrust_direction_rate = thrust.rate
