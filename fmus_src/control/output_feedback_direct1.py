"""Output feedback of the capsule, the turning pair on bank and sideslip, the real poles below."""

from ..interfaces.output_feedback_control import OutputFeedbackControl
from ..mathlib.entry_gains import DIRECT_1


class OutputFeedbackDirect1(OutputFeedbackControl):
    """One gain for all pressures: the turning pair on bank and sideslip, the real poles below."""

    gains = OutputFeedbackControl.gains.with_start(DIRECT_1 * 3)
