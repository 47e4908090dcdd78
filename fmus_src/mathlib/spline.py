"""Polynomials between two states. Kernel functions.

A spline of degree 5 or 6 has seven coefficients c of powers of s = (t - start)/duration for one quantity. Value and
slope are prescribed at both ends, where the second derivative is 0; with degree 6 the third derivative is 0 at the end,
too. With D = (change of value) - (first slope) duration and E = (change of slope) duration the coefficients beyond the
initial motion are

    degree 5: (10 D - 4 E) s^3 + (-15 D +  7 E) s^4 + ( 6 D -  3 E) s^5
    degree 6: (20 D - 10 E) s^3 + (-45 D + 25 E) s^4 + (36 D - 21 E) s^5 + (-10 D + 6 E) s^6

Derivation: docs/systems/robot_rendezvous.md.
"""


def spline(
    value: float, slope: float, end_value: float, end_slope: float, duration: float, degree: int, c: list
) -> None:
    """Set c[7] to the coefficients of the spline, with slopes per unit of time, a duration > 0 and degree 5 or 6."""
    d = end_value - value - slope * duration
    e = (end_slope - slope) * duration
    c[0] = value
    c[1] = slope * duration
    c[2] = 0.0
    if degree == 6:
        c[3] = 20.0 * d - 10.0 * e
        c[4] = 25.0 * e - 45.0 * d
        c[5] = 36.0 * d - 21.0 * e
        c[6] = 6.0 * e - 10.0 * d
    else:
        c[3] = 10.0 * d - 4.0 * e
        c[4] = 7.0 * e - 15.0 * d
        c[5] = 6.0 * d - 3.0 * e
        c[6] = 0.0


def spline_value(c: list, s: float) -> float:
    """Return the value of the quantity at s."""
    return ((((((c[6] * s + c[5]) * s + c[4]) * s + c[3]) * s + c[2]) * s) + c[1]) * s + c[0]


def spline_rate(c: list, s: float, duration: float) -> float:
    """Return the first time derivative of the quantity at s."""
    slope = 6.0 * c[6] * s + 5.0 * c[5]
    slope = ((slope * s + 4.0 * c[4]) * s + 3.0 * c[3]) * s + 2.0 * c[2]
    return (slope * s + c[1]) / duration


def spline_acceleration(c: list, s: float, duration: float) -> float:
    """Return the second time derivative of the quantity at s."""
    curvature = 30.0 * c[6] * s + 20.0 * c[5]
    curvature = (curvature * s + 12.0 * c[4]) * s + 6.0 * c[3]
    return (curvature * s + 2.0 * c[2]) / (duration * duration)
