"""Jet allocation in quantised thrusts, without torque."""

import math

from ..block import Parameter, State
from ..mathlib.actuators.jets import nearest_levels, thrust_of_levels
from ..mathlib.attitude.quaternion import to_body, to_reference
from ..mathlib.vectors import vector
from .jet_allocation import JetAllocation, JetAllocationStatus


class JetAllocationQuantised(JetAllocation):
    """Thrusts in multiples of thrust_quantum that give a force without torque.

    Such forces form the lattice

        F_i = 2 thrust_quantum c_i n_i

    with integers n_i all even or all odd (0.0577 N n with the declared jets). The attainable lattice point nearest to
    the commanded force is applied with least propellant; the remainder is added to the next command as an impulse in
    inertial axes (first-order sigma-delta). A force beyond the attainable ones is first scaled down, and the difference
    is not carried over. Torque commands, and forces that the geometry cannot give, are omitted and reported.

    Derivation: docs/theory/rendezvous.md.
    """

    thrust_quantum = Parameter(0.05, unit="N", minimum=1e-6, description="step of the quantised thrust of each jet")
    owed_impulse = State([0.0, 0.0, 0.0], unit="N.s", frame="inertial", description="commanded impulse not applied yet")

    def allocate(self) -> None:
        owed_body = to_body(self.attitude, self.owed_impulse)
        for i in range(3):
            cannot = self.strength.force[i] == 0.0 and self.demand.force[i] != 0.0
            if cannot or self.demand.torque[i] != 0.0:
                self.status = JetAllocationStatus.TORQUE_LEFT_OUT
        force_body = self.demand.force + owed_body / self.translation_period
        highest = float(math.floor(self.maximum_thrust / self.thrust_quantum + 1e-9))
        levels, scale = nearest_levels(self.strength.force, force_body, self.thrust_quantum, highest)
        if scale < 1.0:
            self.status = JetAllocationStatus.SATURATED
        thrust_of_levels(levels, self.thrust_quantum, self.new_thrust)
        left_body = [0.0] * 3
        for i in range(3):
            if self.strength.force[i] != 0.0:
                applied = 2.0 * self.thrust_quantum * self.strength.force[i] * levels[i]
                left_body[i] = (scale * force_body[i] - applied) * self.translation_period
        self.owed_impulse = to_reference(self.attitude, vector(*left_body))
