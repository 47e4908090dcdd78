"""Powered explicit guidance for a descent, with one phase of constant thrust."""

from ..block import Parameter, State
from ..interfaces.ports.landing import TerminalStatus
from ..kernel.records import replace
from ..mathlib.lunar.gravity import central_gravity
from ..mathlib.lunar.powered_explicit import (
    SETTLED,
    SteeringProblem,
    SteeringState,
    has_solution,
    iterate_steering,
)
from ..mathlib.vectors import across, clip, norm, vector
from .informed_guidance import LIMIT_THRUST
from .zem_zev import ZemZevGuidance

FIRST_ITERATIONS = 40
ITERATIONS = 3  # per cycle after the first
FIRST_THRUST = 0.85  # fraction of the largest thrust


class PoweredGuidance(ZemZevGuidance):
    """Linear-tangent steering with the constant thrust that meets the range, and ZEM/ZEV near the end.

    There are three iterations per sample. Above end_time the law commands the constant thrust that meets position and
    velocity. Below end_time the law is ZEM/ZEV with the time to go at the hand-over, or with another time if the thrust
    would exceed thrust_margin times maximum_thrust. The status is 1 if the thrust is limited by minimum_thrust or
    maximum_thrust, 2 if an iteration has no solution, and 3 if the iteration does not converge at the start, as in
    hovering descents. With frozen_time_to_go the law is ZEM/ZEV.

    Assumes constant gravity unless gravity_correction is set, and a known exhaust speed.

    Source: Jaggers 1977; McHenry et al. 1979; thrust as an unknown: this repository.
    """

    end_time = Parameter(
        40.0,
        unit="s",
        minimum=0.0,
        description="time to go below which ZEM/ZEV guidance replaces linear-tangent steering",
    )
    steering = State(SteeringState)
    handed_over = State(False, description="true: ZEM/ZEV guidance has replaced linear-tangent steering")

    def reset_law(self) -> None:
        self.chosen = False
        self.checked_time = 0.0
        self.choices = 0
        self.limit = 0
        self.handed_over = False

    def problem(self, time: float) -> SteeringProblem:
        """Return the remaining changes of position and velocity over ``time`` (s), with the engine data."""
        dr = self.aim_position - self.position
        dv = self.target_velocity - self.velocity
        here = vector(0.0, 0.0, -self.gravity)
        there = here
        if self.gravity_correction:
            here = central_gravity(self.position, self.moon_radius, self.gravitational_parameter)
            there = central_gravity(self.aim_position, self.moon_radius, self.gravitational_parameter)
        return SteeringProblem(
            way=dr - time * time * (here / 3.0 + there / 6.0),
            gain=dv - 0.5 * time * (here + there),
            velocity=self.velocity,
            mass=self.mass,
            exhaust=self.exhaust_speed(),
            minimum=self.minimum_thrust,
            maximum=self.maximum_thrust,
        )

    def iterate(self, time: float, count: int) -> None:
        """Iterate at most ``count`` times, starting from a time to go (s)."""
        self.steering = replace(self.steering, time=time, change=1.0)
        for _ in range(count):
            if self.steering.change > SETTLED:
                self.steering = iterate_steering(self.steering, self.problem(self.steering.time))

    def begin_steering(self) -> None:
        """Perform the first iterations, starting from the time to go of about constant thrust."""
        self.steering = SteeringState(
            time=0.0,
            thrust=FIRST_THRUST * self.maximum_thrust,
            direction=vector(0.0, 0.0, 1.0),
            turning=vector(0.0, 0.0, 0.0),
            centre=0.0,
            change=1.0,
        )
        self.iterate(self.first_time(), FIRST_ITERATIONS)
        self.choices = self.choices + 1

    def solve(self) -> None:
        self.measure_glide()
        if self.plan_frozen():
            self.handed_over = True
        if not self.handed_over:
            self.steer()
        if self.handed_over:
            self.end_linearly()

    def steer(self) -> None:
        """Command the constant thrust, or hand over to ZEM/ZEV."""
        self.status = TerminalStatus.GOOD
        self.limit = 0
        if not self.started:
            if not self.chosen:
                self.begin_steering()
                self.chosen = has_solution(self.steering) and self.steering.change <= SETTLED
            if not self.chosen:
                self.status = TerminalStatus.NO_SOLUTION
                self.time_to_go = 0.0
                return
        else:
            self.iterate(self.expected_time, ITERATIONS)
        if not has_solution(self.steering):
            self.status = TerminalStatus.NOT_CONVERGED
            return
        self.time_to_go = self.steering.time
        if self.steering.time <= self.end_time:
            self.handed_over = True
            self.expected_time = self.steering.time
        else:
            self.command_constant_thrust()

    def command_constant_thrust(self) -> None:
        """Command thrust, direction and direction rate of the linear-tangent steering."""
        s = self.steering
        thrust = clip(s.thrust, self.minimum_thrust, self.maximum_thrust)
        if thrust != s.thrust:
            self.status = TerminalStatus.CLAMPED
            self.limit = LIMIT_THRUST
        leaning = s.direction - s.centre * s.turning
        length = norm(leaning)
        direction = leaning / length
        self.command.thrust_acceleration = thrust / self.mass
        self.command.thrust_direction = direction
        self.command.thrust_direction_rate = across(s.turning, direction) / length
        self.predicted_propellant = thrust / self.exhaust_speed() * s.time

    def end_linearly(self) -> None:
        """Command ZEM/ZEV; choose another time at the hand-over only if the thrust does not suffice."""
        time = self.expected_time
        if self.plan_frozen():
            time = self.frozen_time_to_go
        elif self.checked_time <= 0.0:
            if self.cost_of(time, self.flown_kr, 1.0).load > self.thrust_margin:
                choice = self.choose_time()
                if choice > 0.0:
                    time = choice
            self.check(time)
        self.status = TerminalStatus.GOOD
        if self.limit > 0:
            self.status = TerminalStatus.CLAMPED
        self.time_to_go = time
        if time > 0.0:
            self.command_profile(time)
