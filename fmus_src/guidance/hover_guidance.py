"""Guidance between hovers: modes, and the control law that tracks the plans."""

from ..block import Input, Output, Outputs, Parameter, State
from ..interfaces.ports import landing, sampling
from ..interfaces.ports.landing import UNLIMITED, HoverMode, HoverStatus, ThrustCommand
from ..kernel.functions import expm1, tan
from ..mathlib.actuators.lagged_thrust import lagged_thrust
from ..mathlib.attitude.rotation import TurningDirection
from ..mathlib.hover.solution import PlanKind
from ..mathlib.lunar.gravity import STANDARD_GRAVITY
from ..mathlib.vectors import across, clip, dot, limit_length, norm, vector
from ..units import deg
from .hover_plan import HoverPlan

CYCLE_TOLERANCE = 1e-3  # fraction of a cycle: tolerance for communication points at sample instants
USUAL_CYCLE = 0.1  # s, cycle assumed for the first command, before the communication step is known
LEAST_THRUST = 0.02  # m/s2, least commanded value, which keeps the direction defined
LEAST_LEVER = 1.0  # m/s2, least thrust over mass by which a lateral demand is divided
BEFORE_LAST_BURN = 1.0  # s before the last burn, at which its gains begin
HIGH_THRUST = 0.3  # fraction of the largest thrust, above which measured thrust has the high gain
HIGH_GAIN = 0.1
LOW_GAIN = 0.02
LARGEST_FACTOR_ERROR = 0.5  # a larger error means that the engine does not follow this command


