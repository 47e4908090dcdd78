"""Discrete reduced-order observer of the orbital attitude, for yaw alone."""

from ..block import Parameter
from ..kernel.functions import exp
from .attitude_observer import AttitudeObserver


class OrbitalObserverDiscreteReduced(AttitudeObserver):
    """Discrete reduced-order observer: yaw propagated over a sample period and corrected by the roll residual.

    From the last estimate of yaw and the measured values of the other states, the motion F gives yaw ψ_F and roll γ_F:

        ψ^+ = ψ_F - (1 - exp(-λ T)) (γ_m - γ_F)/(ω_0 T)

    with reduced_yaw_pole λ. F is one step of the fourth-order Runge-Kutta method under the mean torque or, with split,
    one step between any two switching times.

    Source: Lapin, thesis, chapter 3.1. See docs/systems/orbital_attitude.md.
    """

    split = Parameter(
        False,
        description=(
            "true: motion integrated pulse by pulse; false: motion integrated with the mean torque of the pulses"
        ),
    )

    def observe(self) -> None:
        carried = self.propagate_estimate(self.split)
        turn = self.orbital_rate * self.sample_period
        gain = (1.0 - exp(-self.reduced_yaw_pole * self.sample_period)) / turn
        self.take_measured(carried.angles.y - gain * (self.measured_roll - carried.angles.x))
