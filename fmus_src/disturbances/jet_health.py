"""Actual torque of each jet as a fraction of its nominal torque."""

from ..block import Block, Parameter
from ..interfaces.ports import entry


class JetHealth(Block):
    """Torque factors of six jets, constant over a simulation unless faults are injected at the connectors.

    See docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    factors = Parameter(
        [1.0] * 6,
        unit="1",
        minimum=0.0,
        description="ratio of actual to nominal torque of the jets about the body axes +x, -x, +y, -y, +z, -z",
    )
    jet_factor = entry.JET_FACTOR.output(
        "ratio of actual to nominal torque of the jets about the body axes +x, -x, +y, -y, +z, -z"
    )

    def initialize(self) -> None:
        for k in range(6):
            self.jet_factor[k] = self.factors[k]

    def step(self, t: float, h: float) -> None:
        pass
