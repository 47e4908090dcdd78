"""Output feedback of the capsule, told the pressure."""

from ..interfaces.output_feedback_control import OutputFeedbackControl
from ..mathlib.entry_gains import SCHEDULE, SCHEDULED


class OutputFeedbackScheduled(OutputFeedbackControl):
    """Gains over the logarithm of the pressure, which it is told, with poles that follow the sideslip's own swing."""

    gains = OutputFeedbackControl.gains.with_start(SCHEDULED)
    pressures = OutputFeedbackControl.pressures.with_start(SCHEDULE)
