"""Transfers to rest by polynomials of degree 7, and the thrust that the transfers require. Kernel functions.

A transfer is the position as a polynomial in s = t/duration for t from 0 to duration. Its thrust over mass is the
acceleration minus gravity: f = r'' + lift, with lift = -gravity (m/s2), constant over the transfer.

Frame: any non-rotating frame. Equations: docs/systems/hover_transfer.md.
"""

import math

from ...kernel.functions import exp
from ...kernel.records import Field, Record
from ..vectors import Vector3, clip, cross, dot, norm, vector

SAMPLES = 41  # points of a transfer at which its limits are evaluated

# Largest speed and acceleration from rest to rest over a distance D, in D/T and D/T^2: r' = 140 s^3 (1 - s)^3 D/T.
FASTEST = 2.1875
HARDEST = 7.5132
SHORTEST = 10.0  # s, least duration of a transfer from rest

# Durations tried for a capture: FIRST GROWTH^k, k < TRIALS.
FIRST = 8.0  # s
GROWTH = 1.02
TRIALS = 150
EXCESS_PRICE = 1000.0  # m/s, penalty on a limit exceeded by 100 %


class Transfer(Record):
    """Position as a polynomial c0 + c1 s + ... + c7 s^7."""

    c0 = Field(
        Vector3,
        unit="m",
        frozen=True,
        description="constant term of the position polynomial: start position relative to the landing site",
    )
    c1 = Field(Vector3, unit="m", frozen=True, description="coefficient of s^1 of the position, s = 0 to 1")
    c2 = Field(Vector3, unit="m", frozen=True, description="coefficient of s^2 of the position, s = 0 to 1")
    c3 = Field(Vector3, unit="m", frozen=True, description="coefficient of s^3 of the position, s = 0 to 1")
    c4 = Field(Vector3, unit="m", frozen=True, description="coefficient of s^4 of the position, s = 0 to 1")
    c5 = Field(Vector3, unit="m", frozen=True, description="coefficient of s^5 of the position, s = 0 to 1")
    c6 = Field(Vector3, unit="m", frozen=True, description="coefficient of s^6 of the position, s = 0 to 1")
    c7 = Field(Vector3, unit="m", frozen=True, description="coefficient of s^7 of the position, s = 0 to 1")


class TransferLimits(Record):
    """Limits of a transfer and exhaust speed of the engine."""

    maximum_thrust = Field(unit="N", description="largest thrust of the engine in a transfer")
    minimum_thrust = Field(unit="N", description="least thrust of the engine in a transfer")
    angular_acceleration = Field(unit="rad/s2", description="largest angular acceleration of the thrust direction")
    exhaust_speed = Field(unit="m/s", description="exhaust speed of the engine")


class ThrustAlong(Record):
    """Thrust over mass at a point of a transfer, with its rate."""

    size = Field(unit="m/s2", description="thrust over mass")
    direction = Field(Vector3, unit="1", description="thrust direction, unit vector")
    rate = Field(Vector3, unit="1/s", description="first time derivative of the thrust direction")
    bend = Field(Vector3, unit="1/s2", description="second time derivative of the thrust direction")


class Expense(Record):
    """Impulse of a transfer, and violation of its limits."""

    impulse = Field(unit="m/s", description="time integral of thrust over mass")
    excess = Field(unit="1", description="largest relative excess over a limit; 0: within all limits")


class Capture(Record):
    """Transfer of a capture, with duration and expense."""

    duration = Field(unit="s", description="duration of the transfer; 0: no finite transfer exists")
    expense = Field(Expense, description="expense of the transfer")
    transfer = Field(Transfer, description="polynomial of the transfer")


def transfer(
    position: Vector3, speed: Vector3, acceleration: Vector3, jerk: Vector3, goal: Vector3, duration: float
) -> Transfer:
    """Return the transfer from a position (m), velocity, acceleration and jerk to rest at ``goal``.

    The jerk at the end is 0.
    """
    v = speed * duration
    a = 0.5 * acceleration * duration * duration
    j = jerk * duration * duration * duration / 6.0
    # end values, with derivatives by s, minus the contributions of the first four terms
    e0 = goal - position - v - a - j
    e1 = -v - 2.0 * a - 3.0 * j
    e2 = -2.0 * a - 6.0 * j
    e3 = -6.0 * j
    return Transfer(
        c0=position,
        c1=v,
        c2=a,
        c3=j,
        c4=35.0 * e0 - 15.0 * e1 + 2.5 * e2 - e3 / 6.0,
        c5=-84.0 * e0 + 39.0 * e1 - 7.0 * e2 + 0.5 * e3,
        c6=70.0 * e0 - 34.0 * e1 + 6.5 * e2 - 0.5 * e3,
        c7=-20.0 * e0 + 10.0 * e1 - 2.0 * e2 + e3 / 6.0,
    )


