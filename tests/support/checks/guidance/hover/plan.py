"""Plans to a hover in space: their computation, and outputs after their end."""

from dataclasses import dataclass

import numpy as np

from tests.support.checks.guidance.hover.programme import (
    POLYNOMIAL,
    UNPLANNED,
    VERTICAL,
    WITH_FIRST_BURN,
    WITHOUT_FIRST_BURN,
    Programme,
    least_propellant,
    solve,
)
from tests.support.checks.guidance.hover.transfer import Transfer, capture, slow_transfer
from tests.support.checks.guidance.hover.vehicle import (
    EXHAUST,
    MAXIMUM,
    PLANNED_MAXIMUM,
    PLANNED_MINIMUM,
    SLOW,
    STANDBY,
    SWING,
    vertical,
    weight,
)
from tests.support.flights.hover_equations import flown

IDLE, HOLD, PROGRAMME, SLOWLY, CAPTURE, DESCEND = range(6)  # modes
GOOD, NO_PROGRAMME, BEYOND_LIMITS, NO_PLAN = range(4)
# Of the free times of a programme, and of the one without first burn from which the search for it begins.
GUESSES = {
    VERTICAL: (6.0, 18.0),
    WITHOUT_FIRST_BURN: (2.5, 16.5, 5.5, 18.5),
    WITH_FIRST_BURN: (4.5, 14.0, 0.2, 6.7),
}
FROM = {WITH_FIRST_BURN: (5.5, 12.9, 8.5, 16.8)}


@dataclass
class Plan:
    """Final hold of a flight, and the path to it."""

    goal: np.ndarray
    up: np.ndarray
    status: int = GOOD
    kind: int = UNPLANNED
    path: Programme | Transfer | None = None
    duration: float = 0.0
    propellant: float = 0.0
    times: tuple = (0.0,) * 5

    def motion(self, t):
        return self.path.motion(t) if t < self.duration else (self.goal, np.zeros(3))

    def direction(self, t):
        return self.path.direction(t) if t < self.duration else (self.up, np.zeros(3))

    def angular_rate(self, t):
        return np.cross(*self.direction(t))

    def mean_thrust(self, begin, span, gravity):
        """Return the mean over mass (m/s2); gravity (m/s2) from the end on."""
        left = min(max(self.duration - begin, 0.0), span)
        impulse = self.path.impulse(begin, begin + left) if left > 0.0 else 0.0
        return (impulse + gravity * (span - left)) / span


def plan_transfer(plan, transfer, mass):
    impulse, excess = transfer.expense(mass)
    plan.kind, plan.path, plan.duration = POLYNOMIAL, transfer, transfer.duration
    plan.propellant = mass * (1.0 - np.exp(-impulse / EXHAUST))
    return excess


def plan_programme(plan, observed, gravity, kind):
    """Plan in the plane of start and target, on the target's vertical."""
    up, way = plan.up, plan.goal - observed.position
    y = way @ up
    side = way - y * up
    x = np.linalg.norm(side)
    vehicle = (
        PLANNED_MAXIMUM * MAXIMUM / observed.mass,
        PLANNED_MINIMUM * MAXIMUM / observed.mass,
        EXHAUST,
        gravity,
        SWING,
    )
    assert (kind == VERTICAL) == (x < 1.0)
    origin = observed.position + (side if kind == VERTICAL else 0.0)
    form = min(kind, WITHOUT_FIRST_BURN)
    times = solve(form, FROM.get(kind, GUESSES[kind]), vehicle, x, y)
    if kind == WITH_FIRST_BURN:
        without, times = times, least_propellant(times, GUESSES[kind], vehicle, x, y)
        assert flown(times, vehicle)[4] < flown(without, vehicle)[4]
    plan.kind, plan.times, plan.duration = kind, times, times[4]
    plan.path = Programme(times, vehicle, origin, side / x, up)
    plan.propellant = observed.mass * flown(times, vehicle)[4]


def capture_start(observed, elapsed, lift):
    """Return position and three derivatives, from the thrust measured, or with the engine off that of the weight."""
    force = np.linalg.norm(observed.velocity_increment) / elapsed
    low, high = np.array([PLANNED_MINIMUM, PLANNED_MAXIMUM]) * MAXIMUM / observed.mass
    if force < 0.5 * low:
        force = np.clip(lift @ observed.attitude, low, high)
    jerk = force * np.cross(observed.angular_rate, observed.attitude) + force**2 / EXHAUST * observed.attitude
    return observed.position, observed.velocity, force * observed.attitude - lift, jerk


def make_plan(observed, elapsed, kind):
    """Plan from the block's inputs; ``kind``: the form of a programme, declared with the flight."""
    plan = Plan(observed.target_position, vertical(observed.target_position))
    gravity = 0.5 * (weight(observed.position) + weight(observed.target_position))
    lift = gravity * plan.up
    if observed.mass * gravity >= MAXIMUM:
        plan.goal, plan.status = observed.position, NO_PLAN
    elif observed.mode == PROGRAMME and plan.up @ (plan.goal - observed.position) < 0.0:
        plan_programme(plan, observed, gravity, kind)
    elif observed.mode in (PROGRAMME, SLOWLY):
        plan.status = NO_PROGRAMME if observed.mode == PROGRAMME else GOOD
        limits = STANDBY if observed.mode == PROGRAMME else SLOW
        plan_transfer(plan, slow_transfer(observed.position, plan.goal, plan.up, lift, limits), observed.mass)
    elif observed.mode == CAPTURE:
        start = capture_start(observed, elapsed, lift)
        excess = plan_transfer(plan, capture(start, plan.goal, lift, observed.mass), observed.mass)
        plan.status = BEYOND_LIMITS if excess > 0.0 else GOOD
    return plan
