"""Terminal guidance with a thrust acceleration linear in time, a(t) = a0 + a1 t. Kernel functions.

Gravity g acts along -k (k up, third axis). With dr = r_T - r, dV = V_T - V and time to go T:

    A = dV + g T k, B = dr - V T + g T^2/2 k, a0 = -(2/T^2)(A T - 3 B), a1 = (6/T^3)(A T - 2 B).

Source: Fomichev and Li 2017, with the corrections of docs/systems/lunar_terminal_guidance.md.
"""

import math

from ...kernel.records import Field, Record
from ..polynomial import LARGEST, evaluate, first_crossing, positive_roots, quadratic_roots
from ..vectors import Vector3, dot, norm, vector


class LinearThrust(Record):
    """Thrust acceleration linear in time, over one span."""

    size = Field(unit="m/s2", description="mean thrust over mass in the span")
    direction = Field(Vector3, unit="1", description="thrust direction at the start of the span, unit vector")
    rate = Field(Vector3, unit="1/s", description="time derivative of the thrust direction at the start of the span")


def impulse_and_miss(dr: Vector3, v: Vector3, dv: Vector3, g: float, time_to_go: float) -> tuple[Vector3, Vector3]:
    """Return A (m/s), the velocity to gain, and B (m), the miss without thrust, both after time_to_go."""
    drift = dr - time_to_go * v
    fall = 0.5 * g * time_to_go * time_to_go
    return vector(dv.x, dv.y, dv.z + g * time_to_go), vector(drift.x, drift.y, drift.z + fall)


def quadratic_time(dr: Vector3, v: Vector3, dv: Vector3, g: float) -> float:
    """Return the time to go (s) from |A| T = 2 |B| without its cubic term, on the published branch; 0 if none exists.

    The published branch applies to fast approaches, a2 < 0; for slow or hovering starts above the target (a2 > 0) it
    gives a negative time. A negative discriminant, which occurs in the last steps, is replaced by 0.
    """
    speed = norm(v)
    gain = norm(dv)
    distance = norm(dr)
    a2 = gain * gain - 4.0 * (speed * speed + g * dr.z)
    a3 = 8.0 * dot(dr, v)
    a4 = -4.0 * distance * distance
    discriminant = a3 * a3 - 4.0 * a2 * a4
    if discriminant < 0.0:
        discriminant = 0.0
    if a2 == 0.0:
        return 0.0
    return (-a3 - math.sqrt(discriminant)) / (2.0 * a2)


def cubic_time(dr: Vector3, v: Vector3, dv: Vector3, g: float) -> float:
    """Return the time to go (s) from the complete |A| T = 2 |B|, on the published branch; 0 if none exists.

    |A| T - 2 |B| is negative at T = 0. At its first root, where it rises through 0, the thrust reverses during the
    flight; in motion along a line A T = -2 B, and the thrust changes from 5 W in one direction to 7 W in the other. The
    published branch is the second root, where the function falls through 0; along a line A T = 2 B. This root does not
    exist for starts at rest, moving away from the target or slow above it, and it may not exist when navigation errors
    are as large as the remaining distance.
    """
    c = [0.0] * 5
    c[0] = -4.0 * dot(dr, dr)
    c[1] = 8.0 * dot(dr, v)
    c[2] = dot(dv, dv) - 4.0 * (dot(v, v) + g * dr.z)
    c[3] = 2.0 * g * (dv.z + 2.0 * v.z)
    turning = [0.0] * 2
    turnings = quadratic_roots(c[1], 2.0 * c[2], 3.0 * c[3], turning)
    peak = 0.0
    high = LARGEST
    for k in range(turnings):
        if 3.0 * c[3] * turning[k] + c[2] < 0.0:
            peak = turning[k]
        elif peak > 0.0:
            high = turning[k]
    if not (peak > 0.0 and peak < LARGEST):
        return 0.0
    height = evaluate(c, peak)
    if not height > 0.0:
        return 0.0
    # zero of the parabola that approximates the function at its peak
    guess = peak + math.sqrt(-height / (3.0 * c[3] * peak + c[2]))
    return first_crossing(c, peak, high, guess)


