"""Continuous full-order observer of the orbital attitude."""

from ..block import Parameter
from ..kernel.matrices import identity
from ..mathlib.orbits.attitude import AttitudeState, linear_model
from ..mathlib.vectors import Vector3
from .full_attitude_observer import FullAttitudeObserver


class OrbitalObserverContinuous(FullAttitudeObserver):
    """Continuous full-order observer, in which the sample m is constant over a sample period.

    With yaw_pole λ and measured_pole μ:

        x' = f(x, u) + K (m - C x)    K = (A + μ) (C^T + e l)    l = (-λ/ω_0, 0, 0, 0, 0)

    The linearised errors have the pole -λ once and the pole -μ five times. A sample period is one step of the
    fourth-order Runge-Kutta method under the mean torque or, with split, one step between any two switching times of
    the jets.

    Source: Lapin, thesis, chapter 3.1. Gain: docs/systems/orbital_attitude.md.
    """

    split = Parameter(
        False,
        description=(
            "true: motion integrated pulse by pulse; false: motion integrated with the mean torque of the pulses"
        ),
    )

    def begin(self) -> bool:
        a = linear_model(self.inertia, self.inverse_inertia, self.orbital_rate)
        row = [0.0] * 5
        row[0] = -self.yaw_pole / self.orbital_rate
        self.compose(a + self.measured_pole * identity(6), row)
        return True

    def derivatives(self, t: float, s: AttitudeState, torque: Vector3) -> AttitudeState:
        return self.motion(s, torque) + self.correction(s, self.last_roll, self.last_pitch, self.last_rates)

    def observe(self) -> None:
        self.estimate = self.propagate_estimate(self.split)
