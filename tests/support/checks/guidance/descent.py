"""Truths of descent laws with engine limits: profiles by linear equations, times by searches over numpy arrays.

Masses are 1 kg, so that thrusts are accelerations. Adopted from the blocks: the conditions under which a time is
chosen, checked and counted down, and the steps of the search.
"""

import numpy as np
from numpy.polynomial import Polynomial

from tests.support.checks.guidance.certain_time import effort_slope
from tests.support.checks.guidance.terminal import CLAMPED, GOOD, NO_SOLUTION, STEP, Solution
from tests.support.descent.polynomial_laws import EXHAUST, Leg, Limits
from tests.support.flights.linear_thrust import (
    GRAVITY,
    TARGET,
    balance_polynomial,
    balance_roots,
    impulse_and_miss,
    positive_roots,
)

HOLD = 1.5 * STEP  # s; the last command
CHECKED_ABOVE = 10.0  # s
LIMITS = Limits(mass=1.0, maximum=5.6, minimum=0.55)
ENGINE = {"maximum_thrust": LIMITS.maximum, "minimum_thrust": LIMITS.minimum, "sample_period": STEP}


def leg_of(position, velocity):
    return Leg(np.asarray(position), np.asarray(velocity), TARGET, GRAVITY, round_moon=False)


def effort_time(position, velocity, weight=0.0):
    """Return time of least effort and ``weight`` times the time; 0 at the target."""
    slope = effort_slope(position, velocity) + Polynomial([0.0, 0.0, 0.0, 0.0, 2.0 * weight])
    if not slope.coef[:3].any():
        return 0.0
    return next((root for root in positive_roots(slope, 4) if slope.deriv()(root) > 0.0), 0.0)


def first_time(position, velocity):
    """Return time of about constant thrust where that brakes, else of least effort."""
    balance = balance_polynomial(position, velocity, 3)
    roots = balance_roots(position, velocity, 3) if balance.coef[0] != 0.0 else []
    falling = [root for root in roots if balance.deriv()(root) < 0.0]
    if falling:
        brakes = np.dot(*impulse_and_miss(position, velocity, falling[0])) > 0.0
        if brakes and effort_slope(position, velocity)(falling[0]) <= 0.0:
            return falling[0]
    return effort_time(position, velocity)


def glide_margin(position, slope):
    offset = np.asarray(position) - TARGET
    return offset[2] + 5.0 - np.tan(slope) * np.hypot(offset[0], offset[1])


def command(leg, time, shape):
    """Return size of Simpson's mean over the burn, direction now, and its mean rate across."""
    span = time if time <= HOLD else STEP
    now, middle, end = leg.thrust(time, shape, 1.0 - np.array([0.0, 0.5, 1.0]) * span / time)
    direction = now / np.linalg.norm(now)
    change = end - now
    rate = (change - (change @ direction) * direction) / (span * np.linalg.norm(now))
    return np.linalg.norm(now + 4.0 * middle + end) / 6.0, direction, rate


def check_plan(leg, memory, limits, shape):
    """Note what the rest of the profile breaks and takes, at the time in memory."""
    memory["checked"], memory["limit"] = memory["time"], 0
    if memory["time"] > 0.0:
        impulse = limits.measure(leg, memory["time"], shape)[0]
        memory["propellant"] = limits.mass * -np.expm1(-impulse / EXHAUST)
        memory["limit"] = int(limits.broken(leg, memory["time"], shape))


def polynomial_law(choose, limits, update=None):
    """Return the law of a function ``choose`` of the leg and memory, which gives the time and the shape.

    ``update`` gives a later time of its own; without it the time is counted down, and chosen where thrust is short.
    """
    spent = {}

    def law(position, velocity, memory):
        leg = leg_of(position, velocity)
        chosen = memory.get("time", 0.0) > 0.0 or "chosen" in memory
        if not chosen:
            memory["choices"] = memory.get("choices", 0) + 1
            memory["time"], memory["shape"] = choose(leg, memory)
            check_plan(leg, memory, limits, memory["shape"])
            if memory["time"] > 0.0:
                memory["chosen"] = True
        else:
            memory["time"] -= STEP
            if update is not None:
                memory["time"] = update(leg, memory)
            if memory["time"] > CHECKED_ABOVE and memory["checked"] - memory["time"] >= 2.0:
                if update is None and limits.measure(leg, memory["time"], memory["shape"])[1] > 1.0:
                    memory["choices"] += 1
                    memory["time"], memory["shape"] = choose(leg, memory)
                check_plan(leg, memory, limits, memory["shape"])
        spent["propellant"] = memory.get("propellant", spent.get("propellant", 0.0))
        extras = {
            "limit": memory["limit"],
            "choices": memory["choices"],
            "glide_margin": glide_margin(position, limits.glide_slope),
            "predicted_propellant": spent["propellant"],
        }
        if memory["time"] <= 0.0:
            return Solution(0.0, status=NO_SOLUTION if "chosen" not in memory else GOOD, extras=extras)
        status = CLAMPED if memory["limit"] else GOOD
        return Solution(memory["time"], *command(leg, memory["time"], memory["shape"]), status, extras=extras)

    return law
