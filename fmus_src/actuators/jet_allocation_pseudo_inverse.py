"""Jet allocation by the pseudo-inverse, shifted and scaled."""

from ..mathlib.actuators.jets import pseudo_inverse, shift_and_scale
from .jet_allocation import JetAllocation, JetAllocationStatus


class JetAllocationPseudoInverse(JetAllocation):
    """Thrusts by the pseudo-inverse, raised equally until the least is 0 and scaled to maximum_thrust.

        p = B^# wrench - min(B^# wrench)

    The wrench is exact if the largest and least elements of B^# wrench differ by at most maximum_thrust: for a force
    without torque |F_1| + |F_2| + |F_3| <= 1.154 N with the declared jets. Beyond this limit the wrench keeps its
    direction but is smaller.

    Source: Somov, Butyrin, Somov and Somova, with the factor maximum_thrust corrected. See docs/theory/rendezvous.md.
    """

    def allocate(self) -> None:
        possible = pseudo_inverse(self.strength, self.demand, self.new_thrust)
        if not possible:
            self.status = JetAllocationStatus.TORQUE_LEFT_OUT
        scale = shift_and_scale(self.new_thrust, self.maximum_thrust)
        if scale < 1.0:
            self.status = JetAllocationStatus.SATURATED
