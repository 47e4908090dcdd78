"""Convex powered-descent guidance: least-propellant plans by an interior-point method, and a law that tracks them."""

from ..block import Output, Parameter, State
from ..interfaces.ports.landing import TerminalStatus
from ..kernel.records import replace
from ..mathlib.lunar.convex.expansion import PLAN, DescentTask, PlanSummary
from ..mathlib.lunar.convex.flight_time import TimeBracket, first_bracket, is_met, plan_descent, replan_bracket
from ..mathlib.lunar.convex.problem import INTERVALS
from ..mathlib.lunar.convex.tracking import mean_thrust, reference, tracking_thrust
from ..mathlib.vectors import all_below, clip, norm, vector
from .informed_guidance import LIMIT_GLIDE_SLOPE, LIMIT_PLACE
from .polynomial_guidance import GLIDE_TOLERANCE
from .zem_zev import ZemZevGuidance

LARGEST = 1e9  # largest position (m), speed (m/s) and mass (kg) for planning
SMALLEST_MASS = 1e-3  # kg, for planning
LOWEST_BRAKING = 0.7  # lower bound of a search, as a fraction of a first time that brakes at about constant thrust
LOWEST_EFFORT = 0.4  # the same, as a fraction of a first time of least effort
CLEARANCE = 5.0  # m, distance of a start below the declared glide slope from a lowered one
OFF_COURSE = 30.0  # m, deviation from the plan at which a new plan is computed
CLOSING = 1.0  # m/s; times the time to go it is the same deviation near the end
PATIENCE = 5.0  # s, least time between two plans
END_LOAD = 1.1  # thrust of ZEM/ZEV over the largest thrust, above which another time is chosen
LATE = 1.03  # multiple of the remaining time; a longer plan may use more of the thrust


