"""Orbital attitude by a discrete observer of the whole state."""

from ..block import Parameter
from ..kernel.functions import exp
from ..kernel.matrices import exponential, identity
from ..mathlib.orbits.attitude import YAW, index_of_measured, linear_model
from .full_attitude_observer import FullAttitudeObserver


class OrbitalObserverDiscrete(FullAttitudeObserver):
    """Discrete observer of the whole state: the motion over a tick, F(x), then x = F(x) + L (m - C F(x)).

    With Ad = exp(A T): L = (1 - exp(-measured_pole T) Ad^-1)(C' + e l), l = ((Ad)_yaw,yaw - exp(-yaw_pole T)) c'/(c'c),
    c = C Ad e, gives the linear errors the multipliers exp(-measured_pole T) five times and exp(-yaw_pole T) once. F is
    one step of Runge-Kutta's fourth order under the mean torque, or with split one between any two switch-offs.
    Source: Lapin, thesis, chapter 3.1; gain: docs/systems/orbital_attitude.md.
    """

    split = Parameter(False, description="follow each pulse instead of their mean")

    def begin(self) -> bool:
        period = self.sample_period
        a = linear_model(self.inertia, self.inverse_inertia, self.orbital_rate)
        ahead = exponential(a, period)
        back = exponential(a, -period)
        row = [0.0] * 5
        square = 0.0
        for j in range(5):
            row[j] = ahead[index_of_measured(j), YAW]
            square = square + row[j] * row[j]
        if not square > 0.0:
            return False
        change = ahead[YAW, YAW] - exp(-self.yaw_pole * period)
        for j in range(5):
            row[j] = change * row[j] / square
        forgotten = exp(-self.measured_pole * period)
        self.compose(identity(6) - forgotten * back, row)
        return True

    def observe(self) -> None:
        s = self.carry(self.split)
        self.estimate = s + self.correction(s, self.measured_roll, self.measured_pitch, self.measured_angular_velocity)