def transfer_position(c: Transfer, t: float, duration: float) -> Vector3:
    """Return the position (m) at time t (s)."""
    s = t / duration
    return ((((((c.c7 * s + c.c6) * s + c.c5) * s + c.c4) * s + c.c3) * s + c.c2) * s + c.c1) * s + c.c0


def transfer_velocity(c: Transfer, t: float, duration: float) -> Vector3:
    """Return the velocity (m/s) at time t (s)."""
    s = t / duration
    high = ((7.0 * c.c7 * s + 6.0 * c.c6) * s + 5.0 * c.c5) * s + 4.0 * c.c4
    return (((high * s + 3.0 * c.c3) * s + 2.0 * c.c2) * s + c.c1) / duration


def transfer_acceleration(c: Transfer, t: float, duration: float) -> Vector3:
    """Return the acceleration (m/s2) at time t (s)."""
    s = t / duration
    high = ((42.0 * c.c7 * s + 30.0 * c.c6) * s + 20.0 * c.c5) * s + 12.0 * c.c4
    return ((high * s + 6.0 * c.c3) * s + 2.0 * c.c2) / duration / duration


def transfer_jerk(c: Transfer, t: float, duration: float) -> Vector3:
    """Return the jerk (m/s3) at time t (s)."""
    s = t / duration
    high = ((210.0 * c.c7 * s + 120.0 * c.c6) * s + 60.0 * c.c5) * s + 24.0 * c.c4
    return (high * s + 6.0 * c.c3) / duration / duration / duration


def transfer_snap(c: Transfer, t: float, duration: float) -> Vector3:
    """Return the time derivative of the jerk (m/s4) at time t (s)."""
    s = t / duration
    high = ((840.0 * c.c7 * s + 360.0 * c.c6) * s + 120.0 * c.c5) * s + 24.0 * c.c4
    return high / duration / duration / duration / duration


def thrust_along(c: Transfer, t: float, duration: float, lift: Vector3) -> ThrustAlong:
    """Return the thrust over mass at time t (s).

    Without thrust, the direction is the direction of lift, and its rate is 0.
    """
    f = transfer_acceleration(c, t, duration) + lift
    size = norm(f)
    if size == 0.0:
        rest = vector(0.0, 0.0, 0.0)
        weight = norm(lift)
        if weight == 0.0:
            return ThrustAlong(size=0.0, direction=vector(0.0, 0.0, 1.0), rate=rest, bend=rest)
        return ThrustAlong(size=0.0, direction=lift / weight, rate=rest, bend=rest)
    jerk = transfer_jerk(c, t, duration)
    snap = transfer_snap(c, t, duration)
    d = f / size
    rate = (jerk - dot(jerk, d) * d) / size
    bend = (snap - (dot(d, snap) + dot(rate, jerk)) * d - 2.0 * dot(jerk, d) * rate) / size
    return ThrustAlong(size=size, direction=d, rate=rate, bend=bend)


def slow_duration(way: float, speed: float, acceleration: float) -> float:
    """Return the duration (s) of a transfer from rest over a distance (m) within a speed and an acceleration (> 0)."""
    time = SHORTEST
    if FASTEST * way / speed > time:
        time = FASTEST * way / speed
    accelerating = math.sqrt(HARDEST * way / acceleration)
    if accelerating > time:
        time = accelerating
    return time


def expense(
    c: Transfer, duration: float, lift: Vector3, mass: float, limits: TransferLimits, bearable: float
) -> Expense:
    """Return the expense of a transfer; the evaluation stops once it exceeds ``bearable`` (m/s).

    The prescribed angular acceleration at the start is not counted. Integrals are computed by the trapezoidal rule, the
    mass (kg) by the rocket equation from its initial value.
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
    position: Vector3,
    speed: Vector3,
    acceleration: Vector3,
    jerk: Vector3,
    goal: Vector3,
    lift: Vector3,
    mass: float,
    limits: TransferLimits,
) -> Capture:
    """Return the transfer to rest at goal with the least impulse plus a penalty for violated limits."""
    quickest = transfer(position, speed, acceleration, jerk, goal, FIRST)
    best = Capture(duration=0.0, expense=Expense(impulse=0.0, excess=0.0), transfer=quickest)
    minimum = math.inf
    duration = FIRST
    for _ in range(TRIALS):
        trial = transfer(position, speed, acceleration, jerk, goal, duration)
        spent = expense(trial, duration, lift, mass, limits, minimum)
        price = spent.impulse + EXCESS_PRICE * spent.excess
        if price < minimum:
            minimum = price
            best = Capture(duration=duration, expense=spent, transfer=trial)
        duration = GROWTH * duration
    return best
