"""Shared state of the phases of a landing: connectors, order of phases, statuses."""

from ..block import Output, Outputs, Parameter, State
from ..interfaces.ports import landing
from ..interfaces.ports.landing import CommandSource, HoverMode, ThrustCommand
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import vector
from .landing_inputs import LandingInputs

NEVER = -1.0  # s; time of an event that has not occurred
ROUNDING = 1e-6  # s, rounding allowed in times of communication points


class LandingPhase(Enumeration):
    """Phase of a landing."""

    REFUSED = member("refused")
    DEORBIT = member("deorbit")
    COAST = member("coast")
    BRAKING = member("braking")
    HOVER_1 = member("hover 1")
    TRANSFER = member("transfer")
    HOVER_2 = member("hover 2")
    APPROACH = member("approach")
    DESCENT = member("descent")
    CONTACT = member("contact")


class LandingStatus(Enumeration):
    """Deviation from the nominal sequence."""

    GOOD = member("good")
    SHORTENED = member("re-designation shortened")
    HOVER_GUIDANCE_SAID = member("fault reported by the hover guidance")
    TIMEOUT = member("timeout")
    SITE_MOVED = member("site moved")
    DROPPED = member("re-designation dropped")
    CUT_OFF = member("engine cut off without probe contact")
    OUT_OF_PROPELLANT = member("out of propellant")
    BRAKING_FAILED = member("braking failed")
    REFUSED = member("refused")


class LandingSequence(LandingInputs, interface=True):
    """Phases of a landing in sequence, with a command for each.

    Phases only advance. No output depends directly on an input. `status_flags` contains all statuses so far, each of
    which is stored with its first time; `status` is the largest of them. A new `plan_number` requests a plan from the
    hover guidance; outputs of the hover guidance are ignored until it returns this number.

    Frame: landing site, not rotating; the Moon's centre is moon_radius below the origin.
    """

    start_phase = Parameter(
        LandingPhase.DEORBIT, description="phase of the landing at the start of the simulation, 1 to 9"
    )
    moon_radius = landing.MOON_RADIUS.parameter()
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter()
    minimum_thrust = landing.MINIMUM_THRUST.parameter(340.0, "least thrust of the burning engine")
    maximum_thrust = landing.MAXIMUM_THRUST.parameter(description="largest thrust of the engine")
    dry_mass = Parameter(440.0, unit="kg", minimum=0.0, description="mass of the lander without propellant")
    probe_length = landing.PROBE_LENGTH.parameter()
    preliminary_altitude = Parameter(2400.0, unit="m", description="target altitude of hover 1, after braking")
    final_altitude = Parameter(100.0, unit="m", description="target altitude of hover 2, after the transfer")
    cutoff_altitude = Parameter(4.0, unit="m", description="target altitude of the hover after the approach")
    phase = Output(LandingPhase, description="current phase of the landing")
    braking_active = Output(False, description="true: braking guidance active")
    hover_active = Output(False, description="true: hover guidance active")
    hover_mode = Output(HoverMode)
    plan_number = landing.PLAN_NUMBER.output(
        "number of the plan requested from the hover guidance; a change requests a new plan"
    )
    target_position = landing.POSITION.output(
        "target position of the hover guidance relative to the initial landing site"
    )
    site = landing.POSITION.output(
        "position of the landing site on the sphere of moon_radius, relative to the initial landing site"
    )
    source = Output(CommandSource, description="source of the current command")
    engine_on = landing.ENGINE_ON.output("true: engine to burn")
    command = Outputs(ThrustCommand, about="command of the sequencer:")
    free_flight = landing.FREE_FLIGHT.output("true: free flight without thrust, for navigation")
    status = Output(LandingStatus, description="highest status since the start")
    status_flags = Output(
        0,
        minimum=0,
        maximum=511,
        description="all statuses since the start: sum of 2^(k - 1) over each status k that occurred",
    )
    status_time = Output(
        [NEVER] * 9, unit="s", description="time of the first occurrence of each status from 1 on; -1: not occurred"
    )
    phase_time = Output([NEVER] * 9, unit="s", description="start time of each phase; -1: not started")
    phase_mass = Output(
        [0.0] * 9,
        unit="kg",
        description="mass of the lander one decision period after the start of each phase; 0: not started",
    )
    finished = landing.FINISHED.output()
    mass_is_known = State(False, description="true: phase_mass of the current phase set")

    def record_status(self, status: int, time: float) -> None:
        """Record a status at ``time`` (s)."""
        if self.status_time[status - 1] < 0.0:
            self.status_time[status - 1] = time
            flag = 1
            for _ in range(status - 1):
                flag = 2 * flag
            self.status_flags = self.status_flags + flag
        if status > self.status:
            self.status = status

    def open_phase(self, phase: int, time: float) -> None:
        """Set the phase that begins at ``time`` (s)."""
        self.phase = phase
        self.phase_time[phase - 1] = time
        self.mass_is_known = False

    def since_start(self, time: float) -> float:
        """Return the time (s) from the start of the phase to ``time``."""
        return time - self.phase_time[self.phase - 1]

    def take_over(self, source: int, engine_on: bool) -> None:
        """Make ``source`` the source of the command."""
        self.source = source
        self.engine_on = engine_on
        self.braking_active = source == CommandSource.BRAKING
        self.hover_active = source == CommandSource.HOVER
        if source != CommandSource.HOVER:
            self.hover_mode = HoverMode.IDLE
        if source != CommandSource.OWN:
            self.command.thrust_acceleration = 0.0
            self.command.thrust_direction = vector(0.0, 0.0, 0.0)
            self.command.thrust_direction_rate = vector(0.0, 0.0, 0.0)
            self.command.burn_duration = 0.0

    def request_plan(self, mode: int) -> None:
        """Request a new plan from the hover guidance and make it the source of the command."""
        self.take_over(CommandSource.HOVER, True)
        self.hover_mode = mode
        self.plan_number = self.plan_number + 1

    def is_answered(self) -> bool:
        """Return True if the hover guidance's outputs belong to the requested plan."""
        return self.source == CommandSource.HOVER and self.sampled_plan == self.plan_number

    def plan_is_over(self) -> bool:
        """Return True if the requested plan is complete."""
        return self.is_answered() and self.sampled_hover_finished
