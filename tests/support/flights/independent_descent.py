"""Independent planar lunar descent: the published equations and the law written out, without a matrix.

Source: Diveev, Pupkov and Sofronova 2013. `encoded_law` is the law that the published matrix encodes, `printed_law` the
law printed in the paper. Units: m, m/s, s, rad, kg and, for thrust, kgf.
"""

import math
from collections.abc import Callable

Q1, Q2, Q3 = 1.50049, 13.54590, 12.96753
H0, HF = 18148.0, 1500.0
G0, RADIUS = 1.623, 1.7384e6
P0, DP = 440.0, 80.0  # kgf
ISP, STANDARD = 319.0, 9.80665
LARGE = 1e8
LARGEST_EXPONENT = -math.log(1e-8)
TRUE, LEGACY = LARGE, LARGEST_EXPONENT  # what exp saturates to


def _step(z: float) -> float:
    return 1.0 if z >= 0.0 else 0.0


def _odd_exp(z: float) -> float:
    return math.copysign(math.exp(abs(z)) - 1.0 if abs(z) <= LARGEST_EXPONENT else LARGE, z)


def _odd_root(z: float) -> float:
    return math.copysign(math.sqrt(abs(z)), z)


def _sigmoid(z: float) -> float:
    """Return (1 - exp(-z))/(1 + exp(-z)) without overflow."""
    return math.tanh(z / 2.0)


def encoded_law(path_angle: float, altitude: float, saturation: float) -> tuple[float, float]:
    """Return u1 (rad) and u2 (kgf) before they are limited; exp takes the value ``saturation`` above ln 1e8."""

    def exp(z: float) -> float:
        return math.exp(z) if z <= LARGEST_EXPONENT else saturation

    p, d = math.pi + path_angle, (HF - altitude) / H0
    z7 = Q1 * p
    z8 = Q2 * d * (p - p**3)
    z11 = z8 + _step(d)
    z12 = -Q3 * path_angle * math.cos(path_angle)
    a = z11 + _odd_root(d) + _odd_exp(z12)
    b = 1.0 / Q2 + _odd_exp(z7) + exp(z11) + exp(z12)
    inverse = 1.0 / z7 if abs(z7) > 1e-8 else math.copysign(LARGE, z7)
    u1 = inverse + _step(z8) + _sigmoid(a)
    return u1, math.cbrt(u1) + exp(b) - z12


def printed_law(path_angle: float, altitude: float, saturation: float) -> tuple[float, float]:
    """Evaluate the printed formulas, mistakes included."""

    def exp(z: float) -> float:
        return math.exp(z) if z <= LARGEST_EXPONENT else saturation

    p, d = math.pi + path_angle, (HF - altitude) / H0
    c = Q3 * path_angle * math.cos(path_angle)
    z8 = Q2 * d * (p - p**3)
    a = _odd_exp(c) + _step(d) + z8 + _odd_root(d)
    b = exp(z8 * _step(d)) + exp(c) + _odd_exp(Q1 * p) + 1.0 / Q2
    u1 = 1.0 / (Q1 * p) + _step(z8) + _sigmoid(a)
    return u1, math.cbrt(u1) + exp(b) - c


def fly(
    law: Callable[[float, float, float], tuple[float, float]],
    altitude: float,
    path_angle: float,
    saturation: float = LEGACY,
    step: float = 0.01,
    end: float = 400.0,
) -> tuple[float, float, float]:
    """Fly; return time, speed and altitude at the hand-over (less than 6 m/s at 1.2 to 1.8 km), on the ground, or at
    ``end``.

    The published V, th, h and m are integrated by Heun's method, the law evaluated at both of its slopes.
    """

    def slope(v: float, th: float, h: float, m: float) -> tuple[float, float, float, float]:
        u1, u2 = law(th, h, saturation)
        u1, thrust = max(0.0, min(math.pi, u1)), P0 + max(-DP, min(DP, u2))
        w, g = STANDARD * thrust / m, G0 * (RADIUS / (RADIUS + h)) ** 2
        return (
            w * math.cos(u1 - th) - g * math.cos(th),
            (w * math.sin(u1 - th) + g * math.sin(th)) / v,
            v * math.cos(th),
            -thrust / ISP,
        )

    y = (1689.0, path_angle, altitude, 940.0)
    for n in range(round(end / step)):
        if y[2] <= 0.0 or (y[0] < 6.0 and 1200.0 <= y[2] <= 1800.0):
            return n * step, y[0], y[2]
        k1 = slope(*y)
        k2 = slope(*(a + step * b for a, b in zip(y, k1, strict=True)))
        y = tuple(a + step / 2.0 * (b + c) for a, b, c in zip(y, k1, k2, strict=True))
    return end, y[0], y[2]
