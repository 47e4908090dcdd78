"""Remaining torque of each jet."""

from ..block import Block, Parameter
from ..interfaces.ports import entry


class JetHealth(Block):
    """Factors on the torques of six jets, constant over a flight; faults on the connectors change them in flight.

    Ours: docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    factors = Parameter([1.0] * 6, unit="1", minimum=0.0, description="of +x, -x, +y, -y, +z, -z")
    jet_factor = entry.JET_FACTOR.output("likewise")

    def initialize(self) -> None:
        for k in range(6):
            self.jet_factor[k] = self.factors[k]

    def step(self, t: float, h: float) -> None:
        pass
