"""Terminal guidance with a thrust acceleration linear in time, a(t) = a0 + a1 t. Kernel functions.

Gravity g acts along -k (k up, third axis). With dr = r_T - r, dV = V_T - V and time-to-go T:
A = dV + g T k, B = dr - V T + g T^2/2 k, a0 = -(2/T^2)(A T - 3 B), a1 = (6/T^3)(A T - 2 B).
Source: Fomichev and Li 2017, with the corrections of docs/lunar_terminal_guidance.md.
"""

import math

from .vectors import norm


def impulse_and_miss(dr: list, v: list, dv: list, g: float, time_to_go: float, a: list, b: list) -> None:
    """A (m/s), velocity still to gain, and B (m), the miss without thrust, both after time_to_go."""
    for i in range(3):
        a[i] = dv[i]
        b[i] = dr[i] - v[i] * time_to_go
    a[2] = a[2] + g * time_to_go
    b[2] = b[2] + 0.5 * g * time_to_go * time_to_go


def quadratic_time(dr: list, v: list, dv: list, g: float) -> float:
    """Time-to-go (s) from |A| T = 2 |B| without its cubic term, on the published branch.

    0 where there is none. The branch is that of fast approaches, a2 < 0; for slow or hovering
    starts above the target (a2 > 0) it gives a negative time. A negative discriminant counts as
    0, which happens in the last steps.
    """
    speed = norm(v)
    gain = norm(dv)
    distance = norm(dr)
    a2 = gain * gain - 4.0 * (speed * speed + g * dr[2])
    a3 = 8.0 * (dr[0] * v[0] + dr[1] * v[1] + dr[2] * v[2])
    a4 = -4.0 * distance * distance
    discriminant = a3 * a3 - 4.0 * a2 * a4
    if discriminant < 0.0:
        discriminant = 0.0
    if a2 == 0.0:
        return 0.0
    return (-a3 - math.sqrt(discriminant)) / (2.0 * a2)


def cubic_time(dr: list, v: list, dv: list, vt: list, g: float) -> float:
    """Time-to-go (s) from |A| T = 2 |B| in full, by Newton from the quadratic root; 0 where that has none.

    Eight iterations, which settle everywhere in the published box; where they lead to a time that
    is not positive, outside of it, the quadratic root is returned.
    """
    start = quadratic_time(dr, v, dv, g)
    if start <= 0.0:
        return 0.0
    speed = norm(v)
    gain = norm(dv)
    distance = norm(dr)
    c3 = 2.0 * g * (vt[2] + v[2])
    c2 = gain * gain - 4.0 * (speed * speed + g * dr[2])
    c1 = 8.0 * (dr[0] * v[0] + dr[1] * v[1] + dr[2] * v[2])
    c0 = -4.0 * distance * distance
    time = start
    change = time
    for _ in range(8):
        if abs(change) > 1e-12 * time:
            value = ((c3 * time + c2) * time + c1) * time + c0
            slope = (3.0 * c3 * time + 2.0 * c2) * time + c1
            if slope != 0.0:
                change = value / slope
                time = time - change
    if time <= 0.0:
        return start
    return time
