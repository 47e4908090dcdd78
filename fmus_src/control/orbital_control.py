"""Interface of controllers of the orbital attitude, which compute the torque over a sample period from the estimate."""

from ..block import Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import is_finite, vector
from ..models.orbital_body import OrbitalBody
from ..units import deg


class OrbitalControlStatus(Enumeration):
    """Status of the torque command."""

    GOOD = member("good")
    NOT_FINITE = member("estimate not finite")
    NO_GAIN = member("parameters unusable")


class OrbitalControl(OrbitalBody, interface=True):
    """Torque that turns a body into the orbital frame and holds it there.

    At each sample a controller receives angles and rates and sets the torque of the next sample period. All controllers
    of the slot have the same parameters; inertia and jet torques are the values known on board. Inputs that are not
    finite give no torque. A controller defines `begin`, which may compute gains, and `regulate`, which sets
    torque_command.

    Frames: orbital; body.

    Assumes a circular orbit.

    See docs/systems/orbital_attitude.md.
    """

    to_write = ("regulate",)

    angle_poles = Parameter(
        [0.10, 0.08, 0.10], unit="1/s", minimum=0.0, description="decay rates of roll, yaw and pitch in the closed loop"
    )
    rate_poles = Parameter(
        [0.15, 0.12, 0.15],
        unit="1/s",
        minimum=0.0,
        description="decay rates of the deviations of roll, yaw and pitch from their decay with angle_poles",
    )
    arrival_time = Parameter(
        35.0, unit="s", minimum=0.0, description="time from the start at which all angles are to be 0"
    )
    least_time = Parameter(
        8.0, unit="s", minimum=1e-3, description="least remaining time to arrival assumed, also after arrival_time"
    )
    band = Parameter(
        [deg(0.15), deg(0.1), deg(0.15)],
        unit="rad",
        minimum=0.0,
        description="magnitudes of roll, yaw and pitch below which no correction is commanded",
    )
    turn_angle = Parameter(
        0.0, unit="rad", description="yaw angle of an additional turn, which makes gyro biases and yaw distinguishable"
    )
    turn_rate = Parameter(deg(0.8), unit="rad/s", minimum=1e-6, description="angular rate of the additional yaw turn")
    turn_start = Parameter(
        45.0,
        unit="s",
        minimum=0.0,
        description="time from the start of the simulation to the start of the additional yaw turn",
    )
    turn_stay = Parameter(
        120.0, unit="s", minimum=0.0, description="duration for which the yaw of the additional turn is held"
    )
    shortest_pulse = body.SHORTEST_PULSE.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="sample period of the control", minimum=1e-3)
    estimated_angles = body.ESTIMATED_ANGLES.input()
    estimated_angular_velocity = body.ANGULAR_VELOCITY.input(
        "estimated angular velocity of the body relative to the inertial frame"
    )
    torque_command = body.TORQUE.output("commanded torque of the jets, mean over the sample period", direct=True)
    status = Output(OrbitalControlStatus, direct=True)
    start_time = sampling.START_TIME.state()
    usable = State(True, description="true: gains of the control law computed")

    def begin(self) -> None:
        """Compute gains from the parameters."""

    def regulate(self, time: float) -> None:
        """Set torque_command from the estimate at ``time`` (s) after the start."""

    def command(self, time: float) -> None:
        """Set torque_command and status at ``time`` (s) after the start."""
        self.status = OrbitalControlStatus.GOOD
        self.torque_command = vector(0.0, 0.0, 0.0)
        if not self.usable:
            self.status = OrbitalControlStatus.NO_GAIN
        elif not (is_finite(self.estimated_angles) and is_finite(self.estimated_angular_velocity)):
            self.status = OrbitalControlStatus.NOT_FINITE
        else:
            self.regulate(time)

    def initialize(self) -> None:
        self.usable = self.invert_inertia()
        if self.usable:
            self.begin()
        self.command(0.0)

    def step(self, t: float, h: float) -> None:
        self.command(t + h - self.start_time)
