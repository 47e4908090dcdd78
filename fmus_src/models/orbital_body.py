"""Model of a spacecraft on a circular orbit, shared by plants, observers and controllers."""

import math

from ..block import Block, Parameter, State
from ..interfaces.ports import body
from ..kernel.integrators import count_steps, runge_kutta_4
from ..kernel.matrices import inverse
from ..mathlib.orbits.attitude import AttitudeState, angle_rates, angular_acceleration, evaluate_angles
from ..mathlib.vectors import Vector3, vector


class OrbitalBody(Block, interface=True):
    """Rigid body on a circular orbit, with jets about its axes that have the same torque in both directions.

    With angles a = (γ, ψ, θ) of roll, yaw and pitch relative to the orbital frame, absolute angular velocity ω in body
    axes, orbital rate ω_0 and radial direction j in body axes:

        J ω' = 3 ω_0^2 j × (J j) + (J ω) × ω + u    j = (sin θ, cos γ cos θ, -sin γ cos θ)
        γ' = ω_x - q tan θ - ω_0 sin ψ/cos θ    ψ' = q/cos θ + ω_0 sin ψ tan θ    θ' = p + ω_0 cos ψ
        q = ω_y cos γ - ω_z sin γ    p = ω_y sin γ + ω_z cos γ

    A pulse about an axis is a signed duration (s): the jet of that sign exerts jet_torque for this time from the start
    of the sample period. A block may extend `derivatives`. The off-diagonal elements of inertia are the negative
    products of inertia.

    Frames: orbital; body.

    Assumes a circular orbit, constant inertia, and no torques except the gravity gradient and the jets.

    Source: Lapin, thesis, chapter 1.1. See docs/systems/orbital_attitude.md.
    """

    default_step = 0.2

    inertia = body.INERTIA.parameter([6500.0, -150.0, -100.0, -150.0, 30000.0, -200.0, -100.0, -200.0, 29000.0])
    jet_torque = body.JET_TORQUE.parameter()
    orbital_rate = Parameter(
        0.0011,
        unit="rad/s",
        minimum=1e-9,
        description="angular rate of the orbital frame relative to the inertial frame",
    )
    inverse_inertia = State(
        [0.0] * 9, columns=3, description="inverse of the body's inertia matrix, 1/(kg m2) (body frame)"
    )

    def invert_inertia(self) -> bool:
        """Set inverse_inertia; return True if the inertia matrix is invertible."""
        self.inverse_inertia, invertible = inverse(self.inertia)
        return invertible

    def motion(self, s: AttitudeState, torque: Vector3) -> AttitudeState:
        """Return the time derivative of the attitude state under a torque (N m, body)."""
        a = evaluate_angles(s.angles)
        w = s.angular_velocity
        return AttitudeState(
            angles=angle_rates(a, w, self.orbital_rate),
            angular_velocity=angular_acceleration(a, w, torque, self.inertia, self.inverse_inertia, self.orbital_rate),
        )

    def derivatives(self, t: float, s: AttitudeState, torque: Vector3) -> AttitudeState:
        """Return the time derivative of the attitude state, with the arguments that an integrator passes."""
        return self.motion(s, torque)

    def torque_at(self, pulses: Vector3, time: float) -> Vector3:
        """Return the torque (N m, body) of the jets at ``time`` (s) after the start of ``pulses`` (s)."""
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
        self, s: AttitudeState, pulses: Vector3, constant_torque: Vector3, h: float, longest: float
    ) -> AttitudeState:
        """Return the attitude state after h (s) under pulses (s) that start now and a constant torque (N m, body).

        The time is divided where a pulse ends, and each interval into steps of at most ``longest`` (s).
        """
        time = 0.0
        while time < h:
            end = h
            for i in range(3):
                length = abs(pulses[i])
                if length > time and length < end:
                    end = length
            torque = self.torque_at(pulses, time) + constant_torque
            pieces = count_steps(end - time, longest)
            for _ in range(pieces):
                s = runge_kutta_4(self.derivatives, time, s, (end - time) / float(pieces), torque)
            time = end
        return s
