"""Apollo's lunar descent guidance: a quartic polynomial to the target, where a prescribed jerk sets the time to go."""

from ..block import Parameter, State
from ..mathlib.lunar.polynomial_descent import DescentShape, jerk_time
from ..mathlib.vectors import Vector3, norm, vector
from .polynomial_guidance import PolynomialGuidance


class ApolloGuidance(PolynomialGuidance):
    """Quartic polynomial of time to the target, as in Apollo's P63 and P64; the final jerk sets the time to go.

    The final thrust acceleration is final_lift upwards and final_deceleration against the forward axis, which is
    horizontal towards the target at the start and then fixed. The time to go is the time for which the final jerk along
    this axis equals target_jerk, by Newton's method from the previous time. Below freeze_time, and when Newton's method
    fails, it is counted down. The status is 3 if no time exists at the start, as for a jerk of the wrong sign.
    time_choice and time_weight have no effect. The law does not limit thrust; the status is 1 if the remaining descent
    needs more than maximum_thrust.

    Assumes constant gravity unless gravity_correction is set.

    Source: Klumpp 1974, "Apollo lunar descent guidance", Automatica 10(2), equations 8 to 12; defaults scaled to a
    thrust acceleration of 5 m/s2.
    """

    final_deceleration = Parameter(
        5.0, unit="m/s2", description="thrust acceleration at the target opposite to the forward axis"
    )
    final_lift = Parameter(
        2.2, unit="m/s2", description="thrust acceleration at the target along z of the landing site frame"
    )
    target_jerk = Parameter(0.029, unit="m/s3", description="jerk at the target along the forward axis")
    freeze_time = Parameter(
        10.0,
        unit="s",
        minimum=0.0,
        description="time to go below which the time to go is counted down instead of computed",
    )
    lead_time = Parameter(
        0.0, unit="s", minimum=0.0, description="lead time of the commanded thrust, compensating for delays"
    )
    flown_kr = PolynomialGuidance.flown_kr.with_start(12.0)
    forward = State(
        [1.0, 0.0, 0.0],
        unit="1",
        frame="landing site",
        description="forward axis, horizontal direction towards the target at the start, unit vector",
    )

    def final_thrust(self) -> Vector3:
        """Return the thrust acceleration (m/s2) at the target."""
        along = self.final_deceleration * self.forward
        return vector(-along.x, -along.y, self.final_lift - along.z)

    def shape(self, kr: float) -> DescentShape:
        return DescentShape(final=self.final_thrust(), gamma=1.0, kr=kr)

    def lead(self) -> float:
        return self.lead_time

    def face_target(self) -> None:
        """Set the forward axis to the horizontal direction towards the target."""
        way = self.aim_position - self.position
        level = vector(way.x, way.y, 0.0)
        length = norm(level)
        if length > 0.0:
            self.forward = level / length

    def choose_time(self) -> float:
        """Return the time to go (s) for target_jerk, starting from the time of least propellant; 0 if none exists."""
        self.choices = self.choices + 1
        self.face_target()
        first = self.first_time()
        if not first > 0.0:
            return 0.0
        return self.time_from_jerk(self.search_time(first))

    def time_from_jerk(self, time: float) -> float:
        """Return the time to go (s) for target_jerk by Newton's method from an estimate; 0 without convergence."""
        dr, dv = self.remaining_over(time)
        constant = self.final_thrust() + vector(0.0, 0.0, -self.gravity)
        return jerk_time(dr, self.velocity, dv, constant, self.forward, self.target_jerk, time)

    def time_left(self) -> float:
        if self.plan_frozen():
            return self.frozen_time_to_go
        time = self.expected_time
        if not self.chosen:
            time = self.choose_time()
            self.chosen = time > 0.0
            self.check(time)
        elif time > self.freeze_time:
            root = self.time_from_jerk(time)
            if root > 0.0:
                time = root
        if self.is_check_due(time):
            self.check(time)
        return time