def keeps_direction(dr: Vector3, v: Vector3, dv: Vector3, g: float, time: float) -> bool:
    """Return True if a thrust that satisfies |A| T = 2 |B| with ``time`` (s) does not reverse, i.e. A.B > 0."""
    a, b = impulse_and_miss(dr, v, dv, g, time)
    return dot(a, b) > 0.0


def effort_slope(dr: Vector3, v: Vector3, dv: Vector3, g: float, weight: float, c: list) -> None:
    """Set c to the polynomial T^4 dJ/dT in T; J is the time integral of |a0 + a1 t|^2 plus twice ``weight`` (m2/s4).

    Without weight J = (|A T|^2 + 3 |A T - 2 B|^2)/T^3, and A T - 2 B = (dV + 2 V) T - 2 dr.
    """
    s = dv + 2.0 * v
    c[0] = -36.0 * dot(dr, dr)
    c[1] = 24.0 * dot(dr, s)
    c[2] = -(dot(dv, dv) + 3.0 * dot(s, s))
    c[3] = 0.0
    c[4] = g * g + 2.0 * weight


def effort_rises(dr: Vector3, v: Vector3, dv: Vector3, g: float, time: float) -> bool:
    """Return True if the integral of |a0 + a1 t|^2 would be larger for a flight longer than ``time`` (s)."""
    c = [0.0] * 5
    effort_slope(dr, v, dv, g, 0.0, c)
    return evaluate(c, time) > 0.0


def least_effort_time(dr: Vector3, v: Vector3, dv: Vector3, g: float) -> float:
    """Return the time to go (s) with the least integral of |a0 + a1 t|^2 (the first minimum); 0 if none exists.

    The time exists for g > 0 and dr other than 0; for a hover at a distance h above, below or beside the target it is
    sqrt(6 h/g). Source: D'Souza 1997, with a velocity at the target.
    """
    return weighted_effort_time(dr, v, dv, g, 0.0)


def weighted_effort_time(dr: Vector3, v: Vector3, dv: Vector3, g: float, weight: float) -> float:
    """Return the time to go (s) with the least integral of |a0 + a1 t|^2/2 + weight (m2/s4); 0 if none exists.

    Source: D'Souza 1997, equation 12.
    """
    c = [0.0] * 5
    effort_slope(dr, v, dv, g, weight, c)
    slope = [0.0] * 5
    bend = [0.0] * 4
    turning = [0.0] * 4
    roots = [0.0] * 4
    for i in range(4):
        slope[i] = (i + 1.0) * c[i + 1]
    bends = quadratic_roots(slope[1], 2.0 * slope[2], 3.0 * slope[3], bend)
    turnings = positive_roots(slope, bend, bends, turning)
    count = positive_roots(c, turning, turnings, roots)
    if count == 0:
        return 0.0
    return roots[0]


def linear_thrust(a: Vector3, b: Vector3, time: float, span: float, direction: Vector3, rate: Vector3) -> LinearThrust:
    """Return the thrust a0 + a1 t over ``span`` (s): mean magnitude, initial direction, and rate of the direction.

    For a0 = 0 the direction is the direction of the mean and its rate is 0; without thrust, the arguments ``direction``
    and ``rate`` are returned.
    """
    p = 3.0 * b - time * a
    q = time * a - 2.0 * b
    fraction = 1.5 * span / time
    mean = p + fraction * q
    length = norm(p)
    size = norm(mean)
    if length > 0.0:
        along = dot(q, p) / (length * length)
        direction = p / length
        rate = 3.0 / time * (q - along * p) / length
    elif size > 0.0:
        direction = mean / size
        rate = vector(0.0, 0.0, 0.0)
    return LinearThrust(size=2.0 * size / (time * time), direction=direction, rate=rate)
