"""The mean of pulses instead of pulses."""

from .pulse_allocation import PulseAllocation


class PulseAllocationMean(PulseAllocation):
    """Passes the demand as a torque held over the tick: pulse allocation as linear studies see it."""

    mean = PulseAllocation.mean.with_start(True)
