"""Output feedback of the capsule, the dual route, -0.35 on its upper level."""

from ..interfaces.output_feedback_control import OutputFeedbackControl
from ..mathlib.entry_gains import DUAL_B


class OutputFeedbackDualB(OutputFeedbackControl):
    """One gain for all pressures: the dual route, -0.35 on its upper level."""

    gains = OutputFeedbackControl.gains.with_start(DUAL_B * 3)
