"""Output feedback of the capsule, the dual route, -0.6 on its upper level."""

from ..interfaces.output_feedback_control import OutputFeedbackControl
from ..mathlib.entry_gains import DUAL_A


class OutputFeedbackDualA(OutputFeedbackControl):
    """One gain for all pressures: the dual route, -0.6 on its upper level."""

    gains = OutputFeedbackControl.gains.with_start(DUAL_A * 3)
