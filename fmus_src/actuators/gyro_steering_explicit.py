"""Gyro steering by an explicit distribution law."""

from ..block import Parameter
from ..mathlib.actuators.gyros import ISOTROPIC_RHO, distribute_rates, robust_rates
from ..mathlib.vectors import Vector3, Vector4
from .gyro_steering import GyroSteering, GyroSteeringStatus


class GyroSteeringExplicit(GyroSteering):
    """Gimbal rates by Somov's explicit distribution law of the 2-SPE cluster.

        f = u - v + ρ (u v - 1) = 0    u = (C_1 + C_2)/a    v = (C_3 + C_4)/b    f' = -law_gain f
        a = sqrt(4 - h_y^2)    b = sqrt(4 - h_z^2)

    with cosines C_1 to C_4 of the gimbal angles and the normalised momentum h. The torque at the sample is exact. With
    the declared rho the law is not singular at any momentum below 1.96 h_g, the momentum of one rotor. Where a divisor
    of the law falls below least_divisor (|h| > 1.93), the singularity-robust pseudo-inverse sets the rates; the torque
    is then approximate and the status 1.

    Source: Somov 2013. See docs/theory/rendezvous.md.
    """

    rho = Parameter(
        ISOTROPIC_RHO, unit="1", minimum=0.0, maximum=0.999, description="bias rho of the explicit distribution law"
    )
    law_gain = Parameter(
        0.2, unit="1/s", minimum=0.0, description="decay rate of the residual of the explicit distribution law"
    )
    least_divisor = Parameter(
        0.02, unit="1", minimum=1e-6, description="least divisor for which the explicit distribution law is used"
    )

    def steer(self, angles: Vector4, momentum_rate: Vector3, time: float) -> None:
        lawful, rates = distribute_rates(angles, momentum_rate, self.rho, self.law_gain, self.least_divisor)
        if not lawful:
            self.status = GyroSteeringStatus.NEAR_SINGULAR
            rates, _ = robust_rates(angles, momentum_rate, self.damping, self.damping_threshold, self.swing, time)
        self.gimbal_rates = rates
