"""Transfers to rest by polynomials of degree 7, and the thrust that flies them. Kernel functions.

A transfer is a list of 24 coefficients (m), axis by axis, of the position over s = t/duration; it is meant from 0 to
duration. Its thrust over mass is the acceleration less gravity: f = r'' + lift, with lift = -gravity (m/s2), constant
over the transfer. Frame: any that does not rotate. Equations: docs/systems/hover_transfer.md.
"""

import math

from ...kernel.functions import exp
from ...kernel.records import Field, Record
from ..vectors import Vector3, clip, cross, dot, norm, vector

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


class TransferLimits(Record):
    """What a transfer should keep to, and the engine that flies it."""

    maximum_thrust = Field(unit="N", description="largest thrust")
    minimum_thrust = Field(unit="N", description="least thrust")
    angular_acceleration = Field(unit="rad/s2", description="largest of the thrust's direction")
    exhaust_speed = Field(unit="m/s", description="of the engine")


class ThrustAlong(Record):
    """Thrust over mass at a time of a transfer."""

    size = Field(unit="m/s2", description="thrust over mass")
    direction = Field(Vector3, unit="1", description="unit vector")
    rate = Field(Vector3, unit="1/s", description="first derivative of the direction")
    bend = Field(Vector3, unit="1/s2", description="its second derivative")


class Expense(Record):
    """What a transfer takes."""

    impulse = Field(unit="m/s", description="integral of thrust over mass")
    excess = Field(unit="1", description="largest relative excess over a limit, 0 within all of them")


class Capture(Record):
    """The transfer that a capture flies."""

    duration = Field(unit="s", description="duration; 0: there is no transfer that is finite")
    expense = Field(Expense, description="what it takes")


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


def thrust_along(c: list, t: float, duration: float, lift: Vector3) -> ThrustAlong:
    """Thrust at the time t (s).

    Where there is no thrust, the direction is that of lift, at rest.
    """
    f = derivative(c, 2, t, duration) + lift
    size = norm(f)
    if size == 0.0:
        rest = vector(0.0, 0.0, 0.0)
        weight = norm(lift)
        if weight == 0.0:
            return ThrustAlong(size=0.0, direction=vector(0.0, 0.0, 1.0), rate=rest, bend=rest)
        return ThrustAlong(size=0.0, direction=lift / weight, rate=rest, bend=rest)
    jerk = derivative(c, 3, t, duration)
    snap = derivative(c, 4, t, duration)
    d = f / size
    rate = (jerk - dot(jerk, d) * d) / size
    bend = (snap - (dot(d, snap) + dot(rate, jerk)) * d - 2.0 * dot(jerk, d) * rate) / size
    return ThrustAlong(size=size, direction=d, rate=rate, bend=bend)


def slow_duration(way: float, speed: float, acceleration: float) -> float:
    """Duration (s) of a transfer from rest over a way (m), within a speed and an acceleration, both > 0."""
    time = SHORTEST
    if FASTEST * way / speed > time:
        time = FASTEST * way / speed
    accelerating = math.sqrt(HARDEST * way / acceleration)
    if accelerating > time:
        time = accelerating
    return time


def expense(c: list, duration: float, lift: Vector3, mass: float, limits: TransferLimits, bearable: float) -> Expense:
    """What a transfer takes, as far as it is not dearer than ``bearable`` (m/s).

    Angular acceleration counts but at the start, which is given. By the trapezoidal rule, mass (kg) from that at the
    start by the rocket equation.
    """
    h = duration / float(SAMPLES - 1)
    spent = 0.0
    before = 0.0
    excess = 0.0
    for k in range(SAMPLES):
        thrust = thrust_along(c, float(k) * h, duration, lift)
        if k > 0:
            spent = spent + 0.5 * h * (before + thrust.size)
            swing = norm(cross(thrust.direction, thrust.bend)) / limits.angular_acceleration - 1.0
            if swing > excess:
                excess = swing
        before = thrust.size
        force = mass * exp(-clip(spent / limits.exhaust_speed, 0.0, 700.0)) * thrust.size
        over = force / limits.maximum_thrust - 1.0
        if over > excess:
            excess = over
        under = 1.0 - force / limits.minimum_thrust
        if under > excess:
            excess = under
        if spent + EXCESS_PRICE * excess > bearable:
            return Expense(impulse=spent, excess=excess)
    return Expense(impulse=spent, excess=excess)


def capture(
    place: Vector3,
    speed: Vector3,
    acceleration: Vector3,
    jerk: Vector3,
    goal: Vector3,
    lift: Vector3,
    mass: float,
    limits: TransferLimits,
    c: list,
) -> Capture:
    """c[24] = the transfer from flight to rest at goal that takes least thrust, with a price on limits exceeded."""
    trial = [0.0] * TRANSFER
    best = Capture(duration=0.0, expense=Expense(impulse=0.0, excess=0.0))
    minimum = math.inf
    duration = FIRST
    for _ in range(TRIALS):
        transfer(place, speed, acceleration, jerk, goal, duration, trial)
        spent = expense(trial, duration, lift, mass, limits, minimum)
        price = spent.impulse + EXCESS_PRICE * spent.excess
        if price < minimum:
            minimum = price
            best = Capture(duration=duration, expense=spent)
            for i in range(TRANSFER):
                c[i] = trial[i]
        duration = GROWTH * duration
    return best
