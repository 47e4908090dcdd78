"""Orbital attitude by a continuous observer of the whole state."""

from ..block import Parameter
from ..kernel.matrices import identity
from ..mathlib.orbits.attitude import AttitudeState, linear_model
from ..mathlib.vectors import Vector3
from .full_attitude_observer import FullAttitudeObserver


class OrbitalObserverContinuous(FullAttitudeObserver):
    """Continuous observer of the whole state: x' = f(x, u) + L (m - C x), the sample m held over a tick.

    L = (A + measured_pole)(C' + e l), l = (-yaw_pole/w0, 0, 0, 0, 0) gives the linear errors yaw_pole once and
    measured_pole five times. Integrated over a tick by one step of Runge-Kutta's fourth order under the mean torque,
    or with split between the switch-offs of the jets. Source: Lapin, thesis, chapter 3.1; gain:
    docs/systems/orbital_attitude.md.
    """

    split = Parameter(False, description="follow each pulse instead of their mean")

    def begin(self) -> bool:
        a = linear_model(self.inertia, self.inverse_inertia, self.orbital_rate)
        row = [0.0] * 5
        row[0] = -self.yaw_pole / self.orbital_rate
        self.compose(a + self.measured_pole * identity(6), row)
        return True

    def derivatives(self, t: float, s: AttitudeState, torque: Vector3) -> AttitudeState:
        return self.motion(s, torque) + self.correction(s, self.last_roll, self.last_pitch, self.last_rates)

    def observe(self) -> None:
        self.estimate = self.carry(self.split)