class HoverGuidance(HoverPlan):
    """Guidance between hovers, with the modes idle, hold, programme, slow transfer, capture and descend.

    A plan starts when active becomes true and when plan_number or mode changes, with the target at that instant. After
    its plan every mode holds the end of the plan; mode 5 descends from target_position with descent_acceleration up to
    descent_speed. With the plan's position r, velocity v, thrust over mass A and direction d, and estimates r_e, v_e:

        e = lim(r - r_e, largest_error)    f = ω^2 e + 2 ζ ω (v - v_e)
        q = lim((f - (f · d) d)/max(A + f · d, 1), tan(largest_tilt))
        thrust_acceleration = max(A + f · d, 0.02) |d + q|/thrust_factor    direction = (d + q)/|d + q|

    Accelerations are in m/s2. q passes a first-order low-pass filter with the time constant tilt_filter. A is the mean
    of the plan over a sample period that begins engine_lag later. The frequency ω is coasting_frequency in a programme,
    braking_frequency from 1 s before its last burn on, and holding_frequency in holds and polynomials. thrust_factor is
    estimated from measured and commanded thrust. thrust_direction_rate is the rate of the plan's direction d alone;
    including the rate of q would cause limit cycles.

    Source: Huang 2017 (programme); control law: this repository. See docs/systems/hover_transfer.md.
    """

    engine_lag = Parameter(0.1, unit="s", minimum=0.0, description="time constant of the engine's thrust")
    coasting_frequency = Parameter(
        0.06,
        unit="rad/s",
        minimum=0.0,
        description="natural frequency of the position loop in a programme before its last burn",
    )
    braking_frequency = Parameter(
        0.15,
        unit="rad/s",
        minimum=0.0,
        description="natural frequency of the position loop in the last burn of a programme",
    )
    holding_frequency = Parameter(
        0.12,
        unit="rad/s",
        minimum=0.0,
        description="natural frequency of the position loop in hold and polynomial plans",
    )
    damping = Parameter(0.9, unit="1", minimum=0.0, description="damping ratio of the position loop")
    tilt_filter = Parameter(
        0.7, unit="s", minimum=0.0, description="time constant of the filter of the lateral thrust demand; 0: no filter"
    )
    largest_error = Parameter(
        40.0, unit="m", minimum=0.0, description="distance to which the position error is limited in the control law"
    )
    largest_tilt = Parameter(
        deg(12.0),
        unit="rad",
        minimum=0.0,
        maximum=1.5,
        description="largest angle between commanded and planned thrust direction",
    )
    estimate_thrust = Parameter(True, description="true: thrust_factor estimated; false: thrust_factor fixed at 1")
    descent_acceleration = Parameter(
        0.3, unit="m/s2", minimum=1e-3, description="downward acceleration at the start of a descent"
    )
    descent_speed = Parameter(1.0, unit="m/s", minimum=1e-3, description="constant speed of a descent")
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.1, "sample period of the guidance; 0: a sample at every communication point"
    )
    active = landing.ACTIVE.input()
    mode = Input(
        HoverMode, start=HoverMode.PROGRAMME, description="requested mode of the guidance; a change starts a plan"
    )
    plan_number = landing.PLAN_NUMBER.input()
    command = Outputs(ThrustCommand, direct=True, thrust_direction=[0.0, 0.0, 1.0], burn_duration=UNLIMITED)
    time_to_go = landing.TIME_TO_GO.output("remaining time of the plan", direct=True)
    finished = landing.FINISHED.output("true: plan completed", direct=True)
    angular_acceleration_feed = landing.ANGULAR_ACCELERATION.output(
        ("feedforward of the planned angular acceleration of the thrust axis, mean over the next sample period"),
        direct=True,
    )
    answered_plan = Output(
        0, direct=True, description="plan_number of the plan that the outputs follow, in idle mode of the last plan"
    )
    plan_time = Output(0.0, unit="s", direct=True, description="time since the start of the plan")
    thrust_factor = Output(1.0, unit="1", direct=True, description="estimated ratio of actual to commanded thrust")
    reference_position = landing.POSITION.output(
        "reference position on the plan relative to the landing site", direct=True
    )
    reference_velocity = landing.VELOCITY.output(
        "reference velocity on the plan relative to the landing site", direct=True
    )
    saturated = Output(
        False, direct=True, description="true: thrust demand beyond the engine's limits, or position error limited"
    )
    cycle = State(0.1, unit="s", description="time to the next guidance sample")
    tilt = State(
        [0.0, 0.0, 0.0],
        unit="1",
        frame="landing site",
        description=(
            "filtered lateral component of the commanded thrust, relative to the component along the plan's thrust"
        ),
    )
    elapsed = State(
        0.1, unit="s", description="time between the last two guidance samples, covered by velocity_increment"
    )
    sample_time = State(0.0, unit="s", description="time of the last guidance sample")
    plan_start = State(0.0, frozen=True, unit="s", description="start time of the plan")
    in_charge = State(False, description="true: guidance was active at the last sample")
    flown_mode = State(HoverMode, description="mode in which the last plan was requested")
    engine_thrust = State(0.0, unit="N", description="thrust of the engine predicted by a model of its lag")
    commanded_thrust = State(0.0, unit="N", description="last thrust command within the engine's limits; 0: no command")
    start_time = State(0.0, unit="s", description="start time of the simulation")

    def initialize(self) -> None:
        self.sample_time = self.start_time
        self.cycle = USUAL_CYCLE
        if self.sample_period > 0.0:
            self.cycle = self.sample_period
        self.guide(self.start_time)

    def step(self, t: float, h: float) -> None:
        self.cycle = h
        if self.sample_period > 0.0:
            self.cycle = self.sample_period
        self.guide(t + h)

    def guide(self, time: float) -> None:
        """Process the sample at ``time`` (s)."""
        self.elapsed = time - self.sample_time
        # the nominal cycle, free of rounding, unless communication points miss sample instants
        if abs(self.elapsed - self.cycle) <= CYCLE_TOLERANCE * self.cycle or not self.elapsed > 0.0:
            self.elapsed = self.cycle
        self.sample_time = time
        if not self.active or self.mode == HoverMode.IDLE:
            self.deactivate(time)
        else:
            if self.in_charge:
                self.weigh_thrust()
            else:
                self.tilt = vector(0.0, 0.0, 0.0)
                self.engine_thrust = self.mass * norm(self.velocity_increment) / (self.elapsed * self.thrust_factor)
            if not self.in_charge or self.mode != self.flown_mode or self.plan_number != self.answered_plan:
                self.begin_plan(time)
            self.in_charge = True
            self.follow(time)
        self.command.command_time = time

    def deactivate(self, time: float) -> None:
        """Withdraw the command."""
        if self.in_charge:
            self.drop_plan()
        self.in_charge = False
        self.command.thrust_acceleration = 0.0
        self.command.thrust_direction_rate = vector(0.0, 0.0, 0.0)
        self.angular_acceleration_feed = vector(0.0, 0.0, 0.0)
        self.commanded_thrust = 0.0
        self.time_to_go = 0.0
        self.plan_time = 0.0
        self.finished = False
        self.saturated = False

    def begin_plan(self, time: float) -> None:
        """Compute the plan of the present mode."""
        self.plan_start = time
        self.flown_mode = self.mode
        self.answered_plan = self.plan_number
        self.drop_plan()
        possible = self.can_plan()
        if possible:
            if self.mode == HoverMode.PROGRAMME:
                self.plan_programme()
            elif self.mode == HoverMode.SLOW:
                self.plan_transfer(self.slow_speed, self.slow_acceleration)
            elif self.mode == HoverMode.CAPTURE:
                self.plan_capture(self.elapsed)

    def weigh_thrust(self) -> None:
        """Update thrust_factor by comparing the measured thrust of the last cycle with the command."""
        thrust = lagged_thrust(self.engine_thrust, self.commanded_thrust, self.engine_lag, self.elapsed)
        impulse = thrust.impulse
        self.engine_thrust = thrust.end
        mean = impulse / self.elapsed
        if self.estimate_thrust and mean > 0.0:
            exhaust = STANDARD_GRAVITY * self.specific_impulse
            mass = self.mass + 0.5 * impulse / exhaust
            measured = mass * norm(self.velocity_increment) / impulse
            gain = LOW_GAIN
            if mean > HIGH_THRUST * self.maximum_thrust:
                gain = HIGH_GAIN
            if abs(measured - 1.0) < LARGEST_FACTOR_ERROR:
                self.thrust_factor = self.thrust_factor + gain * (measured - self.thrust_factor)

    def sinking(self) -> bool:
        """Return True if the reference descends."""
        return self.mode == HoverMode.DESCEND and self.status == HoverStatus.GOOD

    def sink_speed(self, t: float) -> float:
        """Return the speed (m/s) of the descent at time t (s) after its start."""
        speed = self.descent_acceleration * t
        if speed > self.descent_speed:
            return self.descent_speed
        return speed

    def reference(self, t: float) -> None:
        """Set reference_position and reference_velocity for time t (s) after the plan's start."""
        planned = self.plan_motion(t)
        self.reference_position = planned.position
        self.reference_velocity = planned.velocity
        if self.sinking():
            speed = self.sink_speed(t)
            sunk = speed * t - 0.5 * speed * speed / self.descent_acceleration
            if speed < self.descent_speed:
                sunk = 0.5 * speed * t
            self.reference_position = self.goal - sunk * self.up
            self.reference_velocity = -speed * self.up

    def reference_thrust(self, begin: float, end: float) -> float:
        """Return the plan's mean thrust over mass (m/s2) between two times (s); after its end, local gravity.

        The acceleration of a descent is not fed forward: feedback alone tracks the reference, which makes the motion
        smooth.
        """
        gravity = self.gravity_at(self.position)
        left = clip(self.duration - begin, 0.0, end - begin)
        impulse = gravity * (end - begin - left)
        if left > 0.0:
            impulse = impulse + self.plan_impulse(begin, begin + left)
        return impulse / (end - begin)

    def frequency(self, t: float) -> float:
        """Return the natural frequency (rad/s) of the control loop at time t (s) after the plan's start."""
        if self.plan_kind == PlanKind.NONE or self.plan_kind == PlanKind.POLYNOMIAL or t >= self.duration:
            return self.holding_frequency
        if t >= self.shape.last_burn_begin - BEFORE_LAST_BURN:
            return self.braking_frequency
        return self.coasting_frequency

    def follow(self, time: float) -> None:
        """Set the command at ``time`` (s)."""
        t = time - self.plan_start
        if self.duration - t < sampling.TIME_ROUNDING and t < self.duration:
            t = self.duration
        self.plan_time = t
        self.time_to_go = clip(self.duration - t, 0.0, self.duration)
        self.finished = t >= self.duration and not self.sinking()
        self.reference(t)
        planned = self.plan_direction(t)
        # after the end of the plan its rate is 0
        self.angular_acceleration_feed = (self.plan_rate(t + self.cycle) - self.plan_rate(t)) / self.cycle
        ahead = self.reference_thrust(t + self.engine_lag, t + self.engine_lag + self.cycle)
        self.track(planned, ahead, self.frequency(t))

    def track(self, plan: TurningDirection, planned: float, frequency: float) -> None:
        """Apply the control law with the plan's direction and thrust over mass (m/s2) as feedforward."""
        direction = plan.direction
        error = self.reference_position - self.position
        near = limit_length(error, self.largest_error)
        push = frequency * (frequency * near + 2.0 * self.damping * (self.reference_velocity - self.velocity))
        wanted = planned + dot(push, direction)
        lever = wanted
        if lever < LEAST_LEVER:
            lever = LEAST_LEVER
        lateral = across(push, direction) / lever
        reach = tan(self.largest_tilt)
        self.saturated = norm(error) > self.largest_error or norm(lateral) > reach
        lateral = limit_length(lateral, reach)
        fraction = 1.0
        if self.tilt_filter > 0.0:
            fraction = -expm1(-self.elapsed / self.tilt_filter)
        self.tilt = self.tilt + fraction * (lateral - self.tilt)
        if wanted < LEAST_THRUST:
            wanted = LEAST_THRUST
        leaning = direction + self.tilt
        length = norm(leaning)
        self.command.thrust_direction = leaning / length
        self.command.thrust_direction_rate = across(plan.rate, self.command.thrust_direction) / length
        self.command.thrust_acceleration = wanted * length / self.thrust_factor
        demand = self.mass * self.command.thrust_acceleration
        self.commanded_thrust = clip(demand, self.minimum_thrust, self.maximum_thrust)
        if demand != self.commanded_thrust:
            self.saturated = True
