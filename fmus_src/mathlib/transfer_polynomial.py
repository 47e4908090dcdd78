"""Transfers to rest by polynomials of degree 7, and the thrust that flies them. Kernel functions.

A transfer is a list of 24 coefficients (m), axis by axis, of the position over s = t/duration; it is meant from 0 to
duration. Its thrust over mass is the acceleration less gravity: f = r'' + lift, with lift = -gravity (m/s2), constant
over the transfer. Frame: any that does not rotate. Equations: docs/systems/hover_transfer.md.
"""

import math

from ..kernel.functions import exp
from .vectors import Vector3, clip, cross, dot, norm, vector

TRANSFER = 24
SAMPLES = 41  # of a transfer, where its limits are looked at

# Largest speed and acceleration from rest to rest over a way D, in D/T and D/T^2: r' = 140 s^3 (1 - s)^3 D/T.
FASTEST = 2.1875
HARDEST = 7.5132
SHORTEST = 10.0  # s

# Durations that a capture is tried with: FIRST GROWTH^k, k < TRIALS.
FIRST = 8.0  # s
GROWTH = 1.02
TRIALS = 150
EXCESS_PRICE = 1000.0  # m/s for a limit exceeded by all of itself

# Limits of a transfer: a list of four.
LARGEST_THRUST = 0  # N
LEAST_THRUST = 1  # N
LARGEST_SWING = 2  # rad/s2
EXHAUST_SPEED = 3  # m/s


def transfer(
    place: Vector3, speed: Vector3, acceleration: Vector3, jerk: Vector3, goal: Vector3, duration: float, c: list
) -> None:
    """c[24] = the transfer from place (m), speed, acceleration and jerk to rest at goal, without jerk there."""
    for i in range(3):
        p = place[i]
        v = speed[i] * duration
        a = 0.5 * acceleration[i] * duration * duration
        j = jerk[i] * duration * duration * duration / 6.0
        e0 = goal[i] - p - v - a - j
        e1 = -v - 2.0 * a - 3.0 * j
        e2 = -2.0 * a - 6.0 * j
        e3 = -6.0 * j
        c[8 * i] = p
        c[8 * i + 1] = v
        c[8 * i + 2] = a
        c[8 * i + 3] = j
        c[8 * i + 4] = 35.0 * e0 - 15.0 * e1 + 2.5 * e2 - e3 / 6.0
        c[8 * i + 5] = -84.0 * e0 + 39.0 * e1 - 7.0 * e2 + 0.5 * e3
        c[8 * i + 6] = 70.0 * e0 - 34.0 * e1 + 6.5 * e2 - 0.5 * e3
        c[8 * i + 7] = -20.0 * e0 + 10.0 * e1 - 2.0 * e2 + e3 / 6.0


def derivative(c: list, order: int, t: float, duration: float) -> Vector3:
    """Position (order 0; m) or its derivative of that order (m/s^order) at the time t (s), duration > 0."""
    s = t / duration
    part = [0.0] * 3
    for n in range(8 - order):
        k = 7 - n
        factor = 1.0
        for m in range(order):
            factor = factor * float(k - m)
        for i in range(3):
            part[i] = part[i] * s + factor * c[8 * i + k]
    for _ in range(order):
        for i in range(3):
            part[i] = part[i] / duration
    return vector(*part)


def thrust_along(c: list, t: float, duration: float, lift: Vector3) -> tuple[float, Vector3, Vector3, Vector3]:
    """Thrust over mass (m/s2) at the time t (s), its direction and the direction's first two derivatives.

    Where there is no thrust, the direction is that of lift, at rest.
    """
    f = derivative(c, 2, t, duration) + lift
    size = norm(f)
    if size == 0.0:
        rest = vector(0.0, 0.0, 0.0)
        weight = norm(lift)
        if weight == 0.0:
            return 0.0, vector(0.0, 0.0, 1.0), rest, rest
        return 0.0, lift / weight, rest, rest
    jerk = derivative(c, 3, t, duration)
    snap = derivative(c, 4, t, duration)
    d = f / size
    rate = (jerk - dot(jerk, d) * d) / size
    bend = (snap - (dot(d, snap) + dot(rate, jerk)) * d - 2.0 * dot(jerk, d) * rate) / size
    return size, d, rate, bend


def slow_duration(way: float, speed: float, acceleration: float) -> float:
    """Duration (s) of a transfer from rest over a way (m), within a speed and an acceleration, both > 0."""
    time = SHORTEST
    if FASTEST * way / speed > time:
        time = FASTEST * way / speed
    accelerating = math.sqrt(HARDEST * way / acceleration)
    if accelerating > time:
        time = accelerating
    return time


def expense(c: list, duration: float, lift: Vector3, mass: float, limits: list, bearable: float) -> tuple[float, float]:
    """Integral of thrust over mass (m/s) over a transfer, and by how much it exceeds a limit at most.

    Both only as far as it is not dearer than ``bearable`` (m/s).

    The excess is relative, 0 within all limits; angular acceleration counts but at the start, which is given.
    By the trapezoidal rule, mass (kg) from that at the start by the rocket equation.
    """
    h = duration / float(SAMPLES - 1)
    spent = 0.0
    before = 0.0
    excess = 0.0
    for k in range(SAMPLES):
        size, d, _, bend = thrust_along(c, float(k) * h, duration, lift)
        if k > 0:
            spent = spent + 0.5 * h * (before + size)
            swing = norm(cross(d, bend)) / limits[LARGEST_SWING] - 1.0
            if swing > excess:
                excess = swing
        before = size
        force = mass * exp(-clip(spent / limits[EXHAUST_SPEED], 0.0, 700.0)) * size
        over = force / limits[LARGEST_THRUST] - 1.0
        if over > excess:
            excess = over
        under = 1.0 - force / limits[LEAST_THRUST]
        if under > excess:
            excess = under
        if spent + EXCESS_PRICE * excess > bearable:
            return spent, excess
    return spent, excess


def capture(
    place: Vector3,
    speed: Vector3,
    acceleration: Vector3,
    jerk: Vector3,
    goal: Vector3,
    lift: Vector3,
    mass: float,
    limits: list,
    c: list,
) -> tuple[float, float, float]:
    """c[24] = the transfer from flight to rest at goal that takes least thrust, with a price on limits exceeded.

    Returns its duration (s), 0 where there is none that is finite, and what `expense` says of it.
    """
    trial = [0.0] * TRANSFER
    best = 0.0
    minimum = math.inf
    spent_best = 0.0
    excess_best = 0.0
    duration = FIRST
    for _ in range(TRIALS):
        transfer(place, speed, acceleration, jerk, goal, duration, trial)
        spent, excess = expense(trial, duration, lift, mass, limits, minimum)
        price = spent + EXCESS_PRICE * excess
        if price < minimum:
            minimum = price
            best = duration
            spent_best = spent
            excess_best = excess
            for i in range(TRANSFER):
                c[i] = trial[i]
        duration = GROWTH * duration
    return best, spent_best, excess_best
