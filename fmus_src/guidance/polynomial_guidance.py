"""Terminal guidance by a thrust acceleration with two powers of the time to go, and the choice of the time to go."""

from ..block import Parameter, State
from ..interfaces.ports.landing import TerminalStatus
from ..kernel.enumerations import Enumeration, member
from ..kernel.functions import cos, exp, expm1
from ..kernel.records import Field, Record
from ..mathlib.lunar.polynomial_descent import DescentShape, descent_profile, offset_at, thrust_at
from ..mathlib.vectors import across, clip, norm, vector
from .informed_guidance import LIMIT_GLIDE_SLOPE, LIMIT_THRUST, LIMIT_TILT, InformedGuidance

NODES = 32  # intervals of a profile over which propellant and thrust are evaluated
OVERLOAD_PRICE = 2000.0  # m/s, penalty on a thrust of twice the largest
GLIDE_PRICE = 2.0  # 1/s, penalty (m/s) per metre below the glide slope
TILT_PRICE = 500.0  # m/s, penalty on a difference of 1 between the cosines of tilts
TRIALS = 25
SHORTEST, SPACING = 0.6, 0.05  # shortest time and spacing of the grid, as fractions of the first time
GOLDEN = 0.6180339887498949
REDUCTIONS = 12
CHECK_INTERVAL = 2.0  # s between checks of the thrust that the plan requires
LAST_CHECK = 10.0  # s to go, below which there are no checks
MOST_CHOICES = 30
GLIDE_TOLERANCE = 1.0  # m, largest violation of the glide slope by a search with penalties


class TimeChoice(Enumeration):
    """Objective of the time to go."""

    PROPELLANT = member("least propellant within the thrust limit")
    EFFORT = member("least effort")


class ProfileCost(Record):
    """Impulse of a thrust profile, and violations of limits."""

    objective = Field(unit="m/s", description="impulse with penalties on violated limits")
    impulse = Field(unit="m/s", description="integral of thrust acceleration")
    load = Field(unit="1", description="largest thrust, as a fraction of maximum_thrust")
    depth = Field(unit="m", description="largest depth below the glide slope; 0: none")
    tilt_excess = Field(
        unit="1", description="largest violation of the tilt limit, as a difference of cosines; 0: none"
    )


