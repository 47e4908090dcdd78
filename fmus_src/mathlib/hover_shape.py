"""Pitch and throttle of the simplified hover-to-hover programme over time. Kernel functions.

A lander turns from the vertical towards its target, over to the other side to brake, and back, with no angular
acceleration but +a, -a and 0; the engine gives full thrust once about the first turning point and once at the end,
its least in between. The deviation is the angle of thrust from the vertical, positive against the way to go.

A programme is a list of five times (s) with the indices TURN, RETURN, WIDTH, LAST_BURN and END: t2, where the
deviation is least; t5, where it is largest; w = t1 sqrt(2 (1 - k)), half the first burn where that lies about t2
symmetrically, 0: no first burn; tp, the last burn's length; t7, the end. Its shape is the list of SHAPE times that
`shape` makes of it. Source: Huang 2017, with the pieces of its equations where they join.
"""

import math

TURN = 0
RETURN = 1
WIDTH = 2
LAST_BURN = 3
END = 4
UNKNOWNS = 5

# A shape: t1, t2, ..., t7; the first burn's begin and end, the last burn's begin; d = t3 - t2; t7 - t6.
SHAPE = 12

STEEPEST = 0.5 * math.pi  # rad; largest deviation, beyond which thrust would push down


def clear(p: list) -> None:
    """p = no programme."""
    for i in range(UNKNOWNS):
        p[i] = 0.0


def copy(p: list, other: list) -> None:
    """other = p, programmes."""
    for i in range(UNKNOWNS):
        other[i] = p[i]


def shape(p: list, acceleration: float, s: list) -> bool:
    """s[12] = the shape of the programme p at an angular acceleration (rad/s2, > 0); whether there is one.

    t3 and t4 bound the stretch of constant rate, d after t2 and before t5, that joins both turns:
    d^2 - (t5 - t2) d + t1^2 + (t7 - t6)^2 = 0. There is none without room for that, where thrust would point down,
    and where the burns overlap; s is not to be used then.
    """
    first = 0.5 * p[TURN]
    last = 0.5 * (p[END] - p[RETURN])
    between = p[RETURN] - p[TURN]
    width = p[WIDTH]
    room = between * between - 4.0 * (first * first + last * last)
    turns = first >= 0.0 and last >= 0.0 and between > 0.0 and room >= 0.0 and acceleration > 0.0
    if not (turns and width >= 0.0 and p[LAST_BURN] >= 0.0 and math.isfinite(p[END]) and room < math.inf):
        return False
    if acceleration * first * first > STEEPEST or acceleration * last * last > STEEPEST:
        return False
    d = 2.0 * (first * first + last * last) / (between + math.sqrt(room))
    fraction = 2.0 * first * first - width * width  # 2 k t1^2
    if not fraction >= 0.0:
        return False
    s[0] = first
    s[1] = p[TURN]
    s[2] = p[TURN] + d
    s[3] = p[RETURN] - d
    s[4] = p[RETURN]
    s[5] = p[RETURN] + last
    s[6] = p[END]
    s[7] = p[TURN] - width
    s[8] = p[TURN] + width
    if width > first:
        s[7] = math.sqrt(fraction)
    if width > d:
        if not d > 0.0:
            return False
        s[8] = p[TURN] + (width * width + d * d) / (2.0 * d)
    s[9] = p[END] - p[LAST_BURN]
    s[10] = d
    s[11] = last
    return s[8] <= s[9]


def pitch(s: list, acceleration: float, t: float) -> tuple[float, float]:
    """Deviation (rad) and its rate (rad/s) at the time t (s); 0 before the start and from the end on."""
    begin, value, rate, half = pitch_piece(s, acceleration, t)
    since = t - begin
    return value + since * (rate + since * half), rate + 2.0 * since * half


def pitch_piece(s: list, acceleration: float, t: float) -> tuple[float, float, float, float]:
    """The parabola that the deviation follows at t: from which time (s), its value, rate and half the acceleration."""
    if not (t > 0.0 and t < s[6]):
        return t, 0.0, 0.0, 0.0
    if t < s[0]:
        return 0.0, 0.0, 0.0, -0.5 * acceleration
    if t < s[2]:
        return s[1], -acceleration * s[0] * s[0], 0.0, 0.5 * acceleration
    if t < s[3]:
        return s[2], acceleration * (0.5 * s[10] * s[10] - s[0] * s[0]), acceleration * s[10], 0.0
    if t < s[5]:
        return s[4], acceleration * s[11] * s[11], 0.0, -0.5 * acceleration
    return s[6], 0.0, 0.0, 0.5 * acceleration


def full_thrust(s: list, t: float) -> bool:
    """Whether the engine gives full thrust at the time t (s), in place of its least."""
    return (t >= s[7] and t < s[8]) or (t >= s[9] and t < s[6])


def burnt(s: list, t: float) -> float:
    """Time at full thrust (s) from the start to t (s)."""
    time = 0.0
    if t > s[7]:
        time = s[8] - s[7]
        if t < s[8]:
            time = t - s[7]
    if t > s[9]:
        time = time + t - s[9]
    return time
