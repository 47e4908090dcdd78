"""Thrust that follows a command with a first-order lag, exactly. Kernel functions."""

from ..kernel.functions import expm1
from .vectors import Vector3, vector


def lagged_thrust(delivered: float, commanded: float, lag: float, h: float) -> tuple[Vector3, float, float]:
    """Thrust (N) at start, middle and end of h (s) under a command (N), and its impulses (N s) until the latter two.

    Thrust is ``delivered`` at the start, and the command at once where the lag (s) is 0.
    """
    excess = 0.0
    half = 1.0
    if lag > 0.0:
        excess = delivered - commanded
        half = -expm1(-0.5 * h / lag)
    middle_impulse = 0.5 * commanded * h + excess * lag * half
    impulse = commanded * h + excess * lag * half * (2.0 - half)
    middle = commanded + excess * (1.0 - half)
    end = commanded + excess * (1.0 - half) * (1.0 - half)
    return vector(commanded + excess, middle, end), middle_impulse, impulse
