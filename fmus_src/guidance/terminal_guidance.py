"""Interface of terminal guidance, which steers to a target position and velocity in the time to go."""

from ..block import Block, Input, Output, Outputs, Parameter, State
from ..interfaces.ports import landing, sampling
from ..interfaces.ports.landing import UNLIMITED, TerminalStatus, ThrustCommand
from ..kernel.enumerations import Enumeration, member
from ..kernel.integrators import STEP_ROUNDING
from ..mathlib.lunar.gravity import central_gravity
from ..mathlib.vectors import Vector3, vector

# Least last burn in cycles; a shorter one would need a large thrust for small misses.
LAST_BURN = 1.5
# Largest number of solutions at the start; they end when the time to go changes by less than SETTLED of it.
SETTLING = 20
SETTLED = 1e-10


class TerminalStep(Enumeration):
    """Way in which a terminal guidance ends."""

    STOP = member("stop: finished when time_to_go < sample_period")
    EXACT = member("exact: last command burnt to the end of time_to_go")


class TerminalGuidance(Block, interface=True):
    """Terminal guidance in a landing-site frame: thrust commands until the target state is reached.

    A law defines `solve`, which sets time_to_go, status, thrust and direction from position and velocity; this class
    samples the law, ends the flight and times the last burn. A good solution with time_to_go <= 0 ends the flight and
    keeps the command. With status 2 or 3 the last command is held and time_to_go counts down.

    With gravity_correction, gravity is linear in time from g_0 at the vehicle to g_T at the target, and adds

        Δv = T (g_0 + g_T)/2    Δr = T^2 (g_0/3 + g_T/6)

    with T from the previous sample, or at the start from repeated solutions until T is consistent.

    While `active` is false there is no command, and all states are reset; the next active sample is a new start. When
    divert_count changes, divert_position becomes the target from the next sample on and the law starts again; without a
    solution the last command is held for its remaining time and each sample tries again. During the last burn diverts
    are ignored.

    With frozen_time_to_go the law uses this time at every sample, which makes it a constant feedback law for linear
    stability studies. Other conditions then end the flight, and there is no last burn.

    Frame: landing site (x north, y west, z up), not rotating.
    """

    to_write = ("solve",)

    target_position = landing.POSITION.parameter([0.0, 0.0, 2000.0], "target position relative to the landing site")
    target_velocity = landing.VELOCITY.parameter(description="target velocity relative to the landing site")
    gravity = landing.GRAVITY.parameter()
    gravity_correction = Parameter(
        False, description="true: gravity linear in time between vehicle and target; false: constant gravity"
    )
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter(
        description="gravitational parameter of the Moon, used with gravity_correction"
    )
    moon_radius = landing.MOON_RADIUS.parameter(description="distance of the landing site from the Moon's centre")
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.0, "sample period of the guidance; 0: a sample at every communication point"
    )
    terminal_step = Parameter(TerminalStep)
    last_burn = Parameter(
        0.0,
        unit="s",
        minimum=0.0,
        description="duration for which the last command is held with terminal_step exact",
    )
    frozen_time_to_go = Parameter(
        0.0,
        unit="s",
        minimum=0.0,
        description=(
            "constant time to go of every command, for stability studies; 0: time to go computed at each sample"
        ),
    )
    position = landing.POSITION.input("estimated position of the lander relative to the landing site")
    velocity = landing.VELOCITY.input("estimated velocity of the lander relative to the landing site")
    mass = landing.MASS.input("estimated mass of the lander")
    active = landing.ACTIVE.input("true: guidance active; a change to true restarts the guidance")
    divert_count = Input(0, description="number of diverts since the start; a change makes divert_position the target")
    divert_position = landing.POSITION.input("target position after a divert, relative to the landing site")
    command = Outputs(ThrustCommand, direct=True, thrust_direction=[0.0, 0.0, 1.0], burn_duration=UNLIMITED)
    time_to_go = landing.TIME_TO_GO.output(direct=True)
    status = Output(TerminalStatus, direct=True)
    finished = landing.FINISHED.output("true: target reached, guidance finished", direct=True)
    cycle = State(0.0, unit="s", description="time to the next guidance sample; 0 until the first step")
    under_way = State(False, description="true: guidance was active at the last sample")
    started = State(False, description="true: a command with positive time to go issued for the current target")
    start_time = sampling.START_TIME.state()
    expected_time = State(
        0.0, unit="s", description="time to go expected at the current sample from the previous one; 0 or less: unknown"
    )
    aim_position = landing.POSITION.state(
        "current target position: target_position, or divert_position of the last divert"
    )
    flown_divert = State(0, description="divert_count of the current target")
    commanding = State(
        False, description="true: a command with positive time to go issued for the current or an earlier target"
    )

    def solve(self) -> None:
        """Set the command, time_to_go and status from position and velocity."""

    def remaining(self) -> tuple[Vector3, Vector3]:
        """Return the remaining changes of position (m) and velocity (m/s) in the landing-site frame."""
        return self.remaining_over(self.expected_time)

    def remaining_over(self, time: float) -> tuple[Vector3, Vector3]:
        """Return the remaining changes of position (m) and velocity (m/s), with gravity_correction over ``time`` (s)
        if it is positive.
        """
        dr = self.aim_position - self.position
        dv = self.target_velocity - self.velocity
        if self.gravity_correction and time > 0.0:
            here = central_gravity(self.position, self.moon_radius, self.gravitational_parameter)
            there = central_gravity(self.aim_position, self.moon_radius, self.gravitational_parameter)
            dv = dv - time * 0.5 * (here + there)
            dr = dr - time * time * (here / 3.0 + there / 6.0)
            dv = vector(dv.x, dv.y, dv.z - time * self.gravity)
            dr = vector(dr.x, dr.y, dr.z - 0.5 * time * time * self.gravity)
        return dr, dv

    def plan_frozen(self) -> bool:
        """Return True if time_to_go is held constant."""
        return self.frozen_time_to_go > 0.0

    def planned_time(self, time: float) -> float:
        """Return the time to go (s) for a command: frozen_time_to_go if it is set, otherwise ``time``."""
        if self.plan_frozen():
            return self.frozen_time_to_go
        return time

    def aim(self) -> None:
        """Solve; at a start with gravity_correction, repeat until the time to go is consistent."""
        self.solve()
        if self.gravity_correction and not self.started:
            for _ in range(SETTLING):
                time = self.time_to_go
                change = abs(time - self.expected_time)
                if self.status < TerminalStatus.NOT_CONVERGED and time > 0.0 and change > SETTLED * time:
                    self.expected_time = time
                    self.solve()

    def initialize(self) -> None:
        self.take_target()
        if self.active:
            self.under_way = True
            self.begin(self.start_time)

    def take_target(self) -> None:
        """Set the target to target_position."""
        self.aim_position = self.target_position
        self.flown_divert = self.divert_count

    def divert(self) -> None:
        """Set the target to divert_position."""
        self.aim_position = self.divert_position
        self.flown_divert = self.divert_count

    def begin(self, time: float) -> None:
        """Issue the first command at ``time`` (s)."""
        self.command.command_time = time
        self.cycle = self.sample_period
        self.expected_time = self.planned_time(0.0)
        self.aim()
        self.check_solution()
        if self.status >= TerminalStatus.NOT_CONVERGED:
            self.time_to_go = 0.0
            self.command.thrust_acceleration = 0.0
        elif self.terminal_step == TerminalStep.EXACT and not self.plan_frozen():
            self.command.burn_duration = self.time_to_go

    def check_solution(self) -> None:
        """Set ``started`` after a solution with time left; until then a good status is replaced by no solution."""
        if self.time_to_go > 0.0 and self.status < TerminalStatus.NOT_CONVERGED:
            self.started = True
            self.commanding = True
        if not self.started and self.status < TerminalStatus.NOT_CONVERGED:
            self.status = TerminalStatus.NO_SOLUTION

    def step(self, t: float, h: float) -> None:
        if not self.active:
            if self.under_way:
                self.deactivate()
        elif not self.under_way:
            self.under_way = True
            self.take_target()
            self.begin(t + h)
        else:
            self.process_sample(t, h)

    def deactivate(self) -> None:
        """Deactivate: withdraw the command and reset all states."""
        self.under_way = False
        self.started = False
        self.commanding = False
        self.finished = False
        self.expected_time = 0.0
        self.command.thrust_acceleration = 0.0
        self.command.thrust_direction_rate = vector(0.0, 0.0, 0.0)
        self.command.burn_duration = UNLIMITED
        self.time_to_go = 0.0
        self.status = TerminalStatus.GOOD
        self.reset_law()

    def reset_law(self) -> None:
        """Reset the states of a derived law to their start values; no action unless overridden."""

    def process_sample(self, t: float, h: float) -> None:
        """Process the sample at t + h (s): hold the command of a last burn, finish, or issue a new command."""
        if not self.finished:
            self.cycle = self.sample_period
            if self.cycle <= 0.0:
                self.cycle = h
            burn_left = self.command.command_time + self.command.burn_duration - t - h
            if (
                self.terminal_step == TerminalStep.STOP
                or not self.commanding
                or burn_left > self.hold_time() - self.cycle
            ):
                self.follow(t + h)
            elif burn_left > self.cycle * STEP_ROUNDING:
                self.time_to_go = burn_left
            else:
                self.finish(t + h)

    def burn_span(self, time: float) -> float:
        """Return the duration (s) of a command with ``time`` (s) to go."""
        held = self.hold_time()
        if self.plan_frozen():
            held = self.cycle  # no last burn
        if time <= held:
            return time
        return self.cycle

    def hold_time(self) -> float:
        """Return the longest time (s) for which the last command is held."""
        held = LAST_BURN * self.cycle
        if self.last_burn > held:
            held = self.last_burn
        return held

    def finish(self, time: float) -> None:
        """End the flight at ``time`` (s)."""
        self.finished = True
        self.command.thrust_acceleration = 0.0
        self.time_to_go = 0.0
        self.command.burn_duration = 0.0
        self.command.command_time = time

    def follow(self, time: float) -> None:
        """Process the sample at ``time`` (s): a command, the last burn or the end."""
        left = self.planned_time(self.time_to_go - self.cycle)
        self.expected_time = left
        if self.divert_count != self.flown_divert:
            self.divert()
            self.started = False
            self.reset_law()
        if self.commanding and not self.started:
            self.expected_time = self.planned_time(0.0)
        self.aim()
        self.check_solution()
        if self.status >= TerminalStatus.NOT_CONVERGED:
            self.time_to_go = left
            if not self.commanding:
                self.time_to_go = 0.0
                self.command.thrust_acceleration = 0.0
        elif self.time_to_go > 0.0:
            self.command.command_time = time
        if self.commanding and not self.plan_frozen():
            self.end(time)

    def end(self, time: float) -> None:
        """End at ``time`` (s): with the last burn if it is due, or immediately if less than a cycle is left."""
        if self.terminal_step == TerminalStep.EXACT:
            self.command.burn_duration = UNLIMITED
            if self.time_to_go <= self.hold_time():
                # the duration is measured from command_time, which is earlier if the last command is held
                self.command.burn_duration = time - self.command.command_time + self.time_to_go
        elif self.time_to_go < self.cycle:
            self.finished = True
            self.command.thrust_acceleration = 0.0
