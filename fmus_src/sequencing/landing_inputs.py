"""Inputs of the landing sequencer, sampled once in each of its cycles."""

from ..block import Block, Input, Parameter, State
from ..interfaces.ports import landing
from ..interfaces.ports.landing import HoverStatus, TerminalStatus

CYCLE_TOLERANCE = 1e-6  # of a cycle: communication points carry rounding
TIME_TOLERANCE = 1e-15  # of the time


class LandingInputs(Block, interface=True):
    """Inputs of a landing's sequencer, sampled at start + k cycle and held until the decision at start + (k + 1) cycle.

    What is decided from them holds one cycle after they were sampled, whatever the communication step, so that events
    such as the contact of the probe act with the same delay at every step that divides the cycle. Where communication
    points miss these times, the next one is taken. The sampled values are in the states ``sampled_...``.
    Frame: landing site.
    """

    cycle = Parameter(0.1, unit="s", minimum=0.0, description="time between decisions; 0: every communication point")
    estimated_position = landing.POSITION.input()
    estimated_velocity = landing.VELOCITY.input()
    mass = landing.MASS.input("mass of the vehicle")
    attitude = landing.DIRECTION.input("measured unit vector of thrust")
    braking_direction = landing.DIRECTION.input("thrust direction of the braking guidance")
    braking_command_time = Input(
        0.0, unit="s", description="of the braking guidance; what it puts out counts only from the braking's start on"
    )
    braking_time_to_go = Input(0.0, unit="s", description="of the braking guidance")
    braking_status = Input(TerminalStatus, description="of the braking guidance")
    braking_finished = Input(False, description="the braking guidance has ended its flight")
    hover_plan = landing.HOVER_PLAN.input("plan_number that the hover guidance's outputs belong to")
    hover_finished = Input(False, description="the plan of the hover guidance is over")
    hover_status = Input(HoverStatus, description="of the hover guidance")
    predicted_propellant = landing.PREDICTED_PROPELLANT.input("propellant that the hover guidance's plan needs")
    probe_contact = landing.PROBE_CONTACT.input()
    ground_contact = landing.GROUND_CONTACT.input()
    redesignation_1 = Input(
        [0.0, 0.0], unit="m", frame="landing site", description="move of the site, x and y, read when hover 1 ends"
    )
    redesignation_2 = Input(
        [0.0, 0.0], unit="m", frame="landing site", description="move of the site, x and y, read when hover 2 ends"
    )
    divert_count = Input(
        0, description="of diverts of the braking guidance; a change during the braking moves the site"
    )
    divert_position = landing.POSITION.input("target of the braking after a divert, above the new site")
    sampled_time = State(0.0, unit="s", description="when the inputs were sampled")
    sampled_position = State([0.0, 0.0, 0.0], unit="m", frame="landing site", description="estimated_position then")
    sampled_velocity = State([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="estimated_velocity then")
    sampled_mass = State(1.0, unit="kg", description="mass then")
    sampled_attitude = State([0.0, 0.0, 1.0], unit="1", frame="landing site", description="attitude then")
    sampled_direction = State([0.0, 0.0, 1.0], unit="1", frame="landing site", description="braking_direction then")
    sampled_command_time = State(0.0, unit="s", description="braking_command_time then")
    sampled_time_to_go = State(0.0, unit="s", description="braking_time_to_go then")
    sampled_braking_status = State(TerminalStatus, description="braking_status then")
    sampled_braking_finished = State(False, description="braking_finished then")
    sampled_plan = State(0, description="hover_plan then")
    sampled_hover_finished = State(False, description="hover_finished then")
    sampled_hover_status = State(HoverStatus, description="hover_status then")
    sampled_propellant = State(0.0, unit="kg", description="predicted_propellant then")
    sampled_probe_contact = State(False, description="probe_contact then")
    sampled_ground_contact = State(False, description="ground_contact then")
    sampled_move_1 = State([0.0, 0.0], unit="m", frame="landing site", description="redesignation_1 then")
    sampled_move_2 = State([0.0, 0.0], unit="m", frame="landing site", description="redesignation_2 then")
    sampled_divert = State(0, description="divert_count then")
    sampled_divert_position = State([0.0, 0.0, 0.0], unit="m", frame="landing site", description="divert_position then")
    is_sampled = State(False, description="the inputs of the cycle under way have been sampled")
    cycles = State(0, description="cycles completed")
    start_time = State(0.0, unit="s", description="start of the flight")

    def sample_inputs(self, time: float) -> None:
        """Copy the inputs, which are those of ``time`` (s)."""
        self.sampled_time = time
        self.sampled_position = self.estimated_position
        self.sampled_velocity = self.estimated_velocity
        self.sampled_mass = self.mass
        self.sampled_attitude = self.attitude
        self.sampled_direction = self.braking_direction
        self.sampled_command_time = self.braking_command_time
        self.sampled_time_to_go = self.braking_time_to_go
        self.sampled_braking_status = self.braking_status
        self.sampled_braking_finished = self.braking_finished
        self.sampled_plan = self.hover_plan
        self.sampled_hover_finished = self.hover_finished
        self.sampled_hover_status = self.hover_status
        self.sampled_divert = self.divert_count
        self.sampled_divert_position = self.divert_position
        self.sampled_propellant = self.predicted_propellant
        self.sampled_probe_contact = self.probe_contact
        self.sampled_ground_contact = self.ground_contact
        self.sampled_move_1 = self.redesignation_1
        self.sampled_move_2 = self.redesignation_2
        self.is_sampled = True

    def is_due(self, time: float) -> bool:
        """Return True if a cycle is over at ``time`` (s), which then counts as its end."""
        if self.cycle > 0.0:
            margin = CYCLE_TOLERANCE * self.cycle + TIME_TOLERANCE * abs(time)
            completed = int((time - self.start_time + margin) / self.cycle)
            if completed <= self.cycles:
                return False
            self.cycles = completed
        return True
