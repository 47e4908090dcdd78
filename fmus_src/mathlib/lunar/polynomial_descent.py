"""Powered descent with a thrust acceleration that is a sum of powers of the time to go. Kernel functions.

With t the time to go, a_f the final thrust acceleration, gamma_2 = kr/(gamma + 2) - 2 and gravity (0, 0, -g),

    a(t) = a_f + d1 t^gamma + d2 t^gamma_2,

where position and velocity at the end determine d1 and d2. Apollo's P63 and P64 have gamma = 1, kr = 12 (Klumpp 1974);
E-guidance and ZEM/ZEV have gamma = 1, kr = 6 (Cherry 1964; Ebrahimi et al. 2008; Guo, Hawkins and Wie 2011) and do not
depend on a_f.

Frame: landing site; dr = r_T - r and dv = v_T - v in constant gravity.

Source: Lu 2019 and 2020, "Augmented Apollo powered descent guidance", "Theory of fractional-polynomial powered descent
guidance", JGCD 42(3), 43(3).
"""

from ...kernel.functions import pow
from ...kernel.records import Field, Record
from ..vectors import Vector3, dot, vector

PASSES = 8  # iterations of Newton's method for the time of a jerk, as many as Apollo performed
SETTLED = 1e-6  # relative change of the time


class DescentShape(Record):
    """Parameters of the control law."""

    final = Field(Vector3, unit="m/s2", description="thrust acceleration at the target")
    gamma = Field(unit="1", description="first exponent gamma of the time to go")
    kr = Field(unit="1", description="gain of the position error")


class DescentProfile(Record):
    """Thrust acceleration final + first s^gamma + second s^gamma_2, with s = time to go/initial time to go."""

    final = Field(Vector3, unit="m/s2", description="thrust acceleration at the target")
    first = Field(Vector3, unit="m/s2", description="coefficient of s^gamma")
    second = Field(Vector3, unit="m/s2", description="coefficient of s^gamma_2")
    gamma = Field(unit="1", description="first exponent gamma of the time to go")
    gamma_2 = Field(unit="1", description="second exponent of the time to go")


def second_exponent(shape: DescentShape) -> float:
    """Return the exponent gamma_2."""
    return shape.kr / (shape.gamma + 2.0) - 2.0


def is_regular(shape: DescentShape) -> bool:
    """Return True if both exponents are nonnegative and differ, so that a profile exists."""
    gamma_2 = second_exponent(shape)
    return shape.gamma >= 0.0 and gamma_2 >= 0.0 and gamma_2 != shape.gamma


def feedback(dr: Vector3, v: Vector3, dv: Vector3, g: float, time: float, shape: DescentShape) -> Vector3:
    """Return the present thrust acceleration (m/s2) with ``time`` (s) to go. Source: Lu 2019, equation 22."""
    gamma = shape.gamma
    ratio = shape.kr / (gamma + 2.0)
    down = vector(0.0, 0.0, -g)
    straight = gamma * (0.5 * ratio - 1.0) * shape.final + (0.5 * gamma * ratio - gamma - 1.0) * down
    return straight + (gamma + 1.0) * (1.0 - ratio) / time * dv + shape.kr / (time * time) * (dr - time * v)


def descent_profile(dr: Vector3, v: Vector3, dv: Vector3, g: float, time: float, shape: DescentShape) -> DescentProfile:
    """Return the profile that satisfies the conditions at both ends in ``time`` (s), for a regular shape."""
    gamma_2 = second_exponent(shape)
    a1 = 1.0 / (shape.gamma + 1.0)
    b1 = 1.0 / (shape.gamma + 2.0)
    a2 = 1.0 / (gamma_2 + 1.0)
    b2 = 1.0 / (gamma_2 + 2.0)
    constant = shape.final + vector(0.0, 0.0, -g)
    p = dv / time - constant
    q = (dr - time * v) / (time * time) - 0.5 * constant
    determinant = a1 * b2 - a2 * b1
    return DescentProfile(
        final=shape.final,
        first=(b2 * p - a2 * q) / determinant,
        second=(a1 * q - b1 * p) / determinant,
        gamma=shape.gamma,
        gamma_2=gamma_2,
    )


def raise_fraction(s: float, exponent: float) -> float:
    """Return s^exponent for a fraction s, by products if the exponent is a small integer; 0^0 = 1."""
    if exponent == 0.0:
        return 1.0
    if exponent == 1.0:
        return s
    if exponent == 2.0:
        return s * s
    if not s > 0.0:
        return 0.0
    return pow(s, exponent)


def thrust_at(profile: DescentProfile, s: float) -> Vector3:
    """Return the thrust acceleration (m/s2) at the fraction s of the time to go."""
    first = raise_fraction(s, profile.gamma) * profile.first
    return profile.final + first + raise_fraction(s, profile.gamma_2) * profile.second


def offset_at(profile: DescentProfile, target_velocity: Vector3, g: float, time: float, s: float) -> Vector3:
    """Return the position (m) relative to the target at the fraction s of ``time`` (s) to go, in constant gravity."""
    square = time * time
    half = 0.5 * s * s * square * (profile.final + vector(0.0, 0.0, -g))
    gamma = profile.gamma
    gamma_2 = profile.gamma_2
    first = raise_fraction(s, gamma) * s * s / ((gamma + 1.0) * (gamma + 2.0)) * profile.first
    second = raise_fraction(s, gamma_2) * s * s / ((gamma_2 + 1.0) * (gamma_2 + 2.0)) * profile.second
    return half + square * (first + second) - s * time * target_velocity


def jerk_time(
    dr: Vector3, v: Vector3, dv: Vector3, constant: Vector3, forward: Vector3, jerk: float, time: float
) -> float:
    """Return the time to go (s) of a quartic with this ``jerk`` (m/s3) along ``forward`` at the target; 0 if none.

    ``constant`` is the sum of thrust acceleration and gravity (m/s2) at the target; ``time`` (s) is the initial value
    of Newton's method. Source: Klumpp 1974, equation 12.
    """
    arrival = v + dv
    square = 6.0 * dot(constant, forward)
    linear = dot(18.0 * arrival + 6.0 * v, forward)
    free = 24.0 * dot(dr, forward)
    t = -time
    for _ in range(PASSES):
        value = ((jerk * t + square) * t + linear) * t + free
        slope = (3.0 * jerk * t + 2.0 * square) * t + linear
        if slope == 0.0:
            return 0.0
        step = value / slope
        t = t - step
        if abs(step) < SETTLED * abs(t):
            if t < 0.0:
                return -t
            return 0.0
    return 0.0
