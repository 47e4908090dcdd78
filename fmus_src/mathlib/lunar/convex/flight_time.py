"""Time of flight of least propellant, by bisection on plans. Kernel functions.

As a function of time, the propellant falls steeply where the thrust does not suffice, then rises slowly. The result is
the shortest time for which a plan is solved, reaches its target and would need more propellant for a longer time. Plans
are expanded about the last solved plan.
"""

from ....kernel.records import Field, Record, replace
from .expansion import DescentTask, PlanSummary, improve_plan, seed_plan

FIRST_HIGH = 1.2  # upper time of a first search, as a multiple of the first time
GROWTH = 1.3
GROWTHS = 5
BISECTIONS = 9
SETTLINGS = 2  # solutions for the upper time before the search
TIME_SLACK = 1.02  # plans use this multiple of the best time, which costs 0.1 % more propellant
REPLAN_LOW = 0.8  # lower time of a new plan, as a fraction of the remaining time
REPLAN_HIGH = 1.5
REPLAN_BISECTIONS = 8
POSITION_TOLERANCE = 1.0  # m
VELOCITY_TOLERANCE = 0.1  # m/s


class TimeBracket(Record):
    """Bounds of the time of flight in a search."""

    time = Field(unit="s", description="time of flight to try next")
    low = Field(unit="s", description="time of flight known to be too short")
    high = Field(unit="s", description="time of flight known to be long enough")
    growths = Field(int, description="number of times that the upper bound may still grow")
    bisections = Field(int, description="number of bisections")


def is_met(s: PlanSummary) -> bool:
    """Return True if a plan ends at its target."""
    return s.solved and s.position_miss < POSITION_TOLERANCE and s.velocity_miss < VELOCITY_TOLERANCE


def is_long_enough(s: PlanSummary) -> bool:
    """Return True if a plan ends at its target and would need more propellant for a longer time."""
    return is_met(s) and s.slope > 0.0


def first_bracket(time: float, lowest: float) -> TimeBracket:
    """Return the bracket of a first plan, from an estimated ``time`` (s) and the fraction ``lowest`` of it."""
    return TimeBracket(time=time, low=lowest * time, high=FIRST_HIGH * time, growths=GROWTHS, bisections=BISECTIONS)


def replan_bracket(time: float) -> TimeBracket:
    """Return the bracket of a new plan with ``time`` (s) to go."""
    return TimeBracket(
        time=time, low=REPLAN_LOW * time, high=REPLAN_HIGH * time, growths=0, bisections=REPLAN_BISECTIONS
    )


def plan_descent(task: DescentTask, bracket: TimeBracket, plan: list) -> PlanSummary:
    """Set a plan for the best time in a bracket, whose upper bound may grow; return its summary with all iterations.

    If no time is long enough, the summary describes the last plan, which is not solved or has the least miss.
    """
    low = bracket.low
    high = bracket.high
    seed_plan(task, high, plan)
    s = improve_plan(task, high, plan)
    iterations = s.iterations
    for _ in range(bracket.growths):
        if not is_long_enough(s):
            low = high
            high = GROWTH * high
            seed_plan(task, high, plan)
            s = improve_plan(task, high, plan)
            iterations = iterations + s.iterations
    if is_long_enough(s):
        for _ in range(bracket.bisections):
            middle = 0.5 * (low + high)
            s = improve_plan(task, middle, plan)
            iterations = iterations + s.iterations
            if is_long_enough(s):
                high = middle
            else:
                low = middle
        for _ in range(SETTLINGS):
            s = improve_plan(task, high, plan)
            iterations = iterations + s.iterations
        s = improve_plan(task, TIME_SLACK * high, plan)
        iterations = iterations + s.iterations
    return replace(s, iterations=iterations)
