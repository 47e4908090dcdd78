"""Allocation to one body-fixed engine: throttle and attitude with their limits."""

from ..block import Parameter, State
from ..interfaces.allocation import Allocation, AllocationStatus
from ..interfaces.ports import landing, sampling
from ..kernel.functions import exp
from ..mathlib.attitude.rotation import turn_towards
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import clip, dot, norm, vector


class ThrustAllocation(Allocation):
    """Engine thrust and attitude for a commanded thrust acceleration and direction.

        thrust_lag F' = (1 + e) clip(m a_c, minimum_thrust, maximum_thrust) - F

    with a constant random error e. The lag is exact for a demand that is constant over the step; the plant holds the
    output, which adds half a step of delay. With a slew limit the direction turns towards the commanded one at a mean
    rate of at most slew_rate_limit over each step, and by no more than 1.5 rad in one step; it starts aligned and
    without a rate. All limits are off by default. If minimum_thrust exceeds maximum_thrust, the status is 2 and only
    the maximum limits the thrust.

    thrust_lead ends the burn early, to compensate the impulse that a first-order lag leaves after cut-off.
    direction_lead commands the future direction, to compensate a first-order attitude response.

    A demand between dead_band_low and dead_band_high, as fractions of maximum_thrust, keeps the engine on the side of
    this dead band on which it was; above the band the engine gives full thrust, below it the commanded thrust. For
    Apollo's descent engine the fractions were 0.57 and 0.63 (Klumpp 1974). For reversed bounds, or a dead band without
    maximum_thrust, the status is 2.

    Assumes thrust through the centre of mass.

    See docs/systems/lunar_landing.md.
    """

    minimum_thrust = landing.MINIMUM_THRUST.parameter()
    maximum_thrust = landing.MAXIMUM_THRUST.parameter(0.0, "largest thrust of the engine; 0: no limit")
    thrust_lag = landing.THRUST_LAG.parameter()
    slew_rate_limit = Parameter(
        0.0, unit="rad/s", minimum=0.0, description="largest angular rate of the thrust direction; 0: no limit"
    )
    thrust_error = Parameter(
        0.0, unit="1", minimum=0.0, description="random relative error of thrust, 1 sigma, constant over a simulation"
    )
    thrust_offset = Parameter(
        0.0,
        unit="1",
        minimum=-1.0,
        description="deterministic relative error of thrust, added to the random error",
    )
    thrust_lead = Parameter(
        0.0, unit="s", minimum=0.0, description="time by which a burn is ended early to compensate for the engine's lag"
    )
    direction_lead = Parameter(
        0.0,
        unit="s",
        minimum=0.0,
        description="lead time of the commanded direction, to compensate for the lag of the attitude",
    )
    dead_band_low = Parameter(
        0.0,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        description="lower end of the engine's dead band, as a fraction of maximum_thrust",
    )
    dead_band_high = Parameter(
        0.0,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        description="upper end of the engine's dead band, as a fraction of maximum_thrust; 0: no dead band",
    )
    seed, stream = sampling.random_stream()
    generator = sampling.GENERATOR.state()
    thrust_factor = State(1.0, unit="1", description="ratio of actual to commanded thrust of the engine")
    commanded_thrust = State(0.0, unit="N", description="thrust commanded at the last communication point")
    full = State(False, description="true: engine at full thrust, above its dead band")

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        error = normal(self.generator)
        self.thrust_factor = 1.0 + self.thrust_offset + self.thrust_error * error
        self.command_thrust()
        self.thrust = self.commanded_thrust
        self.pass_direction()
        if self.slew_rate_limit > 0.0:
            self.thrust_direction_rate = vector(0.0, 0.0, 0.0)

    def command_thrust(self) -> None:
        """Set commanded_thrust (N) from the demand."""
        demanded = self.mass * self.thrust_acceleration
        allowed = demanded
        if demanded > 0.0:
            if demanded < self.minimum_thrust:
                allowed = self.minimum_thrust
            if self.maximum_thrust > 0.0:
                allowed = clip(allowed, 0.0, self.maximum_thrust)
            allowed = self.leave_dead_band(allowed)
        else:
            self.full = False
        self.status = AllocationStatus.GOOD
        if allowed != demanded:
            self.status = AllocationStatus.LIMITED
        if self.is_contradictory():
            self.status = AllocationStatus.CONTRADICTORY
        self.commanded_thrust = allowed * self.thrust_factor

    def leave_dead_band(self, demanded: float) -> float:
        """Return the thrust (N) for a ``demanded`` thrust, moved out of the dead band if there is one."""
        if self.dead_band_high <= 0.0 or self.maximum_thrust <= 0.0:
            return demanded
        if demanded > self.dead_band_high * self.maximum_thrust:
            self.full = True
        elif demanded < self.dead_band_low * self.maximum_thrust:
            self.full = False
        if self.full:
            return self.maximum_thrust
        return demanded

    def is_contradictory(self) -> bool:
        """Return True if the limits contradict each other."""
        if self.dead_band_low > self.dead_band_high:
            return True
        if self.dead_band_high > 0.0 and self.maximum_thrust <= 0.0:
            return True
        return self.maximum_thrust > 0.0 and self.minimum_thrust > self.maximum_thrust

    def duration(self) -> float:
        """Return the burn duration (s) measured from demand_time."""
        shortened = self.demanded_duration - self.thrust_lead
        if self.thrust_lead > 0.0 and shortened < 0.0:
            shortened = 0.0
        return shortened

    def pass_direction(self) -> None:
        """Output the demanded direction and burn timing, shifted by their lead times."""
        self.thrust_direction = self.demanded_direction
        self.thrust_direction_rate = self.demanded_direction_rate
        # an earlier reference time gives the direction in advance, at any time
        self.command_time = self.demand_time - self.direction_lead
        self.burn_duration = self.duration() + self.direction_lead

    def slew(self, time: float, h: float) -> None:
        """Turn the thrust direction at ``time`` (s) towards the demanded one, by at most the slew limit over h (s)."""
        since = time + h - (self.demand_time - self.direction_lead)
        goal = self.demanded_direction + since * self.demanded_direction_rate
        goal = goal / norm(goal)
        now = self.thrust_direction + (time - self.command_time) * self.thrust_direction_rate
        now = now / norm(now)
        # a direction with a constant rate cannot turn by 90 deg or more in one step
        ahead, left = turn_towards(now, goal, clip(self.slew_rate_limit * h, 0.0, 1.5))
        if left > 0.0 and self.status == AllocationStatus.GOOD:
            self.status = AllocationStatus.LIMITED
        self.thrust_direction = now
        # now + rate h is parallel to ahead, and the rate is perpendicular to now
        self.thrust_direction_rate = (ahead / dot(now, ahead) - now) / h
        self.command_time = time
        self.burn_duration = self.demand_time + self.duration() - time

    def step(self, t: float, h: float) -> None:
        held = self.commanded_thrust
        lagged = self.thrust
        self.command_thrust()
        self.thrust = self.commanded_thrust
        if self.thrust_lag > 0.0:
            self.thrust = held + (lagged - held) * exp(-h / self.thrust_lag)
        if self.slew_rate_limit > 0.0:
            self.slew(t + h, h)
        else:
            self.pass_direction()
