"""The slot of terminal guidance: bring the vehicle to a position and velocity at time_to_go."""

from ..block import Block, Input, Output, Parameter, State

GOOD = 0
CLAMPED = 1
NOT_CONVERGED = 2
NO_SOLUTION = 3
UNLIMITED = 1e9  # s; longer than any flight
ROUNDING = 1e-9  # of a cycle, allowed for in times of communication points
# Cycles; a last burn is never a sliver of one, in which small misses would ask for a large thrust.
LAST_BURN = 1.5


class TerminalGuidance(Block, interface=True):
    """Terminal guidance in a landing-site frame: thrust command until the target state is met.

    Frame: origin at the site, x north, y west, z up; not rotating. A guidance writes `solve`,
    which sets time_to_go, thrust_acceleration, thrust_direction, its rate and status from
    position and velocity; this class samples it, ends the flight and times the last burn.
    A solve that is good with time_to_go <= 0 says that time is up and leaves the command. With
    status not converged or no solution the last command is held and time_to_go counts down.
    """

    target_position = Parameter([0.0, 0.0, 2000.0], unit="m", frame="landing site", description="where to arrive")
    target_velocity = Parameter(
        [0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity to arrive with"
    )
    gravity = Parameter(1.62, unit="m/s2", minimum=0.0, description="gravity, constant, along -z")
    sample_period = Parameter(0.0, unit="s", minimum=0.0, description="guidance cycle; 0: every communication point")
    terminal_step = Parameter(
        0,
        minimum=0,
        maximum=1,
        description="0 stop: finished when time_to_go < cycle; 1 exact: burn the last 0.5 to 1.5 cycles to the end",
    )
    position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="estimated position")
    velocity = Input([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="estimated velocity")
    mass = Input(1.0, unit="kg", description="estimated mass")
    thrust_acceleration = Output(0.0, unit="m/s2", direct=True, description="commanded thrust over mass")
    thrust_direction = Output(
        [0.0, 0.0, 1.0],
        unit="1",
        frame="landing site",
        direct=True,
        description="commanded unit vector at command_time",
    )
    thrust_direction_rate = Output(
        [0.0, 0.0, 0.0],
        unit="1/s",
        frame="landing site",
        direct=True,
        description="its derivative, perpendicular to it",
    )
    command_time = Output(0.0, unit="s", direct=True, description="when the command was computed")
    burn_duration = Output(UNLIMITED, unit="s", direct=True, description="how long to thrust from command_time on")
    time_to_go = Output(0.0, unit="s", direct=True, description="time left to the target state")
    status = Output(
        0, minimum=0, maximum=3, direct=True, description="0 good, 1 clamped, 2 not converged, 3 no solution"
    )
    finished = Output(False, direct=True, description="the flight is over")
    cycle = State(0.0, unit="s", description="time to the next sample; 0 until the first step")
    started = State(False, description="a command with time left has been given")
    start_time = State(0.0, unit="s", description="start of the flight")

    def solve(self) -> None:
        """Set the command, time_to_go and status from position and velocity."""

    def remaining(self, dr: list, dv: list) -> None:
        """dr (m) and dv (m/s): position and velocity still to gain, landing-site frame."""
        for i in range(3):
            dr[i] = self.target_position[i] - self.position[i]
            dv[i] = self.target_velocity[i] - self.velocity[i]

    def initialize(self) -> None:
        self.command_time = self.start_time
        self.cycle = self.sample_period
        self.solve()
        self.judge()
        if self.status >= NOT_CONVERGED:
            self.time_to_go = 0.0
        elif self.terminal_step == 1:
            self.burn_duration = self.time_to_go

    def judge(self) -> None:
        """Tell time that is up from time that never was."""
        if self.time_to_go > 0.0 and self.status < NOT_CONVERGED:
            self.started = True
        if not self.started and self.status < NOT_CONVERGED:
            self.status = NO_SOLUTION

    def step(self, t: float, h: float) -> None:
        if not self.finished:
            self.cycle = self.sample_period
            if self.cycle <= 0.0:
                self.cycle = h
            burn_left = self.command_time + self.burn_duration - t - h
            if self.terminal_step == 0 or not self.started or burn_left > (LAST_BURN - 1.0) * self.cycle:
                self.follow(t + h)
            elif burn_left > self.cycle * ROUNDING:
                self.time_to_go = burn_left
            else:
                self.finish(t + h)

    def finish(self, time: float) -> None:
        """End the flight at ``time`` (s)."""
        self.finished = True
        self.thrust_acceleration = 0.0
        self.time_to_go = 0.0
        self.burn_duration = 0.0
        self.command_time = time

    def follow(self, time: float) -> None:
        """Command for the sample at ``time`` (s), or the end, or the last burn."""
        left = self.time_to_go - self.cycle
        self.solve()
        self.judge()
        if self.status >= NOT_CONVERGED:
            self.time_to_go = left
            if not self.started:
                self.time_to_go = 0.0
        elif self.time_to_go > 0.0:
            self.command_time = time
        if self.started and self.terminal_step == 1:
            self.burn_duration = UNLIMITED
            if self.time_to_go <= LAST_BURN * self.cycle:
                # from command_time on, which is earlier where the last command is held
                self.burn_duration = time - self.command_time + self.time_to_go
        elif self.started and self.time_to_go < self.cycle:
            self.finished = True
            self.thrust_acceleration = 0.0