class PolynomialGuidance(InformedGuidance, interface=True):
    """Thrust acceleration with two powers of the time to go, with an optimised time of flight.

        a = a_f + d_1 t^γ + d_2 t^γ_2    t = time_to_go

    Position and velocity at the target determine the coefficients. The time of flight minimises propellant, with
    thrust_margin times maximum_thrust as the largest thrust, or effort; it is chosen at the start and counted down.
    Every 2 s, until 10 s to go, the largest remaining thrust is compared with maximum_thrust; if the thrust is larger,
    another time is chosen, at most 30 times. Further violations are accepted with status 1.

    Assumes constant gravity unless gravity_correction is set, and thrust limits without a dead band.

    Source: Lu 2019 and 2020; choice of time: this repository.
    """

    time_choice = Parameter(TimeChoice, description="objective by which the time to go is chosen")
    time_weight = Parameter(
        0.0, unit="m2/s4", minimum=0.0, description="weight of the time to go in the least-effort objective"
    )
    chosen = State(False, description="true: time to go chosen for the current target")
    checked_time = State(0.0, unit="s", description="time to go at the last check of the thrust constraints")
    flown_kr = State(6.0, unit="1", description="gain kr of the position error in use")

    def shape(self, kr: float) -> DescentShape:
        """Return the parameters of the law for the gain ``kr``; ZEM/ZEV, with a gain of 6, unless overridden."""
        return DescentShape(final=vector(0.0, 0.0, 0.0), gamma=1.0, kr=kr)

    def take_gain(self) -> None:
        """Set flown_kr if the gain is a parameter; no action unless overridden."""

    def reset_law(self) -> None:
        self.chosen = False
        self.checked_time = 0.0
        self.choices = 0
        self.limit = 0

    def cost_of(self, time: float, kr: float, margin: float) -> ProfileCost:
        """Return the cost of the profile for ``time`` (s), with the thrust limit multiplied by ``margin``."""
        dr, dv = self.remaining_over(time)
        profile = descent_profile(dr, self.velocity, dv, self.gravity, time, self.shape(kr))
        arrival = self.velocity + dv
        exhaust = self.exhaust_speed()
        step = time / float(NODES)
        upright = cos(self.largest_tilt)
        impulse = 0.0
        before = 0.0
        load = 0.0
        depth = 0.0
        tilt_excess = 0.0
        for i in range(NODES + 1):
            s = 1.0 - float(i) / float(NODES)
            thrust = thrust_at(profile, s)
            size = norm(thrust)
            if i > 0:
                impulse = impulse + 0.5 * step * (before + size)
            before = size
            demand = size * self.mass * exp(-clip(impulse / exhaust, 0.0, 700.0)) / self.maximum_thrust
            if demand > load:
                load = demand
            if self.glide_slope > 0.0:
                below = -self.glide_height(offset_at(profile, arrival, self.gravity, time, s))
                if below > depth:
                    depth = below
            if size > 0.0 and upright > -1.0:
                excess = upright - thrust.z / size
                if excess > tilt_excess:
                    tilt_excess = excess
        objective = impulse
        if load > margin:
            objective = objective + OVERLOAD_PRICE * (load / margin - 1.0)
        return ProfileCost(objective=objective, impulse=impulse, load=load, depth=depth, tilt_excess=tilt_excess)

    def objective(self, time: float, kr: float) -> float:
        """Return the objective (m/s) for a time of flight (s) and a gain."""
        return self.cost_of(time, kr, self.thrust_margin).objective

    def best_time(self, first: float, shortest: float, spacing: float, kr: float) -> float:
        """Return the time (s) of the least objective by a grid with multiples of ``first`` (s), then golden section."""
        best = 0
        minimum = self.objective(first * shortest, kr)
        for i in range(1, TRIALS):
            price = self.objective(first * (shortest + float(i) * spacing), kr)
            if price < minimum:
                minimum = price
                best = i
        low = first * (shortest + (float(best) - 1.0) * spacing)
        high = first * (shortest + (float(best) + 1.0) * spacing)
        left = high - GOLDEN * (high - low)
        right = low + GOLDEN * (high - low)
        at_left = self.objective(left, kr)
        at_right = self.objective(right, kr)
        for _ in range(REDUCTIONS):
            if at_left < at_right:
                high = right
                right = left
                at_right = at_left
                left = high - GOLDEN * (high - low)
                at_left = self.objective(left, kr)
            else:
                low = left
                left = right
                at_left = at_right
                right = low + GOLDEN * (high - low)
                at_right = self.objective(right, kr)
        return 0.5 * (low + high)

    def choose_time(self) -> float:
        """Set flown_kr and return the time to go (s), or 0 if no time exists."""
        self.choices = self.choices + 1
        if self.time_choice == TimeChoice.EFFORT:
            return self.effort_time(self.time_weight)
        first = self.first_time()
        if not first > 0.0:
            return 0.0
        return self.search_time(first)

    def search_time(self, first: float) -> float:
        """Return the time to go (s) of the least objective by a search from ``first`` (s)."""
        return self.best_time(first, SHORTEST, SPACING, self.flown_kr)

    def time_left(self) -> float:
        """Return the time to go (s), chosen at the start and when thrust does not suffice, otherwise counted down."""
        if self.plan_frozen():
            self.take_gain()
            return self.frozen_time_to_go
        time = self.expected_time
        if not self.chosen:
            time = self.choose_time()
            self.chosen = time > 0.0
            self.check(time)
        elif self.is_check_due(time):
            if self.cost_of(time, self.flown_kr, 1.0).load > 1.0 and self.choices < MOST_CHOICES:
                choice = self.choose_time()
                if choice > 0.0:
                    time = choice
            self.check(time)
        return time

    def is_check_due(self, time: float) -> bool:
        """Return True if the remaining thrust must be checked at ``time`` (s) to go."""
        return time > LAST_CHECK and self.checked_time - time >= CHECK_INTERVAL

    def check(self, time: float) -> None:
        """Set `limit` and the predictions from the profile with ``time`` (s) to go."""
        self.checked_time = time
        self.limit = 0
        if time > 0.0:
            cost = self.cost_of(time, self.flown_kr, 1.0)
            self.predicted_propellant = -self.mass * expm1(-clip(cost.impulse / self.exhaust_speed(), 0.0, 700.0))
            if cost.load > 1.0 or cost.impulse * self.mass < self.minimum_thrust * time:
                self.limit = self.limit + LIMIT_THRUST
            if cost.depth > GLIDE_TOLERANCE:
                self.limit = self.limit + LIMIT_GLIDE_SLOPE
            if cost.tilt_excess > 0.0:
                self.limit = self.limit + LIMIT_TILT

    def solve(self) -> None:
        self.measure_glide()
        time = self.time_left()
        self.time_to_go = time
        self.status = TerminalStatus.GOOD
        if self.limit > 0:
            self.status = TerminalStatus.CLAMPED
        if time > 0.0:
            self.command_profile(time)
        elif not self.chosen:
            self.status = TerminalStatus.NO_SOLUTION

    def lead(self) -> float:
        """Return the lead time (s) with which the profile is commanded; 0 unless overridden."""
        return 0.0

    def command_profile(self, time: float) -> None:
        """Command the mean of the profile over the next burn, by Simpson's rule, with ``time`` (s) to go."""
        dr, dv = self.remaining_over(time)
        profile = descent_profile(dr, self.velocity, dv, self.gravity, time, self.shape(self.flown_kr))
        span = self.burn_span(time)
        lead = self.lead()
        begin = thrust_at(profile, clip(1.0 - lead / time, 0.0, 1.0))
        middle = thrust_at(profile, clip(1.0 - (lead + 0.5 * span) / time, 0.0, 1.0))
        end = thrust_at(profile, clip(1.0 - (lead + span) / time, 0.0, 1.0))
        size = norm(begin + 4.0 * middle + end) / 6.0
        self.command.thrust_acceleration = size
        length = norm(begin)
        if length > 0.0:
            direction = begin / length
            self.command.thrust_direction = direction
            self.command.thrust_direction_rate = vector(0.0, 0.0, 0.0)
            if span > 0.0:
                change = end - begin
                self.command.thrust_direction_rate = across(change, direction) / (span * length)
