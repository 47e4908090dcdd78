"""Jet allocation with the least propellant, in closed form."""

from ..mathlib.actuators.jets import least_propellant, pseudo_inverse
from .jet_allocation import JetAllocation, JetAllocationStatus


class JetAllocationLeastPropellant(JetAllocation):
    """Thrusts of least sum for the commanded wrench, wherever it is attainable.

        min Σ p    B p = wrench    0 <= p <= maximum_thrust

    The optimum is in closed form. An unattainable wrench is scaled to the largest attainable one of its direction. A
    force without torque is attainable if |F_i| + |F_j| <= 1.155 N for each two axes, with the declared jets.

    Derivation: docs/theory/rendezvous.md.
    """

    def allocate(self) -> None:
        possible = pseudo_inverse(self.strength, self.demand, self.new_thrust)
        if not possible:
            self.status = JetAllocationStatus.TORQUE_LEFT_OUT
        scale = least_propellant(self.new_thrust, self.maximum_thrust)
        if scale < 1.0:
            self.status = JetAllocationStatus.SATURATED
