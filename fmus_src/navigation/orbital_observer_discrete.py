"""Discrete full-order observer of the orbital attitude."""

from ..block import Parameter
from ..kernel.functions import exp
from ..kernel.matrices import exponential, identity
from ..mathlib.orbits.attitude import YAW, index_of_measured, linear_model
from .full_attitude_observer import FullAttitudeObserver


class OrbitalObserverDiscrete(FullAttitudeObserver):
    """Discrete full-order observer that propagates the estimate by the motion F over a sample period.

    With yaw_pole λ, measured_pole μ and the unit vector e of yaw:

        A_d = exp(A T)    x^+ = F(x) + K (m - C F(x))    K = (1 - exp(-μ T) A_d^-1) (C^T + e l)
        l = (A_yaw - exp(-λ T)) c^T/(c^T c)    c = C A_d e

    with A the linearised motion and A_yaw the diagonal element of A_d for yaw. The linearised errors have the
    multiplier exp(-μ T) five times and exp(-λ T) once. F is one step of the fourth-order Runge-Kutta method under the
    mean torque or, with split, one step between any two switching times.

    Source: Lapin, thesis, chapter 3.1. Gain: docs/systems/orbital_attitude.md.
    """

    split = Parameter(
        False,
        description=(
            "true: motion integrated pulse by pulse; false: motion integrated with the mean torque of the pulses"
        ),
    )

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
        s = self.propagate_estimate(self.split)
        self.estimate = s + self.correction(s, self.measured_roll, self.measured_pitch, self.measured_angular_velocity)
