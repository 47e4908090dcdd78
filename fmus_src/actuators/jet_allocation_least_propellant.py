"""Jet allocation with the least propellant, in closed form."""

from ..mathlib.actuators.jets import least_propellant, pseudo_inverse
from .jet_allocation import JetAllocation, JetAllocationStatus


class JetAllocationLeastPropellant(JetAllocation):
    """Thrusts of the least sum that give the wanted wrench, wherever there are any.

    The optimum of the linear programme min sum(p), B p = wrench, 0 <= p <= maximum_thrust, in closed
    form. A wrench that no thrusts give is scaled to the largest of its direction that some do. For
    a force without torque all is attainable up to |Fi| + |Fj| = 1.155 N for each two axes, with the
    declared jets. Derivation: docs/theory/rendezvous.md.
    """

    def allocate(self) -> None:
        possible = pseudo_inverse(self.strength, self.wanted, self.new_thrust)
        if not possible:
            self.status = JetAllocationStatus.TORQUE_LEFT_OUT
        scale = least_propellant(self.new_thrust, self.maximum_thrust)
        if scale < 1.0:
            self.status = JetAllocationStatus.SATURATED
