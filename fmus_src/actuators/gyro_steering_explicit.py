"""Gyro steering by an explicit distribution law."""

from ..block import Parameter
from ..mathlib.actuators.gyros import ISOTROPIC_RHO, distribute_rates, robust_rates
from ..mathlib.vectors import Vector3, Vector4
from .gyro_steering import GyroSteering, GyroSteeringStatus


class GyroSteeringExplicit(GyroSteering):
    """Gimbal rates of the 2-SPE cluster from the distribution law u - v + rho (u v - 1) = 0, without iteration.

    The torque at the sample instant is exact. With the declared rho no momentum below 1.96 of one rotor's is singular
    under the law; law_gain leads angles that are off it back to it. Where a divisor of the law
    falls below least_divisor (|h| > 1.93), the rates are those of the singularity-robust pseudo-inverse: the
    torque is then approximate and the status 1. Source: Somov 2013; see docs/theory/rendezvous.md.
    """

    rho = Parameter(ISOTROPIC_RHO, unit="1", minimum=0.0, maximum=0.999, description="bias of the distribution law")
    law_gain = Parameter(0.2, unit="1/s", minimum=0.0, description="rate at which the law's residual decays")
    least_divisor = Parameter(0.02, unit="1", minimum=1e-6, description="below it the law is not used")

    def steer(self, angles: Vector4, momentum_rate: Vector3, time: float) -> None:
        lawful, rates = distribute_rates(angles, momentum_rate, self.rho, self.law_gain, self.least_divisor)
        if not lawful:
            self.status = GyroSteeringStatus.NEAR_SINGULAR
            rates, _ = robust_rates(angles, momentum_rate, self.damping, self.damping_threshold, self.swing, time)
        self.gimbal_rates = rates
