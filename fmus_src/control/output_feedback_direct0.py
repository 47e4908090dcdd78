"""Output feedback of the capsule, the real poles on bank and sideslip, the pair below."""

from ..interfaces.output_feedback_control import OutputFeedbackControl
from ..mathlib.entry_gains import DIRECT_0


class OutputFeedbackDirect0(OutputFeedbackControl):
    """One gain for all pressures: the real poles on bank and sideslip, the pair below."""

    gains = OutputFeedbackControl.gains.with_start(DIRECT_0 * 3)
