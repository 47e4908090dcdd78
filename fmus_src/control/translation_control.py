"""Position control by jets: force from errors of position and velocity."""

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import inertial, landing, robot
from ..interfaces.ports.robot import ControlLaw
from ..kernel.enumerations import Enumeration, member
from ..mathlib.lead import LeadLaw, advance_lead, change_lead, is_same, lead_output, tustin_lead
from ..mathlib.vectors import Vector3, is_finite


class TranslationControlStatus(Enumeration):
    """Status of the force command."""

    GOOD = member("good")
    NOT_FINITE = member("last inputs not finite, force held")


class TranslationControl(Block):
    """Force of the jets: planned acceleration and a correction, once per translation_period.

        P = m (a_p - u)

    law 0: u is the output of a lead compensator for e = position_error, discretised by Tustin's rule at
    translation_period:

        u = k (t_1 s + 1)/(t_2 s + 1) e

    law 1, with natural_frequency and damping:

        u = ω_0^2 position_error + 2 ζ ω_0 velocity_error

    Each law has two designs; the one whose design_period is nearest to translation_period is used. When the design
    changes, the state of the lead compensator is set for a continuous output. The force is held until a change of the
    count signals the next sample; the inputs at the start are the first sample. Inputs that are not finite leave the
    force unchanged.

    Frame: inertial.

    Assumes a known mass.

    Source: Somov, Butyrin, Somov and Somova, with the sign of u corrected. See docs/theory/rendezvous.md.
    """

    default_step = 0.125

    law = Parameter(
        ControlLaw, start=ControlLaw.PROPORTIONAL_DERIVATIVE, description="control law of the position error"
    )
    mass = landing.MASS.parameter(1000.0, "mass of the robot", minimum=1e-3)
    design_period = Parameter(
        [8.0, 4.0],
        unit="s",
        minimum=1e-3,
        description="translation_period for which each of the two control designs holds",
    )
    lead_gain = Parameter(
        [1.5625e-4, 6.25e-4], minimum=0.0, description="static gain of the lead compensator in each design, 1/s2"
    )
    lead_time = Parameter(
        [160.0, 80.0], unit="s", minimum=0.0, description="time constant of the lead compensator's zero in each design"
    )
    lag_time = Parameter(
        [13.3, 6.67], unit="s", minimum=0.0, description="time constant of the lead compensator's pole in each design"
    )
    natural_frequency = Parameter(
        [0.03, 0.05],
        unit="rad/s",
        minimum=0.0,
        description="natural frequency of the closed position loop with the PD law, in each design",
    )
    damping = Parameter(
        [0.9, 0.9],
        unit="1",
        minimum=0.0,
        description="damping ratio of the closed position loop with the PD law, in each design",
    )
    position_error = inertial.POSITION.input("error of the robot's position relative to its plan")
    velocity_error = inertial.VELOCITY.input("error of the robot's velocity relative to its plan")
    planned_acceleration = inertial.ACCELERATION.input(
        "planned acceleration of the robot, mean over the time in which the force acts"
    )
    translation_period = robot.TRANSLATION_PERIOD.input()
    translation_count = robot.TRANSLATION_COUNT.input()
    force_command = inertial.FORCE.output(direct=True)
    command_count = robot.COMMAND_COUNT.output(direct=True)
    status = Output(TranslationControlStatus, direct=True)
    ticks = State(0, description="translation_count of the last control sample")
    lead_state = inertial.POSITION.state("internal state of the lead compensator per axis")
    last_law = State(LeadLaw, description="lead compensator of the last control sample")
    started = State(False, description="true: last_law computed")

    def initialize(self) -> None:
        self.ticks = self.translation_count
        self.command()

    def design(self) -> int:
        """Return the index of the design for translation_period."""
        nearest = 0
        first = abs(self.translation_period - self.design_period[0])
        second = abs(self.translation_period - self.design_period[1])
        if second < first:
            nearest = 1
        return nearest

    def correction(self) -> Vector3:
        """Return the correction to subtract from the acceleration (m/s2), and advance the compensator."""
        k = self.design()
        if self.law == ControlLaw.LEAD:
            law = tustin_lead(self.lead_gain[k], self.lead_time[k], self.lag_time[k], self.translation_period)
            changed = not is_same(law, self.last_law)
            if self.started and changed:
                self.lead_state = change_lead(self.last_law, law, self.position_error, self.lead_state)
            self.started = True
            self.last_law = law
            m = lead_output(law, self.lead_state, self.position_error)
            self.lead_state = advance_lead(law, self.lead_state, self.position_error)
            return m
        w = self.natural_frequency[k]
        return w * (w * self.position_error + 2.0 * self.damping[k] * self.velocity_error)

    def command(self) -> None:
        """Compute a new force command."""
        known = is_finite(self.position_error) and is_finite(self.velocity_error)
        if not (known and is_finite(self.planned_acceleration)):
            self.status = TranslationControlStatus.NOT_FINITE
            return
        self.status = TranslationControlStatus.GOOD
        m = self.correction()
        self.force_command = self.mass * (self.planned_acceleration - m)
        self.command_count = self.command_count + 1

    def step(self, t: float, h: float) -> None:
        if self.translation_count != self.ticks:
            self.ticks = self.translation_count
            self.command()
