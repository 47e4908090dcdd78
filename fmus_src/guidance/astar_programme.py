"""The angle programme that the three guidances of method A* share."""

import math

from ..block import Output
from ..interfaces.terminal_guidance import CLAMPED, GOOD, TerminalGuidance
from ..mathlib.vectors import clip, norm


class AstarProgramme(TerminalGuidance, interface=True):
    """Linear pitch and yaw programmes of method A*, for a given time-to-go and thrust acceleration.

    In the method's own axes (x forward, y up, z right) the thrust acceleration is
    W (cos th cos psi, sin th cos psi, -sin psi); its angles are not the analytic method's. Assumes
    that thrust has a forward component along x: arcsines cannot express another.
    An arcsine argument above 1 is clamped and counted: in the original arithmetic it turned the
    state complex. The angle's rate is then all but infinite. A programme that turns by more than
    a radian within a guidance cycle cannot be put as a direction and its rate; its mean over the
    cycle by Simpson's rule is commanded instead, which is what the paper's Runge-Kutta step makes
    of it. Source: Fomichev and Li 2017, method A*.
    """

    clamp_count = Output(0, direct=True, description="arcsine arguments clamped so far, in repeated solves too")

    def angle(self, sine: float) -> float:
        """Arcsine, clamped and counted outside [-1, 1] (1e-12 allowed for rounding)."""
        if abs(sine) > 1.000000000001:
            self.clamp_count = self.clamp_count + 1
            self.status = CLAMPED
        return math.asin(clip(sine, -1.0, 1.0))

    def add_direction(self, theta: float, psi: float, weight: float) -> None:
        """Add weight times the unit vector of the angles to thrust_direction, landing-site frame."""
        self.thrust_direction[0] = self.thrust_direction[0] + weight * math.cos(theta) * math.cos(psi)
        self.thrust_direction[1] = self.thrust_direction[1] + weight * math.sin(psi)
        self.thrust_direction[2] = self.thrust_direction[2] + weight * math.sin(theta) * math.cos(psi)

    def point(self, a: list, b: list, time: float, acceleration: float) -> None:
        """Set the command from A, B (landing-site frame), time-to-go (s) and acceleration (m/s2)."""
        ay = a[2]
        az = -a[1]
        by = b[2]
        bz = -b[1]
        w = acceleration
        self.status = GOOD
        psi = self.angle((2.0 * az / time - 6.0 * bz / (time * time)) / w)
        cpsi = math.cos(psi)
        spsi = math.sin(psi)
        psi_rate = (-6.0 * az / (time * time) + 12.0 * bz / (time * time * time)) / (w * cpsi)
        theta = self.angle((-2.0 * ay / time + 6.0 * by / (time * time)) / (w * cpsi))
        ct = math.cos(theta)
        st = math.sin(theta)
        climb = 6.0 * ay / (time * time) - 12.0 * by / (time * time * time)
        theta_rate = (climb + w * psi_rate * st * spsi) / (w * ct * cpsi)
        for i in range(3):
            self.thrust_direction[i] = 0.0
        self.thrust_acceleration = w
        span = clip(time, 0.0, self.cycle)
        if (abs(psi_rate) + abs(theta_rate)) * span > 1.0:
            half = 0.5 * span
            self.add_direction(theta, psi, 1.0 / 6.0)
            self.add_direction(theta + theta_rate * half, psi + psi_rate * half, 4.0 / 6.0)
            self.add_direction(theta + theta_rate * span, psi + psi_rate * span, 1.0 / 6.0)
            share = norm(self.thrust_direction)
            self.thrust_acceleration = w * share
            for i in range(3):
                if share > 0.0:
                    self.thrust_direction[i] = self.thrust_direction[i] / share
                self.thrust_direction_rate[i] = 0.0
        else:
            self.add_direction(theta, psi, 1.0)
            self.thrust_direction_rate[0] = -st * cpsi * theta_rate - ct * spsi * psi_rate
            self.thrust_direction_rate[1] = cpsi * psi_rate
            self.thrust_direction_rate[2] = ct * cpsi * theta_rate - st * spsi * psi_rate
