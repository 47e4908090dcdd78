"""Jet allocation by the pseudo-inverse, lifted and scaled."""

from ..mathlib.actuators.jets import pseudo_inverse, shift_and_scale
from .jet_allocation import JetAllocation, JetAllocationStatus


class JetAllocationPseudoInverse(JetAllocation):
    """Thrusts by the pseudo-inverse, lifted until the least is 0 and scaled by maximum_thrust/largest where due.

    Gives the wanted wrench only where largest - least of the pseudo-inverse is within maximum_thrust:
    for a force without torque |F1| + |F2| + |F3| <= 1.154 N with the declared jets. Beyond, a
    smaller wrench of the same direction. Source: Somov, Butyrin, Somov and Somova, see
    docs/theory/rendezvous.md; the factor maximum_thrust is missing in print.
    """

    def allocate(self) -> None:
        possible = pseudo_inverse(self.strength, self.wanted, self.new_thrust)
        if not possible:
            self.status = JetAllocationStatus.TORQUE_LEFT_OUT
        scale = shift_and_scale(self.new_thrust, self.maximum_thrust)
        if scale < 1.0:
            self.status = JetAllocationStatus.SATURATED
