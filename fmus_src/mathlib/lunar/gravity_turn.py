"""Gravity turn with a constant ratio of thrust acceleration to gravity, in closed form. Kernel functions.

The thrust acceleration n g is opposite to the velocity v, which has the angle psi from the downward vertical. With tau
= tan(psi/2) and constant gravity: v is proportional to tau^(n - 1) + tau^(n + 1), gravity constant. Source: Citron,
Dunin and Meissinger 1964; Culler and Fried 1957.
"""

import math

from ...kernel.records import Field, Record


class GravityTurn(Record):
    """Gravity turn that ends at rest at the height of the target."""

    ratio = Field(
        unit="1", description="ratio of thrust acceleration to gravity; 0: no gravity turn ends at rest at this height"
    )
    duration = Field(unit="s", description="duration of the gravity turn until rest")
    distance = Field(unit="m", description="horizontal distance of the gravity turn until rest")


def gravity_turn(speed: float, descent_cosine: float, height: float, g: float) -> GravityTurn:
    """Return the gravity turn from a ``speed`` (m/s) at a ``height`` (m) above its end.

    ``descent_cosine`` is the cosine of the angle between velocity and downward vertical. No turn exists if the speed is
    so small that thrust balances gravity within rounding.
    """
    speed_square = speed * speed
    if not (height > 0.0 and descent_cosine > 0.0 and speed_square > 0.0 and g > 0.0):
        return GravityTurn(ratio=0.0, duration=0.0, distance=0.0)
    cosine = descent_cosine
    if cosine > 1.0:
        cosine = 1.0
    square = (1.0 - cosine) / (1.0 + cosine)  # of tau
    tau = math.sqrt(square)
    q = 1.0 + square
    fourth = square * square
    k = 2.0 * height * g * q * q / speed_square
    difference = 1.0 - fourth
    n = (difference + math.sqrt(difference * difference + 4.0 * k * (k + 1.0 + fourth))) / (2.0 * k)
    if not n > 1.0:
        return GravityTurn(ratio=0.0, duration=0.0, distance=0.0)
    duration = speed / (g * q) * (1.0 / (n - 1.0) + square / (n + 1.0))
    distance = 2.0 * speed * speed * tau / (g * q * q) * (1.0 / (2.0 * n - 1.0) + square / (2.0 * n + 1.0))
    return GravityTurn(ratio=n, duration=duration, distance=distance)
