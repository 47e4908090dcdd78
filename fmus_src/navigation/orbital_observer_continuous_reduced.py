"""Continuous reduced-order observer of the orbital attitude, for yaw alone."""

from ..block import State
from ..kernel.functions import cos, exp, sin, tan
from .attitude_observer import AttitudeObserver


class OrbitalObserverContinuousReduced(AttitudeObserver):
    """Continuous reduced-order observer for yaw; the other states are taken as measured.

        ψ = z + l γ    l = -λ/ω_0    z' = f - λ z

    with reduced_yaw_pole λ. f contains all nonlinear and measured terms; with f constant over a sample period,
    evaluated at the mean of its two samples, the solution is exact. It needs neither torque nor inertia.

    Source: Lapin, thesis, chapter 3.1. See docs/systems/orbital_attitude.md.
    """

    z = State(0.0, unit="rad", description="state of the reduced-order observer: yaw minus l times roll")

    def begin(self) -> bool:
        self.z = self.reduced_yaw_pole / self.orbital_rate * self.measured_roll
        return True

    def observe(self) -> None:
        w0 = self.orbital_rate
        pole = self.reduced_yaw_pole
        fraction = -pole / w0
        roll = 0.5 * (self.last_roll + self.measured_roll)
        pitch = 0.5 * (self.last_pitch + self.measured_pitch)
        w = 0.5 * (self.last_rates + self.measured_angular_velocity)
        yaw = self.estimate.angles.y
        sin_yaw = sin(yaw)
        cos_pitch = cos(pitch)
        tan_pitch = tan(pitch)
        q = w.y * cos(roll) - w.z * sin(roll)
        yaw_rate = q / cos_pitch + w0 * sin_yaw * tan_pitch
        roll_rate = w.x - tan_pitch * q
        bent = sin_yaw / cos_pitch - yaw
        f = yaw_rate - fraction * roll_rate + fraction * w0 * bent + fraction * fraction * w0 * roll
        retained = exp(-pole * self.sample_period)
        self.z = retained * self.z + (1.0 - retained) * f / pole
        self.take_measured(self.z + fraction * self.measured_roll)

    def coast(self) -> None:
        self.estimate = self.propagate_estimate(True)
        fraction = -self.reduced_yaw_pole / self.orbital_rate
        self.z = self.estimate.angles.y - fraction * self.estimate.angles.x
