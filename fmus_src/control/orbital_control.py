"""The slot of regulators of the orbital attitude: from the estimate to the torque over a tick."""

from ..block import Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import is_finite, vector
from ..models.orbital_body import OrbitalBody
from ..units import deg


class OrbitalControlStatus(Enumeration):
    """Presence of a command."""

    GOOD = member("good")
    NOT_FINITE = member("estimate not finite")
    NO_GAIN = member("parameters unusable")


class OrbitalControl(OrbitalBody, interface=True):
    """Torque that turns the body into the orbital frame and holds it there.

    At each tick a regulator is given angles and rates and answers with the torque of the tick to come. The parameters
    are those that any regulator of the slot may need; inertia and jets are those known on board. Inputs that are not
    finite ask for no torque. A regulator writes `begin`, which may make gains, and `regulate`, which sets
    torque_command. Frames: orbital, body. Equations: docs/systems/orbital_attitude.md.
    Assumes a circular orbit.
    """

    to_write = ("regulate",)

    angle_poles = Parameter([0.10, 0.08, 0.10], unit="1/s", minimum=0.0, description="decay of roll, yaw, pitch")
    rate_poles = Parameter([0.15, 0.12, 0.15], unit="1/s", minimum=0.0, description="decay of how they should decay")
    arrival_time = Parameter(35.0, unit="s", minimum=0.0, description="when all angles are to arrive, after the start")
    least_time = Parameter(8.0, unit="s", minimum=1e-3, description="shortest time to arrive in, also afterwards")
    band = Parameter(
        [deg(0.15), deg(0.1), deg(0.15)],
        unit="rad",
        minimum=0.0,
        description="errors of roll, yaw, pitch that are let be",
    )
    turn_angle = Parameter(0.0, unit="rad", description="yaw to turn to and back, which tells gyro biases from yaw")
    turn_rate = Parameter(deg(0.8), unit="rad/s", minimum=1e-6, description="of that turn")
    turn_start = Parameter(45.0, unit="s", minimum=0.0, description="when it begins, after the start")
    turn_stay = Parameter(120.0, unit="s", minimum=0.0, description="how long the body stays turned")
    shortest_pulse = body.SHORTEST_PULSE.parameter()
    sample_period = sampling.SAMPLE_PERIOD.parameter(description="tick", minimum=1e-3)
    estimated_angles = body.ESTIMATED_ANGLES.input()
    estimated_angular_velocity = body.ANGULAR_VELOCITY.input()
    torque_command = body.TORQUE.output("torque wanted over the tick", direct=True)
    status = Output(OrbitalControlStatus, direct=True)
    start_time = sampling.START_TIME.state()
    usable = State(True, description="what the regulator needs could be made")

    def begin(self) -> None:
        """Make gains from the parameters."""

    def regulate(self, time: float) -> None:
        """Set torque_command for the estimate, ``time`` (s) after the start."""

    def command(self, time: float) -> None:
        """Set torque and status, ``time`` (s) after the start."""
        self.status = OrbitalControlStatus.GOOD
        self.torque_command = vector(0.0, 0.0, 0.0)
        if not self.usable:
            self.status = OrbitalControlStatus.NO_GAIN
        elif not (is_finite(self.estimated_angles) and is_finite(self.estimated_angular_velocity)):
            self.status = OrbitalControlStatus.NOT_FINITE
        else:
            self.regulate(time)

    def initialize(self) -> None:
        self.usable = self.weigh()
        if self.usable:
            self.begin()
        self.command(0.0)

    def step(self, t: float, h: float) -> None:
        self.command(t + h - self.start_time)