class ConvexGuidance(ZemZevGuidance):
    """Least propellant within limits of thrust, glide slope and tilt, by convex plans that are tracked.

    A plan has 24 intervals of constant thrust acceleration and 1.02 times the best time of flight. A plan is computed
    at the start and when the vehicle deviates from the last one by 30 m or, if this is less, by 1 m for each second to
    go. In between the vehicle tracks the plan. Below end_time the law is ZEM/ZEV.

    The status is 1, with `limit`, if the plan starts below the glide slope (2); if the target is out of reach and the
    plan has the least miss, or if no new plan meets the target and the old one is still used (8); or if ZEM/ZEV is used
    because no plan exists. It is 2 if position, velocity or mass is not usable for planning, and 3 if no time exists at
    the start. With frozen_time_to_go the law is ZEM/ZEV.

    Assumes constant gravity unless gravity_correction is set.

    Source: Acikmese and Ploen 2007; Blackmore, Acikmese and Scharf 2010; Vandenberghe 2010 (solver, with a Riccati
    recursion); time of flight and tracking: this repository. Problem and solver: docs/theory/convex_guidance.md.
    """

    end_time = Parameter(
        8.0, unit="s", minimum=0.0, description="time to go below which ZEM/ZEV guidance replaces the plan"
    )
    solver_iterations = Output(0, direct=True, description="number of interior-point iterations for the last plan")
    plan = State(
        [0.0] * PLAN,
        frozen=True,
        description=(
            "plan: thrust acceleration per interval, then position, velocity, gravity and logarithm of mass per node"
        ),
    )
    plan_time = State(0.0, unit="s", frozen=True, description="duration of the plan")
    since_plan = State(0.0, unit="s", frozen=True, description="time since the last attempt to compute a plan")
    planned_margin = State(
        1.0,
        unit="1",
        frozen=True,
        description="upper limit of thrust in the next plan, as a fraction of maximum_thrust",
    )
    handed_over = State(False, description="true: ZEM/ZEV guidance has replaced the plan")

    def reset_law(self) -> None:
        self.chosen = False
        self.checked_time = 0.0
        self.choices = 0
        self.limit = 0
        self.handed_over = False
        self.plan_time = 0.0
        self.since_plan = 0.0

    def task(self) -> DescentTask:
        """Return the descent problem from the present state with the limits for plans."""
        return DescentTask(
            position=self.position,
            velocity=self.velocity,
            target=self.aim_position,
            arrival=self.target_velocity,
            mass=self.mass,
            maximum=self.planned_margin * self.maximum_thrust,
            minimum=self.minimum_thrust,
            exhaust=self.exhaust_speed(),
            tilt=self.largest_tilt,
            slope=self.glide_slope,
            depth=self.glide_offset,
            central=self.gravity_correction,
            gravity=self.gravity,
            parameter=self.gravitational_parameter,
            radius=self.moon_radius,
        )

    def take(self, s: PlanSummary, plan: list) -> None:
        """Start to follow a plan."""
        for i in range(PLAN):
            self.plan[i] = plan[i]
        self.plan_time = s.time
        self.predicted_propellant = s.propellant
        self.predicted_miss = s.position_miss
        self.expected_time = s.time

    def plan_first(self) -> None:
        """Compute and follow the first plan, from an estimate of the time, or hand over to ZEM/ZEV."""
        time = self.braking_time()
        lowest = LOWEST_BRAKING
        if not time > 0.0:
            time = self.effort_time(0.0)
            lowest = LOWEST_EFFORT
        self.limit = 0
        self.choices = self.choices + 1
        self.since_plan = 0.0
        self.planned_margin = self.thrust_margin
        self.chosen = False
        if time > 0.0:
            plan = [0.0] * PLAN
            s = self.find_plan(first_bracket(time, lowest), plan)
            self.chosen = s.solved
            if s.solved:
                self.take(s, plan)
                if not is_met(s):
                    self.limit = self.limit + LIMIT_PLACE
        self.handed_over = not self.chosen

    def find_plan(self, bracket: TimeBracket, plan: list) -> PlanSummary:
        """Compute a plan; if the glide slope prevents it, use a lower slope that contains the start, then none."""
        task = self.task()
        first = bracket
        outside = self.glide_slope > 0.0 and self.glide_margin < 0.0
        if outside:
            first = replace(bracket, growths=0)
        s = plan_descent(task, first, plan)
        iterations = s.iterations
        if outside and not s.solved:
            self.limit = LIMIT_GLIDE_SLOPE
            s = plan_descent(replace(task, depth=task.depth + CLEARANCE - self.glide_margin), bracket, plan)
            iterations = iterations + s.iterations
        if self.glide_slope > 0.0 and not s.solved:
            self.limit = LIMIT_GLIDE_SLOPE
            s = plan_descent(replace(task, slope=0.0), bracket, plan)
            iterations = iterations + s.iterations
        self.solver_iterations = iterations
        return s

    def replan(self) -> None:
        """Compute a plan from the present state with about the remaining time; follow it if it meets the target.

        A plan uses all the thrust that it is allowed, so a late correction of the estimate could make the next plan far
        longer; therefore a plan that is longer may use half of the thrust reserve.
        """
        plan = [0.0] * PLAN
        bracket = replan_bracket(self.expected_time)
        self.choices = self.choices + 1
        self.since_plan = 0.0
        self.limit = LIMIT_PLACE
        s = plan_descent(self.task(), bracket, plan)
        iterations = s.iterations
        if is_met(s):
            self.limit = 0
            self.take(s, plan)
        if not is_met(s) or s.time > LATE * bracket.time:
            self.planned_margin = 0.5 * (self.planned_margin + 1.0)
            s = plan_descent(self.task(), bracket, plan)
            iterations = iterations + s.iterations
            if is_met(s):
                self.limit = 0
                self.take(s, plan)
        self.solver_iterations = iterations

    def is_end_due(self) -> bool:
        """Return True if ZEM/ZEV is due: near the end, if it hardly violates a limit, and for the last burn."""
        if self.expected_time <= self.hold_time() + self.cycle:
            return True
        if self.expected_time > self.end_time:
            return False
        cost = self.cost_of(self.expected_time, self.flown_kr, 1.0)
        return cost.depth <= GLIDE_TOLERANCE and cost.tilt_excess <= 0.0 and cost.load <= END_LOAD

    def hand_over(self) -> None:
        """Hand over to ZEM/ZEV with the remaining time, or with another time if the thrust does not suffice."""
        self.handed_over = True
        self.chosen = True
        if self.cost_of(self.expected_time, self.flown_kr, 1.0).load > self.thrust_margin:
            time = self.choose_time()
            if time > 0.0:
                self.expected_time = time
        self.check(self.expected_time)

    def is_sound(self) -> bool:
        """Return True if the estimated state of the vehicle is usable for planning."""
        known = all_below(self.position, LARGEST) and all_below(self.velocity, LARGEST)
        return known and self.mass > SMALLEST_MASS and self.mass < LARGEST and self.maximum_thrust > 0.0

    def solve(self) -> None:
        self.measure_glide()
        if not self.is_sound():
            self.status = TerminalStatus.NOT_CONVERGED
            return
        if self.plan_frozen():
            self.handed_over = True
        elif not self.chosen:
            self.plan_first()
        elif not self.handed_over:
            self.stay_on_course()
        if self.handed_over:
            self.end_linearly()
        else:
            self.track()

    def stay_on_course(self) -> None:
        """Compute a new plan if the deviation requires it, or hand over to ZEM/ZEV if it is due."""
        if self.is_end_due():
            self.hand_over()
            return
        if self.started:
            self.since_plan = self.since_plan + self.cycle
        step = self.plan_time / float(INTERVALS)
        position, _ = reference(self.plan, step, self.plan_time - self.expected_time)
        allowed = clip(CLOSING * self.expected_time, 0.0, OFF_COURSE)
        if norm(position - self.position) > allowed and self.since_plan >= PATIENCE:
            self.replan()

    def track(self) -> None:
        """Command the plan's thrust with a correction for deviations from the plan."""
        self.time_to_go = self.expected_time
        step = self.plan_time / float(INTERVALS)
        elapsed = self.plan_time - self.expected_time
        position, velocity = reference(self.plan, step, elapsed)
        planned = mean_thrust(self.plan, step, elapsed, self.burn_span(self.time_to_go))
        largest = self.maximum_thrust / self.mass
        thrust = tracking_thrust(planned, position - self.position, velocity - self.velocity, largest)
        size = norm(thrust)
        self.command.thrust_acceleration = size
        if size > 0.0:
            self.command.thrust_direction = thrust / size
        self.command.thrust_direction_rate = vector(0.0, 0.0, 0.0)
        self.report()

    def end_linearly(self) -> None:
        """Command ZEM/ZEV guidance."""
        time = self.time_left()
        self.time_to_go = time
        self.report()
        if time > 0.0:
            self.command_profile(time)

    def report(self) -> None:
        """Set the status according to the violated limits."""
        self.status = TerminalStatus.GOOD
        if self.limit > 0:
            self.status = TerminalStatus.CLAMPED
