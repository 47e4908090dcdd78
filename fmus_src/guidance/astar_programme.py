"""Angle programme shared by the three guidances of method A*."""

from ..block import Output
from ..interfaces.ports.landing import TerminalStatus
from ..kernel.functions import asin, cos, sin
from ..mathlib.vectors import Vector3, clip, norm, vector
from .terminal_guidance import TerminalGuidance


class AstarProgramme(TerminalGuidance, interface=True):
    """Linear pitch and yaw programmes of method A*, for a known time to go and thrust acceleration W.

    In the axes of the method (x forward, y up, z right) the thrust acceleration is

        a = W (cos θ cos ψ, sin θ cos ψ, -sin ψ)
        sin ψ = (2 A_z/T - 6 B_z/T^2)/W    sin θ = (-2 A_y/T + 6 B_y/T^2)/(W cos ψ)

    An arcsine argument above 1 is clamped and counted. A programme that rotates by more than a radian within a sample
    period is replaced by its mean over the period, computed by Simpson's rule.

    Assumes a forward component of thrust along x, which the arcsines require.

    Source: Fomichev and Li 2017, method A*.
    """

    clamp_count = Output(
        0, direct=True, description="number of arcsine arguments clamped since the start, repeated solutions included"
    )

    def angle(self, sine: float) -> float:
        """Return the arcsine of an argument clamped to [-1, 1]; count an argument outside by more than 1e-12."""
        if abs(sine) > 1.000000000001:
            self.clamp_count = self.clamp_count + 1
            self.status = TerminalStatus.CLAMPED
        return asin(clip(sine, -1.0, 1.0))

    def apply_weights(self, weight: float, theta: float, psi: float) -> Vector3:
        """Return ``weight`` times the unit vector with the programme's angles, in the landing-site frame."""
        forward = weight * cos(theta) * cos(psi)
        return vector(forward, weight * sin(psi), weight * sin(theta) * cos(psi))

    def point(self, a: Vector3, b: Vector3, time: float, acceleration: float) -> None:
        """Set the command from A, B (landing-site frame), time to go (s) and acceleration W (m/s2)."""
        ay = a.z
        az = -a.y
        by = b.z
        bz = -b.y
        w = acceleration
        self.status = TerminalStatus.GOOD
        psi = self.angle((2.0 * az / time - 6.0 * bz / (time * time)) / w)
        cpsi = cos(psi)
        spsi = sin(psi)
        psi_rate = (-6.0 * az / (time * time) + 12.0 * bz / (time * time * time)) / (w * cpsi)
        theta = self.angle((-2.0 * ay / time + 6.0 * by / (time * time)) / (w * cpsi))
        ct = cos(theta)
        st = sin(theta)
        climb = 6.0 * ay / (time * time) - 12.0 * by / (time * time * time)
        theta_rate = (climb + w * psi_rate * st * spsi) / (w * ct * cpsi)
        self.command.thrust_acceleration = w
        direction = vector(0.0, 0.0, 0.0)
        span = clip(time, 0.0, self.cycle)
        if (abs(psi_rate) + abs(theta_rate)) * span > 1.0:
            half = 0.5 * span
            direction = direction + self.apply_weights(1.0 / 6.0, theta, psi)
            direction = direction + self.apply_weights(4.0 / 6.0, theta + theta_rate * half, psi + psi_rate * half)
            direction = direction + self.apply_weights(1.0 / 6.0, theta + theta_rate * span, psi + psi_rate * span)
            fraction = norm(direction)
            self.command.thrust_acceleration = w * fraction
            if fraction > 0.0:
                direction = direction / fraction
            self.command.thrust_direction_rate = vector(0.0, 0.0, 0.0)
        else:
            direction = direction + self.apply_weights(1.0, theta, psi)
            self.command.thrust_direction_rate = vector(
                -st * cpsi * theta_rate - ct * spsi * psi_rate,
                cpsi * psi_rate,
                ct * cpsi * theta_rate - st * spsi * psi_rate,
            )
        self.command.thrust_direction = direction
