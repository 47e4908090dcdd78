"""Exact response of thrust to a command with a first-order lag. Kernel functions."""

from ...kernel.functions import expm1
from ...kernel.records import Field, Record


class LaggedThrust(Record):
    """Thrust over a step and its time integrals."""

    start = Field(unit="N", description="thrust at the start of the step")
    middle = Field(unit="N", description="thrust in the middle of the step")
    end = Field(unit="N", description="thrust at the end of the step")
    middle_impulse = Field(unit="N.s", description="impulse from the start to the middle of the step")
    impulse = Field(unit="N.s", description="impulse from the start to the end of the step")


def lagged_thrust(delivered: float, commanded: float, lag: float, h: float) -> LaggedThrust:
    """Return the thrust over h (s) for a constant command (N), starting from the thrust ``delivered`` (N).

    With a ``lag`` (s) of 0 the thrust equals the command.
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
