"""Plan of an approach whose turn takes the least time within limits of rate, acceleration and jerk."""

from ..block import Output, Parameter, State
from ..mathlib.jerk_limited import AxisMotion, JerkLimits, RateProfile, follow_profile, plan_axis
from .rendezvous_guidance import RendezvousGuidance, RendezvousStatus


class RendezvousGuidanceJerkLimited(RendezvousGuidance):
    """Rendezvous plan with a rest-to-rest turn of least time within limits of rate, acceleration and jerk.

    The turn begins at turn_start and ends before turn_end; afterwards the robot keeps its attitude. The default limits
    are below the largest rate, acceleration and jerk of the polynomial turn (0.0461 rad/s, 1.81e-3 rad/s2, 2.67e-4
    rad/s3). If the turn takes longer than its phase there is no plan: the status is 2, and the robot stays at rest.

    Source: Biagiotti and Melchiorri 2008, section 3.4. See docs/systems/satellite_pointing.md.
    """

    turn_rate_limit = Parameter(
        0.03, unit="rad/s", minimum=1e-9, description="largest angular rate of the robot's turn"
    )
    turn_acceleration_limit = Parameter(
        1.8e-3, unit="rad/s2", minimum=1e-12, description="largest angular acceleration of the robot's turn"
    )
    turn_jerk_limit = Parameter(
        2.6e-4, unit="rad/s3", minimum=1e-15, description="largest angular jerk of the robot's turn"
    )
    turn_duration = Output(0.0, unit="s", description="duration of the robot's turn")
    turn_profile = State(RateProfile, description="rate profile of the turn")

    def plan_turn(self, angle: float) -> None:
        limits = JerkLimits(
            rate=self.turn_rate_limit, acceleration=self.turn_acceleration_limit, jerk=self.turn_jerk_limit
        )
        self.turn_profile = plan_axis(angle, 0.0, 0.0, limits)
        self.turn_duration = self.turn_profile.duration
        if self.turn_duration > self.turn_end - self.turn_start:
            self.status = RendezvousStatus.TURN_TOO_LONG

    def turn_motion(self, elapsed: float) -> AxisMotion:
        """Return the turn's motion at a time (s) since turn_start."""
        if self.status != RendezvousStatus.GOOD or elapsed <= 0.0:
            return AxisMotion(angle=0.0, rate=0.0, acceleration=0.0)
        if elapsed >= self.turn_duration:
            return AxisMotion(angle=self.turn_profile.angle, rate=0.0, acceleration=0.0)
        return follow_profile(self.turn_profile, elapsed)

    def turn(self, time: float) -> None:
        now = self.turn_motion(time - self.turn_start)
        ahead = self.turn_motion(time - self.turn_start + 0.5 * self.attitude_period)
        self.set_turn(now.angle, now.rate, ahead.acceleration)
