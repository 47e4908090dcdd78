"""Interface of gyro steering laws, which convert the torque demanded of the gyro cluster into gimbal rates."""

from ..block import Block, Output, Parameter
from ..interfaces.ports import body, robot, sampling
from ..interfaces.ports.robot import LARGEST
from ..kernel.enumerations import Enumeration, member
from ..mathlib.actuators.gyros import singularity_measure
from ..mathlib.vectors import Vector3, Vector4, all_below, vector


class GyroSteeringStatus(Enumeration):
    """Status of the last command."""

    GOOD = member("good")
    NEAR_SINGULAR = member("near a singular state of cluster or steering law")
    LIMITED = member("rates limited")
    NOT_FINITE = member("command not finite")


class GyroSteering(Block, interface=True):
    """Gimbal rates of four control moment gyros in two scissored pairs (2-SPE) for a commanded torque.

    With gimbal angles β and A = dh/dβ for the normalised momentum h of rotors of momentum h_g, the cluster exerts

        M = -h_g A β'

    on the body, without the term ω × H. Rates are held until the next sample while the torque rotates with the gimbals;
    torque_lead sets the instant at which the torque is exact; with half a sample_period its mean over the sample is
    nearly exact. Rates beyond gimbal_rate_limit are scaled together. A steering law defines `steer`, which sets
    gimbal_rates and status from the commanded rate of change of the momentum.

    Frame: body.

    Assumes gimbals without lag, and rotors of constant speed.

    See docs/theory/rendezvous.md.
    """

    to_write = ("steer",)

    default_step = 0.125

    rotor_momentum = robot.ROTOR_MOMENTUM.parameter()
    torque_lead = Parameter(
        0.0,
        unit="s",
        minimum=0.0,
        description="lead time from the sample to the instant at which the gyros produce exactly the commanded torque",
    )
    damping = Parameter(
        0.05,
        unit="1",
        minimum=1e-9,
        description="damping k of the pseudo-inverse in a singular state of the gyro cluster",
    )
    damping_threshold = Parameter(
        0.5, unit="1", minimum=0.0, description="singularity measure below which the pseudo-inverse is damped"
    )
    swing = Parameter(
        0.1,
        unit="1",
        minimum=0.0,
        maximum=0.45,
        description=("amplitude of the periodic deviations (4 s) of the weighting matrices E and W from unit matrices"),
    )
    gimbal_rate_limit = Parameter(
        1.0, unit="rad/s", minimum=0.0, description="largest magnitude of a gimbal rate; 0: no limit"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.25, "sample period of the steering; 0: a sample at every communication point"
    )
    torque_command = body.TORQUE.input("commanded torque of the gyro cluster on the body")
    gimbal_angles = robot.GIMBAL_ANGLES.input()
    gimbal_rates = robot.GIMBAL_RATES.output(direct=True)
    singularity = Output(
        1.5396007178390021,
        unit="1",
        direct=True,
        description=(
            "singularity measure of the gyro cluster, square root of det(A A^T) with A = dh/dbeta; 0: singular state"
        ),
    )
    status = Output(GyroSteeringStatus, direct=True)

    start_time = sampling.START_TIME.state()

    def steer(self, angles: Vector4, momentum_rate: Vector3, time: float) -> None:
        """Set gimbal_rates (rad/s) and status for a rate of change (1/s) of the normalised momentum h."""

    def sample(self, time: float) -> None:
        """Set the gimbal rates for torque and gimbal angles at ``time`` (s)."""
        momentum_rate = -self.torque_command / self.rotor_momentum
        if all_below(momentum_rate, LARGEST) and all_below(self.gimbal_angles, LARGEST):
            self.singularity = singularity_measure(self.gimbal_angles)
            self.turn(self.gimbal_angles, momentum_rate, time)
            if self.torque_lead > 0.0:
                self.turn(self.gimbal_angles + self.torque_lead * self.gimbal_rates, momentum_rate, time)
        else:
            self.status = GyroSteeringStatus.NOT_FINITE
            self.gimbal_rates = vector(0.0, 0.0, 0.0, 0.0)

    def turn(self, angles: Vector4, momentum_rate: Vector3, time: float) -> None:
        """Set the status and the limited gimbal rates for gimbal ``angles`` (rad)."""
        self.status = GyroSteeringStatus.GOOD
        self.steer(angles, momentum_rate, time)
        self.limit()

    def limit(self) -> None:
        """Scale the gimbal rates to their limit if one exceeds it."""
        largest = 0.0
        for i in range(4):
            size = abs(self.gimbal_rates[i])
            if size > largest:
                largest = size
        if self.gimbal_rate_limit > 0.0 and largest > self.gimbal_rate_limit:
            self.status = GyroSteeringStatus.LIMITED
            self.gimbal_rates = self.gimbal_rate_limit / largest * self.gimbal_rates

    def initialize(self) -> None:
        self.sample(self.start_time)

    def step(self, t: float, h: float) -> None:
        self.sample(t + h)
