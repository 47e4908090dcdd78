"""Polynomials that lead from one state to another. Kernel functions.

A spline of degree 5 or 6 is a polynomial in s = (t - start)/duration, for one quantity: value and slope are given at
both ends, and the second derivative is 0 there. The term of degree 6 makes the third derivative 0 at the end, too.
With D = what the value gains beyond first slope times duration and E = duration times what the slope gains:

    degree 5: (10 D - 4 E) s^3 + (-15 D +  7 E) s^4 + ( 6 D -  3 E) s^5
    degree 6: (20 D - 10 E) s^3 + (-45 D + 25 E) s^4 + (36 D - 21 E) s^5 + (-10 D + 6 E) s^6

Derivation: docs/systems/robot_rendezvous.md.
"""

from ..kernel.records import Field, Record


class Spline(Record):
    """c0 + c1 s + ... + c6 s^6."""

    c0 = Field(description="coefficient of s^0")
    c1 = Field(description="coefficient of s^1")
    c2 = Field(description="coefficient of s^2")
    c3 = Field(description="coefficient of s^3")
    c4 = Field(description="coefficient of s^4")
    c5 = Field(description="coefficient of s^5")
    c6 = Field(description="coefficient of s^6")


def spline(value: float, slope: float, end_value: float, end_slope: float, duration: float, degree: int) -> Spline:
    """The spline; slopes are per unit of time, duration > 0, degree 5 or 6."""
    d = end_value - value - slope * duration
    e = (end_slope - slope) * duration
    if degree == 6:
        return Spline(
            c0=value,
            c1=slope * duration,
            c2=0.0,
            c3=20.0 * d - 10.0 * e,
            c4=25.0 * e - 45.0 * d,
            c5=36.0 * d - 21.0 * e,
            c6=6.0 * e - 10.0 * d,
        )
    return Spline(
        c0=value,
        c1=slope * duration,
        c2=0.0,
        c3=10.0 * d - 4.0 * e,
        c4=7.0 * e - 15.0 * d,
        c5=6.0 * d - 3.0 * e,
        c6=0.0,
    )


def spline_value(c: Spline, s: float) -> float:
    """The quantity at s."""
    return ((((((c.c6 * s + c.c5) * s + c.c4) * s + c.c3) * s + c.c2) * s) + c.c1) * s + c.c0


def spline_rate(c: Spline, s: float, duration: float) -> float:
    """Its derivative by time at s."""
    slope = 6.0 * c.c6 * s + 5.0 * c.c5
    slope = ((slope * s + 4.0 * c.c4) * s + 3.0 * c.c3) * s + 2.0 * c.c2
    return (slope * s + c.c1) / duration


def spline_acceleration(c: Spline, s: float, duration: float) -> float:
    """Its second derivative by time at s."""
    curvature = 30.0 * c.c6 * s + 20.0 * c.c5
    curvature = (curvature * s + 12.0 * c.c4) * s + 6.0 * c.c3
    return (curvature * s + 2.0 * c.c2) / (duration * duration)
