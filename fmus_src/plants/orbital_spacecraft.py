"""A spacecraft on a circular orbit, turned by jets in pulses."""

from ..block import Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.orbits.attitude import AttitudeState
from ..mathlib.vectors import Vector3, vector
from ..models.orbital_body import OrbitalBody


class SpacecraftStatus(Enumeration):
    """Motion of the spacecraft."""

    GOOD = member("good")
    NO_INERTIA = member("inertia cannot be inverted, nothing moves")


class OrbitalSpacecraft(OrbitalBody):
    """Rigid body on a circular orbit under the gravity gradient, whose jets give pure moments in pulses.

    A change of pulse_count tells new pulses, which start at once, all of them, and take the place of what is left of
    the last; the count at the start counts. A pulse is cut exactly where it ends, whatever the communication step;
    between, Runge-Kutta of fourth order in steps of at most internal_step. mean_torque is a torque beside the pulses,
    held over the step, for the study of what pulses do in the mean. Jets are at full level at once; inertia does not
    change. Frames: orbital, body. Equations: docs/systems/orbital_attitude.md. Source: Lapin, thesis, chapter 1.1.
    """

    initial_angles = Parameter([0.0, 0.0, 0.0], unit="rad", description="roll, yaw, pitch at the start")
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(
        [0.0, 0.0, -0.0011], "angular velocity at the start, absolute"
    )
    internal_step = sampling.INTERNAL_STEP.parameter(minimum=1e-3)
    pulse_lengths = body.PULSES.input()
    pulse_count = body.PULSE_COUNT.input()
    mean_torque = body.TORQUE.input("torque beside the pulses, held")
    angles = body.ANGLES.output()
    angular_velocity = body.ANGULAR_VELOCITY.output()
    fired_pulses = body.PULSES.output("the last pulses, with their sign")
    held_torque = body.TORQUE.output("mean_torque over the last step")
    jet_seconds = Output(0.0, unit="s", description="time that jets have fired, summed over the axes: the propellant")
    status = Output(SpacecraftStatus)
    left = State([0.0, 0.0, 0.0], unit="s", frame="body", description="what is left of the pulses, with their sign")
    counted = State(0, description="pulse_count of the last pulses")

    def initialize(self) -> None:
        self.angles = self.initial_angles
        self.angular_velocity = self.initial_angular_velocity
        invertible = self.weigh()
        if not invertible:
            self.status = SpacecraftStatus.NO_INERTIA

    def after(self, length: float, h: float) -> float:
        """Return the rest of one pulse (s, with its sign) after h (s)."""
        if length > h:
            return length - h
        if length < -h:
            return length + h
        return 0.0

    def size(self, pulses: Vector3) -> float:
        """Sum of the lengths of three pulses (s)."""
        return abs(pulses.x) + abs(pulses.y) + abs(pulses.z)

    def step(self, t: float, h: float) -> None:
        if self.pulse_count != self.counted:
            self.counted = self.pulse_count
            self.left = self.pulse_lengths
            self.fired_pulses = self.pulse_lengths
        self.held_torque = self.mean_torque
        if self.status == SpacecraftStatus.GOOD:
            s = AttitudeState(angles=self.angles, angular_velocity=self.angular_velocity)
            s = self.fire(s, self.left, self.mean_torque, h, self.internal_step)
            self.angles = s.angles
            self.angular_velocity = s.angular_velocity
        before = self.size(self.left)
        self.left = vector(self.after(self.left.x, h), self.after(self.left.y, h), self.after(self.left.z, h))
        self.jet_seconds = self.jet_seconds + before - self.size(self.left)
