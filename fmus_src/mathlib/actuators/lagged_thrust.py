"""Thrust that follows a command with a first-order lag, exactly. Kernel functions."""

from ...kernel.functions import expm1
from ...kernel.records import Field, Record


class LaggedThrust(Record):
    """Thrust over a step, and its integrals."""

    start = Field(unit="N", description="at the start of the step")
    middle = Field(unit="N", description="in its middle")
    end = Field(unit="N", description="at its end")
    middle_impulse = Field(unit="N.s", description="until the middle")
    impulse = Field(unit="N.s", description="until the end")


def lagged_thrust(delivered: float, commanded: float, lag: float, h: float) -> LaggedThrust:
    """Return thrust over h (s) under a command (N).

    Thrust is ``delivered`` at the start, and the command at once where the lag (s) is 0.
    """
    excess = 0.0
    half = 1.0
    if lag > 0.0:
        excess = delivered - commanded
        half = -expm1(-0.5 * h / lag)
    return LaggedThrust(
        start=commanded + excess,
        middle=commanded + excess * (1.0 - half),
        end=commanded + excess * (1.0 - half) * (1.0 - half),
        middle_impulse=0.5 * commanded * h + excess * lag * half,
        impulse=commanded * h + excess * lag * half * (2.0 - half),
    )
