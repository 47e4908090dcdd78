"""What spacecraft on a circular orbit and the models of them in observers and regulators have in common."""

import math

from ..block import Block, Parameter, State
from ..mathlib.matrices import inverse
from ..mathlib.orbital import angle_rates, angular_acceleration
from ..mathlib.vectors import Vector3, vector

STEP_ROUNDING = 1e-9  # of a longest step, by which a step may exceed it


class OrbitalBody(Block, interface=True):
    """A rigid body on a circular orbit, turned by jets about its axes that fire both ways at one level each.

    A pulse is a signed length (s) about one axis: the jet of that sign gives jet_torque from the start of the tick
    for so long. Motion: `mathlib.orbital`; a block may add to `slopes` what drives its model. Inertia is the matrix
    that multiplies angular velocity: elements off the diagonal are minus the products of inertia.
    Frames: orbital and body. Equations: docs/systems/orbital_attitude.md.
    Assumes an orbit that stays circular, constant inertia, and no torque but the gravity gradient's and the jets'.
    """

    default_step = 0.2

    inertia = Parameter(
        [6500.0, -150.0, -100.0, -150.0, 30000.0, -200.0, -100.0, -200.0, 29000.0],
        columns=3,
        unit="kg.m2",
        frame="body",
        description="matrix of inertia",
    )
    jet_torque = Parameter(
        [60.0, 120.0, 120.0], unit="N.m", minimum=1e-9, frame="body", description="of a jet about x, y, z, both ways"
    )
    orbital_rate = Parameter(0.0011, unit="rad/s", minimum=1e-9, description="turn of the orbital frame")
    inverse_inertia = State([0.0] * 9, columns=3, description="inverse of inertia, 1/(kg m2)")

    def weigh(self) -> bool:
        """Set inverse_inertia; whether the matrix of inertia has one."""
        invertible = inverse(self.inertia, self.inverse_inertia, 3)
        return invertible

    def motion(self, angles: Vector3, w: Vector3, torque: Vector3) -> tuple[Vector3, Vector3]:
        """Rates of angles (rad) and angular velocity (rad/s, body) under a torque (N m, body)."""
        turning = angle_rates(angles, w, self.orbital_rate)
        return turning, angular_acceleration(angles, w, torque, self.inertia, self.inverse_inertia, self.orbital_rate)

    def slopes(self, angles: Vector3, w: Vector3, torque: Vector3) -> tuple[Vector3, Vector3]:
        """Rates of angles and angular velocity as they are integrated."""
        turning, acceleration = self.motion(angles, w, torque)
        return turning, acceleration

    def turn(self, angles: Vector3, w: Vector3, torque: Vector3, h: float) -> tuple[Vector3, Vector3]:
        """Angles and angular velocity h (s) later, one step of Runge-Kutta's fourth order under a constant torque."""
        a1, w1 = self.slopes(angles, w, torque)
        a2, w2 = self.slopes(angles + 0.5 * h * a1, w + 0.5 * h * w1, torque)
        a3, w3 = self.slopes(angles + 0.5 * h * a2, w + 0.5 * h * w2, torque)
        a4, w4 = self.slopes(angles + h * a3, w + h * w3, torque)
        return angles + h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0, w + h * (w1 + 2.0 * w2 + 2.0 * w3 + w4) / 6.0

    def torque_at(self, pulses: Vector3, time: float) -> Vector3:
        """Torque (N m, body) of the jets after ``time`` (s) of the pulses (s)."""
        x = 0.0
        y = 0.0
        z = 0.0
        if abs(pulses.x) > time:
            x = math.copysign(self.jet_torque.x, pulses.x)
        if abs(pulses.y) > time:
            y = math.copysign(self.jet_torque.y, pulses.y)
        if abs(pulses.z) > time:
            z = math.copysign(self.jet_torque.z, pulses.z)
        return vector(x, y, z)

    def fire(
        self, angles: Vector3, w: Vector3, pulses: Vector3, held: Vector3, h: float, longest: float
    ) -> tuple[Vector3, Vector3]:
        """Angles and angular velocity h (s) later, under pulses (s) from now on and a torque held (N m, body).

        The time is cut where a jet goes off, and what lies between into steps no longer than ``longest`` (s).
        """
        time = 0.0
        while time < h:
            end = h
            for i in range(3):
                length = abs(pulses[i])
                if length > time and length < end:
                    end = length
            torque = self.torque_at(pulses, time) + held
            pieces = int((end - time) / longest - STEP_ROUNDING) + 1
            for _ in range(pieces):
                angles, w = self.turn(angles, w, torque, (end - time) / float(pieces))
            time = end
        return angles, w
