"""What the phases of a landing share: connectors, the order of phases, what is remembered of each, statuses."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.vectors import vector

REFUSED_PHASE = 0
DEORBIT = 1
COAST = 2
BRAKING = 3
HOVER_1 = 4
TRANSFER = 5
HOVER_2 = 6
APPROACH = 7
DESCENT = 8
CONTACT = 9

NO_SOURCE = 0
OWN = 1
BRAKING_GUIDANCE = 2
HOVER_GUIDANCE = 3

# Modes of hover_guidance
IDLE = 0
HOLD = 1
PROGRAMME = 2
SLOW = 3
CAPTURE = 4
SINK = 5

GOOD = 0
SHORTENED = 1
HOVER_GUIDANCE_SAID = 2
TIMEOUT = 3
SITE_MOVED = 4
DROPPED = 5
CUT_OFF = 6
OUT_OF_PROPELLANT = 7
BRAKING_FAILED = 8
REFUSED = 9

NEVER = -1.0  # s; the time of what has not happened
ROUNDING = 1e-6  # s, allowed for in times of communication points


class LandingSequence(Block, interface=True):
    """Phases of a landing, entered one after another, with the command that each of them gives.

    Phases: 1 deorbit, 2 coast, 3 braking, 4 hover 1, 5 transfer, 6 hover 2, 7 approach, 8 descent, 9 contact. They only
    go on. No output depends directly on an input: what is decided from the values of t_n holds from t_(n+1). A status
    is remembered with its first time, and `status` is the largest so far.
    Frame: landing site, not rotating; the Moon's centre is moon_radius below the origin.
    """

    start_phase = Parameter(1, description="phase to begin with, 1 to 9")
    moon_radius = Parameter(1.7374e6, unit="m", minimum=1.0, description="of the sphere that the site lies on")
    gravitational_parameter = Parameter(4.9028e12, unit="m3/s2", minimum=0.0, description="of the Moon")
    minimum_thrust = Parameter(340.0, unit="N", minimum=0.0, description="least thrust of the engine")
    maximum_thrust = Parameter(5099.0, unit="N", minimum=0.0, description="largest thrust of the engine")
    dry_mass = Parameter(440.0, unit="kg", minimum=0.0, description="mass without propellant")
    probe_length = Parameter(1.5, unit="m", minimum=0.0, description="altitude at which the probe touches the ground")
    preliminary_altitude = Parameter(2400.0, unit="m", description="altitude of hover 1, to which braking goes")
    final_altitude = Parameter(100.0, unit="m", description="altitude of hover 2, to which the transfer goes")
    cutoff_altitude = Parameter(4.0, unit="m", description="altitude of the hover that the approach goes to")
    estimated_position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="position")
    estimated_velocity = Input([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity")
    mass = Input(1.0, unit="kg", description="mass of the vehicle")
    attitude = Input([0.0, 0.0, 1.0], unit="1", frame="landing site", description="measured unit vector of thrust")
    braking_direction = Input(
        [0.0, 0.0, 1.0], unit="1", frame="landing site", description="thrust direction of the braking guidance"
    )
    braking_time_to_go = Input(0.0, unit="s", description="of the braking guidance")
    braking_status = Input(0, description="of the braking guidance; 2 and more: no solution of its own")
    braking_finished = Input(False, description="the braking guidance has ended its flight")
    hover_finished = Input(False, description="the plan of the hover guidance is over")
    hover_status = Input(0, description="of the hover guidance; 0 good")
    predicted_propellant = Input(0.0, unit="kg", description="what the hover guidance's plan needs")
    probe_contact = Input(False, description="the probe has touched the ground")
    ground_contact = Input(False, description="the ground was reached")
    redesignation_1 = Input(
        [0.0, 0.0], unit="m", frame="landing site", description="move of the site, x and y, read when hover 1 ends"
    )
    redesignation_2 = Input(
        [0.0, 0.0], unit="m", frame="landing site", description="move of the site, x and y, read when hover 2 ends"
    )
    phase = Output(0, minimum=0, maximum=9, description="1 to 9, see the block; 0: refused")
    braking_active = Output(False, description="the braking guidance is to command")
    hover_active = Output(False, description="the hover guidance is to command")
    hover_mode = Output(
        IDLE, minimum=0, maximum=5, description="0 idle, 1 hold, 2 programme, 3 slow, 4 capture, 5 sink"
    )
    plan_number = Output(0, description="a change tells the hover guidance to begin anew")
    target_position = Output([0.0, 0.0, 0.0], unit="m", frame="landing site", description="of the hover guidance")
    site = Output([0.0, 0.0, 0.0], unit="m", frame="landing site", description="where to land, on the sphere")
    source = Output(
        NO_SOURCE, minimum=0, maximum=3, description="whose command counts: 0 nobody's, 1 own, 2 braking, 3 hover"
    )
    engine_on = Output(False, description="the command's thrust is given")
    thrust_acceleration = Output(0.0, unit="m/s2", description="own command: thrust over mass")
    thrust_direction = Output(
        [0.0, 0.0, 0.0], unit="1", frame="landing site", description="own command: unit vector at command_time; 0: none"
    )
    thrust_direction_rate = Output(
        [0.0, 0.0, 0.0], unit="1/s", frame="landing site", description="own command: its derivative"
    )
    command_time = Output(0.0, unit="s", description="own command: when it was computed")
    burn_duration = Output(0.0, unit="s", description="own command: how long to thrust from command_time on")
    free_flight = Output(False, description="no thrust acts; for navigation")
    status = Output(
        GOOD,
        minimum=0,
        maximum=9,
        description="largest so far: 1 re-designation shortened, 2 hover guidance said so, 3 timeout, 4 site moved, "
        "5 re-designation dropped, 6 cut off without the probe, 7 out of propellant, 8 braking failed, 9 refused",
    )
    status_time = Output([NEVER] * 9, unit="s", description="first time of each status from 1 on; -1: never")
    phase_time = Output([NEVER] * 9, unit="s", description="start of each phase; -1: never")
    phase_mass = Output([0.0] * 9, unit="kg", description="mass at the start of each phase; 0: never")
    finished = Output(False, description="the flight is over")
    start_time = State(0.0, unit="s", description="start of the flight")

    def note(self, status: int, time: float) -> None:
        """Remember a status at ``time`` (s)."""
        if self.status_time[status - 1] < 0.0:
            self.status_time[status - 1] = time
        if status > self.status:
            self.status = status

    def open_phase(self, phase: int, time: float) -> None:
        """Go on to a phase, which holds from ``time`` (s)."""
        self.phase = phase
        self.phase_time[phase - 1] = time
        self.phase_mass[phase - 1] = self.mass

    def since_start(self, time: float) -> float:
        """How long (s) the phase has gone on at ``time``."""
        return time - self.phase_time[self.phase - 1]

    def take_over(self, source: int, engine_on: bool) -> None:
        """Give the command to a source."""
        self.source = source
        self.engine_on = engine_on
        self.braking_active = source == BRAKING_GUIDANCE
        self.hover_active = source == HOVER_GUIDANCE
        if source != HOVER_GUIDANCE:
            self.hover_mode = IDLE
        if source != OWN:
            self.thrust_acceleration = 0.0
            self.thrust_direction = vector(0.0, 0.0, 0.0)
            self.thrust_direction_rate = vector(0.0, 0.0, 0.0)
            self.burn_duration = 0.0

    def hover(self, mode: int) -> None:
        """Give the command to the hover guidance, with a plan of its own."""
        self.take_over(HOVER_GUIDANCE, True)
        self.hover_mode = mode
        self.plan_number = self.plan_number + 1
