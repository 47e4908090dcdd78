"""Jet allocation with the least propellant, in closed form."""

from ..mathlib.actuators.jets import least_propellant, pseudo_inverse
from .jet_allocation import JetAllocation, JetAllocationStatus


class JetAllocationLeastPropellant(JetAllocation):
    """Thrusts with the least sum that give the commanded wrench, if it is attainable.

        min Σ p    B p = wrench    0 <= p <= maximum_thrust

    The optimum is in closed form. An unattainable wrench is scaled down to the largest attainable one in the same
    direction. With the declared jets a force without torque is attainable if |F_i| + |F_j| <= 1.155 N for every pair of
    axes.

    Derivation: docs/theory/rendezvous.md.
    """

    def allocate(self) -> None:
        possible = pseudo_inverse(self.strength, self.demand, self.new_thrust)
        if not possible:
            self.status = JetAllocationStatus.TORQUE_LEFT_OUT
        scale = least_propellant(self.new_thrust, self.maximum_thrust)
        if scale < 1.0:
            self.status = JetAllocationStatus.SATURATED
