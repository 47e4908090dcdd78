"""Spacecraft on a circular orbit, turned by jet pulses."""

from ..block import Output, Parameter, State
from ..interfaces.ports import body, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.orbits.attitude import AttitudeState
from ..mathlib.vectors import Vector3, vector
from ..models.orbital_body import OrbitalBody


class SpacecraftStatus(Enumeration):
    """Validity of the inertia."""

    GOOD = member("good")
    NO_INERTIA = member("inertia matrix singular, no motion")


class OrbitalSpacecraft(OrbitalBody):
    """Rigid body on a circular orbit under the gravity gradient, with jets that give pure torques in pulses.

    A change of pulse_count signals new pulses, which replace the remaining ones at once; the pulses at the start count
    as new. Pulses end exactly, whatever the communication step; between their ends the motion is integrated by the
    fourth-order Runge-Kutta method in steps of at most internal_step. For studies of the mean motion, mean_torque,
    constant over a step, is added to the pulses. Jets have no rise time.

    See docs/systems/orbital_attitude.md.
    """

    initial_angles = Parameter(
        [0.0, 0.0, 0.0], unit="rad", description="initial roll, yaw and pitch of the body relative to the orbital frame"
    )
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(
        [0.0, 0.0, -0.0011], "initial angular velocity of the body relative to the inertial frame"
    )
    internal_step = sampling.INTERNAL_STEP.parameter(minimum=1e-3)
    pulse_lengths = body.PULSES.input()
    pulse_count = body.PULSE_COUNT.input()
    mean_torque = body.TORQUE.input("torque of the jets in addition to the pulses, constant over a step")
    angles = body.ANGLES.output()
    angular_velocity = body.ANGULAR_VELOCITY.output()
    fired_pulses = body.PULSES.output("lengths of the last fired pulses about x, y and z, signed as the torque")
    held_torque = body.TORQUE.output("torque of the jets in addition to the pulses, over the last step")
    jet_seconds = Output(
        0.0, unit="s", description="accumulated firing time of all jets, proportional to the propellant used"
    )
    status = Output(SpacecraftStatus)
    left = State(
        [0.0, 0.0, 0.0],
        unit="s",
        frame="body",
        description="remaining lengths of the current pulses about x, y and z, signed as the torque",
    )
    counted = State(0, description="pulse_count of the last accepted pulses")

    def initialize(self) -> None:
        self.angles = self.initial_angles
        self.angular_velocity = self.initial_angular_velocity
        invertible = self.invert_inertia()
        if not invertible:
            self.status = SpacecraftStatus.NO_INERTIA

    def after(self, length: float, h: float) -> float:
        """Return the signed length (s) that remains of a pulse after h (s)."""
        if length > h:
            return length - h
        if length < -h:
            return length + h
        return 0.0

    def size(self, pulses: Vector3) -> float:
        """Return the sum of the magnitudes of three signed pulse lengths (s)."""
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
