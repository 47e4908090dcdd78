"""Jet allocation in whole levels of thrust, without torque."""

import math

from ..block import Parameter, State
from ..mathlib.actuators.jets import nearest_levels, thrust_of_levels
from ..mathlib.attitude.quaternion import to_body, to_reference
from ..mathlib.vectors import vector
from .jet_allocation import JetAllocation, JetAllocationStatus


class JetAllocationQuantised(JetAllocation):
    """Thrusts in multiples of thrust_quantum that give a force and no torque at all.

    Such forces are 2 thrust_quantum strength.force[i] n[i] with integers n that are all even or all odd (0.0577 N n
    with the declared jets). The nearest attainable neighbour of the wanted force is given, by the least
    propellant. What it lacks is added to the next command as an impulse in inertial axes (first-order
    sigma-delta), so that the mean force is the wanted one. A force beyond what is attainable is scaled
    first, and what that takes off is not carried. A torque command is left out and reported, as is a
    force that the geometry cannot give. Derivation: docs/theory/rendezvous.md.
    """

    thrust_quantum = Parameter(0.05, unit="N", minimum=1e-6, description="thrusts are multiples of it")
    owed_impulse = State([0.0, 0.0, 0.0], unit="N.s", frame="inertial", description="wanted and not given yet")

    def allocate(self) -> None:
        owed = to_body(self.attitude, self.owed_impulse)
        for i in range(3):
            cannot = self.strength.force[i] == 0.0 and self.wanted.force[i] != 0.0
            if cannot or self.wanted.torque[i] != 0.0:
                self.status = JetAllocationStatus.TORQUE_LEFT_OUT
        force = self.wanted.force + owed / self.translation_period
        highest = float(math.floor(self.maximum_thrust / self.thrust_quantum + 1e-9))
        levels, scale = nearest_levels(self.strength.force, force, self.thrust_quantum, highest)
        if scale < 1.0:
            self.status = JetAllocationStatus.SATURATED
        thrust_of_levels(levels, self.thrust_quantum, self.new_thrust)
        left = [0.0] * 3
        for i in range(3):
            if self.strength.force[i] != 0.0:
                given = 2.0 * self.thrust_quantum * self.strength.force[i] * levels[i]
                left[i] = (scale * force[i] - given) * self.translation_period
        self.owed_impulse = to_reference(self.attitude, vector(*left))
