"""Position of a craft of Basilisk in the middle of its next step. Runs in Basilisk's environment."""

import numpy as np
from Basilisk.architecture import messaging, sysModel


class Ahead(sysModel.SysModel):
    """The craft's position in the middle of the next step, where Basilisk takes the surroundings of that step.

    Along a parabola under the gravity of a point mass (m3/s2): a straight line would be too high by an eighth of
    gravity times the square of the step, in air too thin at every step.
    """

    def __init__(self, craft: object, step: float, mu: float) -> None:
        super().__init__()
        self.ModelTag = "ahead"
        self.craft, self.length, self.mu = craft, step, mu
        self.states = messaging.SCStatesMsg()

    def UpdateState(self, now: int) -> None:  # noqa: N802
        """Write the position half a step after this time (ns)."""
        state = self.craft.scStateOutMsg.read()
        position, half = np.array(state.r_BN_N), 0.5 * self.length
        fall = -self.mu / np.linalg.norm(position) ** 3 * position
        state.r_BN_N = list(position + half * np.array(state.v_BN_N) + 0.5 * half**2 * fall)
        self.states.write(state, now, self.moduleID)
