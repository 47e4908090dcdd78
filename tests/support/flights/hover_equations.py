"""Simplified hover-to-hover programme by the full equations of the paper (Huang 2017), with scipy's DOP853."""

import math
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp


def share_of(p):
    """Return the paper's k."""
    return 1.0 - p[2] ** 2 / (0.5 * p[0] ** 2)


def flown(p, vehicle, until=None):
    """Return the state x, x', y, y', propellant fraction, pitch and its rate under the programme p at a time, by
    default its end.

    Pitch is a state, driven by the switched angular acceleration; the first burn is where pitch is below its share of
    the largest deviation. ``vehicle``: full and least thrust over the mass at the start (m/s2), exhaust speed (m/s),
    gravity (m/s2), angular acceleration (rad/s2).
    """
    full, minimum, exhaust, gravity, acceleration = vehicle
    t2, t5, _, tp, t7 = p
    t1, t6 = 0.5 * t2, 0.5 * (t5 + t7)
    # the rates gained by both turns are equal: (t3 - t2) = (t5 - t4) = d, and the angles add up to 0
    length, turns = t5 - t2, t1 * t1 + (t7 - t6) ** 2
    d = np.min(np.roots([1.0, -length, turns]).real)
    corners = [0.0, t1, t2 + d, t5 - d, t6, t7]
    signs = [-1.0, 1.0, 0.0, -1.0, 1.0]
    least_pitch = 0.5 * math.pi - acceleration * t1 * t1
    bound = 0.5 * math.pi - share_of(p) * (0.5 * math.pi - least_pitch) if t2 > 0.0 else -math.inf

    def fly(start, end, state, turning, thrust):
        def rates(_, s):
            push = thrust / (1.0 - s[4])
            return [
                s[1],
                push * math.cos(s[5]),
                s[3],
                push * math.sin(s[5]) - gravity,
                thrust / exhaust,
                s[6],
                turning,
            ]

        def crossing(_, s):
            return s[5] - bound

        return solve_ivp(rates, (start, end), state, "DOP853", rtol=1e-12, atol=1e-11, events=crossing)

    state, inside = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * math.pi, 0.0]), False
    cuts = sorted({*corners, t7 - tp})
    for start, end in pairwise(cuts):
        turning = acceleration * signs[np.searchsorted(corners, 0.5 * (start + end)) - 1]
        now = start
        while now < end and (until is None or now < until):
            thrust = full if now >= t7 - tp or inside else minimum
            stop = end if until is None else min(end, until)
            run = fly(now, stop, state, turning, thrust)
            collected = [t for t in run.t_events[0] if t > now + 1e-7]
            if collected and p[2] > 0.0 and now < t7 - tp:
                state = fly(now, collected[0], state, turning, thrust).y[:, -1]
                now, inside = collected[0], not inside
            else:
                state, now = run.y[:, -1], stop
    return state
