"""Gyro steering by the singularity-robust pseudo-inverse."""

from ..mathlib.actuators.gyros import robust_rates
from ..mathlib.vectors import Vector3, Vector4
from .gyro_steering import GyroSteering, GyroSteeringStatus


class GyroSteeringRobust(GyroSteering):
    """Gimbal rates by the singularity-robust pseudo-inverse, with least norm and bounded everywhere.

        β' = W A^T (A W A^T + k E)^-1 h'

    The torque is exact (k = 0) while singularity is at least damping_threshold; below it rates are bounded, the torque
    is approximate and the status 1. swing leads out of singular states. The pseudo-inverse leaves the isotropic angles
    and does not return to them.

    Source: Nakamura and Hanafusa 1986; Wie 2005. See docs/theory/rendezvous.md.
    """

    def steer(self, angles: Vector4, momentum_rate: Vector3, time: float) -> None:
        self.gimbal_rates, measure = robust_rates(
            angles, momentum_rate, self.damping, self.damping_threshold, self.swing, time
        )
        if measure < self.damping_threshold:
            self.status = GyroSteeringStatus.NEAR_SINGULAR
