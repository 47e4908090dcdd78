"""Inputs of the landing sequencer, sampled once per decision period."""

from ..block import Block, Input, Parameter, State
from ..interfaces.ports import landing
from ..interfaces.ports.landing import HoverStatus, TerminalStatus

CYCLE_TOLERANCE = 1e-6  # fraction of a cycle, since communication points contain rounding errors
TIME_TOLERANCE = 1e-15  # fraction of the time


class LandingInputs(Block, interface=True):
    """Inputs of a landing sequencer, sampled at start + k cycle and used at start + (k + 1) cycle.

    Decisions lag their inputs by one cycle, so events such as contact of the probe take effect with the same delay for
    every communication step that divides the cycle. A decision time between communication points moves to the next one.

    Frame: landing site.
    """

    cycle = Parameter(
        0.1,
        unit="s",
        minimum=0.0,
        description="decision period of the sequencer; 0: a decision at every communication point",
    )
    estimated_position = landing.POSITION.input("estimated position of the lander relative to the landing site")
    estimated_velocity = landing.VELOCITY.input("estimated velocity of the lander relative to the landing site")
    mass = landing.MASS.input("mass of the lander")
    attitude = landing.DIRECTION.input("measured direction of the thrust axis, unit vector")
    braking_direction = landing.DIRECTION.input("thrust direction commanded by the braking guidance, unit vector")
    braking_command_time = Input(0.0, unit="s", description="reference time of the command of the braking guidance")
    braking_time_to_go = Input(0.0, unit="s", description="time to go of the braking guidance")
    braking_status = Input(TerminalStatus, description="status of the braking guidance")
    braking_finished = Input(False, description="true: braking guidance finished")
    hover_plan = landing.HOVER_PLAN.input("plan_number of the plan that the outputs of the hover guidance follow")
    hover_finished = Input(False, description="true: plan of the hover guidance completed")
    hover_status = Input(HoverStatus, description="status of the hover guidance")
    predicted_propellant = landing.PREDICTED_PROPELLANT.input(
        "predicted propellant consumption of the plan of the hover guidance"
    )
    probe_contact = landing.PROBE_CONTACT.input()
    ground_contact = landing.GROUND_CONTACT.input()
    redesignation_1 = Input(
        [0.0, 0.0],
        unit="m",
        frame="landing site",
        description="first re-designation: offset of the landing site along x and y, read at the end of hover 1",
    )
    redesignation_2 = Input(
        [0.0, 0.0],
        unit="m",
        frame="landing site",
        description="second re-designation: offset of the landing site along x and y, read at the end of hover 2",
    )
    divert_count = Input(
        0, description="number of diverts of the braking guidance; a change during braking moves the landing site"
    )
    divert_position = landing.POSITION.input(
        "target position of the braking guidance after a divert, above the new landing site"
    )
    sampled_time = State(0.0, unit="s", description="time at which the inputs of this decision period were sampled")
    sampled_position = State(
        [0.0, 0.0, 0.0],
        unit="m",
        frame="landing site",
        description="estimated position of the lander, sampled for this decision period",
    )
    sampled_velocity = State(
        [0.0, 0.0, 0.0],
        unit="m/s",
        frame="landing site",
        description="estimated velocity of the lander, sampled for this decision period",
    )
    sampled_mass = State(1.0, unit="kg", description="mass of the lander, sampled for this decision period")
    sampled_attitude = State(
        [0.0, 0.0, 1.0],
        unit="1",
        frame="landing site",
        description="measured direction of the thrust axis, sampled for this decision period",
    )
    sampled_direction = State(
        [0.0, 0.0, 1.0],
        unit="1",
        frame="landing site",
        description="thrust direction commanded by the braking guidance, sampled for this decision period",
    )
    sampled_command_time = State(
        0.0, unit="s", description="reference time of the braking command, sampled for this decision period"
    )
    sampled_time_to_go = State(
        0.0, unit="s", description="time to go of the braking guidance, sampled for this decision period"
    )
    sampled_braking_status = State(
        TerminalStatus, description="status of the braking guidance, sampled for this decision period"
    )
    sampled_braking_finished = State(
        False, description="true: braking guidance finished, as sampled for this decision period"
    )
    sampled_plan = State(0, description="plan_number of the hover guidance's outputs, sampled for this decision period")
    sampled_hover_finished = State(
        False, description="true: plan of the hover guidance completed, as sampled for this decision period"
    )
    sampled_hover_status = State(
        HoverStatus, description="status of the hover guidance, sampled for this decision period"
    )
    sampled_propellant = State(
        0.0,
        unit="kg",
        description="predicted propellant of the hover guidance's plan, sampled for this decision period",
    )
    sampled_probe_contact = State(
        False, description="true: landing probe in contact with the ground, as sampled for this decision period"
    )
    sampled_ground_contact = State(
        False, description="true: lander in contact with the ground, as sampled for this decision period"
    )
    sampled_move_1 = State(
        [0.0, 0.0],
        unit="m",
        frame="landing site",
        description="first re-designation: offset of the landing site along x and y, sampled for this decision period",
    )
    sampled_move_2 = State(
        [0.0, 0.0],
        unit="m",
        frame="landing site",
        description="second re-designation: offset of the landing site along x and y, sampled for this decision period",
    )
    sampled_divert = State(0, description="number of diverts of the braking guidance, sampled for this decision period")
    sampled_divert_position = State(
        [0.0, 0.0, 0.0],
        unit="m",
        frame="landing site",
        description="target position after a divert, sampled for this decision period",
    )
    is_sampled = State(False, description="true: inputs of this decision period sampled")
    cycles = State(0, description="number of completed decision periods")
    start_time = State(0.0, unit="s", description="start time of the simulation")

    def sample_inputs(self, time: float) -> None:
        """Sample the inputs at ``time`` (s)."""
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
        """Return True if a decision period ends at ``time`` (s), and count it."""
        if self.cycle > 0.0:
            margin = CYCLE_TOLERANCE * self.cycle + TIME_TOLERANCE * abs(time)
            completed = int((time - self.start_time + margin) / self.cycle)
            if completed <= self.cycles:
                return False
            self.cycles = completed
        return True
