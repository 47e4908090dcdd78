"""Where a craft of Basilisk is in the middle of its next step. Runs in Basilisk's environment."""

import numpy as np
from Basilisk.architecture import messaging, sysModel


class Ahead(sysModel.SysModel):
    """The craft's position in the middle of the next step, where Basilisk takes the surroundings of that step."""

    def __init__(self, craft: object, step: float) -> None:
        super().__init__()
        self.ModelTag = "ahead"
        self.craft, self.length = craft, step
        self.states = messaging.SCStatesMsg()

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """Position half a step after this time (ns), at the present velocity."""
        state = self.craft.scStateOutMsg.read()
        state.r_BN_N = list(np.array(state.r_BN_N) + 0.5 * self.length * np.array(state.v_BN_N))
        self.states.write(state, now, self.moduleID)
