"""Orbital attitude by a discrete observer of yaw alone."""

from ..block import Parameter
from ..kernel.functions import exp
from .attitude_observer import AttitudeObserver


class OrbitalObserverDiscreteReduced(AttitudeObserver):
    """Discrete observer of reduced order: yaw by the motion over a tick, and by how far roll then is from its sample.

    From the last estimate, its measured parts as measured, the motion gives yaw and roll; yaw is moved by
    -(1 - exp(-reduced_yaw_pole T))/(w0 T) times what the roll measured is ahead. Motion: one step of Runge-Kutta's
    fourth order under the mean torque, or with split one between any two switch-offs.
    Source: Lapin, thesis, chapter 3.1; equations: docs/systems/orbital_attitude.md.
    """

    split = Parameter(False, description="follow each pulse instead of their mean")

    def observe(self) -> None:
        carried = self.carry(self.split)
        turn = self.orbital_rate * self.sample_period
        gain = (1.0 - exp(-self.reduced_yaw_pole * self.sample_period)) / turn
        self.take_measured(carried.angles.y - gain * (self.measured_roll - carried.angles.x))
